// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/label_edges.hpp"

#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace mapscore::eval {
namespace {

constexpr std::size_t kEdgeClasses = 4;

/// Blocks of random classes, so that there are edges near each other and areas without any.
cv::Mat1w random_blocks(cv::Size size, std::uint64_t seed) {
  RandomStream stream(seed, "test", {0});
  const auto below = [&](int most) { return static_cast<int>(stream.uniform() * most); };
  cv::Mat1w image = cv::Mat1w::zeros(size);
  for (int n = 0; n < 12; ++n) {
    const cv::Rect block(below(size.width), below(size.height), 1 + below(9), 1 + below(9));
    image(block & cv::Rect({}, size)).setTo(below(kEdgeClasses));
  }
  return image;
}

bool plainly_at_edge(const cv::Mat1w& image, int u, int v) {
  for (const auto& [du, dv] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
    const int x = u + du, y = v + dv;
    if (x >= 0 && y >= 0 && x < image.cols && y < image.rows && image(y, x) != image(v, u))
      return true;
  }
  return false;
}

/// Every pixel against every pixel.
std::pair<std::int64_t, std::int64_t> plainly_counted(const cv::Mat1w& image,
                                                      const cv::Mat1w& other, std::uint16_t id,
                                                      int tolerance_px) {
  std::int64_t all = 0, near = 0;
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      if (image(v, u) != id || !plainly_at_edge(image, u, v)) continue;
      bool found = false;
      for (int y = 0; y < other.rows; ++y)
        for (int x = 0; x < other.cols; ++x)
          found = found || (other(y, x) == id && plainly_at_edge(other, x, y) &&
                            (x - u) * (x - u) + (y - v) * (y - v) <= tolerance_px * tolerance_px);
      ++all;
      near += found ? 1 : 0;
    }
  return {all, near};
}

TEST(LabelEdges, AreThoseOfAPlainCount) {
  const cv::Size size(37, 26);
  std::int64_t near = 0, far = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const cv::Mat1w truth = random_blocks(size, seed), named = random_blocks(size, seed + 100);
    const int tolerance_px = 1 + static_cast<int>(seed % 3);
    const auto edges = count_edges(truth, named, kEdgeClasses, tolerance_px);
    for (std::uint16_t id = 0; id < kEdgeClasses; ++id) {
      const auto [true_px, found_px] = plainly_counted(truth, named, id, tolerance_px);
      const auto [named_px, right_px] = plainly_counted(named, truth, id, tolerance_px);
      EXPECT_EQ(edges[id], (EdgeCounts{true_px, found_px, named_px, right_px}))
          << seed << ' ' << id;
      near += found_px;
      far += true_px - found_px;
    }
  }
  EXPECT_GT(near, 100);
  EXPECT_GT(far, 100);
}

TEST(LabelEdges, ByHand) {
  cv::Mat1w truth = cv::Mat1w::zeros(6, 8), named = cv::Mat1w::zeros(6, 8);
  truth(cv::Rect(0, 0, 4, 6)).setTo(1);  // a wall on the left: its edge is one column
  named(cv::Rect(0, 0, 6, 6)).setTo(1);  // two columns too far
  const auto narrow = count_edges(truth, named, 2, 1);
  EXPECT_EQ(narrow[1], (EdgeCounts{6, 0, 6, 0})) << "the image's border is no edge";
  EXPECT_EQ(narrow[0], (EdgeCounts{6, 0, 6, 0}));
  const auto wide = count_edges(truth, named, 2, 2);
  EXPECT_EQ(wide[1], (EdgeCounts{6, 6, 6, 6}));
  EXPECT_EQ(boundary_f(wide[1]), 1.0);
  EXPECT_EQ(boundary_f(narrow[1]), 0.0);
  EXPECT_EQ(boundary_f({}), std::nullopt);
  EXPECT_DOUBLE_EQ(*boundary_f({4, 1, 2, 1}), 2 * 0.5 * 0.25 / 0.75);
}

TEST(LabelEdges, AgainstItselfAreAllFoundAndASwapSwaps) {
  const cv::Mat1w a = random_blocks({40, 30}, 1), b = random_blocks({40, 30}, 2);
  for (const EdgeCounts& edges : count_edges(a, a, kEdgeClasses, 1)) {
    EXPECT_EQ(edges.found_px, edges.true_px);
    EXPECT_EQ(edges.right_px, edges.named_px);
  }
  const auto ab = count_edges(a, b, kEdgeClasses, 2), ba = count_edges(b, a, kEdgeClasses, 2);
  for (std::size_t id = 0; id < kEdgeClasses; ++id)
    EXPECT_EQ(ba[id],
              (EdgeCounts{ab[id].named_px, ab[id].right_px, ab[id].true_px, ab[id].found_px}));
}

TEST(LabelEdges, ToleranceIsAShareOfTheDiagonal) {
  EXPECT_EQ(edge_tolerance_px({640, 480}), 6);
  EXPECT_EQ(edge_tolerance_px({320, 240}), 3);
  EXPECT_EQ(edge_tolerance_px({64, 48}), 1);
}

}  // namespace
}  // namespace mapscore::eval
