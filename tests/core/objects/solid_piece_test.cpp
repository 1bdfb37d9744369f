// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/solid_piece.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"
#include "tests/core/points.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace mapscore {
namespace {

using testing::Points;

/// Pieces by comparing every pair of points; the one with most points, ties to the earlier.
Points plain_piece(const Points& points, double cell_m) {
  const auto cell = [&](const Eigen::Vector3d& p) {
    return Eigen::Vector3d((p / cell_m).array().floor());
  };
  std::vector<std::size_t> piece(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) piece[n] = n;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t a = 0; a < points.size(); ++a)
      for (std::size_t b = 0; b < points.size(); ++b) {
        const Eigen::Vector3d apart = cell(points[a]) - cell(points[b]);
        if (apart.cwiseAbs().maxCoeff() > 1.0 || piece[a] <= piece[b]) continue;
        piece[a] = piece[b];
        changed = true;
      }
  }
  Points best;
  for (std::size_t first = 0; first < points.size(); ++first) {
    Points members;
    for (std::size_t n = 0; n < points.size(); ++n)
      if (piece[n] == first) members.push_back(points[n]);
    if (members.size() > best.size()) best = members;
  }
  return best;
}

TEST(SolidPiece, LeavesTheWallBehindTheEdgeAway) {
  Points points;
  for (int n = 0; n < 50; ++n) points.emplace_back(0.01 * n, 0.0, 1.0);  // half a metre of object
  const Points object = points;
  for (int n = 0; n < 20; ++n) points.emplace_back(0.51 + 0.01 * n, 0.0, 2.5);
  EXPECT_EQ(largest_solid_piece(points, 0.05), object);
  EXPECT_EQ(largest_solid_piece(points, 5.0), points);  // a cell that holds both
}

TEST(SolidPiece, EqualsThePlainForm) {
  RandomStream stream(3, "solid_piece");
  for (int cloud = 0; cloud < 200; ++cloud) {
    Points points;
    const int count = 1 + static_cast<int>(60 * stream.uniform());
    for (int n = 0; n < count; ++n)
      points.emplace_back(stream.uniform() - 0.5, stream.uniform() - 0.5, stream.uniform());
    const double cell_m = 0.03 + 0.15 * stream.uniform();
    EXPECT_EQ(largest_solid_piece(points, cell_m), plain_piece(points, cell_m));
  }
}

TEST(SolidPiece, NothingOnePointAndATie) {
  EXPECT_TRUE(largest_solid_piece({}, 0.05).empty());
  EXPECT_EQ(largest_solid_piece({{1, 2, 3}}, 0.05).size(), 1u);
  const Points tie{{9, 9, 9}, {-9, -9, -9}};
  EXPECT_EQ(largest_solid_piece(tie, 0.05), Points{tie[0]});  // the earlier, not the lower
  EXPECT_THROW((void)largest_solid_piece(tie, 0.0), Error);
  EXPECT_THROW((void)largest_solid_piece(tie, std::nan("")), Error);
}

}  // namespace
}  // namespace mapscore
