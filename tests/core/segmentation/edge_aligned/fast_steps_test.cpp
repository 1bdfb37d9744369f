// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/calibration/outline_evidence.hpp"
#include "core/random_stream.hpp"
#include "core/segmentation/edge_aligned/matched_edges.hpp"
#include "core/segmentation/edge_aligned/near_holes.hpp"
#include "core/segmentation/edge_aligned/pixel_votes.hpp"
#include "core/segmentation/edge_aligned/settled_depth.hpp"
#include "core/segmentation/edge_aligned/surface_vote.hpp"
#include "plain_edge_aligned.hpp"
#include "plate_scene.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <numbers>
#include <string>
#include <utility>

namespace mapscore {
namespace {

using namespace mapscore::testing;

/// Plates before a wall, on a floor; its depth has noise, single pixels without depth and a hole.
struct RoughScene {
  Calibration believed;
  cv::Mat1w depth;
  std::vector<Detection> detections;

  RoughScene(double noise, double grown_px, const Eigen::Vector3d& shift_m) {
    const PlateScene scene({{-0.5, 0.1, -0.3, 0.35, 1.4, 1},
                            {0.05, 0.3, -0.5, 0.2, 1.7, 2},
                            {0.3, 0.32, -0.4, 0.5, 1.9, 3},
                            {-0.9, -0.5, 0.1, 0.6, 2.1, 4}},
                           0.6);
    believed = scene.misregistered(shift_m, {0, 0.004, 0});
    depth = scene.depth();
    RandomStream random(11, "rough", {});
    for (std::uint16_t& z : depth) {
      const double w = kDepthUnitsPerMetre / z + noise * random.normal();
      z = random.uniform() < 0.01 ? std::uint16_t{0}
                                  : cv::saturate_cast<std::uint16_t>(kDepthUnitsPerMetre / w);
    }
    depth(cv::Rect(200, 30, 60, 40)) = 0;
    cv::Mat1w label = scene.label();
    const int size = 2 * static_cast<int>(std::abs(grown_px)) + 1;
    const cv::Mat1b square(size, size, std::uint8_t{1});
    cv::Mat1w changed;
    grown_px > 0 ? cv::dilate(label, changed, square) : cv::erode(label, changed, square);
    detections = scene.detections(changed);
  }
};

bool same_bits(const cv::Mat1f& a, const cv::Mat1f& b) {
  return a.size() == b.size() && cv::countNonZero(a != b) == 0;
}

void expect_equal_steps(const DepthEdges& fast, const DepthEdges& plain) {
  EXPECT_TRUE(same_bits(fast.right, plain.right));
  EXPECT_TRUE(same_bits(fast.down, plain.down));
  ASSERT_EQ(fast.steps.size(), plain.steps.size());
  for (std::size_t n = 0; n < plain.steps.size(); ++n) {
    ASSERT_EQ(fast.steps[n].point, plain.steps[n].point) << n;
    ASSERT_EQ(fast.steps[n].outward, plain.steps[n].outward) << n;
    ASSERT_EQ(fast.steps[n].strength, plain.steps[n].strength) << n;
  }
}

TEST(EdgeAlignedFastSteps, EqualThePlainOnesOfACalibration) {
  for (const double noise : {0.0, 0.0015, 0.003}) {
    SCOPED_TRACE("noise " + std::to_string(noise) + "/m");
    RoughScene scene(noise, 0, {0, 0, 0});
    scene.depth(cv::Rect(60, 60, 20, 180)) = static_cast<std::uint16_t>(0.5 * kDepthUnitsPerMetre);
    scene.depth(cv::Rect(30, 60, 30, 180)) = 0;  // perhaps a shadow; near, for the lower border
    scene.believed.range_min_m = 0.4;
    const DepthEdges edges = find_depth_edges(scene.depth, scene.believed, kCalibrationEdges);
    ASSERT_GT(cv::countNonZero(edges.near_holes == kNearHole), 0);
    expect_equal_steps(edges, plain_steps(edges, scene.believed, kCalibrationEdges));
    const DepthEdges segmentation = find_depth_edges(scene.depth, scene.believed);
    EXPECT_EQ(edges.steps.size() != segmentation.steps.size(), is_noisy(edges));
  }
}

TEST(EdgeAlignedFastSteps, EqualThePlainOnes) {
  int shifted = 0, settled_pixels = 0, labelled = 0;
  for (const double noise : {0.0, 0.0015, 0.003})
    for (const double grown_px : {-2.0, 0.0, 3.0})
      for (const double shift_m : {0.0, 0.03}) {
        SCOPED_TRACE("noise " + std::to_string(noise) + "/m, masks grown by " +
                     std::to_string(grown_px) + " px, shift " + std::to_string(shift_m) + " m");
        const RoughScene scene(noise, grown_px, {shift_m, 0, 0});
        const DepthEdges edges = find_depth_edges(scene.depth, scene.believed);
        expect_equal_steps(edges, plain_steps(edges, scene.believed));
        ASSERT_EQ(cv::countNonZero(edges.near_holes), 0);

        OutlineField field = outline_field(scene.detections, 320, 240, 60);
        OutlineAlignment alignment = align_outlines(edges, field, scene.believed, 40).mended;
        if (shift_m > 0) alignment = {};  // so that something is left to shift
        alignment.score = 0.5F, alignment.sharpness = 0.5F;
        alignment.offset_px = static_cast<float>(-grown_px);
        if (grown_px > 0) alignment.focal = 1.02F;
        const OutlineShifts shifts = find_outline_shifts(edges, field, alignment, scene.believed);
        const OutlineShifts plain_ones = plain_shifts(edges, field, alignment, scene.believed);
        ASSERT_EQ(shifts.nodes.empty(), plain_ones.nodes.empty());
        if (!shifts.nodes.empty()) {
          EXPECT_TRUE(same_bits(shifts.nodes.reshape(1), plain_ones.nodes.reshape(1)));
          ++shifted;
        }

        Continuity on = is_noisy(edges) ? Continuity{edges.right.clone(), edges.down.clone()}
                                        : part_at_creases(edges);
        const MaskField masks = open_grooves(std::move(field));
        cv::Mat1w labels = vote_on_surfaces(edges, masks, alignment, shifts, scene.believed,
                                            scene.detections.size(), on, 3.0);
        EXPECT_EQ(cv::countNonZero(labels != plain_surface_votes(edges, masks, alignment, shifts,
                                                                 scene.believed,
                                                                 scene.detections.size(), 3.0F)),
                  0);
        labelled += cv::countNonZero(labels);
        cv::Mat1w plain_labels = labels.clone();
        const cv::Mat1f settled = settle_on_surfaces(edges, labels);
        EXPECT_TRUE(same_bits(settled, settle_plainly(edges, plain_labels)));
        EXPECT_EQ(cv::countNonZero(labels != plain_labels), 0);
        settled_pixels += cv::countNonZero(settled != edges.inverse_depth);
      }
  EXPECT_GT(shifted, 5);
  EXPECT_GT(labelled, 18 * 5000);
  EXPECT_GT(settled_pixels, 18 * 5000);
}

/// Where masks meet at small steps, of which some hide what lies behind them and some too little.
TEST(EdgeAlignedFastSteps, VoteAsThePlainOnesWhereMasksMeet) {
  int labelled = 0, rigs = 0;
  for (const double offset_px : {-2.0, 0.0, 1.0})
    for (const double step_m : {0.005, 0.008, 0.012, 0.03, 0.05, 0.07}) {
      SCOPED_TRACE("offset " + std::to_string(offset_px) + " px, step " + std::to_string(step_m));
      const double z = 1.5;
      const PlateScene front({{-0.6, -0.2, -0.4, 0.0, z, 1},
                              {-0.2, 0.0, -0.4, 0.0, z + step_m, 2},
                              {0.0, 0.012, -0.4, 0.0, z + 2 * step_m, 3},
                              {0.012, 0.3, -0.4, 0.0, z, 4},
                              {-0.6, 0.0, 0.0, 0.3, z + step_m, 5},
                              {0.0, 0.3, 0.0, 0.02, z + step_m, 6},
                              {0.0, 0.3, 0.02, 0.3, z, 7}});
      const int rig = rigs++ % 4;  // beside each other, above each other, oblique, in one place
      const CameraModel color =
          CameraModel::from_hfov(320 * (rig + 1), 240 * (rig + 1), 60 * std::numbers::pi / 180);
      const PlateScene scene = front.seen_by(
          color, {rig % 2 == 0 ? 0.025 : 0.0, rig == 1 || rig == 2 ? 0.02 : 0.0, 0.0});
      const std::vector<Detection> detections = scene.detections();
      const DepthEdges edges = find_depth_edges(scene.depth(), scene.truth());
      const MaskField masks =
          open_grooves(outline_field(detections, color.width_px, color.height_px, 60));
      OutlineAlignment alignment;
      alignment.offset_px = static_cast<float>(offset_px);
      Continuity on = part_at_creases(edges);
      const cv::Mat1w labels =
          vote_on_surfaces(edges, masks, alignment, {}, scene.truth(), detections.size(), on, 3.0);
      const cv::Mat1w plain =
          plain_surface_votes(edges, masks, alignment, {}, scene.truth(), detections.size(), 3.0F);
      EXPECT_EQ(cv::countNonZero(labels != plain), 0);
      labelled += cv::countNonZero(labels);
    }
  EXPECT_GT(labelled, 18 * 10000);
}

/// Edges matched many at once are those that are matched one by one, bit by bit.
TEST(EdgeAlignedFastSteps, MatchEdgesAsOneByOne) {
  const RoughScene scene(0.0, 2.0, {0.02, 0, 0});
  const OutlineField field = outline_field(scene.detections, 320, 240, 60);
  const Projection project = Projection(scene.believed.color).scaled(1.002F);
  const Eigen::Isometry3f T = scene.believed.T_color_depth.cast<float>();
  std::vector<ProjectedEdge> edges;
  for (const DepthEdge& edge : find_depth_edges(scene.depth, scene.believed).steps)
    edges.push_back({T * edge.point, direction_of(edge.outward),
                     static_cast<std::uint8_t>(edge.outward), edge.strength});
  edges.push_back(edges.front());
  edges.back().p.z() = -1.0F;  // behind the camera
  OutlineAlignment a;
  a.rotation = Eigen::AngleAxisf(0.004F, Eigen::Vector3f(0.1F, 1, 0.3F).normalized()).matrix();
  a.translation = {-0.005F, 0.004F, 0.002F};
  int at_border = 0;
  for (const float offset_px : {0.0F, -2.0F, 1.5F})
    for (const float sigma_px : {1.2F, 5.0F})
      for (const std::size_t most : {std::size_t{300}, std::size_t{100000}}) {
        a.offset_px = offset_px;
        const EdgeColumns columns(edges, most);
        MatchedEdges matched(field);
        matched.match(columns, a, project, sigma_px);
        ASSERT_EQ(matched.weight.size() % EdgeColumns::kTogether, 0);
        int weighed = 0;
        for (std::size_t n = 0; n < matched.weight.size(); ++n) {
          if (n * columns.stride >= edges.size()) {
            ASSERT_EQ(matched.weight[n], 0) << n;
            continue;
          }
          const ProjectedEdge& edge = edges[n * columns.stride];
          const Eigen::Vector3f p = a.rotation * edge.p + a.translation;
          const Eigen::Vector2f at = project(p);
          EdgeMatch plain;
          if (p.z() > MatchedEdges::kNearest_m)
            plain = plain_match(field,
                                {at.x(), at.y(), edge.outward.x(), edge.outward.y(), edge.strength},
                                {offset_px, sigma_px});
          ASSERT_EQ(matched.weight[n], plain.weight) << n;
          if (!(plain.weight > 0)) continue;
          ++weighed, at_border += plain.at_border ? 1 : 0;
          ASSERT_EQ(matched.residual[n], plain.residual) << n;
          ASSERT_EQ(matched.distance[n], plain.distance) << n;
          ASSERT_EQ(matched.facing[n], plain.facing) << n;
          ASSERT_EQ(matched.slope_u[n], plain.slope_u) << n;
          ASSERT_EQ(matched.slope_v[n], plain.slope_v) << n;
          ASSERT_EQ(matched.slope_offset[n], plain.at_border ? 0 : -1) << n;
          ASSERT_EQ(Eigen::Vector2f(matched.u[n], matched.v[n]), at) << n;
          ASSERT_EQ(Eigen::Vector3f(matched.x[n], matched.y[n], matched.nearness[n]),
                    Eigen::Vector3f(p.x(), p.y(), 1) * (1 / p.z()))
              << n;
        }
        EXPECT_GT(weighed, 30);
      }
  EXPECT_GT(at_border, 20);
}

/// In sixteen lanes and single precision, and one by one in double precision.
TEST(EdgeAlignedFastSteps, AddUpEdgesAsOneByOne) {
  const RoughScene scene(0.0, 2.0, {0.02, 0, 0});
  const OutlineField field = outline_field(scene.detections, 320, 240, 60);
  const Projection project = Projection(scene.believed.color).scaled(1.01F);
  const float focal_px = static_cast<float>(scene.believed.color.fx_px);
  const Eigen::Isometry3f T = scene.believed.T_color_depth.cast<float>();
  std::vector<ProjectedEdge> edges;
  for (const DepthEdge& edge : find_depth_edges(scene.depth, scene.believed).steps)
    edges.push_back({T * edge.point, direction_of(edge.outward),
                     static_cast<std::uint8_t>(edge.outward), edge.strength});
  MatchedEdges matched(field);
  matched.match(EdgeColumns(edges, 800), {}, project, 5.0F);
  Eigen::Matrix<double, kParameters, kParameters> H;
  Eigen::Matrix<double, kParameters, 1> b;
  H.setZero(), b.setZero();
  double weights = 0, squares = 0;
  matched.for_each([&](std::size_t n) {
    // How the point moves with each parameter, in the colour camera's frame over its depth.
    const double f = static_cast<double>(focal_px), x = static_cast<double>(matched.x[n]),
                 y = static_cast<double>(matched.y[n]),
                 z = 1 / static_cast<double>(matched.nearness[n]);
    const Eigen::Vector3d p(x, y, 1);
    const Eigen::Vector2d g(static_cast<double>(matched.slope_u[n] * project.fx),
                            static_cast<double>(matched.slope_v[n] * project.fy));
    const auto seen = [&](const Eigen::Vector3d& by) {
      return g.dot(Eigen::Vector2d(by.x() - x * by.z(), by.y() - y * by.z()));
    };
    Eigen::Matrix<double, kParameters, 1> J;
    J[kTurnX] = seen(Eigen::Vector3d::UnitX().cross(p)) / f;
    J[kTurnY] = seen(Eigen::Vector3d::UnitY().cross(p)) / f;
    J[kRoll] = seen(Eigen::Vector3d::UnitZ().cross(p)) / f;
    J[kFocal] = g.dot(Eigen::Vector2d(x, y)) / f;
    J[kShiftX] = seen(Eigen::Vector3d::UnitX()) / z;
    J[kShiftY] = seen(Eigen::Vector3d::UnitY()) / z;
    J[kOffset] = static_cast<double>(matched.slope_offset[n]);
    const double w = static_cast<double>(matched.weight[n]),
                 r = static_cast<double>(matched.residual[n]);
    H += w * J * J.transpose();
    b -= w * r * J;
    weights += w, squares += w * r * r;
  });
  const NormalEquations sums = add_up(matched, project, focal_px);
  EXPECT_GT(weights, 50);
  EXPECT_NEAR(static_cast<double>(sums.matched), weights, 1e-5 * weights);
  EXPECT_NEAR(static_cast<double>(sums.squares), squares, 1e-5 * squares);
  for (int i = 0; i < kParameters; ++i) {
    const double scale = std::sqrt(H(i, i));
    EXPECT_NEAR(static_cast<double>(sums.b[i]), b[i], 1e-5 * scale * std::sqrt(squares)) << i;
    for (int j = 0; j < kParameters; ++j)
      EXPECT_NEAR(static_cast<double>(sums.H(i, j)), H(i, j), 1e-5 * scale * std::sqrt(H(j, j)))
          << i << ' ' << j;
  }
}

/// Also the pixel that lies in the colour image's first, beside one that lies beyond it.
TEST(EdgeAlignedFastSteps, ReadEachPixelOfAColourImageThatSeesLess) {
  Calibration believed = PlateScene({}).truth();
  believed.T_color_depth.setIdentity();
  believed.color = believed.depth;
  believed.color.width_px = 100, believed.color.height_px = 80;
  believed.color.cx_px -= 40, believed.color.cy_px -= 30;
  DepthEdges edges;
  edges.inverse_depth = cv::Mat1f(240, 320, 0.5F);
  edges.right = edges.down = cv::Mat1f(240, 320, 1.0F);
  edges.near_holes = cv::Mat1b(120, 160, std::uint8_t{0});
  Detection all;
  all.box = {0, 0, 99, 79};
  all.mask = cv::Mat1b(80, 100, std::uint8_t{255});
  const MaskField masks = open_grooves(outline_field({all}, 100, 80, 20));
  const cv::Mat1w owners = pixel_votes(edges, masks, {}, {}, believed, 1).owner;
  cv::Mat1w expected(240, 320, std::uint16_t{0});
  expected(cv::Rect(40, 30, 100, 80)) = 1;
  EXPECT_EQ(cv::countNonZero(owners != expected), 0);
}

}  // namespace
}  // namespace mapscore
