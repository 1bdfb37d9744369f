// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/rivals/geometric_segments.hpp"

#include "core/random_stream.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <set>

namespace mapscore {
namespace {

const CameraModel kNarrow{64, 48, 200, 200, 31.5, 23.5};
const GeometricParams kNarrowParams{.normal_window_px = 3, .min_segment_px = 50};

cv::Mat1f wall_depths(float z_m) {
  return cv::Mat1f(kNarrow.height_px, kNarrow.width_px, z_m);
}

/// Two walls that meet at the middle column, at `angle_rad` from the image plane: a valley where
/// it is positive, a ridge where it is negative.
cv::Mat1f folded(double angle_rad) {
  cv::Mat1f depth_m(kNarrow.height_px, kNarrow.width_px);
  for (int v = 0; v < depth_m.rows; ++v)
    for (int u = 0; u < depth_m.cols; ++u) {
      const double x = std::abs((u - kNarrow.cx_px) / kNarrow.fx_px);
      depth_m(v, u) = static_cast<float>(2 / (1 + x * std::tan(angle_rad)));
    }
  return depth_m;
}

TEST(GeometricSegments, AStepPartsTwoWalls) {
  cv::Mat1f depth_m = wall_depths(2);
  depth_m.colRange(32, 64) = 3;
  const GeometricSegments segments = geometric_segments(depth_m, kNarrow, kNarrowParams);
  EXPECT_EQ(segments.count, 2);
  // Edges are filled from the nearest point, so that nothing is lost at the step.
  EXPECT_EQ(cv::countNonZero(segments.labels.colRange(0, 32) != segments.labels(20, 5)), 0);
  EXPECT_EQ(cv::countNonZero(segments.labels.colRange(32, 64) != segments.labels(20, 60)), 0);
  EXPECT_NE(segments.labels(20, 5), segments.labels(20, 60));
}

TEST(GeometricSegments, AStepBelowTheShareIsNoEdge) {
  GeometricParams params = kNarrowParams;
  params.convexity = -1;  // without concave edges
  cv::Mat1f depth_m = wall_depths(2);
  depth_m.colRange(32, 64) = 2.019F;
  EXPECT_EQ(geometric_segments(depth_m, kNarrow, params).count, 1);
  depth_m.colRange(32, 64) = 2.021F;  // more than 1 % of 2 m
  EXPECT_EQ(geometric_segments(depth_m, kNarrow, params).count, 2);
}

TEST(GeometricSegments, SurfacesPartWhereTheyMeetInAValleyAndNotOnARidge) {
  EXPECT_EQ(geometric_segments(folded(0.5), kNarrow, kNarrowParams).count, 2);
  EXPECT_EQ(geometric_segments(folded(-0.5), kNarrow, kNarrowParams).count, 1);
}

TEST(GeometricSegments, AShallowValleyIsNoEdge) {
  GeometricParams params = kNarrowParams;
  params.convexity = std::cos(0.6);  // the normals are 1 rad apart
  EXPECT_EQ(geometric_segments(folded(0.5), kNarrow, params).count, 2);
  params.convexity = std::cos(1.1);
  EXPECT_EQ(geometric_segments(folded(0.5), kNarrow, params).count, 1);
}

TEST(GeometricSegments, SmallOnesAreDroppedAndFilledFromWhatIsNear) {
  cv::Mat1f depth_m = wall_depths(2);
  depth_m(cv::Rect(20, 20, 8, 8)) = 1.5F;   // nothing of it within 5 cm: stays without a segment
  depth_m(cv::Rect(40, 20, 8, 8)) = 1.97F;  // 3 cm before the wall
  const GeometricSegments segments = geometric_segments(depth_m, kNarrow, kNarrowParams);
  EXPECT_EQ(segments.count, 1);
  EXPECT_EQ(cv::countNonZero(segments.labels(cv::Rect(20, 20, 8, 8))), 0);
  EXPECT_EQ(segments.labels(20, 40), 1);
  EXPECT_EQ(segments.labels(23, 43), 0) << "no piece within four pixels";
}

TEST(GeometricSegments, WithoutDepthThereIsNothing) {
  const GeometricSegments segments = geometric_segments(wall_depths(0), kNarrow, kNarrowParams);
  EXPECT_EQ(segments.count, 0);
  EXPECT_EQ(cv::countNonZero(segments.labels), 0);
}

/// Whether pixel (u, v) is an edge before gaps are closed, pair by pair.
bool plain_edge(const cv::Mat1f& z, const VectorImage& p, const VectorImage& n, int u, int v) {
  const auto at = [](const VectorImage& image, int column, int row) {
    return Eigen::Vector3f(image.x(row, column), image.y(row, column), image.z(row, column));
  };
  for (int dv = -2; dv <= 2; ++dv)
    for (int du = -2; du <= 2; ++du) {
      const int uq = u + du, vq = v + dv;
      if (uq < 0 || vq < 0 || uq >= z.cols || vq >= z.rows) continue;
      if (std::abs(du) < 2 && std::abs(dv) < 2 && std::abs(z(vq, uq) - z(v, u)) > 0.01F * z(v, u))
        return true;
      const Eigen::Vector3f normal = at(n, u, v), other = at(n, uq, vq);
      if (normal.isZero() || other.isZero()) continue;
      if ((at(p, uq, vq) - at(p, u, v)).dot(normal) >= 5e-4F && normal.dot(other) <= 0.97F)
        return true;
    }
  return z(v, u) == 0;
}

TEST(GeometricSegments, EdgesEqualThePlainFormOnRandomSurfaces) {
  int edges = 0, others = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    RandomStream random(seed, "geometric segments");
    cv::Mat1f depth_m(kNarrow.height_px, kNarrow.width_px);
    const double a = 8 + 10 * random.uniform(), b = 8 + 10 * random.uniform();
    for (int v = 0; v < depth_m.rows; ++v)
      for (int u = 0; u < depth_m.cols; ++u)
        depth_m(v, u) = static_cast<float>(2 + 0.1 * std::abs(std::sin(u / a) * std::cos(v / b)));
    depth_m(cv::Rect(10, 10, 12, 20)) -= 0.3F;
    depth_m(cv::Rect(40, 30, 5, 5)) = 0;
    const VectorImage points = points_of(depth_m, kNarrow);
    const VectorImage normals = surface_normals(depth_m, kNarrow, 3);
    cv::Mat1b steps(depth_m.size(), std::uint8_t{0});
    const cv::Mat1b found = geometric_edges(points, kNarrow, kNarrowParams);
    for (int v = 0; v < depth_m.rows; ++v)
      for (int u = 0; u < depth_m.cols; ++u)
        if (plain_edge(depth_m, points, normals, u, v)) {
          EXPECT_EQ(found(v, u), 255) << u << ' ' << v;
          steps(v, u) = 255;
          ++edges;
        }
    // Closing adds what a 3 x 3 window around edges encloses, and nothing else.
    cv::Mat1b closed;
    cv::morphologyEx(steps, closed, cv::MORPH_CLOSE, cv::Mat1b::ones(3, 3));
    EXPECT_EQ(cv::countNonZero(found & ~closed), 0);
    others += static_cast<int>(found.total()) - cv::countNonZero(found);
  }
  EXPECT_GT(edges, 1000);
  EXPECT_GT(others, 1000);
}

}  // namespace
}  // namespace mapscore
