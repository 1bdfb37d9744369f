// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace mapscore::eval {

/// Type of one number in a point cloud file.
struct ScalarType {
  std::size_t size;  ///< bytes
  bool is_real;
  /// The number that lies at `bytes`; `swapped`: in the other byte order than this machine's.
  /// 64-bit integers beyond 2^53 are rounded.
  double (*at)(const char* bytes, bool swapped);
};

template <class Scalar>
[[nodiscard]] double scalar_at(const char* bytes, bool swapped) {
  std::array<char, sizeof(Scalar)> own;
  std::memcpy(own.data(), bytes, sizeof(Scalar));
  if (swapped) std::reverse(own.begin(), own.end());
  Scalar value;
  std::memcpy(&value, own.data(), sizeof(Scalar));
  return static_cast<double>(value);
}

template <class Scalar>
inline constexpr ScalarType kScalar{sizeof(Scalar), std::is_floating_point_v<Scalar>,
                                    scalar_at<Scalar>};

/// A named column of a point cloud, as .ply and .pcd have them.
struct CloudField {
  std::string name;
  ScalarType type;
  std::size_t count = 1;                       ///< numbers a point, of a .pcd
  std::optional<ScalarType> length_type = {};  ///< of a list, of a .ply

  [[nodiscard]] std::size_t bytes() const { return count * type.size; }
  /// One number a point; lists and arrays are passed over.
  [[nodiscard]] bool single() const { return count == 1 && !length_type; }
};

/// What a column says of a point.
enum class Meaning { x, y, z, label, red, green, blue, packed_colour, probability, instance };
inline constexpr std::size_t kMeanings = 10;

/// Numbers of one point, by meaning; those that the file does not have stay 0.
using PointNumbers = std::array<double, kMeanings>;
[[nodiscard]] auto& at(auto& numbers, Meaning meaning) {
  return numbers[static_cast<std::size_t>(meaning)];
}

/// Which column has which meaning, by the names of docs/formats.md (capitals do not matter).
class CloudMeanings {
 public:
  /// Throws Error naming the file: x, y or z missing, a doubled name, a column that has a meaning
  /// and not one number a point, a packed colour of other than 4 bytes.
  CloudMeanings(std::span<const CloudField> fields, const std::filesystem::path& file);

  [[nodiscard]] bool has(Meaning meaning) const { return at(columns_, meaning).has_value(); }
  /// Of a column; nothing for those to pass over.
  [[nodiscard]] std::optional<Meaning> meaning(std::size_t column) const;
  /// Red, green and blue are in [0, 1] rather than 0 to 255.
  [[nodiscard]] bool real_colours() const { return real_colours_; }

 private:
  void take_label_or_colour(std::span<const CloudField> fields);

  std::array<std::optional<std::size_t>, kMeanings> columns_;
  bool real_colours_ = false;
};

/// The number of a column with a meaning, from a binary body. A packed colour counts by its bits,
/// in whichever type of 4 bytes it came.
[[nodiscard]] double number_at(const char* bytes, Meaning meaning, ScalarType type, bool swapped);
/// The same from a word of an ascii body; nothing where it is no number.
[[nodiscard]] std::optional<double> number_of(std::string_view word, Meaning meaning,
                                              ScalarType type);

}  // namespace mapscore::eval
