// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/sim/render/rendered_frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

// The triangles of the truth are the ones that MuJoCo draws, all of them and from their outside:
// every pixel against the nearest triangle that its ray hits.

namespace mapscore::sim {
namespace {

using Eigen::Vector3d;
using testing::load_text;
using testing::mjcf;

constexpr double kNothing = std::numeric_limits<double>::infinity();

/// Where the ray from the origin first meets a triangle, in multiples of `ray`.
double first_hit(const std::vector<Triangle>& triangles, const Vector3d& ray) {
  double nearest = kNothing;
  for (const auto& [a, b, c] : triangles) {
    const Vector3d ab = b - a, ac = c - a, across = ray.cross(ac);
    const double determinant = ab.dot(across);
    if (determinant == 0) continue;
    const double u = -a.dot(across) / determinant;
    const double v = ray.dot((-a).cross(ab)) / determinant;
    const double t = ac.dot((-a).cross(ab)) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0) nearest = std::min(nearest, t);
  }
  return nearest;
}

struct Difference {
  int hit = 0, other = 0;
};

/// Pixels that hit the only shape, and those where picture and rays differ by more than the
/// rounding of single precision.
Difference compare(const World& world) {
  Renderer renderer(world, false);
  const Pose T_world_base = Pose::Identity();
  const cv::Mat1f depth = renderer.render_metric_depth(T_world_base);
  const Frame frame = testing::frame_at(renderer, T_world_base);
  const Calibration& calibration = world.calibration();
  const Shape& shape = world.shapes().at(0);
  const Pose T_depth_shape =
      (T_world_base * calibration.T_base_depth).inverse() * shape.T_world_shape;
  std::vector<Triangle> triangles = shape.triangles;
  for (Triangle& t : triangles)
    for (Vector3d& corner : t) corner = T_depth_shape * corner;
  Difference difference;
  for (int v = 0; v < depth.rows; v += 2) {
    for (int u = 0; u < depth.cols; u += 2) {
      const double exact = first_hit(triangles, calibration.depth.back_project(u, v, 1.0));
      const bool drawn = frame.depth_label(v, u) == 1;
      difference.hit += exact < kNothing;
      const bool same = drawn ? std::abs(exact - depth(v, u)) < 1e-4 : exact == kNothing;
      difference.other += !same;
    }
  }
  return difference;
}

TEST(DrawnTriangles, AreThoseOfTheTruth) {
  const std::string wedge = "vertex='0 0 0  .5 0 0  0 .6 0  .5 .6 0  0 0 .4  0 .6 .4'";
  const std::string head =
      "<asset><hfield name='hill' nrow='5' ncol='6' size='.5 .4 .3 .1' elevation='0 .2 0 .5 0 .1  "
      ".3 1 .2 .4 .9 0  .1 .3 .8 .2 .6 .2  0 .7 .1 .9 .3 .5  .2 0 .4 0 .8 0'/>"
      "<mesh name='wedge' " +
      wedge + "/><mesh name='scaled' scale='1 .5 1.5' " + wedge +
      "/><mesh name='mirrored' scale='-1 1 1' " + wedge +
      "/><mesh name='turned' scale='-1 -1 -1' " + wedge + "/></asset>";
  for (const char* geom :
       {"type='hfield' hfield='hill'", "type='mesh' mesh='wedge'", "type='mesh' mesh='scaled'",
        "type='mesh' mesh='mirrored'", "type='mesh' mesh='turned'", "type='sdf' mesh='scaled'"}) {
    // Seen from the front, the top, the base, both sides, and askew.
    for (const char* euler : {"0 0 0", "0 -90 0", "0 90 0", "90 0 0", "-90 0 0", "0 0 180",
                              "20 -40 30", "200 70 -50"}) {
      SCOPED_TRACE(std::string(geom) + " turned by " + euler);
      const World world = load_text(mjcf("<body name='a_1' pos='1.8 0 1.2' euler='" +
                                             std::string(euler) + "'><geom " + geom + "/></body>",
                                         head));
      const Difference difference = compare(world);
      EXPECT_GT(difference.hit, 1500);
      EXPECT_LE(difference.other, 2 + difference.hit / 500);  // rays that graze a silhouette
    }
  }
}

}  // namespace
}  // namespace mapscore::sim
