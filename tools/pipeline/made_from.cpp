// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/made_from.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "solver/model/error.hpp"
#include "tools/pipeline/provenance.hpp"
#include "tools/pipeline/summary.hpp"
#include "tools/scenario/write_scenario.hpp"

namespace scarp {
namespace {

using Json = nlohmann::ordered_json;

struct MakerNames {
  const char* section;
  const char* verb;
  const char* artefacts;
};

MakerNames names_of(Maker maker) {
  constexpr std::array<MakerNames, 3> names{
      {{"ingest", "ingest", "clouds/"}, {"discretize", "discretize", "model.hdf"}, {"solver", "solve", "frames/"}}};
  return names[static_cast<std::size_t>(maker)];
}

/// A section's own text: the scenario written with nothing but it.
template <class F>
std::string hash_of(F&& fill) {
  Scenario only;
  fill(only);
  return sha256_of_text(to_toml(only));
}

/// What the artefacts depend on, each section by its hash.
Json sections(const Scenario& scenario, Maker maker) {
  Json hashes{{"scans", hash_of([&](Scenario& only) { only.scans = scenario.scans; })}};
  if (maker == Maker::ingest) return hashes;
  hashes["domain"] = hash_of([&](Scenario& only) { only.domain = scenario.domain; });
  hashes["materials"] = hash_of([&](Scenario& only) { only.materials = scenario.materials; });
  hashes["bodies"] = hash_of([&](Scenario& only) {
    only.domain.dimension = scenario.domain.dimension;
    only.bodies = scenario.bodies;
  });
  if (maker == Maker::discretize) return hashes;
  hashes["solver"] = hash_of([&](Scenario& only) { only.solver = scenario.solver; });
  hashes["loads"] = hash_of([&](Scenario& only) {
    only.domain.dimension = scenario.domain.dimension;
    only.loads = scenario.loads;
  });
  hashes["water_table"] = hash_of([&](Scenario& only) {
    only.domain.dimension = scenario.domain.dimension;
    only.water_table = scenario.water_table;
  });
  hashes["shaking"] = hash_of([&](Scenario& only) {
    only.domain.dimension = scenario.domain.dimension;
    only.shaking = scenario.shaking;
  });
  hashes["output"] = hash_of([&](Scenario& only) { only.output = scenario.output; });
  return hashes;
}

/// A sentence when the artefacts come from another scenario than this one.
std::optional<std::string> changed_since(const Project& project, Maker maker) {
  const MakerNames names = names_of(maker);
  const Json summary = read_summary(project);
  const Json* then = &summary;
  for (const char* key : {"made_from", names.section}) {
    if (!then->is_object() || !then->contains(key)) return std::nullopt;
    then = &then->at(key);
  }
  const Json now = sections(project.scenario, maker);
  for (const auto& [section, hash] : now.items())
    if (then->value(section, Json()) != hash)
      return (project.artefacts.root / names.artefacts).string() + " was made with other keys in \"" + section +
             "\" than the scenario has now; run 'scarp " + names.verb + "' (or 'scarp run') first";
  return std::nullopt;
}

}  // namespace

void record_made_from(const Project& project, Maker maker) {
  Json made_from = read_summary(project).value("made_from", Json::object());
  made_from[names_of(maker).section] = sections(project.scenario, maker);
  record_summary(project, "made_from", made_from);
}

void require_made_from(const Project& project, Maker maker) {
  if (const auto change = changed_since(project, maker)) throw Error("pipeline", *change);
}

void warn_unless_made_from(const Project& project, Maker maker) {
  if (const auto change = changed_since(project, maker)) project.reporter->note("warning: " + *change);
}

}  // namespace scarp
