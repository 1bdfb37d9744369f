// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "files/folder_lock.hpp"

#include <filesystem>
#include <optional>

namespace mapscore {

/// A folder under construction beside the place it takes: files go into FOLDER.partial, which
/// finish() renames, so that nothing half-written is ever taken for whole. What a killed process
/// left in FOLDER.partial is removed. One process at a time writes a FOLDER. Removed unless
/// finished.
class WholeFolder {
 public:
  /// Throws Error naming the folder when it exists, another process is writing it, or
  /// FOLDER.partial cannot be made.
  explicit WholeFolder(const std::filesystem::path& folder);
  ~WholeFolder();
  WholeFolder(const WholeFolder&) = delete;
  WholeFolder& operator=(const WholeFolder&) = delete;

  /// Absolute, the folder that it becomes.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Where the files go.
  [[nodiscard]] const std::filesystem::path& partial() const { return partial_; }
  /// Renames. Throws Error naming the folder when it exists by now or cannot be renamed.
  void finish();

 private:
  std::filesystem::path folder_, partial_;
  std::optional<FolderLock> hold_;  ///< on `partial_`
  bool finished_ = false;
};

}  // namespace mapscore
