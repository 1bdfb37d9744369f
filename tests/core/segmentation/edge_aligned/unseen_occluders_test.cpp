// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/unseen_occluders.hpp"

#include "core/geometry/pose.hpp"
#include "core/random_stream.hpp"
#include "plate_scene.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace mapscore {
namespace {

using namespace mapscore::testing;

cv::Mat1w labels_of(const PlateScene& scene) {
  return label_depth(scene.detections(), scene.depth(), scene.truth(), {});
}

/// What is nearer than the range is a hole, and what the colour camera has behind it is not its
/// own.
TEST(UnseenOccluders, HideWhatLiesBehindANearObject) {
  const PlateScene scene({{-0.1, 0.1, -0.1, 5.0, 0.45, 1}});
  ASSERT_GT(cv::countNonZero(scene.label()), 2000);
  EXPECT_EQ(cv::countNonZero(labels_of(scene)), 0);
}

/// A plate that only the colour camera sees: what it hides is the wall's. Where the depth camera
/// sees it, and where it stands so far away that nothing hides it, it is whole.
TEST(UnseenOccluders, HideWhatLiesBehindAnObjectBesideTheView) {
  const PlateScene beside({{0.35, 0.6, -0.3, 0.3, 0.62, 1}});
  ASSERT_GT(cv::countNonZero(beside.label()), 500);
  ASSERT_EQ(cv::countNonZero(beside.depth_label()), 0);
  EXPECT_EQ(cv::countNonZero(labels_of(beside)), 0);
  for (const double z_m : {0.7, 2.9}) {
    const double border_m = z_m * std::tan(0.5 * 58.4 * std::numbers::pi / 180);
    const PlateScene seen({{border_m - 0.03 * z_m, border_m + 1, -0.3 * z_m, 0.3 * z_m, z_m, 1}});
    const Agreement kept = agreement(labels_of(seen), seen.detections(), seen.depth_label());
    EXPECT_GE(kept.precision, 0.99) << z_m;
    EXPECT_GE(kept.recall, 0.97) << z_m;
  }
}

/// A hole that reaches the lower border may be a near object, but no mask holds it.
TEST(UnseenOccluders, HideNothingWhereAFloorEnds) {
  const PlateScene scene({{-0.4, 0.3, -0.3, 0.5, 1.5, 1}}, 1e9, 50.0);
  const Agreement kept = agreement(labels_of(scene), scene.detections(), scene.depth_label());
  EXPECT_GE(kept.precision, 0.99);
  EXPECT_GE(kept.recall, 0.99);
}

cv::Mat1w with_noise(const cv::Mat1w& depth, double noise) {
  cv::Mat1w noisy = depth.clone();
  RandomStream random(5, "noise", {});
  for (std::uint16_t& z : noisy)
    z = cv::saturate_cast<std::uint16_t>(kDepthUnitsPerMetre /
                                         (kDepthUnitsPerMetre / z + noise * random.normal()));
  return noisy;
}

/// Beside what stands near, a projector's shadow has no depth. In a noisy image it hides nothing;
/// in an exact one, where no projector is, it may be something nearer.
TEST(UnseenOccluders, HideNothingBehindAProjectorsShadow) {
  const PlateScene scene({{-0.3, 0.3, -0.3, 0.2, 1.45, 1}, {0.1, 0.4, -0.3, 0.3, 0.64, 2}});
  for (const double noise : {0.0, 0.002}) {
    cv::Mat1w depth = with_noise(scene.depth(), noise), truth = scene.depth_label();
    const cv::Rect shadow(186, 0, 19, 240);
    depth(shadow) = 0, truth(shadow) = 0;
    ASSERT_EQ(cv::countNonZero(truth(cv::Rect(205, 0, 1, 240)) == 2), 240);
    const cv::Mat1w labels = label_depth(scene.detections(), depth, scene.truth(), {});
    const Agreement kept = agreement(labels, scene.detections(), truth);
    EXPECT_GE(kept.precision, 0.99) << noise;
    if (noise > 0)
      EXPECT_GE(kept.recall, 0.97);
    else
      EXPECT_LE(kept.recall, 0.96);
  }
}

/// A plate nearer than the range, in a noisy image, where a shadow could be as wide.
TEST(UnseenOccluders, ANarrowNearObjectIsNoShadow) {
  const PlateScene scene({{-0.6, 0.6, -0.4, 0.3, 2.0, 1},
                          {-0.05, -0.015, -0.3, 0.3, 0.45, 2},
                          {-0.0187, 0.3, -0.3, 0.3, 0.63, 3}});
  const cv::Mat1w depth = with_noise(scene.depth(), 0.002);
  cv::Mat1w truth = scene.depth_label();
  ASSERT_GT(cv::countNonZero(truth == 2), 4000);
  truth.setTo(0, truth == 2);
  const cv::Mat1w labels = label_depth(scene.detections(), depth, scene.truth(), {});
  EXPECT_GE(agreement(labels, scene.detections(), truth).precision, 0.99);
}

/// Nothing is nearer than a range that begins at 0, and no depth is none.
TEST(UnseenOccluders, HideNothingWhereTheRangeBeginsAtTheCamera) {
  const PlateScene scene({{-0.4, 0.3, -0.3, 0.5, 1.5, 1}});
  Calibration camera = scene.truth();
  camera.range_min_m = 0;
  cv::Mat1w depth = scene.depth();
  depth(cv::Rect(0, 200, 320, 40)) = 0;
  EXPECT_EQ(cv::countNonZero(find_depth_edges(depth, camera).inverse_depth > 10), 0);
  EXPECT_GT(cv::countNonZero(label_depth(scene.detections(), depth, camera, {})), 1000);
}

ColorPlaces places_of(const cv::Mat1i& cells) {
  return {cells.size(), [&](int v, int* row) { std::copy_n(cells[v], cells.cols, row); }};
}

/// A panel that comes nearer from left to right, and so ends at the least depth; its mask goes on.
TEST(UnseenOccluders, DoNotHideTheSurfaceThatRunsOn) {
  const Calibration camera = PlateScene({}).truth();
  DepthEdges edges;
  edges.inverse_depth = cv::Mat1f(240, 320);
  edges.right = edges.down = cv::Mat1f(240, 320, 1.0F);
  edges.near_holes = cv::Mat1b(120, 160, std::uint8_t{0});
  edges.near_holes.colRange(103, 160).setTo(255);
  const MaskField masks{cv::Mat1w(240, 320, std::uint16_t{1}),
                        cv::Mat1f(240, 320, -OutlineField::kFar)};
  cv::Mat1i cells(240, 320);
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) {
      const double z_m = 0.6 + 0.002 * (200 - u);
      edges.inverse_depth(v, u) = u <= 200 ? static_cast<float>(1 / z_m) : 0.0F;
      const Eigen::Vector2d at =
          camera.color.project(camera.T_color_depth * camera.depth.back_project(u, v, z_m));
      cells(v, u) = u <= 200 && at.x() >= 0 ? v * 320 + static_cast<int>(at.x() + 0.5) : -1;
    }
  EXPECT_EQ(cv::countNonZero(unseen_occluders(edges, places_of(cells), masks, {}, camera)), 0);
  edges.right.col(195).setTo(0.0F);  // a step: what lies left of it is something else
  const cv::Mat1b hidden = unseen_occluders(edges, places_of(cells), masks, {}, camera);
  EXPECT_GT(cv::countNonZero(hidden), 0);
  EXPECT_EQ(cv::countNonZero(hidden.colRange(196, 201)), 0);
}

