// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/rivals/surface_normals.hpp"

#include <gtest/gtest.h>

namespace mapscore {
namespace {

const CameraModel kTilted{60, 40, 80, 90, 29.5, 19.5};

/// Depths of the plane n p = d.
cv::Mat1f depths_of_plane(const Eigen::Vector3d& n, double d) {
  cv::Mat1f depth_m(kTilted.height_px, kTilted.width_px);
  for (int v = 0; v < depth_m.rows; ++v)
    for (int u = 0; u < depth_m.cols; ++u)
      depth_m(v, u) = static_cast<float>(d / n.dot(kTilted.back_project(u, v, 1)));
  return depth_m;
}

void expect_normal(const VectorImage& normals, int u, int v, const Eigen::Vector3d& expected) {
  const Eigen::Vector3d normal(static_cast<double>(normals.x(v, u)),
                               static_cast<double>(normals.y(v, u)),
                               static_cast<double>(normals.z(v, u)));
  EXPECT_LT((normal - expected).norm(), 1e-3) << u << ' ' << v << ": " << normal.transpose();
}

TEST(SurfaceNormals, OfAPlaneAreItsOwnAndFaceTheCamera) {
  const Eigen::Vector3d n = Eigen::Vector3d(0.4, -0.3, 0.8).normalized();
  const VectorImage normals = surface_normals(depths_of_plane(n, 2), kTilted, 5);
  for (const auto& [u, v] : {std::pair(0, 0), {59, 39}, {30, 20}, {59, 0}})
    expect_normal(normals, u, v, -n);
}

TEST(SurfaceNormals, APlaneBehindAStepDoesNotBendThem) {
  const Eigen::Vector3d n = Eigen::Vector3d(0.4, 0, 0.8).normalized();
  cv::Mat1f depth_m = depths_of_plane(n, 2);
  depth_m.colRange(30, 60) *= 2;  // a parallel plane, twice as far: half the slopes
  const VectorImage normals = surface_normals(depth_m, kTilted, 3);
  expect_normal(normals, 27, 20, -n);
  expect_normal(normals, 29, 20, -n);  // the pair across the step is none
  expect_normal(normals, 31, 20, -n);
}

TEST(SurfaceNormals, ThereAreNoneWithoutNeighbours) {
  cv::Mat1f depth_m(kTilted.height_px, kTilted.width_px, 0.0F);
  depth_m(20, 30) = 2;
  depth_m(5, 5) = depth_m(5, 6) = 2;  // a pair in a row, none in a column
  const VectorImage normals = surface_normals(depth_m, kTilted, 7);
  for (const cv::Mat1f& part : {normals.x, normals.y, normals.z})
    EXPECT_EQ(cv::countNonZero(part), 0);
}

TEST(SurfaceNormals, DepthsOutsideTheRangeAreNone) {
  Calibration believed;
  believed.depth = kTilted;
  believed.range_min_m = 1;
  believed.range_max_m = 2;
  const cv::Mat1w depth = (cv::Mat1w(1, 5) << 0, 4999, 5000, 10000, 10001);
  const cv::Mat1f depth_m = depth_in_range(depth, believed);
  const std::vector<float> found(depth_m.begin(), depth_m.end());
  EXPECT_EQ(found, (std::vector<float>{0, 0, 1, 2, 0}));
}

}  // namespace
}  // namespace mapscore
