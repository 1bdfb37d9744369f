// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/edge_aligned.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "plate_scene.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <cstdint>
#include <vector>

namespace mapscore {
namespace {

using namespace mapscore::testing;

OutlineAlignment fit_of_drawer(const std::vector<Detection>& detections, const PlateScene& scene,
                               const Calibration& believed) {
  return align_outlines(find_depth_edges(scene.depth(), believed),
                        outline_field(detections, 320, 240, 68), believed, 40)
      .mended;
}

void expect_grown(const PlateScene& scene, const Calibration& believed,
                  const std::vector<Detection>& detections) {
  const Agreement found = agreement(label_depth(detections, scene.depth(), believed, {}),
                                    detections, scene.depth_label());
  EXPECT_GE(found.precision, 0.995);
  EXPECT_GE(found.recall, 0.98);
}

/// A drawer, 7 mm before its undetected case, that ends with it at its left and bottom and 8 px
/// inside it at its right and top. Masks 4 px too small, and a turn by as much, explain all of its
/// outline; what is right explains its left and bottom, and a part of its weak own steps.
TEST(EdgeAlignedSetIn, WhatIsSetIntoSomethingUndetectedKeepsItsMask) {
  const PlateScene scene({{-0.1, 0.1, -0.1, 0.1, 1.493, 1}, {-0.1, 0.143, -0.143, 0.1, 1.5, 0}});
  const OutlineAlignment fit = fit_of_drawer(scene.detections(), scene, scene.truth());
  EXPECT_NEAR(fit.offset_px, 0, 0.5);
  EXPECT_LT(fit.score, 0.7F);
  const std::vector<Detection> detections = scene.detections();
  const Agreement found = agreement(label_depth(detections, scene.depth(), scene.truth(), {}),
                                    detections, scene.depth_label());
  EXPECT_GE(found.precision, 0.99);
  EXPECT_GE(found.recall, 0.9);
}

cv::Mat1w shrunk(const cv::Mat1w& label) {
  cv::Mat1w smaller;
  cv::erode(label, smaller, cv::Mat1b(5, 5, std::uint8_t{1}));
  return smaller;
}

/// A smaller drawer with a handle and without a case. Where 11 px are wrong both ways, the handle
/// explains a little of the outline.
TEST(EdgeAlignedSetIn, ASmallObjectsMaskThatIsTooSmallGrows) {
  const PlateScene scene(
      {{-0.08, 0.08, -0.08, 0.08, 1.493, 1}, {-0.05, 0.007, 0.01, 0.05, 1.45, 1}});
  const std::vector<Detection> detections = scene.detections(shrunk(scene.label()));
  expect_grown(scene, scene.truth(), detections);
  expect_grown(scene, scene.misregistered({0.06, -0.06, 0}, {0, 0, 0}), detections);
}

/// What is believed explains its top and bottom, and too little: half of its outline are 150 px.
TEST(EdgeAlignedSetIn, ALargeObjectsMaskThatIsTooSmallGrows) {
  const PlateScene scene({{-0.22, 0.22, -0.22, 0.22, 1.5, 1}});
  const Calibration believed = scene.misregistered({0.1, 0, 0}, {0, 0, 0});
  const std::vector<Detection> detections = scene.detections(shrunk(scene.label()));
  EXPECT_GT(fit_of_drawer(detections, scene, believed).score, 0.9F);
  expect_grown(scene, believed, detections);
}

/// A door, flush with its undetected case, that ends with it at its sides and 5 px above its
/// bottom.
TEST(EdgeAlignedSetIn, WhereTheCalibrationIsKnownAnOutlineDoesNotMoveToWhatRunsBesideIt) {
  const PlateScene scene({{-0.2, 0.2, -0.2, 0.2, 1.4999, 1}, {-0.2, 0.2, -0.4, 0.227, 1.5, 0}});
  const std::vector<Detection> detections = scene.detections();
  const Agreement found =
      agreement(label_depth(detections, scene.depth(), scene.truth(), {.fit = OutlineFit::masks}),
                detections, scene.depth_label());
  EXPECT_GE(found.precision, 0.995);
  EXPECT_GE(found.recall, 0.9);
}

}  // namespace
}  // namespace mapscore
