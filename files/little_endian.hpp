// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace mapscore {

static_assert(std::endian::native == std::endian::little,
              "files are written and read as they lie in memory");

/// Appends a number as binary little-endian files have it.
template <class T>
requires std::is_arithmetic_v<T>
void append_little_endian(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// Takes a number from the front of `bytes`, which must hold one.
template <class T>
requires std::is_arithmetic_v<T>
[[nodiscard]] T take_little_endian(std::string_view& bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  bytes.remove_prefix(sizeof(T));
  return value;
}

}  // namespace mapscore
