// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/simulated_perception.hpp"

#include "core/error.hpp"
#include "core/objects/box_depth.hpp"
#include "core/objects/object_map.hpp"
#include "core/random_stream.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace mapscore {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

CameraModel camera() {
  return CameraModel::from_hfov(64, 48, 1.0);
}

double draw(RandomStream& stream, double reach) {
  return reach * (2.0 * stream.uniform() - 1.0);
}

ObjectBox random_box(RandomStream& stream) {
  ObjectBox box;
  box.T_frame_box.translation() =
      Eigen::Vector3d(draw(stream, 3), draw(stream, 3), draw(stream, 5));
  box.T_frame_box.linear() =
      exp_rotation(Eigen::Vector3d(draw(stream, 3), draw(stream, 3), draw(stream, 3)));
  for (double& size : box.size_m) size = 0.05 + 2.0 * stream.uniform();
  return box;
}

/// A camera frame whose depth image shows the nearest of some boxes, 0 where there is none.
PosedDepth rendered(const std::vector<ObjectBox>& boxes) {
  PosedDepth view;
  view.camera = camera();
  view.depth = cv::Mat1w::zeros(48, 64);
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u) {
      double nearest = 100.0;
      const Eigen::Vector3d ray = view.camera.back_project(u, v, 1.0);
      for (const ObjectBox& box : boxes) {
        const DepthInterval in = BoxRays(box, 0.0, 100.0).at(ray.x(), ray.y());
        if (!in.empty()) nearest = std::min(nearest, in.in_m);
      }
      if (nearest >= view.range_min_m && nearest <= view.range_max_m)
        view.depth(v, u) = static_cast<std::uint16_t>(std::lround(nearest * kDepthUnitsPerMetre));
    }
  return view;
}

ObjectBox upright(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return oriented(Eigen::AlignedBox3d(low, high));
}

TEST(BoxRays, EnterAndLeaveByHand) {
  const BoxRays rays(upright({-1, -1, 2}, {1, 1, 4}), 0.6, 8.0);
  EXPECT_DOUBLE_EQ(rays.at(0, 0).in_m, 2.0);
  EXPECT_DOUBLE_EQ(rays.at(0, 0).out_m, 4.0);
  EXPECT_DOUBLE_EQ(rays.at(0.4, 0).out_m, 2.5);  // leaves through x = 1
  EXPECT_TRUE(rays.at(0.6, 0).empty());
  EXPECT_FALSE(rays.at(0.5, 0).empty());  // touches an edge
  EXPECT_DOUBLE_EQ(BoxRays(upright({-1, -1, -2}, {1, 1, 4}), 0.6, 3.0).at(0, 0).in_m, 0.6);
  EXPECT_DOUBLE_EQ(BoxRays(upright({-1, -1, -2}, {1, 1, 4}), 0.6, 3.0).at(0, 0).out_m, 3.0);
  // A ray along a face, and one beside it.
  EXPECT_FALSE(BoxRays(upright({0, -1, 2}, {1, 1, 4}), 0.6, 8.0).at(0, 0).empty());
  EXPECT_TRUE(BoxRays(upright({0.1, -1, 2}, {1, 1, 4}), 0.6, 8.0).at(0, 0).empty());
}

TEST(BoxRays, PointsAreInTheBoxExactlyWithinTheInterval) {
  RandomStream stream(3, "rays", {0});
  int hits = 0;
  for (int n = 0; n < 3000; ++n) {
    const ObjectBox box = random_box(stream);
    const double x = draw(stream, 0.6), y = draw(stream, 0.6);
    const DepthInterval in = BoxRays(box, 0.6, 8.0).at(x, y);
    hits += !in.empty();
    for (double z = 0.6; z <= 8.0; z += 0.037)
      if (std::abs(z - in.in_m) > 1e-9 && std::abs(z - in.out_m) > 1e-9) {
        EXPECT_EQ(box.contains(z * Eigen::Vector3d(x, y, 1)), in.in_m <= z && z <= in.out_m);
      }
  }
  EXPECT_GT(hits, 50);
}

