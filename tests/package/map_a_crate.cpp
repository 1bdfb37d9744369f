// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include <core/mapping/mapper.hpp>

#include <iostream>

int main() {
  using namespace mapscore;
  // A crate 0.4 m wide, 2 m in front of the camera, before a wall at 3 m. A network found it, 3 px
  // too wide.
  Calibration cameras;
  cameras.color = cameras.depth = CameraModel::from_hfov(320, 240, 1.0);
  cv::Mat1w depth(240, 320, std::uint16_t(3.0 * kDepthUnitsPerMetre));
  depth(cv::Rect(130, 90, 60, 60)) = std::uint16_t(2.0 * kDepthUnitsPerMetre);
  cv::Mat1w label(240, 320, std::uint16_t(0));
  label(cv::Rect(127, 87, 66, 66)) = 1;
  ClassTable table;
  table.classes.push_back({1, "crate", {200, 120, 40}, true});
  table.instances.push_back({1, "crate_1", 1});

  const Mapping mapping{.voxel_m = 0.05, .segmentation = RegionGrowing{}};
  Mapper mapper(mapping, table.classes.size());
  const PoseBelief belief;       // where the robot believes it is: at the map's origin, for certain
  RandomStream draws(1, "map");  // of the poses that are drawn from the belief
  for (const Segment& crate :
       mapper.integrate({cameras, depth, detections_of(label, table)}, belief, draws))
    std::cout << table.classes[crate.class_id].name << ": " << crate.points.size() << " points, "
              << crate.box.sizes().transpose() << " m\n";
  for (const MapVoxel& voxel : mapper.map().voxels())
    std::cout << centre_of(voxel.key, mapping.voxel_m).transpose() << ' ' << voxel.best_class << ' '
              << voxel.probability << '\n';
  mapper.map().save("crate.ot");
}
