// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/whole_file.hpp"

#include "core/error.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace mapscore {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file) {
  throw Error(file.string() +
              ": cannot be written; check that its folder exists, may be written to and has free "
              "space");
}

}  // namespace

WholeFile::WholeFile(std::filesystem::path file) : file_(std::move(file)), aside_(file_) {
  aside_ += ".partial";
  lock();
  stream_.open(aside_, std::ios::binary | std::ios::trunc);
}

void WholeFile::lock() {
  while (true) {
    descriptor_ =
        open(aside_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    struct stat opened {
    }, named{};
    if (descriptor_ < 0 || fstat(descriptor_, &opened) != 0 || !S_ISREG(opened.st_mode)) {
      if (descriptor_ >= 0) close(descriptor_);
      refuse(file_);
    }
    while (flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
    }
    // Whoever held the lock before has renamed or removed what was opened here.
    if (lstat(aside_.c_str(), &named) == 0 && named.st_ino == opened.st_ino &&
        named.st_dev == opened.st_dev)
      return;
    close(descriptor_);
  }
}

WholeFile::~WholeFile() {
  std::error_code ignored;
  if (!finished_) std::filesystem::remove(aside_, ignored);
  close(descriptor_);
}

void WholeFile::finish() {
  stream_.close();
  std::error_code failure;
  if (stream_) std::filesystem::rename(aside_, file_, failure);
  finished_ = stream_ && !failure;
  if (!finished_) refuse(file_);
}

void write_whole_file(const std::filesystem::path& file, std::string_view bytes) {
  WholeFile whole(file);
  whole.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  whole.finish();
}

}  // namespace mapscore
