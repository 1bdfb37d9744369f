// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/map_files/clouds/cloud_fields.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

enum class PcdData { ascii, binary, binary_compressed };

struct PcdHeader {
  std::vector<CloudField> fields;  ///< padding is named `_`
  std::size_t points = 0;
  PcdData data = PcdData::ascii;
  std::size_t bytes = 0;  ///< where the body begins
  std::size_t lines = 0;  ///< up to DATA
};

/// Header of a PCD file, version 0.7, .6 or .5 (without WIDTH, HEIGHT and VIEWPOINT, with COLUMNS
/// for FIELDS). VIEWPOINT is passed over: the points are in the file's frame whatever it says.
/// Throws Error with file and line.
[[nodiscard]] PcdHeader parse_pcd_header(std::string_view bytes, const std::filesystem::path& file);

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<CloudField> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;  ///< in the order of the body
  std::size_t bytes = 0;             ///< where the body begins
  std::size_t lines = 0;             ///< up to end_header
};

/// Header of a PLY file, version 1.0. Throws Error with file and line.
[[nodiscard]] PlyHeader parse_ply_header(std::string_view bytes, const std::filesystem::path& file);

}  // namespace mapscore::eval
