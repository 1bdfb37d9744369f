// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/store_trouble.hpp"

#include "core/error.hpp"
#include "files/text.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <string_view>
#include <system_error>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// A descriptor by which this process has the file open; -1 where there is none. The file is not
/// opened for it, since closing it again would drop SQLite's own locks.
int open_descriptor_of(const fs::path& file) {
  struct stat wanted {};
  if (stat(file.c_str(), &wanted) != 0) return -1;
  std::error_code no_proc;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc/self/fd", no_proc)) {
    const int descriptor = std::atoi(entry.path().filename().c_str());
    struct stat found {};
    if (fstat(descriptor, &found) == 0 && found.st_dev == wanted.st_dev &&
        found.st_ino == wanted.st_ino)
      return descriptor;
  }
  return -1;
}

}  // namespace

std::string lock_holder(const fs::path& file) {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = 0x40000000;  // SQLite's file format, section "Locking": a byte pending, a byte
  lock.l_len = 512;           // reserved, 510 bytes shared
  const int descriptor = open_descriptor_of(file);
  if (descriptor < 0 || fcntl(descriptor, F_GETLK, &lock) != 0) return {};
  if (lock.l_type == F_UNLCK || lock.l_pid <= 0) return {};
  std::ifstream stream(fmt::format("/proc/{}/comm", lock.l_pid));
  std::string name;
  std::getline(stream, name);
  return fmt::format("{} (process {})", name.empty() ? "a program" : shown(name), lock.l_pid);
}

std::string store_trouble(int code, const std::string& words, const fs::path& file) {
  const int kind = code & 0xff;
  if (kind == SQLITE_BUSY) {
    const std::string holder = lock_holder(file);
    return fmt::format("result store: locked by {}; wait until it ends, or stop it",
                       holder.empty() ? "another process" : holder);
  }
  if (kind == SQLITE_INTERRUPT)
    return "result store: it would take endless steps to read, so it is damaged; sweep again into "
           "another folder";
  std::error_code ignored;
  if (code == SQLITE_READONLY_DBMOVED || !fs::exists(file, ignored))
    return fmt::format("result store: {} was removed or replaced while in use; start again",
                       fs::exists(file.parent_path(), ignored) ? "it" : "its folder");
  return "result store: " + words + "; check free space, permissions and that it is a store";
}

void refuse_super_journal(const fs::path& file) {
  // SQLite's file format, section "The Rollback Journal": these end a journal with such a name.
  constexpr std::string_view kEnd("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8);
  std::error_code no_file;
  const fs::path linked = fs::weakly_canonical(file, no_file);  // SQLite follows links too
  std::ifstream journal(linked.string() + "-journal", std::ios::binary);
  std::string end(kEnd.size(), '\0');
  if (!journal.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end) ||
      !journal.read(end.data(), static_cast<std::streamsize>(end.size())) || end != kEnd)
    return;
  throw Error(
      fmt::format("{0}: result store: {0}-journal names a file to delete, which no sweep "
                  "leaves behind; sweep again into another folder",
                  file.string()));
}

}  // namespace mapscore::eval
