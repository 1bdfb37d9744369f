// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/map_files/clouds/cloud_fields.hpp"

#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

namespace mapscore::eval {

enum class PcdData { ascii, binary, binary_compressed };

/// A column of a PCD file; padding is named `_`.
struct PcdField {
  CloudField field;       ///< single: COUNT is 1
  std::size_t count = 1;  ///< numbers a point
  [[nodiscard]] std::size_t bytes() const { return count * size_of(field.type); }
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::size_t points = 0;
  PcdData data = PcdData::ascii;
  std::size_t bytes = 0;  ///< where the body begins
  std::size_t lines = 0;  ///< up to DATA
};

/// Header of a PCD file, version 0.7, .6 or .5 (without WIDTH, HEIGHT and VIEWPOINT, with COLUMNS
/// for FIELDS). VIEWPOINT is passed over: the points are in the file's frame whatever it says.
/// Throws Error with file and line.
[[nodiscard]] PcdHeader parse_pcd_header(std::string_view bytes, const std::filesystem::path& file);

}  // namespace mapscore::eval
