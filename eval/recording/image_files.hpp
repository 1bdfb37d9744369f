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

/// Hash over recording.yaml, lists, poses, surfaces, `logs` and images, wherever the folder lies.
/// The images' own hashes come from hashes.txt, or, where a recording has none, from reading every
/// image; the result is the same. Throws Error when a file is missing or hashes.txt lists other
/// files than `images`.
[[nodiscard]] std::string content_hash(const std::filesystem::path& folder,
                                       const std::vector<std::string>& images,
                                       const std::vector<std::string>& logs = {});

}  // namespace mapscore::eval
