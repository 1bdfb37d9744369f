// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace mapscore {

FolderLock::FolderLock(std::filesystem::path folder, WhenTaken when_taken) {
  const int operation = LOCK_EX | (when_taken == WhenTaken::go_on ? LOCK_NB : 0);
  while (true) {
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    descriptor_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0) return;
    int outcome = 0;
    do outcome = flock(descriptor_, operation);
    while (outcome != 0 && errno == EINTR);
    taken_ = outcome != 0 && errno == EWOULDBLOCK;
    // Whoever held the lock before may have renamed or removed the folder that was opened here.
    held_ = outcome == 0 && still_named(folder);
    if (outcome != 0 || held_) return;
    close(descriptor_);
  }
}

bool FolderLock::still_named(const std::filesystem::path& folder) const {
  struct stat opened {
  }, named{};
  return fstat(descriptor_, &opened) == 0 && stat(folder.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace mapscore
