// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/map_files/legend.hpp"
#include "eval/score/instances/instance_pieces.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/truth/surface_truth.hpp"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace mapscore::eval {

/// Flags that say how a map's file is to be read.
struct MapFlags {
  std::string file, legend, transform;
  bool geometry = false, resample = false, skip_nan = false, trust_frame = false;

  void add_to(CLI::App& verb);
};

/// A map on the lattice of the truth.
struct InputMap {
  MapSnapshot snapshot{{}};
  std::vector<NumberedVoxel> numbers;  ///< of objects; empty where the file has none
  bool geometry = false;               ///< without classes: occupied voxels are of kSurfaceClass
  std::vector<Leftover> leftovers;     ///< labels that mean nothing
  std::string placing;                 ///< in words, how it came onto the lattice
};

/// Reads the map, gives its labels their meaning in `table` and brings it onto the lattice of edge
/// `edge_m`. Throws Error with where and how to mend it.
[[nodiscard]] InputMap read_input_map(const MapFlags& flags, const ClassTable& table,
                                      double edge_m);

/// The labels without meaning in one line, the commonest first.
[[nodiscard]] std::string text_of(const std::vector<Leftover>& leftovers, std::size_t most);

/// Throws Error with the bounds of both when fewer than one occupied voxel in a hundred lies on or
/// beside a surface: then the map lies in another frame. Below one in four it gives a note for the
/// user, else nothing. A map without occupied voxels passes.
[[nodiscard]] std::string check_frame(const MapFlags& flags, const MapSnapshot& map,
                                      const SurfaceTruth& surface);

}  // namespace mapscore::eval
