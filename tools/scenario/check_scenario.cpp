// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/check_scenario.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "solver/materials/law.hpp"
#include "tools/scenario/formula.hpp"
#include "tools/scenario/read_values.hpp"
#include "tools/scenario/resolve.hpp"
#include "tools/scenario/schema_kinds.hpp"
#include "tools/scenario/suggest.hpp"

namespace scarp {
namespace {

using Steps = std::vector<std::string>;

Steps operator+(Steps steps, const std::string& step) {
  steps.push_back(step);
  return steps;
}

class Checker {
 public:
  Checker(const Scenario& scenario, const Node& root) : scenario_(scenario), root_(root) {}

  void run() const {
    check_what_is_simulated();
    check_domain();
    check_names("scans", scan_names());
    check_names("bodies", names_of(scenario_.bodies));
    check_names("render", names_of(scenario_.render));
    check_names("probes", names_of(scenario_.probes));
    for (std::size_t i = 0; i < scenario_.scans.size(); ++i) check_scan(i);
    check_materials();
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) check_body(i);
    check_field({"solver", "body_force"}, scenario_.solver.body_force);
    check_unique_fields();
    check_intervals();
    check_run_out();
    for (std::size_t i = 0; i < scenario_.contact.pairs.size(); ++i) check_contact_pair(i);
    for (std::size_t i = 0; i < scenario_.loads.size(); ++i) check_load(i);
    for (std::size_t i = 0; i < scenario_.probes.size(); ++i) check_probe(i);
    check_water();
    check_transfer();
    check_k0();
    for (std::size_t i = 0; i < scenario_.shaking.size(); ++i) check_shaking(i);
    for (std::size_t i = 0; i < scenario_.render.size(); ++i) check_render(i);
    for (std::size_t i = 0; i < scenario_.compare.size(); ++i) check_compare(i);
    check_names("compare", compare_names());
  }

 private:
  bool flat() const { return scenario_.domain.dimension == 2; }

  [[noreturn]] void fail(const Steps& steps, const std::string& what, const std::string& allowed = {}) const {
    refuse(nearest_node(root_, steps), what, allowed);
  }

  /// "bodies.slide.material": as in --set.
  std::string path_of(const Steps& steps) const {
    std::string path;
    const Node* node = &root_;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const Node& next = nearest_node(root_, Steps(steps.begin(), steps.begin() + static_cast<long>(i) + 1));
      const Node* name = node->is_array() ? next.find("name") : nullptr;
      path += (i ? "." : "") + (name && name->is_string() ? shortened(name->text) : shortened(steps[i]));
      node = &next;
    }
    return path;
  }

  template <class List>
  static Steps names_of(const List& list) {
    Steps names;
    for (const auto& entry : list) names.push_back(entry.name);
    return names;
  }
  Steps scan_names() const { return names_of(scenario_.scans); }
  Steps material_names() const {
    Steps names;
    for (const auto& [name, law] : scenario_.materials) names.push_back(name);
    return names;
  }
  Steps compare_names() const {
    Steps names;
    for (const CompareOptions& compare : scenario_.compare)
      names.push_back(compare.name.empty() ? default_name(compare) : compare.name);
    return names;
  }