/// 255 on the colour pixels that a hole of an exact image covers: by the first pixel of every
/// second of its cells in both ways, one by one, in lines along the baseline, as the definition
/// says.
cv::Mat1b plainly_covered(const cv::Mat1b& hole, const MaskField& masks,
                          const Calibration& camera) {
  cv::Mat1b covered(masks.owner.size(), std::uint8_t{0});
  const Eigen::Vector3d& t = camera.T_color_depth.translation();
  const bool in_rows = std::abs(t.x()) >= std::abs(t.y());
  const int lines = in_rows ? hole.rows : hole.cols, length = in_rows ? hole.cols : hole.rows;
  const auto cell_of = [&](int line, int n) {
    return in_rows ? cv::Point(n, line) : cv::Point(line, n);
  };
  const auto place_of = [&](int line, int n, double z_m) {
    const cv::Point pixel = 2 * cell_of(line, n);
    const Eigen::Vector2d at = camera.color.project(
        camera.T_color_depth * camera.depth.back_project(pixel.x, pixel.y, z_m));
    const cv::Point place(static_cast<int>(std::floor(at.x() + 0.5)),
                          static_cast<int>(std::floor(at.y() + 0.5)));
    return place.inside(cv::Rect({0, 0}, masks.owner.size())) ? place : cv::Point(-1, -1);
  };
  const auto owner_of = [&](int line, int n, double z_m) {
    const cv::Point place = place_of(line, n, z_m);
    return place.x >= 0 && masks.distance(place) < 0 ? masks.owner(place) : 0;
  };
  for (int line = 0; line < lines; line += 2)
    for (int n = 0, begin = 0; n < length; ++n) {
      if (hole(cell_of(line, n)) == 0) begin = n + 1;
      const bool ends = n + 1 == length || hole(cell_of(line, n + 1)) == 0;
      if (hole(cell_of(line, n)) == 0 || !ends) continue;
      std::vector<int> tried;
      for (int at = begin; at <= n; ++at)
        if (at % 2 == 0) tried.push_back(at);
      if (tried.empty()) continue;
      for (const double share : {1.0, 0.85, 0.7, 0.6, 0.5}) {
        const double z_m = share * camera.range_min_m;
        const int middle = owner_of(line, tried[tried.size() / 2], z_m);
        int held = 0;
        for (const int at : tried) held += owner_of(line, at, z_m) == middle ? 1 : 0;
        for (const int at : tried) {
          const int owner = owner_of(line, at, z_m);
          if (owner != 0 && (owner == owner_of(line, at, camera.range_max_m) ||
                             (owner == middle && held >= 0.8 * static_cast<double>(tried.size()))))
            covered(place_of(line, at, z_m)) = 255;
        }
      }
    }
  cv::dilate(covered, covered, cv::Mat1b(9, 9, std::uint8_t{1}));
  return covered;
}

