// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/recording/stamp_list.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Where the id image of a listed image lies: the same file name below `folder` (`label`,
/// `depth_label`).
[[nodiscard]] std::string sibling_path(const std::string& image, const std::string& folder);

/// All image files of a recording in path order, relative to its folder.
[[nodiscard]] std::vector<std::string> image_paths(const std::vector<StampedImage>& color,
                                                   const std::vector<StampedImage>& depth,
                                                   bool has_truth);

/// An image file and the XXH3 hash of its bytes; a line `hash path` of hashes.txt.
struct HashedFile {
  std::string path, hash;
};
[[nodiscard]] std::string hash_list_text(const std::vector<HashedFile>& files);

/// The images' own hashes, in path order: those of hashes.txt, or, where a recording has none, of
/// the bytes that are there. Throws Error when hashes.txt lists other files than `images`.
[[nodiscard]] std::vector<HashedFile> image_hashes(const std::filesystem::path& folder,
                                                   const std::vector<std::string>& images);

/// Hash over recording.yaml, lists, poses, surfaces, `logs` and images, wherever the folder lies.
/// Throws Error when a file is missing.
[[nodiscard]] std::string content_hash(const std::filesystem::path& folder,
                                       const std::vector<HashedFile>& images,
                                       const std::vector<std::string>& logs = {});

/// Throws Error when a listed path is absolute, holds `..` or passes a link that leads out of the
/// folder: a list from elsewhere must not have files read that were never part of it.
void check_inside(const std::filesystem::path& folder, const std::string& path, const char* mend);

}  // namespace mapscore::eval
