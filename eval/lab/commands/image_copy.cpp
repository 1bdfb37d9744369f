// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/commands/image_copy.hpp"

#include "files/file_bytes.hpp"

#include <set>
#include <system_error>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

bool same(const struct stat& a, const struct stat& b) {
  return a.st_ino == b.st_ino && a.st_size == b.st_size && a.st_mtim.tv_sec == b.st_mtim.tv_sec &&
         a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

std::set<std::string> images_of(const Recording& recording) {
  std::set<std::string> paths;
  for (int index = 0; index < recording.frame_count(); ++index)
    paths.insert({recording.color_path(index), recording.label_path(index)});
  for (int index = 0; index < recording.depth_count(); ++index)
    paths.insert(recording.depth_path(index));
  return paths;
}

}  // namespace

ImageCopy::ImageCopy(const Recording& recording, fs::path folder) : folder_(std::move(folder)) {
  for (const std::string& path : images_of(recording)) add(path, recording.read_image(path));
  if (recording.has_odometry()) add(kOdometryFile, read_file(recording.folder() / kOdometryFile));
  if (recording.has_scans()) add(kScanFile, read_file(recording.folder() / kScanFile));
}

void ImageCopy::add(const std::string& path, const std::string& bytes) {
  const fs::path file = folder_ / path;
  make_folder(file.parent_path());
  write_file(file, bytes);
  fs::permissions(file, fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read);
  struct stat made {};
  stat(file.c_str(), &made);
  files_.emplace_back(path, made);
}

std::optional<std::string> ImageCopy::changed() const {
  for (const auto& [path, made] : files_) {
    struct stat now {};
    if (lstat((folder_ / path).c_str(), &now) != 0 || !same(made, now)) return path;
  }
  return std::nullopt;
}

void remove_tree(const fs::path& folder) {
  std::error_code failed;
  fs::remove_all(folder, failed);
  if (!failed) return;
  constexpr auto kOptions = fs::directory_options::skip_permission_denied;
  fs::permissions(folder, fs::perms::owner_all, failed);
  for (fs::recursive_directory_iterator entry(folder, kOptions, failed), end; entry != end;
       entry.increment(failed))
    if (std::error_code ignored; entry->is_directory(ignored) && !entry->is_symlink(ignored)) {
      fs::permissions(entry->path(), fs::perms::owner_all, ignored);
    }
  fs::remove_all(folder, failed);
}

}  // namespace mapscore::eval
