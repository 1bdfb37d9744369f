// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>

namespace mapscore::testing {

/// A recording whose scores can be counted by hand: one frame of 8 x 6 pixels; colour and depth
/// camera are one, at (0, 0, 0.15) m, looking along x. A plate (class 1, detected, the rectangle x
/// = 1.01 m, |y| <= 0.1 m, 0.05 m <= z <= 0.25 m) fills columns 2 to 5 of rows 1 to 4, whose points
/// are the centres, in y and z, of 16 voxels of 5 cm; a wall (class 2, not detected) stands behind
/// it at x = 1.51 m.
///
/// Shifted by kOnePixel along the colour camera's x, the plate's points move by one column, and
/// column 2 of its mask shows the wall: 12 of 16 predicted voxels are true, 4 lie on the wall, and
/// 12 of 16 visible ones are found.
void write_plate_recording(const std::filesystem::path& folder);

/// Lines of a study of it: the methods, the lattice that it is counted on, and both doses.
inline constexpr const char* kPlateStudy =
    "recording: plate\n"
    "methods: {direct: {segmentation: {direct: {}}}}\n"
    "map_origin_m: [0, 0, 0]\n"
    "sweep: {'faults.misregistration.translation_m': [[0, 0, 0], [0.05, 0, 0]]}\n";

}  // namespace mapscore::testing
