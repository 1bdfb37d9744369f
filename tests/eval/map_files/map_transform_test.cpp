// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/map_transform.hpp"

#include "tests/eval/map_files/cloud_bytes.hpp"
#include "tests/support/expect_error.hpp"

namespace mapscore::eval {
namespace {

using testing::expect_error;

struct MapTransform : testing::MapFiles {};

TEST_F(MapTransform, APoseWithAndWithoutStampAndAMatrixAreOne) {
  Eigen::Matrix4d quarter_turn;
  quarter_turn << 0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1;
  for (const char* text :
       {"1 2 3 0 0 0.70710678118654757 0.70710678118654757",
        "# stamp first\n17.5 1 2 3 0 0 0.70710678118654757 0.70710678118654757\n",
        "0 -1 0 1\n1 0 0 2 # second row\n0, 0, 1, 3\n0 0 0 1\n",
        "0,-1,0,1,1,0,0,2,0,0,1,3,0,0,0,1"}) {
    EXPECT_LT((parse_transform(text, "--transform").matrix() - quarter_turn).norm(), 1e-15) << text;
    EXPECT_LT((read_transform(file("T.txt", text)).matrix() - quarter_turn).norm(), 1e-15) << text;
  }
}

TEST_F(MapTransform, ExactMatricesStayExact) {
  const Pose pose = parse_transform("0 -1 0 0.1 1 0 0 0.2 0 0 1 0.3 0 0 0 1", "here");
  EXPECT_EQ(pose.linear()(0, 1), -1.0);
  EXPECT_EQ(pose.linear()(0, 0), 0.0);
  EXPECT_EQ(pose.translation(), Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(parse_transform("0 0 0 0 0 0 1", "here").matrix(), Pose::Identity().matrix());
}

TEST_F(MapTransform, RoundedRotationsAreMended) {
  const Pose pose = parse_transform("0.8660254 -0.5 0 0 0.5 0.8660254 0 0 0 0 1 0 0 0 0 1", "here");
  const Eigen::Matrix3d off =
      pose.linear() * pose.linear().transpose() - Eigen::Matrix3d::Identity();
  EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_NEAR(pose.linear()(0, 0), 0.8660254, 1e-7);
}

TEST_F(MapTransform, BadTransforms) {
  const auto refused = [&](const std::string& text, const std::string& part) {
    expect_error(part, [&] { (void)parse_transform(text, "--transform"); });
  };
  refused("", "--transform: a transform has 7 numbers");
  refused("1 2 3", "these are 3");
  refused("1 2 3 0 0 x 1", "--transform: 'x' is no finite number");
  refused("1 2 3 0 0 nan 1", "--transform: 'nan' is no finite number");
  refused("1 2 3 0 0 0 2", "quaternion qx qy qz qw is not of length 1");
  refused("1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1", "the last row of the matrix is not 0 0 0 1");
  refused("2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1", "the rotation is off orthonormal by 3");
  refused("1 0 0 0 0 1 0 0 0 0 1.000002 0 0 0 0 1", "off orthonormal by 4e-06");
  refused("1e300 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "off orthonormal by");
  refused("1 0 0 0 0 1 0 0 0 0 -1 0 0 0 0 1", "the rotation is a reflection");
  const auto path = file("T.txt", "# T\n1 2 3\n0 0 o 1\n");
  expect_error("T.txt:3: 'o' is no finite number", [&] { (void)read_transform(path); });
  expect_error("cannot open", [&] { (void)read_transform(folder_ / "none.txt"); });
}

}  // namespace
}  // namespace mapscore::eval
