// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/filled_slits.hpp"

#include <gtest/gtest.h>

namespace mapscore {
namespace {

/// A plane at 2 m with a wall at 4 m behind its slits.
struct Slatted {
  cv::Mat1w depth = cv::Mat1w(40, 60, std::uint16_t{10000});
  cv::Mat1w owner = cv::Mat1w(40, 60, std::uint16_t{1});

  void cut(const cv::Rect& slit) { depth(slit) = 20000; }
  [[nodiscard]] cv::Mat1b found(int widest_px) const {
    Calibration camera;
    camera.depth = CameraModel::from_hfov(60, 40, 1.0);
    return filled_slits(find_depth_edges(depth, camera), owner, widest_px);
  }
};

TEST(FilledSlits, UpToTheirWidthAlongRowsAndColumns) {
  Slatted upright, level;
  upright.cut({20, 0, 4, 40});
  level.cut({0, 10, 60, 4});
  EXPECT_EQ(cv::countNonZero(upright.found(4)(cv::Rect(20, 0, 4, 40))), 4 * 40);
  EXPECT_EQ(cv::countNonZero(upright.found(4)), 4 * 40);
  EXPECT_EQ(cv::countNonZero(level.found(4)), 60 * 4);
  EXPECT_EQ(cv::countNonZero(upright.found(3)), 0);
  EXPECT_EQ(cv::countNonZero(level.found(3)), 0);
}

TEST(FilledSlits, BothEndsAndTheRunBelongToOne) {
  Slatted slatted;
  slatted.cut({20, 0, 4, 40});
  slatted.owner(cv::Rect(24, 0, 36, 20)) = 2;
  EXPECT_EQ(cv::countNonZero(slatted.found(4)), 4 * 20);
  slatted.owner(cv::Rect(20, 20, 4, 20)) = 0;
  EXPECT_EQ(cv::countNonZero(slatted.found(4)), 0);
}

TEST(FilledSlits, NothingAtTheImagesEdgeNorBesideHolesNorInFront) {
  Slatted open, holed, bar;
  open.cut({0, 0, 3, 40});
  EXPECT_EQ(cv::countNonZero(open.found(4)), 0);
  holed.cut({20, 0, 3, 40});
  holed.depth(cv::Rect(23, 0, 1, 40)) = 0;
  EXPECT_EQ(cv::countNonZero(holed.found(5)), 0);
  bar.depth(cv::Rect(20, 0, 3, 40)) = 5000;
  EXPECT_EQ(cv::countNonZero(bar.found(4)), 0);
}

}  // namespace
}  // namespace mapscore
