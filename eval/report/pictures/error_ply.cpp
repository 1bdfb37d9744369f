// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/error_ply.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "files/point_ply.hpp"

#include <cstdint>
#include <string>

namespace mapscore::eval {
namespace {

std::string legend_of_verdicts() {
  std::string text = "verdict";
  for (const Verdict verdict : kVerdicts)
    text.append(" ")
        .append(std::to_string(static_cast<int>(verdict)))
        .append(" ")
        .append(name_of(verdict));
  return text;
}

}  // namespace

std::string error_ply_bytes(const JudgedMap& map) {
  PointPly ply(map.voxels.size(),
               {"uchar red", "uchar green", "uchar blue", "ushort class", "uchar verdict"},
               legend_of_verdicts());
  for (const JudgedVoxel& voxel : map.voxels) {
    const Colour colour = colour_of(voxel.verdict);
    ply.add(centre_of(voxel.key, map.edge_m), colour.r, colour.g, colour.b, voxel.class_id,
            static_cast<std::uint8_t>(voxel.verdict));
  }
  return ply.bytes();
}

void write_error_ply(const std::filesystem::path& file, const JudgedMap& map) {
  if (file.extension() != ".ply")
    throw Error(file.string() + ": errors are written as .ply; give the file this ending");
  write_whole_file(file, error_ply_bytes(map));
}

}  // namespace mapscore::eval
