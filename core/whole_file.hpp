// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

namespace mapscore {

/// A file under construction beside the one whose place it takes: bytes go into FILE.partial, which
/// finish() renames, so that FILE is whole at every moment and a full disk never cuts it. Processes
/// that write one FILE take turns (flock); a FILE.partial that a killed one left is written over,
/// one that is a link or no file is refused. Removed unless finished. One thread at a time.
class WholeFile {
 public:
  /// Waits for other processes. Throws Error naming the file when FILE.partial cannot be made.
  explicit WholeFile(std::filesystem::path file);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// Where the bytes go; what fails here is thrown by finish().
  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// Closes and renames. Throws Error naming the file when anything could not be written.
  void finish();

 private:
  void lock();

  std::filesystem::path file_, aside_;
  int descriptor_ = -1;  ///< holds the lock
  std::ofstream stream_;
  bool finished_ = false;
};

/// All of it at once. Throws Error naming the file.
void write_whole_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace mapscore
