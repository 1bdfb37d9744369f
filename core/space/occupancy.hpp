// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"

#include <optional>
#include <string_view>

namespace mapscore {

/// How one frame changes the occupancy of a voxel, as probabilities, with OctoMap's defaults: the
/// log-odds l = log(p / (1 - p)) of a hit or a miss is added and the sum clamped [R, eq. 9, 10].
/// Single precision, as OctoMap has it. Log-odds of 0 and more are occupied.
struct OccupancyModel {
  double hit = 0.7, miss = 0.4, clamp_min = 0.1192, clamp_max = 0.971;

  static void fields(auto& s, auto&& visit) {
    constexpr Range kOccupied{.low = 0.5, .high = 1, .open_low = true, .open_high = true};
    constexpr Range kFree{.low = 0, .high = 0.5, .open_low = true, .open_high = true};
    const auto probability = [&](auto& p, std::string_view key, std::string_view meaning,
                                 const Range& range) {
      visit(p, Field{.key = key, .meaning = meaning, .range = range, .later = true});
    };
    probability(s.hit, "hit", "carving: occupancy that a point in the voxel says", kOccupied);
    probability(s.miss, "miss", "carving: occupancy that a ray through the voxel says", kFree);
    probability(s.clamp_min, "clamp_min", "carving: least occupancy of a voxel", kFree);
    probability(s.clamp_max, "clamp_max", "carving: greatest occupancy of a voxel", kOccupied);
  }
  bool operator==(const OccupancyModel&) const = default;
};

/// Whether and how rays of the depth image free the space that they pass.
struct Carving {
  bool carve = false;
  OccupancyModel model{};
  std::optional<double> max_range_m{};  ///< rays free no farther and hit nothing beyond

  static void fields(auto& s, auto&& visit) {
    visit(s.carve,
          Field{.key = "carve",
                .meaning = "rays of the depth image free what they pass; default: what is in the "
                           "map is occupied (as the paper)",
                .later = true});
    OccupancyModel::fields(s.model, visit);
    visit(s.max_range_m,
          Field{"max_range_m", "carving: rays end here and hit nothing beyond; default: no limit",
                above(0, 1000)});
  }
  bool operator==(const Carving&) const = default;
};

}  // namespace mapscore
