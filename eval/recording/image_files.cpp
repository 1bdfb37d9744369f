// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/image_files.hpp"

#include "files/file_bytes.hpp"
#include "files/refusal.hpp"
#include "files/text.hpp"

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
  for (std::string hash, path; listed.size() <= images.size() && text >> hash >> path;) {
    hashes.push_back({path, hash});
    listed.push_back(path);
  }
  if (listed != images)
    refuse(file,
           "does not list the images of color.txt and depth.txt; remove it to have the images "
           "hashed anew");
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

std::vector<HashedFile> image_hashes(const std::filesystem::path& folder,
                                     const std::vector<std::string>& images) {
  const std::filesystem::path list = folder / "hashes.txt";
  if (std::filesystem::exists(list)) return read_hash_list(list, images);
  std::vector<HashedFile> hashes;
  for (const std::string& path : images)
    hashes.push_back({path, hash_of(read_file(folder / path))});
  return hashes;
}

std::string content_hash(const std::filesystem::path& folder, const std::vector<HashedFile>& images,
                         const std::vector<std::string>& logs) {
  std::string manifest;  // one line a file: hash, size in bytes, path
  std::vector<std::string> files(std::begin(kTextFiles), std::end(kTextFiles));
  files.insert(files.end(), logs.begin(), logs.end());
  for (const std::string& path : files) {
    if (!std::filesystem::exists(folder / path)) continue;
    const std::string bytes = read_file(folder / path);
    manifest += fmt::format("{} {} {}\n", hash_of(bytes), bytes.size(), path);
  }
  for (const HashedFile& file : images)
    manifest += fmt::format("{} {} {}\n", file.hash, std::filesystem::file_size(folder / file.path),
                            file.path);
  return hash_of(manifest);
}

void check_inside(const std::filesystem::path& folder, const std::string& path, const char* mend) {
  namespace fs = std::filesystem;
  const fs::path relative = path;
  std::error_code unreadable, no_folder;  // whoever reads the file says so
  const fs::path real = fs::weakly_canonical(folder / relative, unreadable);
  const fs::path below = real.lexically_relative(fs::canonical(folder, no_folder));
  const bool climbs = std::ranges::find(relative, "..") != relative.end() ||
                      (!unreadable && !no_folder && (below.empty() || *below.begin() == ".."));
  if (relative.is_absolute() || climbs)
    refuse(folder, "image '{}' leads out of the folder; {}", shown(path), mend);
}

}  // namespace mapscore::eval
