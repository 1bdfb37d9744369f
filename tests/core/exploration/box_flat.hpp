// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/explorer.hpp"
#include "core/localization/scan_likelihood.hpp"
#include "core/random_stream.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace mapscore::testing {

using Box = Eigen::AlignedBox3d;

/// Where a flat lies in the map: no wall is to lie on a border of voxels.
inline const Eigen::Vector3d kFlatOrigin(0.013, 0.021, 0.017);

/// A flat of boxes: walls, floor, ceiling and furniture, seen by plain ray casts. Its frame is the
/// map's; boxes are added in the flat's own, whose floor is z = 0.
struct BoxFlat {
  std::vector<Box> boxes;
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();  ///< from the origin, walls included

  /// A room of `x` by `y` metres with walls of 0.1 m, floor and ceiling at 2.5 m.
  BoxFlat(double x, double y) : size_m(x, y) {
    add(0, 0, -0.1, x, y, 0), add(0, 0, 2.5, x, y, 2.6);
    add(0, 0, 0, x, 0.1, 2.5), add(0, y - 0.1, 0, x, y, 2.5);
    add(0, 0, 0, 0.1, y, 2.5), add(x - 0.1, 0, 0, x, y, 2.5);
  }
  void add(double x0, double y0, double z0, double x1, double y1, double z1) {
    boxes.emplace_back(kFlatOrigin + Eigen::Vector3d(x0, y0, z0),
                       kFlatOrigin + Eigen::Vector3d(x1, y1, z1));
  }
  /// A wall along y at x, with a door from `door_y` on; a lintel above 2 m.
  void add_wall_x(double x, double y0, double y1, double door_y, double door_m) {
    add(x, y0, 0, x + 0.1, door_y, 2.5), add(x, door_y + door_m, 0, x + 0.1, y1, 2.5);
    add(x, door_y, 2.0, x + 0.1, door_y + door_m, 2.5);
  }
  /// The same along x at y.
  void add_wall_y(double y, double x0, double x1, double door_x, double door_m) {
    add(x0, y, 0, door_x, y + 0.1, 2.5), add(door_x + door_m, y, 0, x1, y + 0.1, 2.5);
    add(door_x, y, 2.0, door_x + door_m, y + 0.1, 2.5);
  }
  /// A top of 4 cm on four legs.
  void add_table(double x0, double y0, double x1, double y1, double height) {
    add(x0, y0, height - 0.04, x1, y1, height);
    for (const double x : {x0, x1 - 0.05})
      for (const double y : {y0, y1 - 0.05}) add(x, y, 0, x + 0.05, y + 0.05, height - 0.04);
  }

  /// Distance to the first box along a ray; infinity where there is none.
  [[nodiscard]] double cast(const Eigen::Vector3d& from, const Eigen::Vector3d& along) const {
    double least = std::numeric_limits<double>::infinity();
    const Eigen::Array3d inverse = along.array().inverse();
    for (const Box& box : boxes) {
      const Eigen::Array3d a = (box.min() - from).array() * inverse;
      const Eigen::Array3d b = (box.max() - from).array() * inverse;
      const double in = a.min(b).maxCoeff(), out = a.max(b).minCoeff();
      if (in <= out && in > 0) least = std::min(least, in);
    }
    return least;
  }

  /// Distance of a place from what a robot of this height would bump into, 0 within it.
  [[nodiscard]] double clearance(const Eigen::Vector2d& place, double height_m) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Box& box : boxes) {
      if (box.max().z() <= kFlatOrigin.z() + 0.01 || box.min().z() >= kFlatOrigin.z() + height_m)
        continue;
      const Eigen::AlignedBox2d foot(box.min().head<2>().eval(), box.max().head<2>().eval());
      least = std::min(least, foot.exteriorDistance(place));
    }
    return least;
  }
};

/// A robot as that of the scenes, its camera with few pixels.
inline ExploringRobot flat_robot() {
  ExploringRobot robot;
  robot.radius_m = 0.25;
  robot.height_m = 1.2;
  Calibration& cameras = robot.cameras;
  cameras.depth = CameraModel::from_hfov(112, 84, 58.4 * std::numbers::pi / 180.0);
  cameras.color = cameras.depth;
  Eigen::Matrix3d R_link_optical;
  R_link_optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  cameras.T_base_depth.linear() =
      Eigen::AngleAxisd(12.0 * std::numbers::pi / 180.0, Eigen::Vector3d::UnitY()) * R_link_optical;
  cameras.T_base_depth.translation() = Eigen::Vector3d(0.05, 0.025, 1.15);
  return robot;
}

/// What a robot's sensors see of a flat. `noise`: 1 for about an Astra's and an RPLidar's.
class FlatSensors {
 public:
  FlatSensors(const BoxFlat& flat, const ExploringRobot& robot, double noise = 0.0)
      : flat_(flat), cameras_(robot.cameras), noise_(noise), stream_(1, "flat sensors") {}

