// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/fields.hpp"
#include "eval/experiment/occupancy_settings.hpp"

namespace mapscore::eval {

void fields(auto&& visit, Of<OccupancySettings> auto& s) {
  constexpr Range kOccupied{.low = 0.5, .high = 1, .open_low = true, .open_high = true};
  constexpr Range kFree{.low = 0, .high = 0.5, .open_low = true, .open_high = true};
  visit(Field{.key = "carve",
              .meaning = "rays of the depth image free what they pass; default: what is in the map "
                         "is occupied (as the paper)",
              .unkeyed = "false"},
        s.carve);
  visit(Field{.key = "hit",
              .meaning = "carving: occupancy that a point in the voxel says",
              .range = kOccupied,
              .unkeyed = "0.7"},
        s.hit);
  visit(Field{.key = "miss",
              .meaning = "carving: occupancy that a ray through the voxel says",
              .range = kFree,
              .unkeyed = "0.4"},
        s.miss);
  visit(Field{.key = "clamp_min",
              .meaning = "carving: least occupancy of a voxel",
              .range = kFree,
              .unkeyed = "0.1192"},
        s.clamp_min);
  visit(Field{.key = "clamp_max",
              .meaning = "carving: greatest occupancy of a voxel",
              .range = kOccupied,
              .unkeyed = "0.971"},
        s.clamp_max);
  visit(Field{"max_range_m", "carving: rays end here and hit nothing beyond; default: no limit",
              above(0, 1000)},
        s.max_range_m);
}

}  // namespace mapscore::eval
