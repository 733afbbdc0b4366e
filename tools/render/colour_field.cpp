// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/colour_field.hpp"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

std::string names_of_fields(const Frame& frame) {
  std::string names;
  for (const FrameField& field : frame.fields) names += (names.empty() ? "" : ", ") + field.name;
  return names.empty() ? "no field at all" : names;
}

const FrameField& need_field(const Frame& frame, const std::string& name, const std::string& what) {
  const FrameField* field = find_field(frame, name);
  if (!field) throw Error("render", what, name, names_of_fields(frame) + " (add it to output.fields)");
  const std::size_t found = std::visit([](const auto& v) { return v.size(); }, field->values);
  if (field->components < 1 || found != frame.positions.size() * static_cast<std::size_t>(field->components))
    throw Error(
        "render", "the field " + name + " has the wrong number of values", std::to_string(found),
        std::to_string(field->components) + " for each of " + std::to_string(frame.positions.size()) + " particles");
  return *field;
}

/// Index of a component by the name after the dot; nothing if there is no such component.
std::optional<int> component_index(const std::string& name, int components) {
  static const std::array<std::string, 9> three{"x", "y", "z"}, six{"xx", "yy", "zz", "xy", "yz", "xz"},
      nine{"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
  if (components == 3 || components == 6 || components == 9) {
    const auto& names = components == 3 ? three : components == 6 ? six : nine;
    for (int i = 0; i < components; ++i)
      if (names[static_cast<std::size_t>(i)] == name) return i;
  }
  int index = -1;
  const auto end = std::from_chars(name.data(), name.data() + name.size(), index);
  if (end.ec == std::errc() && end.ptr == name.data() + name.size() && index >= 0 && index < components) return index;
  return std::nullopt;
}

std::string in_words(std::string name) {
  for (char& c : name)
    if (c == '_') c = ' ';
  if (name.rfind("von mises", 0) == 0) name[4] = 'M';  // a name
  if (!name.empty()) name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

/// Fills values[i] = f(pointer to the components of particle i).
template <class F>
std::vector<float> map_particles(const FrameField& field, std::size_t count, int threads, F&& f) {
  std::vector<float> values(count);
  const std::size_t stride = static_cast<std::size_t>(field.components);
  std::visit(
      [&](const auto& data) {
        parallel_for(count, threads, [&](std::size_t i) { values[i] = static_cast<float>(f(&data[i * stride])); });
      },
      field.values);
  return values;
}

/// sqrt(3 J2), Pa.
double von_mises(const auto* s) {
  const double a = double(s[0]) - s[1], b = double(s[1]) - s[2], c = double(s[2]) - s[0];
  const double shear = double(s[3]) * s[3] + double(s[4]) * s[4] + double(s[5]) * s[5];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * shear);
}

std::vector<std::int32_t> bodies_of(const Frame& frame) {
  const FrameField* const field = find_field(frame, "body");
  const auto* const bodies = field ? std::get_if<std::vector<std::int32_t>>(&field->values) : nullptr;
  return bodies && bodies->size() == frame.positions.size() ? *bodies : std::vector<std::int32_t>{};
}

ColourField whole_field(const Frame& frame, const FrameField& field, int threads) {
  const std::size_t count = frame.positions.size();
  ColourField result{ColourKind::scalar, in_words(field.name), field.unit, {}, {}, {}, bodies_of(frame)};
  if (field.components == 1) {
    result.values = map_particles(field, count, threads, [](const auto* v) { return double(*v); });
  } else if (field.components == 2 || field.components == 3) {
    if (field.name == "velocity") result.label = "Speed";
    const int n = field.components;
    result.values = map_particles(field, count, threads, [n](const auto* v) {
      double sum = 0;
      for (int k = 0; k < n; ++k) sum += double(v[k]) * v[k];
      return std::sqrt(sum);
    });
  } else if (field.components == 6 && field.name == "stress") {
    result.label = "Von Mises stress";
    result.values = map_particles(field, count, threads, [](const auto* v) { return von_mises(v); });
  } else {
    throw Error("render", "a tensor needs a component to be coloured by", field.name, field.name + ".xx and so on");
  }
  return result;
}

ColourField class_field(const Frame& frame, const FrameField& field) {
  if (field.components != 1) throw Error("render", "classes need one value per particle", field.name);
  ColourField result{ColourKind::classes, in_words(field.name), "1", {}, {}, {}, {}};
  result.classes.reserve(frame.positions.size());
  std::visit(
      [&](const auto& data) {
        for (auto v : data) result.classes.push_back(static_cast<std::int32_t>(v));
      },
      field.values);
  return result;
}

ColourField scan_field(const Frame& frame, const FrameField& field) {
  const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&field.values);
  if (!bytes || field.components != 3) throw Error("render", "colours are three bytes per particle", field.name);
  ColourField result{ColourKind::scan, in_words(field.name), "1", {}, {}, {}, {}};
  result.colours.resize(frame.positions.size());
  for (std::size_t i = 0; i < result.colours.size(); ++i)
    result.colours[i] = {(*bytes)[3 * i], (*bytes)[3 * i + 1], (*bytes)[3 * i + 2]};
  return result;
}

}  // namespace

ColourField evaluate_field(const Frame& frame, const std::string& name, int threads) {
  const std::size_t dot = name.rfind('.');
  if (find_field(frame, name) || dot == std::string::npos) {
    const FrameField& field = need_field(frame, name, "no such field to colour by");
    if (name == "colour") return scan_field(frame, field);
    if (name == "material" || name == "body") return class_field(frame, field);
    return whole_field(frame, field, threads);
  }
  const std::string stem = name.substr(0, dot), component = name.substr(dot + 1);
  const FrameField& field = need_field(frame, stem, "no such field to colour by");
  const std::optional<int> index = component_index(component, field.components);
  if (!index)
    throw Error("render", "no such component of " + stem, component,
                field.components == 3   ? "x, y, z"
                : field.components == 6 ? "xx, yy, zz, xy, yz, xz"
                                        : "0 to " + std::to_string(field.components - 1));
  ColourField result{ColourKind::scalar, in_words(stem) + " " + component, field.unit, {}, {}, {}, bodies_of(frame)};
  result.values =
      map_particles(field, frame.positions.size(), threads, [k = *index](const auto* v) { return double(v[k]); });
  return result;
}

const std::vector<float>& displacements(const Frame& frame, const std::string& why) {
  const FrameField& field = need_field(frame, "displacement", why);
  const auto* values = std::get_if<std::vector<float>>(&field.values);
  if (!values || field.components != 3) throw Error("render", "displacement has three components of type float");
  return *values;
}

}  // namespace scarp
