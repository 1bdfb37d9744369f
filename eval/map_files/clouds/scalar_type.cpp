// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/clouds/scalar_type.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace mapscore::eval {
namespace {

template <class Scalar>
double take(const char* bytes, bool swapped) {
  std::array<char, sizeof(Scalar)> own;
  std::memcpy(own.data(), bytes, sizeof(Scalar));
  if (swapped) std::reverse(own.begin(), own.end());
  Scalar value;
  std::memcpy(&value, own.data(), sizeof(Scalar));
  return static_cast<double>(value);
}

}  // namespace

std::size_t size_of(ScalarType type) {
  switch (type) {
    case ScalarType::int8:
    case ScalarType::uint8:
      return 1;
    case ScalarType::int16:
    case ScalarType::uint16:
      return 2;
    case ScalarType::int32:
    case ScalarType::uint32:
    case ScalarType::float32:
      return 4;
    case ScalarType::int64:
    case ScalarType::uint64:
    case ScalarType::float64:
      break;
  }
  return 8;
}

bool is_real(ScalarType type) {
  return type == ScalarType::float32 || type == ScalarType::float64;
}

double scalar_at(const char* bytes, ScalarType type, bool swapped) {
  switch (type) {
    case ScalarType::int8:
      return take<std::int8_t>(bytes, swapped);
    case ScalarType::uint8:
      return take<std::uint8_t>(bytes, swapped);
    case ScalarType::int16:
      return take<std::int16_t>(bytes, swapped);
    case ScalarType::uint16:
      return take<std::uint16_t>(bytes, swapped);
    case ScalarType::int32:
      return take<std::int32_t>(bytes, swapped);
    case ScalarType::uint32:
      return take<std::uint32_t>(bytes, swapped);
    case ScalarType::int64:
      return take<std::int64_t>(bytes, swapped);
    case ScalarType::uint64:
      return take<std::uint64_t>(bytes, swapped);
    case ScalarType::float32:
      return take<float>(bytes, swapped);
    case ScalarType::float64:
      break;
  }
  return take<double>(bytes, swapped);
}

}  // namespace mapscore::eval
