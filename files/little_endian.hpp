// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <bit>
#include <string>
#include <type_traits>

namespace mapscore {

/// Appends a number as binary little-endian files have it.
template <class T>
requires std::is_arithmetic_v<T>
void append_little_endian(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little,
                "the file is written as it lies in memory");
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

}  // namespace mapscore
