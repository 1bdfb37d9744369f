// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/map_files/map_file.hpp"

#include <filesystem>

namespace mapscore::eval {

/// Largest index of a voxel, either sign, that maps are read with.
inline constexpr std::int32_t kFarthestIndex = 1'000'000;

/// Voxels of a .csv of `i,j,k[,class[,probability[,instance]]]`, or, by its header, of columns in
/// any order, points `x,y,z` in place of voxels among them. Classes are ids when every one of them
/// is a whole number, else names. Throws Error with file and line, of both rows where a voxel
/// stands twice. In the truth's own table (header with `samples`) a voxel's row is its owner's, the
/// one with samples, else its first.
[[nodiscard]] MapFile read_voxel_csv(const std::filesystem::path& file,
                                     NotFinite not_finite = NotFinite::refuse);

}  // namespace mapscore::eval
