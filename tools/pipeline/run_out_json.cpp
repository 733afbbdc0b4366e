// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/run_out_json.hpp"

#include <nlohmann/json.hpp>

#include "tools/pipeline/summary.hpp"

namespace scarp {

using Json = nlohmann::ordered_json;

Json run_out_json(const RunOut& r, const Vec3& origin) {
  const bool moved = r.why_nothing.empty();
  const auto if_moved = [moved](const Json& value) { return moved ? value : Json(nullptr); };
  Json json{{"threshold_m", r.threshold},
            {"moved_volume_m3", r.moved_volume},
            {"moved_share", r.moved_share},
            {"centre_before_m", if_moved(to_json(r.centre_before + origin))},
            {"centre_after_m", if_moved(to_json(r.centre_after + origin))},
            {"footprint_before_m2", if_moved(r.footprint_before)},
            {"footprint_after_m2", if_moved(r.footprint_after)},
            {"footprint_overlap_m2", if_moved(r.footprint_overlap)},
            {"deposit_thickness_largest_m", if_moved(r.deposit_thickness_largest)},
            {"deposit_thickness_mean_m", if_moved(r.deposit_thickness_mean)},
            {"direction", norm(r.direction) > 0 ? to_json(r.direction) : Json(nullptr)}};
  Json why = Json::object();
  if (!moved) why["centre_before_m"] = r.why_nothing;
  if (!r.why_no_direction.empty()) why["direction"] = r.why_no_direction;
  for (const auto& [key, measure] : {std::pair("run_out_m", &r.run_out),
                                     {"crest_drop_m", &r.crest_drop},
                                     {"crest_retreat_m", &r.crest_retreat},
                                     {"travel_angle_deg", &r.travel_angle},
                                     {"deposit_length_m", &r.deposit_length},
                                     {"deposit_width_m", &r.deposit_width}}) {
    json[key] = measure->value ? Json(*measure->value) : Json(nullptr);
    if (!measure->value) why[key] = measure->why_not;
  }
  json["why_null"] = why;
  json["convention"] =
      "of the material points displaced by the threshold or more; run-out: foremost point along the direction, after "
      "minus before; travel angle: from the highest point before to the foremost after; plane strain per metre";
  return json;
}

}  // namespace scarp