/// Two cameras side by side, one above the other, or parallel with what lies at some depths on the
/// borders of the colour camera's pixels.
Calibration camera_of(int trial) {
  Calibration camera = PlateScene({}).truth();
  if (trial % 3 == 2) {
    camera.color = camera.depth;
    camera.color.cx_px += 0.5, camera.color.cy_px += 0.5;
    camera.T_color_depth.translation() = Eigen::Vector3d(-0.06, 0, 0);
    return camera;
  }
  camera.T_color_depth.linear() = exp_rotation({0.01, -0.02, 0.03});
  if (trial % 3 == 1) camera.T_color_depth.translation() = Eigen::Vector3d(0.002, 0.03, 0);
  return camera;
}

/// Holes of many widths, some with masks that hold them at any depth, some with thin ones.
TEST(UnseenOccluders, CoverWhatEachPixelOfAHoleCovers) {
  RandomStream random(11, "holes", {});
  const auto below = [&](int end) { return static_cast<int>(random.uniform() * end); };
  int covered_pixels = 0;
  for (int trial = 0; trial < 24; ++trial) {
    const Calibration camera = camera_of(trial);
    DepthEdges edges;
    edges.inverse_depth = cv::Mat1f(240, 320, 0.5F);
    edges.right = edges.down = cv::Mat1f(240, 320, 1.0F);
    MaskField masks{cv::Mat1w(240, 320, std::uint16_t{0}), cv::Mat1f(240, 320, 3.0F)};
    cv::Mat1b holes(120, 160, std::uint8_t{0}), no_depth;
    for (int n = 1; n < 6; ++n) {
      const cv::Rect mask(below(250), below(150), 10 + below(60), 90);
      masks.owner(mask).setTo(n);
      holes(cv::Rect(below(125), below(75), 2 + below(30), 45)).setTo(255);
    }
    masks.distance.setTo(-3.0F, masks.owner != 0);
    cv::resize(holes, no_depth, {320, 240}, 0, 0, cv::INTER_NEAREST);
    edges.inverse_depth.setTo(0.0F, no_depth);
    cv::Mat1i cells(240, 320);
    for (int v = 0; v < 240; ++v)
      for (int u = 0; u < 320; ++u) cells(v, u) = no_depth(v, u) == 0 ? v * 320 + u : -1;
    edges.near_holes = cv::Mat1b(120, 160, std::uint8_t{0});
    cv::Mat1b expected = unseen_occluders(edges, places_of(cells), masks, {}, camera);
    edges.near_holes = holes;
    const cv::Mat1b covered = plainly_covered(holes, masks, camera);
    expected.setTo(255, covered & (no_depth == 0));
    const cv::Mat1b hidden = unseen_occluders(edges, places_of(cells), masks, {}, camera);
    EXPECT_EQ(cv::countNonZero(hidden != expected), 0) << trial;
    covered_pixels += cv::countNonZero(covered & (no_depth == 0));
  }
  EXPECT_GT(covered_pixels, 24 * 300);
}

}  // namespace
}  // namespace mapscore
