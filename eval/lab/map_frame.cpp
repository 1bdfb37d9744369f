// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/map_frame.hpp"

#include <cmath>
#include <numbers>

namespace mapscore::eval {

Eigen::Vector3d low_discrepancy_point(int n) {
  constexpr double kG = 1.2207440846057594754;
  const Eigen::Vector3d steps(1.0 / kG, 1.0 / (kG * kG), 1.0 / (kG * kG * kG));
  const Eigen::Vector3d point = (Eigen::Vector3d::Constant(0.5) + (n + 1) * steps);
  return point - point.array().floor().matrix();
}

MapFrame map_frame(const Study& study, int seed_index) {
  MapFrame frame;
  frame.edge_m = study.voxel_m;
  frame.yaw_rad = study.map_yaw_deg * std::numbers::pi / 180.0;
  frame.origin_m = study.map_origin_m
                       ? Eigen::Vector3d(study.map_origin_m->at(0), study.map_origin_m->at(1),
                                         study.map_origin_m->at(2))
                       : Eigen::Vector3d(study.voxel_m * low_discrepancy_point(seed_index));
  return frame;
}

}  // namespace mapscore::eval
