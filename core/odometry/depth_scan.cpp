// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/depth_scan.hpp"

#include "core/error.hpp"
#include "core/geometry/depth_rays.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mapscore {
namespace {

/// Blocks along a row of an image.
constexpr int kBlocksAcross = 160;
/// A block whose depths differ by more than this share of the nearest sees more than one surface.
constexpr double kEdgeShare = 0.06;
/// Blocks from one to those on either side that make its normal (one of a coarser raster), and what
/// their depths may differ by, over depth.
constexpr int kNormalReach = 2;
constexpr double kSteepest = 0.3;
/// Pixels of a block that count as independent.
constexpr double kIndependentPixels = 4;

/// Mean point of a block, in the camera's axes; none where less than half of it has depth, or it
/// sees more than one surface.
std::optional<Eigen::Vector3d> block_point(const cv::Mat1w& depth, const DepthRays& rays, int u0,
                                           int v0, int edge, const Calibration& believed,
                                           double range_max_m) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double near = range_max_m, far = 0.0;
  int count = 0;
  const int u1 = std::min(u0 + edge, depth.cols), v1 = std::min(v0 + edge, depth.rows);
  for (int v = v0; v < v1; ++v)
    for (int u = u0; u < u1; ++u) {
      const double z = depth(v, u) / kDepthUnitsPerMetre;
      if (z < believed.range_min_m || z > range_max_m) continue;
      sum += rays.point(u, v, z);
      near = std::min(near, z);
      far = std::max(far, z);
      ++count;
    }
  if (2 * count < (u1 - u0) * (v1 - v0) || count == 0 || far - near > kEdgeShare * near) return {};
  return sum / count;
}

double sigma_at(double z, const DepthSampling& sampling) {
  const double along = sampling.sigma_base_m + sampling.sigma_growth_per_m * (z - 0.4) * (z - 0.4);
  const double step = sampling.disparity_step_per_m * z * z;
  return std::sqrt((along * along + step * step / 12.0) / kIndependentPixels);
}

/// Points of blocks, in rows; NaN where there is none.
struct BlockGrid {
  int columns = 0, rows = 0;
  int reach = 0;  ///< to those that make a normal
  std::vector<Eigen::Vector3d> points;

  [[nodiscard]] const Eigen::Vector3d& at(int column, int row) const {
    return points[static_cast<std::size_t>(row * columns + column)];
  }
};

/// Normal of the blocks around one, towards the camera; none beside an edge of depth.
std::optional<Eigen::Vector3d> normal_at(const BlockGrid& grid, int column, int row) {
  const int left = column - grid.reach, right = column + grid.reach;
  const int above = row - grid.reach, below = row + grid.reach;
  if (left < 0 || above < 0 || right >= grid.columns || below >= grid.rows) return {};
  const Eigen::Vector3d across = grid.at(right, row) - grid.at(left, row);
  const Eigen::Vector3d down = grid.at(column, below) - grid.at(column, above);
  const Eigen::Vector3d& p = grid.at(column, row);
  const double steepest = kSteepest * p.z();
  if (!(std::abs(across.z()) <= steepest && std::abs(down.z()) <= steepest)) return {};
  const Eigen::Vector3d normal = down.cross(across).normalized();
  return normal.dot(p) > 0.0 ? -normal : normal;
}

}  // namespace

DepthScan scan_of(const cv::Mat1w& depth, const Calibration& believed,
                  const DepthSampling& sampling) {
  check_ranges(sampling);
  if (depth.cols != believed.depth.width_px || depth.rows != believed.depth.height_px)
    throw Error(
        "odometry: the depth image is not of the depth camera's size; give its calibration");
  const DepthRays rays(believed.depth);
  const double range_max_m = std::min(sampling.range_max_m, believed.range_max_m);
  const int edge = std::max(1, depth.cols / kBlocksAcross);
  const int pitch = std::max(edge, depth.cols / sampling.points_across);
  BlockGrid grid{(depth.cols + pitch - 1) / pitch,
                 (depth.rows + pitch - 1) / pitch,
                 std::max(1, kNormalReach * edge / pitch),
                 {}};
  for (int v = 0; v < depth.rows; v += pitch)
    for (int u = 0; u < depth.cols; u += pitch)
      grid.points.push_back(block_point(depth, rays, u, v, edge, believed, range_max_m)
                                .value_or(Eigen::Vector3d::Constant(NAN)));
  DepthScan scan;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Vector3d& p = grid.at(column, row);
      if (std::isnan(p.z())) continue;
      const auto normal = normal_at(grid, column, row);
      if (!normal) continue;
      scan.points.push_back(believed.T_base_depth * p);
      scan.normals.push_back(believed.T_base_depth.linear() * *normal);
      scan.sigma_m.push_back(sigma_at(p.z(), sampling));
    }
  return scan;
}

std::vector<std::size_t> upright_points(const DepthScan& scan, const Pose& T_map_base) {
  constexpr double kUpright = 0.7;
  const Eigen::RowVector3d up = T_map_base.linear().row(2);
  std::vector<std::size_t> upright;
  for (std::size_t i = 0; i < scan.size(); ++i)
    if (std::abs(up.dot(scan.normals[i])) < kUpright) upright.push_back(i);
  return upright;
}

}  // namespace mapscore
