// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/refinement/permutohedral_lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mapscore {
namespace {

/// Features 0.3 sigmas apart in a cube of 6.3 sigmas; the last lies in its middle, off the grid.
std::vector<std::array<float, 3>> dense_cube() {
  std::vector<std::array<float, 3>> features;
  for (int x = 0; x < 22; ++x)
    for (int y = 0; y < 22; ++y)
      for (int z = 0; z < 22; ++z) features.push_back({0.3f * x, 0.3f * y, 0.3f * z});
  features.push_back({3.07f, 3.21f, 2.94f});
  return features;
}

TEST(PermutohedralLattice, ValueAtOneFeatureSpreadsLikeAGaussian) {
  const auto features = dense_cube();
  const auto count = static_cast<Eigen::Index>(features.size());
  Eigen::MatrixXf impulse = Eigen::MatrixXf::Zero(1, count);
  impulse(0, count - 1) = 1.0f;
  const Eigen::MatrixXf out = PermutohedralLattice<3>(features).filtered(impulse, 1);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
  double sum = 0.0;
  for (Eigen::Index i = 0; i < count - 1; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = features[static_cast<std::size_t>(i)][axis] - features.back()[axis];
      mean[axis] += out(0, i) * x;
      squares[axis] += out(0, i) * x * x;
    }
    sum += out(0, i);
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(mean[axis] / sum, 0.0, 0.05);
    EXPECT_NEAR(squares[axis] / sum, 1.0, 0.15);
  }
}

TEST(PermutohedralLattice, OwnKernelIsWhatAFeatureGetsBackOfItself) {
  const auto features = dense_cube();
  const auto count = static_cast<Eigen::Index>(features.size());
  const PermutohedralLattice<3> lattice(features);
  for (const Eigen::Index i : {count - 1, Eigen::Index{5577}, Eigen::Index{5050}}) {  // far within
    Eigen::MatrixXf impulse = Eigen::MatrixXf::Zero(1, count);
    impulse(0, i) = 1.0f;
    EXPECT_NEAR(lattice.filtered(impulse, 1)(0, i), lattice.own_kernel(static_cast<std::size_t>(i)),
                1e-5);
  }
}

TEST(PermutohedralLattice, EightFeaturesOfOnePlaceAreSummed) {
  const std::vector<std::array<float, 6>> features(8, {1.5f, -2.5f, 3.1f, 0.2f, 0.7f, 9.9f});
  const PermutohedralLattice<6> lattice(features);
  EXPECT_EQ(lattice.vertices(), 7u);
  const Eigen::MatrixXf out = lattice.filtered(Eigen::MatrixXf::Ones(2, 8), 1);
  for (int i = 1; i < 8; ++i) EXPECT_EQ(out(1, i), out(0, 0));
  const Eigen::MatrixXf one =
      PermutohedralLattice<6>({features.front()}).filtered(Eigen::MatrixXf::Ones(1, 1), 1);
  EXPECT_NEAR(out(0, 0), 8 * one(0, 0), 1e-5);
}

}  // namespace
}  // namespace mapscore