TEST(BoxRays, NoPixelOutsideTheRectangleHits) {
  RandomStream stream(4, "rays", {0});
  for (int n = 0; n < 3000; ++n) {
    const ObjectBox box = random_box(stream);
    const PixelBox pixels = pixels_of(box, camera(), 0.6);
    const BoxRays rays(box, 0.6, 8.0);
    int hits = 0;
    for (int v = 0; v < 48; ++v)
      for (int u = 0; u < 64; ++u) {
        const Eigen::Vector3d ray = camera().back_project(u, v, 1.0);
        if (rays.at(ray.x(), ray.y()).empty()) continue;
        ++hits;
        ASSERT_TRUE(u >= pixels.u_min && u <= pixels.u_max && v >= pixels.v_min &&
                    v <= pixels.v_max);
      }
    if (hits > 0) {
      EXPECT_TRUE(Frustum(camera(), 0.6, 8.0).meets(box));
    }
    const double area_px = outline_px(box, camera(), 0.6);
    if (std::isfinite(area_px) && pixels.u_min > 0 && pixels.v_min > 0 && pixels.u_max < 63 &&
        pixels.v_max < 47) {
      EXPECT_NEAR(hits, area_px, 6.0 + 4.0 * std::sqrt(area_px));
    }
  }
}

TEST(Frustum, MeetsWhatHasAPointInIt) {
  const Frustum frustum(camera(), 0.6, 8.0);
  const double edge = 31.5 / camera().fx_px + 0.5 / camera().fx_px;  // slope of the right edge
  EXPECT_TRUE(frustum.meets(upright({-0.1, -0.1, 7.9}, {0.1, 0.1, 9})));
  EXPECT_FALSE(frustum.meets(upright({-0.1, -0.1, 8.1}, {0.1, 0.1, 9})));
  EXPECT_FALSE(frustum.meets(upright({-0.1, -0.1, 0.1}, {0.1, 0.1, 0.5})));
  EXPECT_TRUE(frustum.meets(upright({edge * 4 - 0.01, -0.1, 3.9}, {10, 0.1, 4})));
  EXPECT_FALSE(frustum.meets(upright({edge * 4 + 0.01, -0.1, 3.9}, {10, 0.1, 4})));
  EXPECT_TRUE(frustum.meets(upright({-99, -99, -99}, {99, 99, 99})));
}

/// Every pixel, one by one, without culling and without a rectangle.
BoxVotes plain_votes(const ObjectBox& box, const PosedDepth& view, double tolerance_m) {
  BoxVotes votes;
  const ObjectBox seen = moved(view.T_map_camera.inverse(), box);
  for (int v = 0; v < view.camera.height_px; ++v)
    for (int u = 0; u < view.camera.width_px; ++u) {
      const Eigen::Vector3d ray = view.camera.back_project(u, v, 1.0);
      const DepthInterval in =
          BoxRays(seen, view.range_min_m, view.range_max_m).at(ray.x(), ray.y());
      if (in.empty()) continue;
      const double z = view.depth(v, u) / kDepthUnitsPerMetre;
      if (view.depth(v, u) == 0)
        ++votes.unmeasured;
      else if (z < in.in_m - tolerance_m)
        ++votes.occluded;
      else if (z > in.out_m + tolerance_m)
        ++votes.beyond;
      else
        ++votes.within;
    }
  return votes;
}

TEST(BoxVotes, EqualThoseOfEveryPixel) {
  RandomStream stream(5, "votes", {0});
  int looked = 0;
  for (int n = 0; n < 400; ++n) {
    PosedDepth view =
        rendered({random_box(stream), random_box(stream), upright({-9, -9, 6}, {9, 9, 7})});
    const Pose T = exp_pose((Vector6() << draw(stream, 1), draw(stream, 1), draw(stream, 1),
                             draw(stream, 1), draw(stream, 1), draw(stream, 1))
                                .finished());
    view.T_map_camera = T;
    for (int m = 0; m < 4; ++m) {
      const ObjectBox box = moved(T, random_box(stream));
      BoxVotes votes = vote(box, view, 0.02);
      looked += votes.looked();
      votes.outline_px = 0.0;
      EXPECT_EQ(votes, plain_votes(box, view, 0.02));
    }
  }
  EXPECT_GT(looked, 10000);
}

TEST(BoxVotes, SayVisibleHiddenAbsent) {
  const ObjectBox wall = upright({-9, -9, 5}, {9, 9, 5.1});
  const ObjectBox crate = upright({-0.5, -0.5, 2}, {0.5, 0.5, 3});
  const Visibility visibility;
  const BoxVotes there = vote(crate, rendered({wall, crate}), 0.02);
  EXPECT_EQ(there.beyond + there.occluded + there.unmeasured, 0);
  EXPECT_TRUE(should_be_seen(there, visibility));
  const BoxVotes gone = vote(crate, rendered({wall}), 0.02);
  EXPECT_EQ(gone.within, 0);
  EXPECT_EQ(gone.beyond, there.within);
  EXPECT_TRUE(should_be_seen(gone, visibility));
  const BoxVotes hidden = vote(crate, rendered({wall, upright({-2, -2, 1}, {2, 2, 1.2})}), 0.02);
  EXPECT_EQ(hidden.occluded, there.within);
  EXPECT_FALSE(should_be_seen(hidden, visibility));
  // Most of it beyond the image's edge: not seen as a whole.
  EXPECT_FALSE(should_be_seen(vote(upright({0.9, -0.5, 2}, {2.9, 0.5, 3}), rendered({wall}), 0.02),
                              visibility));
  EXPECT_EQ(vote(upright({-0.5, -0.5, -3}, {0.5, 0.5, -2}), rendered({wall}), 0.02), BoxVotes());
}

