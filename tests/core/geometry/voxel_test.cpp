// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/voxel.hpp"

#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mapscore {
namespace {

TEST(Voxel, OfAPositionIsTheFloorOnEachAxis) {
  RandomStream stream(1, "voxel");
  for (const double edge_m : {0.05, 0.0625, 0.013}) {
    std::vector<double> positions{
        0.0, -0.0, 1e-300, -1e-300, 2147483646.5 * edge_m, -2147483647.5 * edge_m};
    for (int voxel = -2000; voxel <= 2000; ++voxel)
      for (const double face : {voxel * edge_m, voxel * 1e5 * edge_m})
        for (const double towards : {face, -1e9, 1e9})
          positions.push_back(std::nextafter(face, towards));
    for (int n = 0; n < 20000; ++n) positions.push_back(200 * stream.uniform() - 100);
    for (const double x : positions) {
      const auto expected = static_cast<std::int32_t>(std::floor(x / edge_m));
      EXPECT_EQ(voxel_of({x, 0.5 * edge_m, -0.5 * edge_m}, edge_m), (VoxelKey{expected, 0, -1}));
      EXPECT_EQ(voxel_of({0, x, x}, edge_m), (VoxelKey{0, expected, expected}));
    }
  }
}

}  // namespace
}  // namespace mapscore