  /// Names become the stems of files, and two of a kind would overwrite each other.
  void check_names(const std::string& list, const Steps& names) const {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Steps steps{list, std::to_string(i), "name"};
      const std::string& name = names[i];
      const bool is_stem =
          !name.empty() && name.size() <= 100 && name[0] != '.' && std::none_of(name.begin(), name.end(), [](char c) {
            return static_cast<unsigned char>(c) < ' ' || c == 0x7f || c == '/' || c == '\\';
          });
      if (!is_stem)
        fail(steps, list + "." + std::to_string(i) + ".name cannot name a file",
             "1 to 100 characters without slashes, not starting with a dot");
      if (!seen.insert(name).second)
        fail(steps, "two entries of " + list + " are named \"" + name + "\"", "names that differ");
    }
  }

  void check_reference(const Steps& steps, const std::string& name, const std::string& what, const Steps& known) const {
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    fail(steps, path_of(steps) + ": there is no " + what + " of this name" + did_you_mean(name, known),
         known.empty() ? "no " + what + " is defined" : quoted_list(known));
  }

  /// Both corners stand in the table at `steps`.
  void check_corners(const Steps& steps, const Vec3& min, const Vec3& max, int dimension) const {
    for (int a = 0; a < dimension; ++a)
      if (!(min[a] < max[a]))
        fail(steps + "max", path_of(steps + "max") + " must lie above min in " + "xyz"[a], "above " + shortest(min[a]));
  }

  void check_polygon(const Steps& steps, const std::vector<Vec2>& polygon) const {
    if (polygon.size() < 3) fail(steps, path_of(steps) + " is not a polygon", "at least 3 corners");
  }

  /// All that a simulation needs, unless nothing but scans is compared; then there is nothing to draw or to load.
  void check_what_is_simulated() const {
    const bool only_surveys = scenario_.only_surveys();
    Scenario{}.describe([&](std::string_view key, auto&, const Spec& spec) {
      const bool needed = key == "domain" || key == "materials" || key == "bodies" || key == "solver";
      const bool goes_without = key == "title" || key == "scans" || key == "compare";
      if (!only_surveys && needed && !root_.find(key)) refuse_missing(root_, key, spec, "");
      const Node* given = root_.find(key);
      if (only_surveys && !goes_without && given && !given->children.empty())
        fail({std::string(key)},
             "this scenario compares scans only and has no bodies, which \"" + std::string(key) + "\" is about",
             "title, scans, compare");
    });
    if (!only_surveys && scenario_.bodies.empty())
      fail({"bodies"}, "a scenario needs at least one body, or comparisons of two scans only", "[[bodies]]");
  }

  void check_domain() const {
    const DomainOptions& domain = scenario_.domain;
    if (domain.min && domain.max) check_corners({"domain"}, *domain.min, *domain.max, domain.dimension);
    const BoundaryOptions& faces = domain.boundary;
    if (flat() && (faces.z_min != Condition::free || faces.z_max != Condition::free))
      fail({"domain", "boundary", faces.z_min != Condition::free ? "z_min" : "z_max"},
           "plane strain (domain.dimension = 2) has no faces in z", "x_min, x_max, y_min, y_max");
  }

  void check_scan(std::size_t i) const {
    const ScanOptions& scan = scenario_.scans[i];
    const Steps steps{"scans", std::to_string(i)};
    if (scan.file && scan.synthetic)
      fail(steps + "synthetic", path_of(steps) + " has both \"file\" and \"synthetic\"", "one of them");
    if (!scan.file && !scan.synthetic)
      fail(steps, path_of(steps) + " needs a \"file\", or \"synthetic\" to make one", "one of them");
    if (scan.synthetic && scan.shift != Vec3{0, 0, 0})
      fail(steps + "shift", path_of(steps + "shift") + " is for a \"file\"", "synthetic.site_offset");
    for (std::size_t c = 0; c < scan.clean.size(); ++c)
      if (const auto* crop = std::get_if<Crop>(&scan.clean[c]))
        check_corners(steps + "clean" + std::to_string(c), crop->min, crop->max, 3);
  }

  void check_materials() const {
    for (const auto& [name, material] : scenario_.materials) {
      std::visit(
          [&, &key = name](const auto& law) {
            if constexpr (requires { law.friction_angle, law.dilatancy_angle; })
              if (law.dilatancy_angle > law.friction_angle)
                fail({"materials", key, "dilatancy_angle"},
                     "materials." + key + ".dilatancy_angle must not exceed the friction angle",
                     "at most " + shortest(law.friction_angle) + " deg");
          },
          material);
      validate(material, name, location(nearest_node(root_, {"materials", name}).place));
    }
  }

  void check_body(std::size_t i) const {
    const BodyOptions& body = scenario_.bodies[i];
    const Steps steps{"bodies", std::to_string(i)};
    check_reference(steps + "material", body.material, "material", material_names());
    check_points_per_cell(steps + "points_per_cell", body.points_per_cell);
    check_field(steps + "velocity_field", body.velocity_field);
    check_volume(steps + "volume", body.volume);
    check_rigid(steps, body);
    for (std::size_t r = 0; r < body.materials.size(); ++r)
      check_rule(steps + "materials" + std::to_string(r), body.materials[r], body.volume);
  }

  void check_rigid(const Steps& steps, const BodyOptions& body) const {
    if (body.formulation != Formulation::rigid) {
      if (body.rigid) fail(steps + "rigid", path_of(steps + "rigid") + " is for formulation = \"rigid\"");
      return;
    }
    if (!body.rigid)
      fail(steps + "formulation", path_of(steps) + ": formulation = \"rigid\" needs the key \"rigid\"",
           "rigid = { motion = \"fixed\" }, \"given\" or \"free\"");
    if (!body.velocity_field.empty())
      fail(steps + "velocity_field", path_of(steps + "velocity_field") + " is for bodies that deform");
    const RigidOptions& rigid = *body.rigid;
    const Steps at = steps + "rigid";
    if (rigid.axis && flat()) fail(at + "axis", path_of(at + "axis") + ": plane strain has one axis, z");
    if (rigid.axis && norm(*rigid.axis) == 0)
      fail(at + "axis", path_of(at + "axis") + " has no direction", "any length above 0");
    for (std::size_t g = 0; g < rigid.grips.size(); ++g)
      check_reference(at + "grips" + std::to_string(g), rigid.grips[g], "body", names_of(scenario_.bodies));
    check_table(at + "table", rigid.table);
  }

  void check_table(const Steps& steps, const std::vector<Vec2>& table) const {
    for (std::size_t r = 1; r < table.size(); ++r)
      if (!(table[r - 1][0] < table[r][0]))
        fail(steps + std::to_string(r), path_of(steps) + ": times must rise",
             "above " + shortest(table[r - 1][0]) + " s");
  }

  void check_field(const Steps& steps, const std::vector<std::string>& formulas) const {
    if (formulas.empty()) return;
    if (static_cast<int>(formulas.size()) != scenario_.domain.dimension)
      fail(steps, path_of(steps) + " must have one formula per axis",
           std::to_string(scenario_.domain.dimension) + " of them");
    for (std::size_t a = 0; a < formulas.size(); ++a)
      if (const std::string mistake = mistake_in_formula(formulas[a]); !mistake.empty())
        fail(steps + std::to_string(a), path_of(steps) + " is no formula: " + mistake,
             "numbers, X, Y, Z, t, pi, + - * / ^ and functions");
  }

  void check_points_per_cell(const Steps& steps, int points) const {
    if (points == 0) return;
    std::string allowed;
    for (int n = 1; n <= 10; ++n) {
      const int full = flat() ? n * n : n * n * n;
      if (full == points) return;
      allowed += std::to_string(full) + ", ";
    }
    fail(steps, path_of(steps) + " must be a " + (flat() ? "square" : "cube") + " in " + (flat() ? "2D" : "3D"),
         allowed + "... (0 for the default)");
  }

  void need_dimension(const Steps& steps, std::string_view shape, int dimension) const {
    if (scenario_.domain.dimension == dimension) return;
    fail(steps + std::string(shape), path_of(steps) + ": \"" + std::string(shape) + "\" is for " +
                                         std::to_string(dimension) + "D only, and domain.dimension is " +
                                         std::to_string(scenario_.domain.dimension));
  }

  void check_volume(const Steps& steps, const Volume& volume) const {
    if (const auto* scan = std::get_if<ScanVolume>(&volume)) {
      need_dimension(steps, "scan", 3);
      check_scan_volume(steps, *scan);
    } else if (const auto* box = std::get_if<BoxVolume>(&volume)) {
      check_corners(steps + "box", box->box.min, box->box.max, scenario_.domain.dimension);
    } else if (std::holds_alternative<DiskVolume>(volume)) {
      need_dimension(steps, "disk", 2);
    } else if (std::holds_alternative<SphereVolume>(volume)) {
      need_dimension(steps, "sphere", 3);
    } else if (const auto* polygon = std::get_if<PolygonVolume>(&volume)) {
      need_dimension(steps, "polygon", 2);
      check_polygon(steps + "polygon", polygon->polygon);
    } else if (std::holds_alternative<MeshVolume>(volume)) {
      need_dimension(steps, "mesh", 3);
    }
  }

  void check_scan_volume(const Steps& steps, const ScanVolume& volume) const {
    check_reference(steps + "scan", volume.scan, "scan", scan_names());
    for (const auto& [key, close, given] : {std::tuple("depth", Closing::depth, volume.depth.has_value()),
                                            {"base_elevation", Closing::plane, volume.base_elevation.has_value()},
                                            {"base_scan", Closing::surface, volume.base_scan.has_value()}}) {
      const std::string closing = "close = \"" + std::string(name_of(close)) + "\"";
      if (volume.close == close && !given)
        fail(steps, path_of(steps) + ": " + closing + " needs the key \"" + key + "\"");
      if (volume.close != close && given) fail(steps + key, path_of(steps + key) + " is for " + closing);
    }
    if (volume.base_scan) check_reference(steps + "base_scan", *volume.base_scan, "scan", scan_names());
    if (!volume.outline.empty()) check_polygon(steps + "outline", volume.outline);
  }

  void check_rule(const Steps& steps, const MaterialRule& rule, const Volume& volume) const {
    const std::string& use = std::visit([](const auto& r) -> const std::string& { return r.use; }, rule);
    check_reference(steps + "use", use, "material", material_names());
    if (const auto* box = std::get_if<BoxRule>(&rule))
      check_corners(steps + "box", box->box.min, box->box.max, scenario_.domain.dimension);
    if (const auto* prism = std::get_if<PrismRule>(&rule)) check_polygon(steps + "prism", prism->prism);
    if (std::holds_alternative<BelowRule>(rule)) need_dimension(steps, "below", 3);
    if (std::holds_alternative<ClassRule>(rule) && !std::holds_alternative<ScanVolume>(volume))
      fail(steps + "class", path_of(steps) + ": classes come from scan points, and this body has no scan",
           "a body whose volume is a scan");
  }

  void check_region(const Steps& steps, const LoadRegion& region) const {
    if (!region.box && !region.face && !region.body)
      fail(steps, path_of(steps) + " must say where", "at least one of \"box\", \"face\" and \"body\"");
    for (int a = 0; region.box && a < scenario_.domain.dimension; ++a)  // a flat box names a plane of nodes
      if (!(region.box->min[a] <= region.box->max[a]))
        fail(steps + "box" + "max", path_of(steps + "box" + "max") + " must not lie below min in " + "xyz"[a],
             "at least " + shortest(region.box->min[a]));
    if (region.face && flat() && static_cast<int>(*region.face) >= 4)
      fail(steps + "face", path_of(steps + "face") + ": plane strain has no faces in z", "x_min, x_max, y_min, y_max");
    if (region.body) check_reference(steps + "body", *region.body, "body", names_of(scenario_.bodies));
  }

  void check_contact_pair(std::size_t i) const {
    const ContactPairOptions& pair = scenario_.contact.pairs[i];
    const Steps steps{"contact", "pairs", std::to_string(i)};
    if (pair.bodies.empty() == pair.materials.empty())
      fail(steps, path_of(steps) + " must have one of \"bodies\" and \"materials\"");
    const bool of_bodies = !pair.bodies.empty();
    const std::string key = of_bodies ? "bodies" : "materials";
    const Steps& names = of_bodies ? pair.bodies : pair.materials;
    if (names.size() != 2) fail(steps + key, path_of(steps + key) + " must be two names", "[\"a\", \"b\"]");
    for (std::size_t k = 0; k < 2; ++k)
      check_reference(steps + key + std::to_string(k), names[k], of_bodies ? "body" : "material",
                      of_bodies ? names_of(scenario_.bodies) : material_names());
    if (of_bodies && names[0] == names[1] && !scenario_.contact.self_contact)
      fail(steps + key, path_of(steps + key) + ": a body does not meet itself",
           "two bodies, or contact.self_contact = true");
  }

  void check_load(std::size_t i) const {
    const LoadOptions& load = scenario_.loads[i];
    const Steps steps{"loads", std::to_string(i)};
    check_region(steps + "where", load.where);
    if (load.velocity.has_value() + load.displacement.has_value() + load.traction.has_value() +
            load.force.has_value() !=
        1)
      fail(steps, path_of(steps) + " must have one of \"velocity\", \"displacement\", \"traction\" and \"force\"");
    if (load.axes.empty() || load.axes.find_first_not_of("xyz") != std::string::npos)
      fail(steps + "axes", path_of(steps + "axes") + " must name axes", "letters of \"xyz\"");
    check_table(steps + "table", load.table);
    if (load.displacement && (load.table.empty() || load.table[0][0] > 0 || load.table[0][1] != 0))
      fail(steps + "table", path_of(steps) + ": a displacement needs a table, which must be 0 at time 0",
           "[[0, 0], ...]");
  }

  void check_probe(std::size_t i) const {
    const Steps where{"probes", std::to_string(i), "where"};
    const ProbeShape& shape = scenario_.probes[i].where;
    const int dimension = scenario_.domain.dimension;
    if (const auto* box = std::get_if<BoxProbe>(&shape))
      check_corners(where + "box", box->box.min, box->box.max, dimension);
    if (const auto* line = std::get_if<LineProbe>(&shape))
      if (line->line.from == line->line.to)
        fail(where + "line" + "to", path_of(where + "line") + " has no length", "ends that differ");
    if (const auto* plane = std::get_if<PlaneProbe>(&shape)) {
      if (norm(plane->plane.normal) == 0)
        fail(where + "plane" + "normal", path_of(where + "plane" + "normal") + " has no direction",
             "any length above 0");
      if (plane->within) check_corners(where + "within", plane->within->min, plane->within->max, dimension);
    }
  }

  void check_down(const Steps& steps) const {
    const auto& gravity = scenario_.solver.gravity;
    if (!gravity) return;
    const int up = scenario_.domain.dimension - 1;
    const double down = -(*gravity)[up];
    if (!(down > 0) || std::abs(norm(*gravity) - down) > 1e-12 * down)
      fail({"solver", "gravity"}, "solver.gravity must point straight down with " + path_of(steps),
           flat() ? "[0, -g]" : "[0, 0, -g]");
  }

  void check_water() const {
    if (!scenario_.water_table) return;
    const WaterTableOptions& water = *scenario_.water_table;
    const Steps steps{"water_table"};
    if (water.elevation.has_value() + !water.line.empty() + water.surface.has_value() != 1)
      fail(steps, "water_table must have one of \"elevation\", \"line\" and \"surface\"");
    if (!water.line.empty()) need_dimension(steps, "line", 2);
    if (water.surface) need_dimension(steps, "surface", 3);
    for (std::size_t i = 1; i < water.line.size(); ++i)
      if (!(water.line[i - 1][0] < water.line[i][0]))
        fail(steps + "line" + std::to_string(i), "water_table.line: x must rise",
             "above " + shortest(water.line[i - 1][0]));
    check_down(steps);
  }

  void check_transfer() const {
    const SolverOptions& solver = scenario_.solver;
    const auto only_with = [&](const char* key, Transfer transfer) {
      fail({"solver", key},
           std::string("solver.") + key + " is for solver.transfer = \"" + std::string(name_of(transfer)) + "\"",
           "not with \"" + std::string(name_of(solver.transfer)) + "\"");
    };
    if (solver.transfer != Transfer::flip && solver.flip != 1) only_with("flip", Transfer::flip);
    if (solver.transfer != Transfer::flip && solver.pic_rate != 0) only_with("pic_rate", Transfer::flip);
    if (solver.transfer == Transfer::apic && solver.reference_update)
      fail({"solver", "reference_update"}, "solver.reference_update does not go with solver.transfer = \"apic\"",
           "\"flip\", \"xpic\"");
    if (solver.transfer != Transfer::xpic && solver.xpic_order) only_with("xpic_order", Transfer::xpic);
  }

  void check_k0() const {
    if (!scenario_.solver.k0) return;
    check_down({"solver", "k0"});
    if (scenario_.solver.gravity_ramp > 0)
      fail({"solver", "gravity_ramp"},
           "solver.gravity_ramp does not go with solver.k0, whose stress bears all of gravity", "0 s");
  }

  void check_shaking(std::size_t i) const {
    const ShakingOptions& shaking = scenario_.shaking[i];
    const Steps steps{"shaking", std::to_string(i)};
    if (norm(shaking.direction) == 0)
      fail(steps + "direction", path_of(steps + "direction") + " has no length", "a vector, as [1, 0]");
    if (shaking.base != scenario_.shaking[0].base)
      fail(steps + "base", path_of(steps) + ": rigid and compliant bases do not mix", "the same for all records");
    if (shaking.base == ShakenBase::rigid) {
      if (shaking.face) fail(steps + "face", path_of(steps + "face") + " is for base = \"compliant\"");
      return;
    }
    const FaceName face = shaking.face.value_or(flat() ? FaceName::y_min : FaceName::z_min);
    if (flat() && static_cast<int>(face) >= 4)
      fail(steps + "face", path_of(steps + "face") + ": plane strain has no faces in z", "x_min, x_max, y_min, y_max");
    const BoundaryOptions& b = scenario_.domain.boundary;
    const Face faces[]{b.x_min, b.x_max, b.y_min, b.y_max, b.z_min, b.z_max};
    if (faces[static_cast<int>(face)].condition != FaceCondition::absorbing)
      fail(steps, path_of(steps) + ": a compliant base needs an absorbing face to come through",
           "domain.boundary." + std::string(name_of(face)) + " = \"absorbing\"");
  }

  void check_unique_fields() const {
    std::set<OutputField> seen;
    for (std::size_t i = 0; i < scenario_.output.fields.size(); ++i)
      if (!seen.insert(scenario_.output.fields[i]).second)
        fail({"output", "fields", std::to_string(i)}, "output.fields names a field twice");
  }

  /// "stress", or "stress.xy" for a component. A tensor without a scalar measure of its own needs a component.
  void check_render_field(const Steps& at, const std::string& field) const {
    Steps shown{"colour", "material", "body", "surface"};
    for (const OutputField known : scenario_.output.fields) shown.emplace_back(name_of(known));
    const std::size_t dot = field.find('.');
    const std::string base = field.substr(0, dot);
    if (std::find(shown.begin(), shown.end(), base) == shown.end()) {
      const Steps all = enumerator_names<OutputField>();
      if (std::find(all.begin(), all.end(), base) != all.end())
        fail(at, path_of(at) + ": the field \"" + base + "\" is not in output.fields", quoted_list(shown));
      fail(at, path_of(at) + " is unknown" + did_you_mean(base, shown), quoted_list(shown));
    }
    const Steps components = components_of(base);
    if (dot == std::string::npos) {
      if (base == name_of(OutputField::deformation_gradient))
        fail(at, path_of(at) + " needs a component of the tensor",
             "\"" + base + ".\" and one of " + quoted_list(components));
      return;
    }
    const std::string component = field.substr(dot + 1);
    if (std::find(components.begin(), components.end(), component) == components.end())
      fail(at, path_of(at) + ": \"" + base + "\" has no component \"" + component + "\"",
           components.empty() ? "\"" + base + "\"" : quoted_list(components));
  }

  /// More would fill a disk, or be a slip of the unit.
  void check_intervals() const {
    constexpr double most_frames = 1e5, most_rows = 1e7;
    const double end = scenario_.solver.end_time;
    const auto refuse_below = [&](const char* key, const std::optional<double>& interval, double most) {
      if (interval && end / *interval > most)
        fail({"output", key}, std::string("output.") + key + " asks for more than " + shortest(most) + " outputs",
             "at least " + shortest(end / most) + " s for this end time");
    };
    refuse_below("every", scenario_.output.every, most_frames);
    refuse_below("history_every", scenario_.output.history_every, most_rows);
  }

  void check_run_out() const {
    const auto& direction = scenario_.output.run_out.direction;
    const Steps at{"output", "run_out", "direction"};
    if (direction && (*direction)[0] == 0 && (flat() || (*direction)[1] == 0))
      fail(at, path_of(at) + " has no horizontal part", flat() ? "x other than 0" : "x or y other than 0");
  }

  void check_compare(std::size_t i) const {
    const CompareOptions& compare = scenario_.compare[i];
    const Steps steps{"compare", std::to_string(i)};
    check_reference(steps + "observed", compare.observed, "scan", scan_names());
    if (!compare.of_frame()) {
      check_reference(steps + "simulated", compare.simulated, "scan, nor a frame \"last\" or \"first\",", scan_names());
      const bool by_rasters = compare.method == CompareMethod::dod || compare.method == CompareMethod::footprint;
      if (!by_rasters && compare.max_distance == 0 && scenario_.domain.cell == 0)
        fail(steps, path_of(steps) + " needs the key \"max_distance\": there is no domain with cells", "above 0 m");
    }
    const NormalSide side = compare.m3c2.orientation;
    if ((side == NormalSide::towards || side == NormalSide::away) && !compare.m3c2.viewpoint)
      fail(steps + "m3c2" + "orientation", path_of(steps + "m3c2" + "orientation") + " needs the key \"viewpoint\"");
  }

  static Steps components_of(const std::string& field) {
    if (field == name_of(OutputField::displacement) || field == name_of(OutputField::velocity)) return {"x", "y", "z"};
    if (field == name_of(OutputField::stress)) return {"xx", "yy", "zz", "xy", "yz", "xz"};
    if (field == name_of(OutputField::deformation_gradient))
      return {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
    return {};
  }

  void check_render(std::size_t i) const {
    const RenderOptions& render = scenario_.render[i];
    const Steps steps{"render", std::to_string(i)};
    check_render_field(steps + "colour" + "field", render.colour.field);
    const auto& range = render.colour.range;
    if (range && !((*range)[0] < (*range)[1]))
      fail(steps + "colour" + "range", path_of(steps + "colour" + "range") + " must rise", "[lowest, highest]");
    for (const auto& [key, pixels] : {std::pair("width", render.width), std::pair("height", render.height)})
      if (pixels % 2 != 0) fail(steps + key, path_of(steps + key) + " must be even (videos need it)", "an even number");
  }

  const Scenario& scenario_;
  const Node& root_;
};

}  // namespace

void check_scenario(const Scenario& scenario, const Node& root) { Checker(scenario, root).run(); }

}  // namespace scarp
