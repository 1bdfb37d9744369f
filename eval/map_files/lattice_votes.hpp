// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/map_files/lattice_map.hpp"

#include <cstddef>

namespace mapscore::eval {

/// What one point, or one finer voxel, says of a voxel of the lattice.
struct LatticeVote {
  std::uint64_t packed_key = 0;
  std::size_t number = 0;  ///< of the vote; settles the order of summation
  double probability = 1.0;
  std::uint32_t instance = 0;
  ClassId class_id = kBackground;
  bool occupied = true;
};

/// Counts the votes by voxel, by the rules of `on_lattice`.
[[nodiscard]] LatticeMap count_votes(std::vector<LatticeVote> votes, bool has_instances);

}  // namespace mapscore::eval
