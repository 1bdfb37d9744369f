// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::sim {

/// How joints of a scene move: a configuration at each of some stamps, and straight lines between
/// them. Joints that it does not name stay where the scene has them.
struct Motion {
  std::string file;                 ///< name of the file that it was read from, without folders
  std::string hash;                 ///< XXH3 (128 bits, hexadecimal) of the file's bytes
  std::vector<std::string> joints;  ///< names of hinges and slides in the scene
  std::vector<double> stamps_s;     ///< ascending
  std::vector<double> values;       ///< by stamp, then joint; radians or metres

  /// Values of the joints at a stamp: linear between rows, those of the first row before it and of
  /// the last after it.
  [[nodiscard]] std::vector<double> at(double stamp_s) const;
};

/// Reads a motion file: CSV, a header `stamp_s,JOINT,...`, then a row of numbers a stamp (see
/// docs/formats.md). Throws Error with file and line when it is missing, a row has another number
/// of columns than the header, a number is not finite, stamps do not ascend, or a joint stands
/// twice.
[[nodiscard]] Motion read_motion(const std::filesystem::path& file);

}  // namespace mapscore::sim
