// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/map_file.hpp"

#include "eval/map_files/lower_case.hpp"
#include "eval/map_files/octree_file.hpp"
#include "eval/map_files/pcd_file.hpp"
#include "eval/map_files/ply_file.hpp"
#include "eval/map_files/refusal.hpp"
#include "eval/map_files/voxel_csv.hpp"

#include <algorithm>
#include <array>

namespace mapscore::eval {
namespace {

std::string ending_of(const std::filesystem::path& file) {
  return lower_case(file.extension().string());
}

}  // namespace

bool has_ending_of_a_map(const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 5> kEndings{".ot", ".bt", ".ply", ".pcd", ".csv"};
  return std::ranges::find(kEndings, ending_of(file)) != kEndings.end();
}

MapFile read_map_file(const std::filesystem::path& file, NotFinite not_finite) {
  const std::string ending = ending_of(file);
  if (ending == ".ot" || ending == ".bt") return read_octree(file);
  if (ending == ".ply") return read_ply(file, not_finite);
  if (ending == ".pcd") return read_pcd(file, not_finite);
  if (ending == ".csv") return read_voxel_csv(file, not_finite);
  refuse(file, "maps are read from .ot, .bt, .ply, .pcd and .csv; convert it to one of these");
}

}  // namespace mapscore::eval
