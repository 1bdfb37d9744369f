// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/file_bytes.hpp"

#include "core/error.hpp"
#include "files/suggestion.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace mapscore {
namespace {

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

[[noreturn]] void fail(const std::filesystem::path& path, const char* what, const char* mend) {
  const int reason = errno;
  throw Error(fmt::format("{}: {} ({}); {}", path.string(), what, std::strerror(reason), mend));
}

constexpr const char* kMendWrite = "make room or give another folder";

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  constexpr const char* kMend = "check that the file is there and may be read";
  std::error_code no_status;
  const std::filesystem::file_type type = std::filesystem::status(path, no_status).type();
  if (type == std::filesystem::file_type::fifo || type == std::filesystem::file_type::character ||
      type == std::filesystem::file_type::socket)
    throw Error(fmt::format("{}: is a pipe or a device; put a file there", path.string()));
  if (type == std::filesystem::file_type::directory)
    throw Error(fmt::format("{}: cannot open, it is a folder; give a file", path.string()));
  if (type == std::filesystem::file_type::not_found)
    throw Error(fmt::format("{}: cannot open (no such file); {}", path.string(),
                            path_suggestion(path, kMend)));
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) fail(path, "cannot open", kMend);
  std::string bytes;
  std::error_code no_size;
  const std::uintmax_t size = std::filesystem::file_size(path, no_size);
  bytes.resize(no_size ? 0 : size);
  const std::size_t got = std::fread(bytes.data(), 1, bytes.size(), file.get());
  if (no_size || got != bytes.size()) fail(path, "cannot read", kMend);
  return bytes;
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  File file(std::fopen(path.c_str(), "wb"));
  if (!file) fail(path, "cannot create", kMendWrite);
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  if (!written || std::fflush(file.get()) != 0) fail(path, "cannot write", kMendWrite);
  if (std::fclose(file.release()) != 0) fail(path, "cannot write", kMendWrite);
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw Error(fmt::format("{}: cannot create the folder ({}); give another", folder.string(),
                            error.message()));
}

void link_or_copy(const std::filesystem::path& file, const std::filesystem::path& place) {
  if (link(file.c_str(), place.c_str()) != 0) write_file(place, read_file(file));
}

std::string hash_of(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace mapscore
