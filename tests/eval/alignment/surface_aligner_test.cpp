// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/alignment/surface_aligner.hpp"

#include "core/geometry/voxel.hpp"
#include "tests/eval/alignment/furnished_room.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <set>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;
using testing::box_at;
using testing::empty_room;
using testing::furnished_room;
using ::testing::HasSubstr;
using testing::inside_points;

constexpr double kDegree = std::numbers::pi / 180.0;

SurfaceAligner aligner_of(const std::vector<Shape>& shapes, int jobs = 2) {
  return {prepare(shapes, Pose::Identity()), jobs};
}

std::vector<Vector3d> moved(const std::vector<Vector3d>& points, const Pose& motion) {
  std::vector<Vector3d> there;
  for (const Vector3d& p : points) there.push_back(motion * p);
  return there;
}

/// The centres of the voxels that hold points. A surface may lie anywhere in its voxels, and so few
/// of them leave their place open by up to half a voxel.
std::vector<Vector3d> voxelised(const std::vector<Vector3d>& points, double edge_m) {
  std::set<VoxelKey> keys;
  for (const Vector3d& p : points) keys.insert(voxel_of(p, edge_m));
  std::vector<Vector3d> centres;
  for (const VoxelKey& key : keys) centres.push_back(centre_of(key, edge_m));
  return centres;
}

/// Yaw of 130 degrees, 9 of tilt, 2.9 m of shift.
Pose far_motion() {
  Pose motion = planar_pose(-2.1, 1.9, 130 * kDegree);
  motion.linear() = exp_rotation({9 * kDegree, 0, 0}) * motion.linear();
  motion.translation().z() = 0.7;
  return motion;
}

void expect_found(const Alignment& found, const Pose& motion, double within_m) {
  EXPECT_EQ(found.refusal, "");
  const Pose off = found.best.motion * motion;
  const Vector3d middle(2, 1.5, 0.7);
  EXPECT_LT((off * middle - middle).norm(), within_m);
  EXPECT_LT(Eigen::AngleAxisd(off.linear()).angle(), 0.5 * kDegree);
  EXPECT_GT(found.best.share, 0.8);
}

void expect_found_again(const std::vector<Vector3d>& map, double within_m) {
  const SurfaceAligner aligner = aligner_of(furnished_room());
  const Alignment found = aligner.align(moved(map, far_motion()));
  expect_found(found, far_motion(), within_m);
  EXPECT_LT(found.before.share, 0.5);
  EXPECT_LT(found.next.share, found.best.share);
  expect_found(aligner.align(map), Pose::Identity(), within_m);
}

TEST(SurfaceAligner, FindsACloudAgain) {
  expect_found_again(inside_points(furnished_room(), 30'000), 0.01);
}

TEST(SurfaceAligner, FindsVoxelsAgainToHalfAnEdge) {
  expect_found_again(voxelised(inside_points(furnished_room(), 30'000), 0.047), 0.0235);
}

TEST(SurfaceAligner, IsTheSameForAnyNumberOfJobs) {
  const auto map = moved(inside_points(furnished_room(), 5'000), far_motion());
  const Alignment one = aligner_of(furnished_room(), 1).align(map);
  const Alignment four = aligner_of(furnished_room(), 4).align(map);
  EXPECT_EQ(one.best.motion.matrix(), four.best.motion.matrix());
  EXPECT_EQ(one.best.share, four.best.share);
  EXPECT_EQ(one.next.share, four.next.share);
}

TEST(SurfaceAligner, RefusesARoomThatTurnedRoundIsTheSame) {
  const auto map = inside_points(empty_room(), 20'000);
  EXPECT_THAT(aligner_of(empty_room()).align(map).refusal, HasSubstr("two places fit alike"));
}

TEST(SurfaceAligner, RefusesAFloorThatCouldLieAnywhere) {
  std::vector<Vector3d> floor;
  for (const Vector3d& p : inside_points(furnished_room(), 40'000))
    if (p.z() < 1e-6 && p.x() > 1.5 && p.x() < 2.5) floor.push_back(p);
  EXPECT_THAT(aligner_of(furnished_room()).align(floor).refusal, HasSubstr("two places fit alike"));
}

TEST(SurfaceAligner, RefusesAFloorThatFillsItsRoom) {
  // Nothing but the rim of the floor holds it, and all other places overlap with this one.
  const std::vector<Shape> floor{box_at({2, 1.5, -0.05}, {2.1, 1.6, 0.05}),
                                 box_at({2, 1.5, 0.05}, {0.05, 0.08, 0.05})};
  const Alignment found = aligner_of(floor).align(inside_points(floor, 20'000));
  EXPECT_NE(found.refusal, "");
}

TEST(SurfaceAligner, SurfacesThatNoCameraSawHoldNoMap) {
  // A house of two equal rooms, of which one was seen.
  std::vector<Shape> house = furnished_room();
  for (Shape shape : furnished_room()) {
    shape.T_world_shape.pretranslate(Vector3d(7, 0, 0));
    house.push_back(shape);
  }
  const std::vector<Vector3d> room = inside_points(furnished_room(), 30'000);
  const std::vector<Vector3d> map = moved(room, far_motion());
  EXPECT_THAT(aligner_of(house).align(map).refusal, HasSubstr("two places fit alike"));
  expect_found(SurfaceAligner(prepare(house, Pose::Identity()), 2, room).align(map), far_motion(),
               0.01);
}

TEST(SurfaceAligner, NeverMovesAMapToAWorsePlace) {
  for (const std::size_t points : {300, 3'000, 30'000}) {
    const Alignment found =
        aligner_of(furnished_room()).align(inside_points(furnished_room(), points));
    EXPECT_GE(found.best.share, found.before.share) << points;
  }
}

TEST(SurfaceAligner, RefusesRandomPoints) {
  RandomStream random(3, "cloud");
  std::vector<Vector3d> cloud;
  for (int n = 0; n < 20'000; ++n)
    cloud.emplace_back(4 * random.uniform(), 3 * random.uniform(), 2 * random.uniform());
  EXPECT_THAT(aligner_of(furnished_room()).align(cloud).refusal, HasSubstr("nowhere"));
}

TEST(SurfaceAligner, RefusesAHandfulOfPoints) {
  EXPECT_THAT(aligner_of(furnished_room()).align(inside_points(furnished_room(), 10)).refusal,
              HasSubstr("too few"));
}

}  // namespace
}  // namespace mapscore::eval
