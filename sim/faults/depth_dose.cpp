// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/depth_dose.hpp"

#include "core/error.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace mapscore::sim {
namespace {

using Named = std::pair<const char*, double>;

std::array<Named, 7> doses_of(const DepthDose& d) {
  return {{{"axial", d.axial},
           {"lateral", d.lateral},
           {"quantisation", d.quantisation},
           {"grazing", d.grazing},
           {"shadow", d.shadow},
           {"flying", d.flying},
           {"range", d.range}}};
}

void demand(bool holds, const char* member, const char* problem) {
  if (!holds) throw Error(std::string("depth fault ") + member + ": " + problem);
}

}  // namespace

bool is_zero(const DepthDose& dose) {
  for (const auto& [name, value] : doses_of(dose))
    if (value != 0.0) return false;
  return true;
}

void check(const DepthDose& d) {
  for (const auto& [name, value] : doses_of(d))
    demand(value >= 0.0 && std::isfinite(value), name, "is no dose; give 0 (off) or more");
  const std::array<Named, 4> lengths{{{"axial_base_m", d.axial_base_m},
                                      {"axial_growth_per_m", d.axial_growth_per_m},
                                      {"lateral_px", d.lateral_px},
                                      {"flying_share", d.flying_share}}};
  for (const auto& [name, value] : lengths)
    demand(value >= 0.0 && std::isfinite(value), name, "is negative or no number; give 0 or more");
  demand(d.baseline_m > 0.0 && std::isfinite(d.baseline_m), "baseline_m", "must be above 0");
  demand(d.subpixel_px > 0.0 && std::isfinite(d.subpixel_px), "subpixel_px", "must be above 0");
  demand(d.grazing_from_rad >= 0.0 && d.grazing_from_rad < d.grazing_to_rad, "grazing_from_rad",
         "is not below grazing_to_rad; give a lesser angle");
  demand(d.range_min_m >= 0.0 && d.range_min_m < d.range_max_m, "range_min_m",
         "is not below range_max_m; give a lesser number");
}

DepthDose depth_preset(DepthPreset preset) {
  DepthDose dose;
  if (preset == DepthPreset::ideal) return dose;
  dose.axial = dose.lateral = dose.quantisation = 1.0;
  dose.grazing = dose.shadow = dose.flying = dose.range = 1.0;
  if (preset == DepthPreset::kinect_v1) {
    dose.range_min_m = 0.8;
    dose.range_max_m = 4.0;
  }
  return dose;
}

}  // namespace mapscore::sim
