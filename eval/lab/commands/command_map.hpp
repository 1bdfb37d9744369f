// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/truth/surface_truth.hpp"

#include <filesystem>

namespace mapscore::eval {

/// Reads the map that a command wrote, on the lattice of edge `edge_m`, by the readers of `score`.
/// Classes that `table` does not detect are none. Throws Error when there is no such file of its
/// own, it is refused, or the map lies in another frame than `surface`.
[[nodiscard]] MapSnapshot read_command_map(const std::filesystem::path& file,
                                           const ClassTable& table, double edge_m,
                                           const SurfaceTruth& surface);

}  // namespace mapscore::eval
