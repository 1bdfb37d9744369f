// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/map_files/clouds/cloud_fields.hpp"
#include "eval/map_files/map_file.hpp"

#include <cstddef>
#include <filesystem>
#include <string>

namespace mapscore::eval {

/// Where a point stands in its file, for errors.
struct PointPlace {
  std::size_t number = 0;  ///< of the line, or of the point, from 1
  bool is_line = false;
};

/// Collects the points of a cloud and checks their numbers.
class CloudBuilder {
 public:
  /// `most` is how many points will come at most: bounded by the size of the file before it is
  /// given.
  CloudBuilder(const std::filesystem::path& file, const CloudMeanings& meanings,
               NotFinite not_finite, std::size_t most);

  /// Takes one point, or counts it when a coordinate is not finite: nothing else of it is looked at
  /// then. Throws Error with its place when its label is no whole number, its colour or probability
  /// out of range.
  void add(const PointNumbers& numbers, PointPlace place);

  /// Throws Error when points that are not finite came and are to be refused, or when no point is
  /// left.
  [[nodiscard]] MapFile finish();

 private:
  [[noreturn]] void refuse_at(PointPlace place, const std::string& what) const;
  /// Whole number as 32 bits, negative ones in two's complement.
  [[nodiscard]] std::uint32_t whole(double number, const char* what, PointPlace place) const;
  [[nodiscard]] std::uint32_t colour(const PointNumbers& numbers, PointPlace place) const;
  [[nodiscard]] std::uint32_t channel(double number, PointPlace place) const;

  std::filesystem::path file_;
  CloudMeanings meanings_;
  NotFinite not_finite_;
  std::size_t skipped_ = 0;
  MapFile map_;
};

}  // namespace mapscore::eval