TEST(Perceive, PaintsTheSmallerBoxOverTheLarger) {
  const ObjectBox wall = upright({-9, -9, 5}, {9, 9, 5.1});
  const ObjectBox table = upright({-1, -1, 2}, {1, 1, 4}),
                  cup = upright({-0.2, -0.2, 2}, {0.2, 0.2, 2.2});
  const PosedDepth view = rendered({wall, table, cup});
  const std::vector<PerceivedModel> models{
      {7, {cup}}, {3, {table}}, {9, {upright({-9, -9, -4}, {9, 9, -3})}}};
  const cv::Mat1w label = perceive(models, view, 0.01);
  EXPECT_EQ(label(24, 32), 7);
  EXPECT_EQ(label(24, 32 + 15), 3);
  EXPECT_EQ(label(1, 1), 0);
  int cups = 0;
  for (const InstanceId instance : label) cups += instance == 7;
  ASSERT_GT(cups, 20);
  EXPECT_EQ(perceive(models, view, 0.01, cups)(24, 32), 7);
  EXPECT_EQ(perceive(models, view, 0.01, cups + 1)(24, 32), 0);
}

TEST(Perceive, RefusesAnImageOfAnotherSize) {
  PosedDepth view = rendered({});
  view.depth = cv::Mat1w::zeros(48, 63);
  EXPECT_THROW((void)perceive({}, view, 0.01), Error);
  EXPECT_THROW((void)vote({}, view, 0.01), Error);
  view = rendered({});
  view.range_min_m = 0.0;
  EXPECT_THROW((void)perceive({}, view, 0.01), Error);
}

TEST(Ageing, TakesAwayWhatWasTakenAwayAndNothingElse) {
  const ObjectBox wall = upright({-9, -9, 6}, {9, 9, 6.1});
  const ObjectBox stays = upright({-1.2, -0.4, 3}, {-0.6, 0.4, 4});
  const ObjectBox taken = upright({0.5, -0.4, 3}, {1.1, 0.4, 4});
  const ObjectBox behind_it = upright({0.6, -0.2, 4.5}, {1.0, 0.2, 5});  // hidden by `taken`
  const ObjectBox elsewhere = upright({-0.5, -0.5, -4}, {0.5, 0.5, -3});
  ObjectMapParams params;
  params.visibility.min_pixels = 10;  // of a small image
  ObjectMap map(2, params);
  const auto detection = [](const ObjectBox& box) { return ObjectDetection{1, box, 1.0, {}}; };
  map.integrate(
      std::vector{detection(stays), detection(taken), detection(behind_it), detection(elsewhere)},
      0.0);
  const PosedDepth before = rendered({wall, stays, taken, behind_it});
  const PosedDepth after = rendered({wall, stays, behind_it});
  for (int frame = 1; frame <= 20; ++frame)  // what is hidden or out of view keeps
    EXPECT_THAT(
        map.integrate(std::vector{detection(stays), detection(taken)}, frame, &before).missed,
        IsEmpty());
  ASSERT_EQ(map.objects().size(), 4u);
  for (int frame = 21; frame < 25; ++frame) {
    const auto changes =
        map.integrate(std::vector{detection(stays), detection(behind_it)}, frame, &after);
    EXPECT_THAT(changes.missed, ElementsAre(2));
    EXPECT_THAT(changes.removed, IsEmpty());
  }
  EXPECT_EQ(map.find(2)->age, 4);
  EXPECT_LT(map.find(2)->confidence, map.find(1)->confidence);
  EXPECT_THAT(map.integrate(std::vector{detection(stays)}, 25, &after).removed, ElementsAre(2));
  EXPECT_EQ(map.find(2), nullptr);
  EXPECT_NE(map.find(4), nullptr);
  EXPECT_EQ(map.find(3)->age, 1);  // now in the open, and missed once
  map.integrate(std::vector{detection(behind_it)}, 26, &after);
  EXPECT_EQ(map.find(3)->age, 0);  // a detection makes it young again
}

}  // namespace
}  // namespace mapscore
