// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "solver/model/ground_motion.hpp"
#include "solver/model/load_options.hpp"
#include "solver/model/math.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

template <>
struct enum_names<ShakenBase> {
  static constexpr std::array<std::pair<std::string_view, ShakenBase>, 2> value{
      {{"rigid", ShakenBase::rigid}, {"compliant", ShakenBase::compliant}}};
};

/// What a record's drift is taken to be: the polynomial in time that fits its velocity best.
enum class Baseline { none, constant, linear, quadratic };
template <>
struct enum_names<Baseline> {
  static constexpr std::array<std::pair<std::string_view, Baseline>, 4> value{{{"none", Baseline::none},
                                                                               {"constant", Baseline::constant},
                                                                               {"linear", Baseline::linear},
                                                                               {"quadratic", Baseline::quadratic}}};
};

enum class AccelerationUnit { metres, centimetres, gravities };
template <>
struct enum_names<AccelerationUnit> {
  static constexpr std::array<std::pair<std::string_view, AccelerationUnit>, 3> value{
      {{"m/s2", AccelerationUnit::metres},
       {"cm/s2", AccelerationUnit::centimetres},
       {"g", AccelerationUnit::gravities}}};
};

/// Where a record was taken, for a compliant base.
enum class RecordPlace { outcrop, incoming };
template <>
struct enum_names<RecordPlace> {
  static constexpr std::array<std::pair<std::string_view, RecordPlace>, 2> value{
      {{"outcrop", RecordPlace::outcrop}, {"incoming", RecordPlace::incoming}}};
};

/// A record of acceleration that shakes the base.
struct ShakingOptions {
  InputFile file;
  ShakenBase base = ShakenBase::rigid;
  Vec3 direction{1, 0, 0};
  double scale = 1;
  double start = 0;
  std::optional<AccelerationUnit> unit;
  Baseline baseline = Baseline::none;
  std::optional<double> high_pass;
  RecordPlace record = RecordPlace::outcrop;
  std::optional<FaceName> face;

  template <class V>
  void describe(V&& v) {
    v("file", file,
      Spec{.text = "the record: PEER AT2 (extension .at2), else CSV with the columns time (s) and acceleration",
           .required = true});
    v("base", base,
      Spec{.text =
               "\"rigid\": the record is the motion of everything that faces and bodies hold, and frames are "
               "relative to it; \"compliant\": it comes as a wave through an absorbing face (Joyner and Chen 1975)"});
    v("direction", direction, Spec{.text = "in which positive acceleration points; its length does not count"});
    v("scale", scale, Spec{.text = "factor of the accelerations"});
    v("start", start, Spec{.text = "when the record begins; all is still before", .unit = "s", .at_least = 0});
    v("unit", unit, Spec{.text = "of the accelerations; default: what the file says, as in \"acceleration (g)\""});
    v("baseline", baseline,
      Spec{.text =
               "drift to take out: the derivative of the polynomial b t, b t + c t^2 or b t + c t^2 + d t^3 that "
               "fits the velocity best by least squares, so a \"constant\", \"linear\" or \"quadratic\" acceleration"});
    v("high_pass", high_pass,
      Spec{.text = "frequency below which motion is filtered out first, by a Butterworth filter of second order that "
                   "runs forwards and backwards (no delay)",
           .unit = "Hz",
           .above = 0});
    v("record", record,
      Spec{.text = "for a compliant base: taken on a free surface of the base's rock, which moves with twice the "
                   "incoming wave, or that wave itself"});
    v("face", face,
      Spec{.text = "for a compliant base: the absorbing face through which it comes; default: the lowest"});
  }
};

}  // namespace scarp
