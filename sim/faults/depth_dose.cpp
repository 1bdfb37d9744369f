// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/depth_dose.hpp"

#include "core/error.hpp"

#include <cmath>
#include <string>

namespace mapscore::sim {

bool is_zero(const DepthDose& dose) {
  bool zero = true;
  DepthDose::fields(dose, [&](const auto& member, const Field& field) {
    if constexpr (std::same_as<decltype(member), const double&>)
      zero = zero && (!field.dose || member == 0.0);
  });
  return zero;
}

void check(const DepthDose& d) try {
  check_ranges(d);
  if (!(d.grazing_from_deg.deg < d.grazing_to_deg.deg))
    throw Error("grazing_from_deg: is not below grazing_to_deg; give a lesser angle");
  if (!(d.range_min_m < d.range_max_m))
    throw Error("range_min_m: is not below range_max_m; give a lesser number");
} catch (const Error& error) {
  throw Error(std::string("depth fault ") + error.what());
}

DepthDose DepthDose::of(DepthPreset preset) {
  DepthDose dose;
  if (preset == DepthPreset::ideal) return dose;
  fields(dose, [](auto& member, const Field& field) {
    if constexpr (std::same_as<decltype(member), double&>)
      if (field.dose) member = 1.0;
  });
  if (preset == DepthPreset::kinect_v1) {
    dose.range_min_m = 0.8;
    dose.range_max_m = 4.0;
  }
  return dose;
}

}  // namespace mapscore::sim
