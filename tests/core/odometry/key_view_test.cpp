// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/key_view.hpp"

#include "tests/core/odometry/flat_depth.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace mapscore {
namespace {

using testing::BoxFlat;

struct Seen {
  cv::Mat1w depth;
  DepthScan scan;
};

Seen seen(const BoxFlat& flat, const Pose& T_map_base) {
  const Calibration camera = testing::odometry_camera();
  const cv::Mat1w depth = testing::flat_depth(flat, T_map_base, camera);
  return {depth, scan_of(depth, camera, {})};
}

/// A room with a cupboard 1.5 m ahead of the pose, or without it.
BoxFlat room(bool with_cupboard) {
  BoxFlat flat(6.0, 5.0);
  if (with_cupboard) flat.add(3.0, 1.5, 0.0, 3.4, 3.5, 2.0);
  return flat;
}

const Pose kPose = planar_pose(1.5, 2.5, 0.0);

TEST(SeenThrough, WhereSomethingStoodIsNothing) {
  const Calibration camera = testing::odometry_camera();
  const Seen with = seen(room(true), kPose), without = seen(room(false), kPose);
  EXPECT_GT(seen_through(without.depth, kPose, with.scan, kPose, camera), 0.9);
  EXPECT_EQ(seen_through(with.depth, kPose, with.scan, kPose, camera), 0.0);
  // What stands in front hides it: that says nothing.
  EXPECT_EQ(seen_through(with.depth, kPose, without.scan, kPose, camera), 0.0);
}

/// The end of a wall, seen from before it; along the wall's thickness it is no more than a line,
/// beside which the room goes on.
TEST(SeenThrough, ASilhouetteIsNotSeenThrough) {
  const Calibration camera = testing::odometry_camera();
  BoxFlat flat(6.0, 5.0);
  flat.add(3.0, 2.0, 0.0, 4.5, 2.1, 2.5);
  const Pose other = planar_pose(3.05, 3.9, -std::numbers::pi / 2);
  const Seen end = seen(flat, planar_pose(1.2, 2.3, -0.15));
  for (const double turned_by : {-0.005, 0.0, 0.005})  // a pixel and a half
    EXPECT_LT(seen_through(seen(flat, other).depth, other * planar_pose(0.0, 0.0, turned_by),
                           end.scan, planar_pose(1.2, 2.3, -0.15), camera),
              0.05)
        << turned_by;
}

TEST(SeenThrough, ADarkImageSaysNothing) {
  const Calibration camera = testing::odometry_camera();
  const Seen with = seen(room(true), kPose);
  EXPECT_EQ(seen_through(cv::Mat1w::zeros(with.depth.size()), kPose, with.scan, kPose, camera),
            0.0);
}

struct MissedCase {
  double on_plane_share;
  bool key_has_planes, misses;
};

/// The scan's upright points, on planes where `is_on_plane(point)`.
std::vector<UprightPoint> own_points(const DepthScan& scan, auto is_on_plane) {
  std::vector<UprightPoint> points;
  for (const std::size_t i : upright_points(scan, kPose))
    points.push_back({i, is_on_plane(scan.points[i])});
  return points;
}
std::vector<UprightPoint> own_points(const DepthScan& scan, bool on_planes) {
  return own_points(scan, [&](const Eigen::Vector3d&) { return on_planes; });
}

/// Far walls whose planes are not known yet: an image of them alone says nothing against its pose.
TEST(KeyView, DoesNotMissWhatItsOwnPointsThereLackToo) {
  const Calibration camera = testing::odometry_camera();
  const Seen with = seen(room(true), kPose), far = seen(room(false), kPose);
  const auto is_near = [](const Eigen::Vector3d& p) { return p.x() < 2.5; };  // the cupboard alone
  ScanMatch match;
  match.T_map_base = kPose;
  match.upright = UprightMatch{0.05, 0.0};
  const KeyView of_far(far.depth, far.scan, own_points(far.scan, is_near), camera);
  EXPECT_FALSE(of_far.misses(far.scan, match, camera, Pose::Identity()));
  const KeyView of_near(with.depth, with.scan, own_points(with.scan, is_near), camera);
  EXPECT_TRUE(of_near.misses(with.scan, match, camera, Pose::Identity()));
  // What stands before all that the key frame saw should lie on planes as often as any.
  const KeyView all_known(far.depth, far.scan, own_points(far.scan, true), camera);
  EXPECT_TRUE(all_known.misses(with.scan, match, camera, Pose::Identity()));
}

TEST(KeyView, MissesUprightPointsThatItMustHaveShown) {
  const Calibration camera = testing::odometry_camera();
  const Seen with = seen(room(true), kPose);
  for (const MissedCase& c :
       {MissedCase{0.1, true, true}, MissedCase{0.5, true, false}, MissedCase{0.1, false, false}}) {
    const KeyView view(with.depth, with.scan, own_points(with.scan, c.key_has_planes), camera);
    ScanMatch match;
    match.T_map_base = kPose;
    match.upright = UprightMatch{0.9, c.on_plane_share};
    EXPECT_EQ(view.misses(with.scan, match, camera, Pose::Identity()), c.misses);
    // A key frame that looked the other way showed nothing of this.
    EXPECT_FALSE(view.misses(with.scan, match, camera, planar_pose(0.0, 0.0, 3.0)));
  }
}

}  // namespace
}  // namespace mapscore
