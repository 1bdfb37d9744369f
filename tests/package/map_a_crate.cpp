// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include <core/mapping/placement.hpp>
#include <core/mapping/semantic_map.hpp>
#include <core/segmentation/segmentation.hpp>

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

  const double voxel_m = 0.05;
  const RegisteredCloud cloud = register_depth(depth, cameras);
  Observation observation;
  for (const Detection& detection : detections_of(label, table)) {
    const Segment crate = segment(detection, cloud, voxel_m, RegionGrowingParams{}, false);
    std::cout << table.classes[crate.class_id].name << ": " << crate.points.size() << " points, "
              << crate.box.sizes().transpose() << " m\n";
    observation.push_back({crate.class_id, crate.score, crate.points});
  }
  const std::vector<Pose> T_map_depth{Pose::Identity()};  // where the robot believes its camera is
  SemanticMap map(voxel_m);
  map.fuse(place(observation, T_map_depth, voxel_m), 1, BlendRule{}, table.classes.size());
  for (const MapVoxel& voxel : map.voxels())
    std::cout << centre_of(voxel.key, voxel_m).transpose() << ' ' << voxel.best_class << ' '
              << voxel.probability << '\n';
  map.save("crate.ot");
}
