// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/segmentation/segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

namespace mapscore {
namespace {

struct Method {
  const char* name;
  Segmentation params;
};
void PrintTo(const Method& method, std::ostream* out) {
  *out << method.name;
}

/// A plate before a plane at 2 m, seen by cameras of 64 x 48 pixels.
class FrameSegmentation : public ::testing::TestWithParam<Method> {
 protected:
  FrameSegmentation() {
    pair_.color = pair_.depth = CameraModel{64, 48, 50, 50, 31.5, 23.5};
    table_.classes.push_back({1, "thing", {}, true});
    table_.instances.push_back({1, "thing_1", 1});
    depth_(cv::Rect(5, 5, 12, 10)) = 7000;
  }

  [[nodiscard]] std::vector<Detection> found_in(int width_px, int height_px) const {
    cv::Mat1w label(height_px, width_px, std::uint16_t{0});
    label(cv::Rect(5, 5, 12, 10)) = 1;
    return detections_of(label, table_);
  }
  [[nodiscard]] std::vector<Segment> segments(const std::vector<Detection>& detections) const {
    return segment(Sight(pair_, depth_, detections), GetParam().params, 0.05, false);
  }
  /// Refused with one line that says so.
  void expect_refused(const std::function<void()>& act, const std::string& why) const {
    try {
      act();
      ADD_FAILURE() << "not refused: " << why;
    } catch (const Error& error) {
      const std::string line = error.what();
      EXPECT_NE(line.find(why), std::string::npos) << line;
      EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 0) << line;
    }
  }

  Calibration pair_;
  ClassTable table_;
  cv::Mat1w depth_ = cv::Mat1w(48, 64, std::uint16_t{10000});
};

TEST_P(FrameSegmentation, TakesImagesOfTheColourCamerasSizeAlone) {
  const auto segmented = segments(found_in(64, 48));
  ASSERT_EQ(segmented.size(), 1u);
  EXPECT_FALSE(segmented[0].points.empty());
  expect_refused([&] { (void)segments(found_in(32, 24)); }, "32 x 24");
  expect_refused([&] { (void)segments(found_in(128, 96)); }, "128 x 96");
  std::visit(
      [&]<class Kind>(const Kind& kind) {
        if constexpr (ByDetection<Kind>) {
          const RegisteredCloud cloud = register_depth(depth_, pair_);
          expect_refused([&] { (void)segment(found_in(32, 24)[0], cloud, 0.05, kind, false); },
                         "32 x 24");
        }
      },
      GetParam().params);
}

TEST_P(FrameSegmentation, MasksFillTheirBoxes) {
  std::vector<Detection> detections = found_in(64, 48);
  detections[0].mask = cv::Mat1b(10, 11, std::uint8_t{255});
  expect_refused([&] { (void)segments(detections); }, "11 x 10");
  detections = found_in(64, 48);
  detections[0].box.u_max = 70;
  expect_refused([&] { (void)segments(detections); }, "beyond");
}

TEST_P(FrameSegmentation, CamerasHaveFocalLengths) {
  const Calibration right = pair_;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect_bad = [&](const Calibration& wrong, const std::string& why) {
    pair_ = wrong;
    expect_refused([&] { (void)segments(found_in(64, 48)); }, why);
    expect_refused([&] { (void)register_depth(depth_, pair_); }, why);
  };
  for (const double bad : {0.0, -50.0, nan}) {
    Calibration wrong = right;
    wrong.depth.fx_px = bad;
    expect_bad(wrong, "depth camera: focal");
    wrong = right;
    wrong.color.fy_px = bad;
    expect_bad(wrong, "colour camera: focal");
  }
  Calibration wrong = right;
  wrong.color.cx_px = nan;
  expect_bad(wrong, "principal point");
  wrong = right;
  wrong.T_color_depth.translation().x() = nan;
  expect_bad(wrong, "T_color_depth");
}

TEST_P(FrameSegmentation, HandMadeDetectionsNeedNotKnowTheirImage) {
  std::vector<Detection> detections = found_in(64, 48);
  const auto expected = segments(detections);
  detections[0].image_px = {};
  EXPECT_EQ(segments(detections)[0].points, expected[0].points);
}

INSTANTIATE_TEST_SUITE_P(
    Methods, FrameSegmentation,
    ::testing::Values(Method{"direct", Direct{}}, Method{"erosion", Erosion{1}},
                      Method{"region_growing", RegionGrowing{}},
                      Method{"edge_aligned", EdgeAligned{}},
                      Method{"largest_component", LargestComponent{}}, Method{"dbscan", Dbscan{}},
                      Method{"depth_segments", DepthSegments{.min_segment_px = 50}}));

}  // namespace
}  // namespace mapscore
