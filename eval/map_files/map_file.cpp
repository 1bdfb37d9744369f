// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/map_file.hpp"

#include "files/refusal.hpp"
#include "files/text.hpp"

#include <algorithm>
#include <array>

namespace mapscore::eval {
namespace {

/// A format by its ending.
struct Reader {
  std::string_view ending;
  MapFile (*read)(const std::filesystem::path& file, NotFinite not_finite);
};

MapFile read_tree(const std::filesystem::path& file, NotFinite) {
  return read_octree(file);
}

constexpr auto kReaders = std::to_array<Reader>({{".ot", read_tree},
                                                 {".bt", read_tree},
                                                 {".ply", read_ply},
                                                 {".pcd", read_pcd},
                                                 {".csv", read_voxel_csv}});

/// nullptr where no format has the file's ending.
const Reader* reader_of(const std::filesystem::path& file) {
  const auto found =
      std::ranges::find(kReaders, lower_case(file.extension().string()), &Reader::ending);
  return found == kReaders.end() ? nullptr : &*found;
}

}  // namespace

std::string map_endings() {
  std::string endings;
  for (const Reader& reader : kReaders)
    endings.append(endings.empty() ? "" : ", ").append(reader.ending);
  return endings;
}

bool has_ending_of_a_map(const std::filesystem::path& file) {
  return reader_of(file) != nullptr;
}

MapFile read_map_file(const std::filesystem::path& file, NotFinite not_finite) {
  if (const Reader* reader = reader_of(file)) return reader->read(file, not_finite);
  refuse(file, "maps are read from {}; convert it to one of these", map_endings());
}

}  // namespace mapscore::eval
