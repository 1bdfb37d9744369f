// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/clouds/cloud_file.hpp"

#include "core/whole_file.hpp"
#include "files/point_ply.hpp"
#include "files/refusal.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

std::string pcd_header(std::size_t count) {
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
      "FIELDS x y z label instance\nSIZE 4 4 4 4 4\nTYPE F F F U U\nCOUNT 1 1 1 1 1\n"
      "WIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA binary\n",
      count);
}

}  // namespace

void write_cloud(const std::filesystem::path& file, std::span<const Eigen::Vector3d> points,
                 ClassId class_id, InstanceId instance) {
  const bool ply = file.extension() == ".ply";
  if (!ply && file.extension() != ".pcd")
    refuse(file, "clouds are written as .ply or .pcd; give the file one of these endings");
  PointPly points_ply(points.size(), {"uint label", "uint instance"});
  for (const Eigen::Vector3d& p : points)
    points_ply.add(p, std::uint32_t{class_id}, std::uint32_t{instance});
  // A PCD has the same rows below another header.
  std::string bytes = points_ply.bytes();
  if (!ply) bytes.replace(0, points_ply.header_bytes(), pcd_header(points.size()));
  write_whole_file(file, bytes);
}

void write_voxel_ply(const std::filesystem::path& file, const SemanticMap& map,
                     const ClassTable& table, double threshold) {
  if (file.extension() != ".ply")
    refuse(file, "voxels are written as .ply; give the file this ending");
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
  write_whole_file(file, ply.bytes());
}

}  // namespace mapscore::eval
