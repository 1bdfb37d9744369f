// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>

namespace mapscore::eval {

/// Keeps other processes that lock the same folder waiting until the destructor, or the end of this
/// process (flock). Leaves nothing behind. Where the folder cannot be made or locked it does
/// nothing: whoever then writes there says what is wrong.
class FolderLock {
 public:
  /// Makes the folder when it is not there, and waits for it.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace mapscore::eval
