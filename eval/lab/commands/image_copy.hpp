// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/recording/recording.hpp"

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// A copy of what a recording gives to methods, images and logs, which programs of others may be
/// given links to: what they change shows. One thread at a time.
class ImageCopy {
 public:
  /// Made in `folder`, which is made too. Throws Error when it cannot be written, or an image is
  /// refused.
  ImageCopy(const Recording& recording, std::filesystem::path folder);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// The first file that is gone or other than it was made; nothing where all are as they were.
  [[nodiscard]] std::optional<std::string> changed() const;

 private:
  void add(const std::string& path, const std::string& bytes);

  std::filesystem::path folder_;
  std::vector<std::pair<std::string, struct stat>> files_;
};

/// Removes a folder with all it holds, folders that may not be written to among them.
void remove_tree(const std::filesystem::path& folder);

}  // namespace mapscore::eval