  [[nodiscard]] Eigen::Vector3d camera_at(const PlanarPose& T_map_base) const {
    return T_map_depth(T_map_base).translation();
  }
  /// Points of a depth image, in the map.
  std::vector<Eigen::Vector3d> points(const PlanarPose& T_map_base) {
    const Pose T = T_map_depth(T_map_base);
    const CameraModel& camera = cameras_.depth;
    std::vector<Eigen::Vector3d> points;
    for (int v = 0; v < camera.height_px; ++v)
      for (int u = 0; u < camera.width_px; ++u) {
        const Eigen::Vector3d ray = camera.back_project(u, v, 1.0);
        double z = flat_.cast(T.translation(), T.linear() * ray);
        if (noise_ > 0 && std::isfinite(z))
          z += noise_ * (0.0012 + 0.0019 * (z - 0.4) * (z - 0.4)) * stream_.normal();
        if (z < cameras_.range_min_m || z > cameras_.range_max_m) continue;
        points.push_back(T * (z * ray));
      }
    return points;
  }
  LaserScan scan(const PlanarPose& T_map_base) {
    LaserScan scan{{0.095, 0, 0}, -std::numbers::pi, std::numbers::pi / 180.0, 0.15, 12.0, {}};
    const PlanarPose T = T_map_base * scan.T_base_lidar;
    for (int n = 0; n < 360; ++n) {
      const double angle = T.yaw_rad + scan.first_angle_rad + n * scan.angle_step_rad;
      double range = flat_.cast({T.x_m, T.y_m, kFlatOrigin.z() + 0.2},
                                {std::cos(angle), std::sin(angle), 1e-12});
      if (noise_ > 0) range *= 1.0 + noise_ * 0.005 * stream_.normal();
      scan.ranges_m.push_back(static_cast<float>(range));
    }
    return scan;
  }

 private:
  [[nodiscard]] Pose T_map_depth(const PlanarPose& T_map_base) const {
    Pose T = spatial(T_map_base) * cameras_.T_base_depth;
    T.translation().z() += kFlatOrigin.z();
    return T;
  }

  const BoxFlat& flat_;
  Calibration cameras_;
  double noise_;
  RandomStream stream_;
};

/// Two rooms of 3.5 m x 4 m with a door of 0.9 m between them, a table, a cupboard and a bed.
inline BoxFlat two_rooms(double door_m = 0.9) {
  BoxFlat flat(7.1, 4.0);
  flat.add_wall_x(3.5, 0, 4.0, 1.2, door_m);
  flat.add_table(0.8, 2.4, 2.0, 3.2, 0.75);
  flat.add(0.1, 0.1, 0, 0.6, 1.1, 1.9);
  flat.add(5.0, 2.2, 0, 7.0, 3.9, 0.5);
  return flat;
}

/// A home of 10 m x 8 m: living room, kitchen, corridor, two bedrooms and a bath.
inline BoxFlat five_rooms() {
  BoxFlat flat(10.0, 8.0);
  flat.add_wall_y(4.4, 0, 10.0, 4.6, 0.9);    // living room and kitchen | corridor
  flat.add_wall_x(6.2, 0, 4.4, 2.6, 0.9);     // living room | kitchen
  flat.add_wall_y(5.6, 0, 4.2, 3.0, 0.9);     // corridor | bedroom
  flat.add_wall_y(5.6, 4.2, 6.9, 5.4, 0.8);   // corridor | bath
  flat.add_wall_y(5.6, 6.9, 10.0, 8.0, 0.9);  // corridor | second bedroom
  flat.add(4.2, 5.6, 0, 4.3, 8.0, 2.5), flat.add(6.9, 5.6, 0, 7.0, 8.0, 2.5);
  flat.add(0.1, 1.0, 0, 1.0, 3.2, 0.8);  // sofa
  flat.add_table(1.5, 1.6, 2.1, 2.7, 0.45);
  flat.add(3.4, 0.1, 0, 5.4, 0.5, 0.6), flat.add(3.8, 0.2, 0.6, 5.0, 0.25, 1.3);  // board, tv
  flat.add(0.1, 3.9, 0, 2.2, 4.3, 2.0);                                           // shelf
  flat.add_table(3.6, 2.2, 4.8, 3.1, 0.75);
  for (const double x : {3.8, 4.3})
    for (const double y : {1.75, 3.15}) flat.add_table(x, y, x + 0.4, y + 0.4, 0.46);
  flat.add(6.8, 0.1, 0, 9.9, 0.7, 0.9), flat.add(6.8, 0.1, 1.4, 9.9, 0.45, 2.1);
  flat.add(9.3, 0.7, 0, 9.9, 2.6, 0.9), flat.add(9.3, 3.4, 0, 9.9, 4.2, 1.9);
  flat.add_table(7.3, 2.2, 8.1, 3.0, 0.75);
  flat.add(0.1, 6.2, 0, 2.1, 7.8, 0.5);  // bed
  flat.add(2.2, 7.5, 0, 2.6, 7.9, 0.5), flat.add(3.6, 6.8, 0, 4.2, 7.9, 2.1);
  flat.add(4.3, 7.2, 0, 6.0, 7.9, 0.55), flat.add(6.4, 6.6, 0, 6.9, 7.1, 0.4);
  flat.add(7.0, 6.9, 0, 8.0, 7.9, 0.5), flat.add(9.3, 6.4, 0, 9.9, 7.9, 1.9);
  flat.add_table(7.0, 5.75, 7.5, 6.5, 0.75);
  flat.add(0.1, 5.2, 0, 0.5, 5.6, 1.0), flat.add(9.5, 4.5, 0, 9.9, 5.2, 1.6);
  return flat;
}

}  // namespace mapscore::testing
