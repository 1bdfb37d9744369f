// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/whole_file.hpp"

#include "core/error.hpp"

#include <fstream>
#include <string>
#include <system_error>

namespace mapscore::eval {

void write_whole_file(const std::filesystem::path& file, std::string_view bytes) {
  std::filesystem::path aside = file;
  aside += ".partial";
  std::ofstream stream(aside, std::ios::binary | std::ios::trunc);
  const bool opened = stream.is_open();
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  std::error_code failure;
  if (stream) std::filesystem::rename(aside, file, failure);
  if (stream && !failure) return;
  std::error_code ignored;
  if (opened) std::filesystem::remove(aside, ignored);
  throw Error(file.string() +
              ": cannot be written; check that its folder exists, may be written to and " +
              "has free space");
}

}  // namespace mapscore::eval
