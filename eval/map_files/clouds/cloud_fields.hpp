// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/map_files/clouds/scalar_type.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mapscore::eval {

/// A named column of a point cloud, as .ply and .pcd have them.
struct CloudField {
  std::string name;
  ScalarType type = ScalarType::float32;
  bool single = true;  ///< one number a point; lists and arrays are passed over
};

/// What a column says of a point.
enum class Meaning { x, y, z, label, red, green, blue, packed_colour, probability, instance };
inline constexpr std::size_t kMeanings = 10;

/// Numbers of one point, by meaning; those that the file does not have stay 0.
using PointNumbers = std::array<double, kMeanings>;
[[nodiscard]] inline double& at(PointNumbers& numbers, Meaning meaning) {
  return numbers[static_cast<std::size_t>(meaning)];
}
[[nodiscard]] inline double at(const PointNumbers& numbers, Meaning meaning) {
  return numbers[static_cast<std::size_t>(meaning)];
}

/// Which column has which meaning, by the names of docs/formats.md (capitals do not matter).
class CloudMeanings {
 public:
  /// Throws Error naming the file: x, y or z missing, a doubled name, a column that has a meaning
  /// and not one number a point, a packed colour of other than 4 bytes.
  CloudMeanings(std::span<const CloudField> fields, const std::filesystem::path& file);

  [[nodiscard]] std::optional<std::size_t> column(Meaning meaning) const {
    return columns_[static_cast<std::size_t>(meaning)];
  }
  [[nodiscard]] bool has(Meaning meaning) const { return column(meaning).has_value(); }
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
