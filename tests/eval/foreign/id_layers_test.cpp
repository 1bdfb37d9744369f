// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/id_layers.hpp"

#include "core/random_stream.hpp"
#include "tests/support/expect_error.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;

constexpr int kColumns = 24, kRows = 16;

const std::vector<SemanticClass> kClasses{{}, {1, "cup", {}, true}, {2, "bowl", {}, true}};

/// A detection that covers this window of the image.
Detection covering(const cv::Rect& window, ClassId class_id, InstanceId instance, double score) {
  return {class_id,
          instance,
          score,
          {window.x, window.y, window.br().x - 1, window.br().y - 1},
          cv::Mat1b(window.size(), std::uint8_t{255}),
          {kColumns, kRows}};
}

std::vector<Detection> there_and_back(const std::vector<Detection>& detections, int& layers) {
  const IdLayers written = id_layers(detections, {kColumns, kRows});
  layers = static_cast<int>(written.images.size());
  return detections_of(written.meanings, kClasses, [&](int layer) {
    return written.images.at(static_cast<std::size_t>(layer));
  });
}

void expect_equal(const std::vector<Detection>& a, const std::vector<Detection>& b,
                  bool with_ids = true) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    EXPECT_EQ(a[n].class_id, b[n].class_id);
    EXPECT_EQ(with_ids ? a[n].instance : 0, with_ids ? b[n].instance : 0);
    EXPECT_EQ(a[n].score, b[n].score);
    EXPECT_EQ(a[n].box, b[n].box);
    EXPECT_EQ(cv::countNonZero(a[n].mask != b[n].mask), 0);
    EXPECT_EQ(a[n].image_px, b[n].image_px);
  }
}

TEST(IdLayers, OneHoldsMasksThatDoNotOverlap) {
  const std::vector<Detection> detections{covering({0, 0, 4, 4}, 1, 7, 0.25),
                                          covering({4, 0, 4, 4}, 2, 3, 1.0 / 3.0)};
  int layers = 0;
  expect_equal(there_and_back(detections, layers), detections);
  EXPECT_EQ(layers, 1);
}

TEST(IdLayers, OverlappingMasksTakeFurtherOnes) {
  const std::vector<Detection> detections{covering({0, 0, 9, 9}, 1, 1, 0.9),
                                          covering({3, 3, 9, 9}, 2, 2, 0.8),
                                          covering({8, 8, 2, 2}, 2, 3, 0.7)};
  int layers = 0;
  expect_equal(there_and_back(detections, layers), detections);
  EXPECT_EQ(layers, 3);
}

TEST(IdLayers, EqualInstancesAreNumberedAnew) {
  const std::vector<Detection> detections{covering({0, 0, 4, 4}, 1, 5, 0.9),
                                          covering({2, 2, 4, 4}, 2, 5, 0.8)};
  int layers = 0;
  expect_equal(there_and_back(detections, layers), detections, false);
  EXPECT_EQ(layers, 2);
}

TEST(IdLayers, AnyDetectionsComeBackInTheirOrder) {
  RandomStream draws(1, "id layers");
  const auto below = [&](int most) { return static_cast<int>(draws.uniform() * most); };
  for (int turn = 0; turn < 200; ++turn) {
    std::vector<Detection> detections;
    for (int n = below(8); n > 0; --n) {
      const cv::Point at(below(kColumns - 1), below(kRows - 1));
      const cv::Size size(1 + below(kColumns - at.x), 1 + below(kRows - at.y));
      detections.push_back(covering({at, size}, static_cast<ClassId>(1 + below(2)),
                                    static_cast<InstanceId>(100 * n + below(100)),
                                    draws.uniform()));
    }
    int layers = 0;
    expect_equal(there_and_back(detections, layers), detections);
  }
}

TEST(IdLayers, ADetectionThatDoesNotFitIsRefused) {
  expect_error("beyond", [] {
    (void)id_layers({covering({20, 10, 9, 9}, 1, 1, 1.0)}, {kColumns, kRows});
  });
  expect_error("stands twice", [] {
    (void)detections_of({{{}, 0, 4, 1, 1.0}, {{}, 0, 4, 2, 1.0}}, kClasses,
                        [](int) { return cv::Mat1w::zeros(kRows, kColumns); });
  });
}

}  // namespace
}  // namespace mapscore::eval
