// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>

namespace mapscore {

/// What FolderLock does while another process holds the folder.
enum class WhenTaken { wait, go_on };

/// Keeps other processes out that lock the same folder, until the destructor or the end of this
/// process (flock). Leaves nothing behind. Where the folder cannot be made or locked it does
/// nothing: whoever then writes there says what is wrong.
class FolderLock {
 public:
  /// Makes the folder when it is not there.
  explicit FolderLock(std::filesystem::path folder, WhenTaken when_taken = WhenTaken::wait);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Another process holds the folder (only without waiting).
  [[nodiscard]] bool taken() const { return taken_; }
  /// This lock holds the folder; not where the file system has no locks.
  [[nodiscard]] bool held() const { return held_; }

 private:
  [[nodiscard]] bool still_named(const std::filesystem::path& folder) const;

  int descriptor_ = -1;
  bool taken_ = false, held_ = false;
};

}  // namespace mapscore
