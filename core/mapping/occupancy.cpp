// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/occupancy.hpp"

#include "core/error.hpp"

#include <string>

namespace mapscore {
namespace {

void check_between(const char* name, double value, double low, double high, const char* range) {
  if (value > low && value < high) return;
  throw Error(std::string(name) + ": must lie " + range + "; it is a probability of occupancy");
}

}  // namespace

void check(const OccupancyModel& model) {
  constexpr const char* kOccupied = "above 0.5 and below 1";
  constexpr const char* kFree = "above 0 and below 0.5";
  check_between("hit", model.hit, 0.5, 1.0, kOccupied);
  check_between("clamp_max", model.clamp_max, 0.5, 1.0, kOccupied);
  check_between("miss", model.miss, 0.0, 0.5, kFree);
  check_between("clamp_min", model.clamp_min, 0.0, 0.5, kFree);
}

}  // namespace mapscore
