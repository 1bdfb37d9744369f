// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/map_files/clouds/scalar_type.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::float32;
  bool is_list = false;
  ScalarType length_type = ScalarType::uint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
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
