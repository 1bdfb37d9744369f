// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/drivable_floor.hpp"
#include "core/exploration/floor_paths.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace mapscore {

/// Frontiers of the floor (B. Yamauchi, A Frontier-Based Approach for Autonomous Exploration, CIRA
/// 1997): free cells with an unknown neighbour along an edge of the cell, connected through edges
/// and corners; those of at least `least_m`, number of cells times the resolution, by their first
/// cell. `left_out`: cells that are none. Thread-safe.
[[nodiscard]] std::vector<Frontier> find_frontiers(
    const OccupancyGrid& grid, double least_m,
    const std::function<bool(const GridCell&)>& left_out = {});

/// From where a frontier can be looked at.
struct Approach {
  GridCell place;   ///< reached, not farther from the cell than the robot must keep away
  GridCell target;  ///< cell of the frontier
  double way_m = 0.0;
};

/// The place with the shortest way, ties to the earlier cell; nothing where the frontier cannot be
/// reached. `near_m`: how far a place may lie from a cell of the frontier. Thread-safe.
[[nodiscard]] std::optional<Approach> approach(const Frontier& frontier, const OccupancyGrid& grid,
                                               const FloorPaths& paths, double near_m);

}  // namespace mapscore
