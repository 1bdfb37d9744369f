// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/voxel_ply.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "files/point_ply.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

namespace mapscore::eval {
std::string voxel_ply_bytes(const SemanticMap& map, const ClassTable& table, double threshold) {
  std::vector<MapVoxel> voxels = map.voxels();
  std::erase_if(voxels, [&](const MapVoxel& voxel) {
    return !voxel.occupied || voxel.best_class == kBackground || voxel.probability < threshold;
  });
  PointPly ply(voxels.size(),
               {"uchar red", "uchar green", "uchar blue", "uint label", "float probability"});
  for (const MapVoxel& voxel : voxels) {
    if (voxel.best_class >= table.classes.size())
      throw Error(fmt::format("map: class {} is not in the class table", voxel.best_class));
    const Colour colour = table.classes[voxel.best_class].colour;
    ply.add(centre_of(voxel.key, map.edge_m()), colour.r, colour.g, colour.b,
            std::uint32_t{voxel.best_class}, static_cast<float>(voxel.probability));
  }
  return ply.bytes();
}

void write_voxel_ply(const std::filesystem::path& file, const SemanticMap& map,
                     const ClassTable& table, double threshold) {
  if (file.extension() != ".ply")
    throw Error(file.string() + ": voxels are written as .ply; give the file this ending");
  write_whole_file(file, voxel_ply_bytes(map, table, threshold));
}

}  // namespace mapscore::eval
