// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/voxel_packer.hpp"

#include "core/geometry/voxel.hpp"
#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mapscore::testing {
namespace {

Pose a_turned_pose() {
  Pose T = Pose::Identity();
  T.linear() = exp_rotation({0.3, -0.2, 1.1});
  T.translation() = Eigen::Vector3d(1.0, -2.0, 0.5);
  return T;
}

std::uint64_t packed(const VoxelPacker& packer, const Eigen::Vector3d& p) {
  return packer(p.x(), p.y(), p.z());
}

TEST(VoxelPacker, GivesTheVoxelOfAMovedPoint) {
  const Pose T = a_turned_pose();
  const VoxelPacker packer(T, 0.05);
  RandomStream stream(1, "points");
  for (int n = 0; n < 10000; ++n) {
    const Eigen::Vector3d p(20 * stream.uniform() - 10, 20 * stream.uniform() - 10,
                            20 * stream.uniform() - 10);
    Eigen::Vector3d moved;
    for (int row = 0; row < 3; ++row)
      moved[row] = T(row, 0) * p.x() + T(row, 1) * p.y() + T(row, 2) * p.z() + T(row, 3);
    ASSERT_EQ(packed(packer, p), pack(voxel_of(moved, 0.05)));
  }
}

TEST(VoxelPacker, FacesBelongToTheVoxelAbove) {
  const VoxelPacker packer(Pose::Identity(), 0.25);
  for (int n = -8; n <= 8; ++n) {
    const Eigen::Vector3d p(0.25 * n, -0.25 * n, std::nextafter(0.25 * n, -9.0));
    EXPECT_EQ(packed(packer, p), pack({n, -n, n - 1})) << n;
  }
}

TEST(VoxelPacker, HasNoneForWhatIsNotFiniteOrTooFar) {
  const VoxelPacker packer(Pose::Identity(), 0.5);
  const double last = 0.5 * ((1 << 20) - 1), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(packed(packer, {last, -last, 0}), pack({(1 << 20) - 1, 1 - (1 << 20), 0}));
  for (const double beyond : {std::nextafter(last, 1e9), -1e300, nan, HUGE_VAL, -HUGE_VAL})
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3d p = Eigen::Vector3d::Zero();
      p[axis] = beyond;
      EXPECT_EQ(packed(packer, p), VoxelPacker::kNone) << beyond;
    }
}

}  // namespace
}  // namespace mapscore::testing
