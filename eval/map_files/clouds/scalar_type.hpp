// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>

namespace mapscore::eval {

/// Type of one number in a point cloud file.
enum class ScalarType : std::uint8_t {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64
};

[[nodiscard]] std::size_t size_of(ScalarType type);
[[nodiscard]] bool is_real(ScalarType type);

/// The number that lies at `bytes`; `swapped`: in the other byte order than this machine's. 64-bit
/// integers beyond 2^53 are rounded.
[[nodiscard]] double scalar_at(const char* bytes, ScalarType type, bool swapped);

}  // namespace mapscore::eval
