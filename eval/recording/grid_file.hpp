// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/occupancy_grid.hpp"

#include <filesystem>

namespace mapscore::eval {

/// Reads a grid of the ROS map_server: a YAML file and the PGM (P5 or P2, maxval 255) that it
/// names, relative to its own folder. `mode` trinary (default) or scale; see docs/formats.md.
/// Throws Error naming the file, the place and the mend.
[[nodiscard]] OccupancyGrid load_grid(const std::filesystem::path& yaml_file);

/// Writes `yaml_file` and, beside it, the image (P5) of the same name with ending .pgm; both aside
/// and renamed, the image first. A grid of -1, 0 and 100 is written in mode trinary, one with other
/// values in mode scale, which cannot say unknown. load_grid returns the same grid. Throws Error
/// when the grid holds both, when a value is none of -1 to 100, or when a file cannot be written.
void save_grid(const OccupancyGrid& grid, const std::filesystem::path& yaml_file);

}  // namespace mapscore::eval
