// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Words of `stamp_s tx ty tz qx qy qz qw`.
inline constexpr std::size_t kPoseColumns = 8;

/// One line of a file whose lines begin with a stamp, cut into words.
struct StampedLine {
  std::string file;
  int number = 0;  ///< in the file, from 1
  double stamp_s = 0.0;
  std::vector<std::string> words;  ///< the stamp first

  /// Throws Error "FILE:NUMBER: what".
  [[noreturn]] void refuse(const std::string& what) const;
  /// The word as a finite number; the line must have it. Throws Error.
  [[nodiscard]] double number_at(std::size_t word) const;
  /// Words 1 to 7, tx ty tz qx qy qz qw; the line must have them. Throws Error.
  [[nodiscard]] Pose pose() const;
};

/// What a file of such lines is to hold.
struct LineFormat {
  std::vector<std::size_t> words;  ///< how many a line may have
  std::string text;                ///< the same for people: "expected TEXT"
  std::string mend_empty;          ///< what to do about a file without lines
};

/// Calls `take` with each line but empty ones and those that start with `#`, in the order of the
/// file. One line is held at a time: cut into words it takes some twenty times its bytes. Throws
/// Error with file and line when the file is missing, a line has another number of words, a stamp
/// is none or does not come after the one before, or there is no line.
void read_stamped_lines(const std::filesystem::path& file, const LineFormat& format,
                        const std::function<void(const StampedLine&)>& take);

}  // namespace mapscore::eval
