// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/whole_file.hpp"

#include "core/error.hpp"

#include <fstream>
#include <system_error>

namespace mapscore {

void write_whole(const std::filesystem::path& file,
                 const std::function<bool(std::ostream&)>& write) {
  const std::filesystem::path aside = file.string() + ".partial";
  std::ofstream stream(aside, std::ios::binary);
  const bool written = stream && write(stream) && stream.flush();
  stream.close();
  std::error_code error;
  if (written && stream) std::filesystem::rename(aside, file, error);
  if (written && stream && !error) return;
  std::filesystem::remove(aside, error);
  throw Error(file.string() +
              ": cannot be written; check the folder, its permissions and free space");
}

}  // namespace mapscore
