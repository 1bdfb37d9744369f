// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/image_files.hpp"

#include "core/error.hpp"
#include "eval/recording/file_bytes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <sstream>

namespace mapscore::eval {
namespace {

constexpr const char* kTextFiles[] = {"recording.yaml",  "color.txt",        "depth.txt",
                                      "groundtruth.txt", "truth/shapes.csv", "truth/triangles.ply",
                                      "truth/poses.csv"};

std::vector<HashedFile> read_hash_list(const std::filesystem::path& file,
                                       const std::vector<std::string>& images) {
  std::istringstream text(read_file(file));
  std::vector<HashedFile> hashes;
  std::vector<std::string> listed;
  for (std::string hash, path; text >> hash >> path;) {
    hashes.push_back({path, hash});
    listed.push_back(path);
  }
  if (listed != images)
    throw Error(
        fmt::format("{}: does not list the images of color.txt and depth.txt; remove it to "
                    "have the images hashed anew",
                    file.string()));
  return hashes;
}

std::vector<HashedFile> hash_images(const std::filesystem::path& folder,
                                    const std::vector<std::string>& images) {
  std::vector<HashedFile> hashes;
  for (const std::string& path : images)
    hashes.push_back({path, hash_of(read_file(folder / path))});
  return hashes;
}

}  // namespace

std::string sibling_path(const std::string& image, const std::string& folder) {
  return folder + "/" + std::filesystem::path(image).filename().string();
}

std::vector<std::string> image_paths(const std::vector<StampedImage>& color,
                                     const std::vector<StampedImage>& depth, bool has_truth) {
  std::vector<std::string> paths;
  for (const StampedImage& image : color) {
    paths.push_back(image.path);
    paths.push_back(sibling_path(image.path, "label"));
  }
  for (const StampedImage& image : depth) {
    paths.push_back(image.path);
    if (has_truth) paths.push_back(sibling_path(image.path, "depth_label"));
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string hash_list_text(const std::vector<HashedFile>& files) {
  std::string text;
  for (const HashedFile& file : files) text += file.hash + " " + file.path + "\n";
  return text;
}

std::string content_hash(const std::filesystem::path& folder,
                         const std::vector<std::string>& images,
                         const std::vector<std::string>& logs) {
  std::string manifest;  // one line a file: hash, size in bytes, path
  std::vector<std::string> files(std::begin(kTextFiles), std::end(kTextFiles));
  files.insert(files.end(), logs.begin(), logs.end());
  for (const std::string& path : files) {
    if (!std::filesystem::exists(folder / path)) continue;
    const std::string bytes = read_file(folder / path);
    manifest += fmt::format("{} {} {}\n", hash_of(bytes), bytes.size(), path);
  }
  const std::filesystem::path list = folder / "hashes.txt";
  const auto hashes =
      std::filesystem::exists(list) ? read_hash_list(list, images) : hash_images(folder, images);
  for (const HashedFile& file : hashes)
    manifest += fmt::format("{} {} {}\n", file.hash, std::filesystem::file_size(folder / file.path),
                            file.path);
  return hash_of(manifest);
}

}  // namespace mapscore::eval
