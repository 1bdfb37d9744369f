// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/voxel_ply.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/recording/little_endian.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

namespace mapscore::eval {
std::string voxel_ply_bytes(const SemanticMap& map, const ClassTable& table, double threshold) {
  std::vector<MapVoxel> voxels = map.voxels();
  std::erase_if(voxels, [&](const MapVoxel& voxel) {
    return !voxel.occupied || voxel.best_class == kBackground || voxel.probability < threshold;
  });
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property uint label\nproperty float probability\nend_header\n",
      voxels.size());
  for (const MapVoxel& voxel : voxels) {
    if (voxel.best_class >= table.classes.size())
      throw Error(fmt::format("map: class {} is not in the class table", voxel.best_class));
    for (const double x : centre_of(voxel.key, map.edge_m()))
      append_little_endian(bytes, static_cast<float>(x));
    const Colour colour = table.classes[voxel.best_class].colour;
    for (const std::uint8_t channel : {colour.r, colour.g, colour.b})
      append_little_endian(bytes, channel);
    append_little_endian(bytes, std::uint32_t{voxel.best_class});
    append_little_endian(bytes, static_cast<float>(voxel.probability));
  }
  return bytes;
}

void write_voxel_ply(const std::filesystem::path& file, const SemanticMap& map,
                     const ClassTable& table, double threshold) {
  if (file.extension() != ".ply")
    throw Error(file.string() + ": voxels are written as .ply; give the file this ending");
  write_whole_file(file, voxel_ply_bytes(map, table, threshold));
}

}  // namespace mapscore::eval
