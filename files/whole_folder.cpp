// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/whole_folder.hpp"

#include "files/file_bytes.hpp"
#include "files/refusal.hpp"

#include <unistd.h>

#include <system_error>

namespace mapscore {
namespace {

namespace fs = std::filesystem;

/// Absolute, without `.`, `..` and a closing slash, so that a suffix can be appended.
fs::path normal(const fs::path& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

/// Removes what a crash left, but for the folder itself, which is locked.
void empty(const fs::path& folder) {
  std::error_code ignored;  // making what goes there says what is wrong
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    fs::remove_all(entry.path(), ignored);
}

void check_absent(const fs::path& folder) {
  if (fs::exists(fs::symlink_status(folder)))
    refuse(folder, "exists already; remove it or give another folder");
}

}  // namespace

WholeFolder::WholeFolder(const fs::path& folder)
    : folder_(normal(folder)), partial_(folder_.string() + ".partial") {
  check_absent(folder_);
  // A file or link of that name. Not std::filesystem::remove, which would take the empty folder
  // that another process made a moment ago and locked.
  unlink(partial_.c_str());
  hold_.emplace(partial_, WhenTaken::go_on);
  if (hold_->taken())
    refuse(folder_, "another process is writing it; wait for it, or give another folder");
  std::error_code ignored;  // the other may have finished in between
  if (fs::exists(folder_)) fs::remove_all(partial_, ignored);
  check_absent(folder_);
  empty(partial_);
  make_folder(partial_);
}

WholeFolder::~WholeFolder() {
  std::error_code ignored;
  if (!finished_) fs::remove_all(partial_, ignored);
}

void WholeFolder::finish() {
  check_absent(folder_);
  std::error_code error;
  fs::rename(partial_, folder_, error);
  if (error)
    refuse(folder_, "cannot be renamed from {} ({}); give another folder", partial_.string(),
           error.message());
  finished_ = true;
}

}  // namespace mapscore
