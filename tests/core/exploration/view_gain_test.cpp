// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/view_gain.hpp"

#include "core/exploration/surroundings.hpp"
#include "tests/core/exploration/flat_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace mapscore::testing {
namespace {

constexpr double kStep = 5.0 * std::numbers::pi / 180.0;
constexpr double kRate = 0.7;

/// A flat of which a robot has seen some, and a part of whose surfaces has an uncertain class.
struct Seen {
  BoxFlat flat = two_rooms();
  FlatRun run{flat, {1.5, 1.5, 0.0}, 1.0};
  SemanticMap map{0.05, Carving{.carve = true}};
  LookMemory memory;

  Seen() {
    FlatSensors sensors(flat, flat_robot(), 1.0);
    for (const double yaw : {0.0, 0.8, 2.0}) {
      const PlanarPose here{1.5, 1.5, yaw};
      map.see(sensors.camera_at(here), sensors.points(here));
    }
    for (const MapVoxel& voxel : map.voxels())
      if (voxel.occupied && voxel.key.i % 3 == 0)
        map.set_beliefs(voxel.key, ClassBeliefs({{1, 0.5}, {2, 0.3}}));
    memory.add(Looked::unknown, {{10, 5, 4}, {11, 5, 4}, {12, 6, 5}});
    memory.add(Looked::unknown, {{10, 5, 4}});
    memory.add(Looked::unsure, {{17, 8, 3}, {8, 10, 4}});
  }
  [[nodiscard]] KnownSpace space() const {
    return {map, {Eigen::Vector3d(-1, -1, 0.01), Eigen::Vector3d(8, 5, 3)}, 0.6};
  }
};

ViewGain::Scene scene_of(const KnownSpace& space, const LookMemory& memory) {
  return {space, 0.05, 0.0, {memory, Looked::unknown, space}, {memory, Looked::unsure, space}, {}};
}

/// One ray of docs/exploration.md, cube by cube between the planes that it crosses.
Gain plain_ray(const Seen& seen, const KnownSpace& space, const Eigen::Vector3d& from,
               const Eigen::Vector3d& along, double solid_angle) {
  const Calibration cameras = flat_robot().cameras;
  std::vector<double> crossings{0.0, cameras.range_max_m};
  for (int axis = 0; axis < 3; ++axis)
    for (int plane = -100; plane < 400; ++plane) {
      const double t = (plane * 0.05 - from[axis]) / along[axis];
      if (t > 0 && t < cameras.range_max_m) crossings.push_back(t);
    }
  std::ranges::sort(crossings);
  Gain gain;
  double chance = 1.0;
  for (std::size_t n = 1; n < crossings.size() && chance > 0.05; ++n) {
    const double in = crossings[n - 1], out = crossings[n];
    const VoxelKey key = voxel_of(from + 0.5 * (in + out) * along, 0.05);
    if (key.k < 0 || key.k > 60 || key.i < -20 || key.i > 160 || key.j < -20 || key.j > 100) break;
    const VoxelKey block{key.i >> 2, key.j >> 2, key.k >> 2};
    const double voxels = in < 0.6 ? 0.0 : solid_angle * in * in / (0.05 * 0.05);
    const Space cube = space.at(key);
    if (cube == Space::unsure)
      gain.unsure += chance * voxels * seen.memory.worth(Looked::unsure, block);
    if (cube == Space::occupied || cube == Space::unsure) break;
    if (cube == Space::free) continue;
    double meets = seen.memory.worth(Looked::unknown, block);
    const double sine = key.k == 0 ? std::max(0.15, -along.z()) : 1.0;
    if (key.k > 0) meets *= kRate * (out - in);
    gain.unknown += chance * meets * voxels / sine;
    chance *= 1.0 - meets;
    if (key.k == 0) break;
  }
  return gain;
}

TEST(ViewGain, IsThatOfAPlainTwin) {
  const Seen seen;
  const KnownSpace space = seen.space();
  const ExploringRobot robot = flat_robot();
  const ViewGain gain(robot.cameras, kStep, 3 * kStep, kRate);
  ASSERT_EQ(gain.headings(), 24u);
  for (const Eigen::Vector2d& place :
       {Eigen::Vector2d(1.513, 1.491), Eigen::Vector2d(2.731, 2.023)}) {
    const Panorama panorama = gain.look_around(scene_of(space, seen.memory), place);
    std::vector<Gain> headings(24);
    const Eigen::Vector3d from(place.x(), place.y(), 1.15);
    for (int ring = -17; ring <= 17; ++ring)
      for (int azimuth = 0; azimuth < 72; ++azimuth) {
        const double up = ring * kStep, round = azimuth * kStep;
        const Eigen::Vector3d along(std::cos(up) * std::cos(round), std::cos(up) * std::sin(round),
                                    std::sin(up));
        std::optional<Gain> ray;
        for (int heading = 0; heading < 24; ++heading) {
          const Eigen::Matrix3d R_map_depth =
              Eigen::AngleAxisd(heading * 3 * kStep, Eigen::Vector3d::UnitZ()) *
              robot.cameras.T_base_depth.linear();
          const Eigen::Vector3d p = R_map_depth.transpose() * along;
          const CameraModel& camera = robot.cameras.depth;
          if (p.z() <= 0) continue;
          const Eigen::Vector2d pixel = camera.project(p);
          if (pixel.x() < -0.5 || pixel.x() >= camera.width_px - 0.5 || pixel.y() < -0.5 ||
              pixel.y() >= camera.height_px - 0.5)
            continue;
          if (!ray) ray = plain_ray(seen, space, from, along, std::cos(up) * kStep * kStep);
          headings[static_cast<std::size_t>(heading)].unknown += ray->unknown;
          headings[static_cast<std::size_t>(heading)].unsure += ray->unsure;
        }
      }
    for (std::size_t h = 0; h < 24; ++h) {
      EXPECT_NEAR(panorama.headings[h].unknown, headings[h].unknown,
                  1e-6 * (1 + headings[h].unknown));
      EXPECT_NEAR(panorama.headings[h].unsure, headings[h].unsure, 1e-6 * (1 + headings[h].unsure));
    }
    EXPECT_GT(headings[10].unknown, 50.0);
  }
}

// Space that is all seen promises nothing, whatever lies behind its walls.
TEST(ViewGain, BehindWallsNothingCounts) {
  const BoxFlat flat(4.0, 3.0);
  FlatRun run(flat, {2.0, 1.5, 0.0});
  run.drive({{2.0, 1.5, 2.1}, {2.0, 1.5, -2.1}, {1.0, 1.5, 0.0}, {3.0, 1.5, 3.0}, {3.0, 1.5, 0.0}});
  const ExplorationState state = run.state();
  const Surroundings now(state, flat_robot(), 0.0);
  const LookMemory nothing;
  const ViewGain gain(flat_robot().cameras, kStep, 3 * kStep, kRate);
  const Panorama panorama = gain.look_around(scene_of(now.space, nothing), {2.0, 1.5});
  for (const Gain& heading : panorama.headings) EXPECT_LT(heading.unknown, 40.0);
  const SemanticMap blank(0.05, Carving{.carve = true});
  const KnownSpace unknown(blank, {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 3, 2.5)}, 0.0);
  EXPECT_GT(gain.look_around(scene_of(unknown, nothing), {2.0, 1.5}).headings[0].unknown, 200.0);
}

// What a view from the place had in view is worth nothing from there, and nothing else changes.
TEST(ViewGain, WhatWasInViewFromTheSamePlaceIsWorthNothing) {
  const Seen seen;
  const KnownSpace space = seen.space();
  const ViewGain gain(flat_robot().cameras, kStep, 3 * kStep, kRate);
  const ViewGain::Scene scene = scene_of(space, seen.memory);
  const Eigen::Vector2d place(2.731, 2.023);
  const Panorama before = gain.look_around(scene, place);
  const Panorama after = gain.look_around(scene, place, {-10 * 3 * kStep});
  ASSERT_GT(before.headings[14].unknown, 0.0);
  EXPECT_EQ(after.headings[14].unknown, 0.0);  // -10 steps of 24
  EXPECT_EQ(after.headings[2].unknown, before.headings[2].unknown);
  EXPECT_NEAR(after.all.unknown, before.all.unknown - before.headings[14].unknown, 1e-6);
}

// A point to be looked at again counts where it is in view and nothing is before it.
TEST(ViewGain, PointsToBeLookedAtAgainCountWhereTheyAreInView) {
  const Seen seen;
  const KnownSpace space = seen.space();
  const ViewGain gain(flat_robot().cameras, kStep, 3 * kStep, kRate);
  ViewGain::Scene scene = scene_of(space, seen.memory);
  scene.again = {{{3.4, 1.5, 0.8}, 25.0}};  // on the wall, straight ahead
  const Panorama panorama = gain.look_around(scene, {1.5, 1.5});
  EXPECT_EQ(panorama.headings[0].again, 25.0);
  EXPECT_EQ(panorama.headings[12].again, 0.0);
  EXPECT_EQ(panorama.all.again, 25.0);
  scene.again = {{{5.0, 2.6, 0.6}, 25.0}};  // behind that wall
  EXPECT_EQ(gain.look_around(scene, {1.5, 1.5}).all.again, 0.0);
}

TEST(LookMemory, EachLookInVainHalvesWhatAFurtherOneIsWorth) {
  LookMemory memory;
  EXPECT_EQ(memory.worth(Looked::unknown, {1, 2, 3}), 1.0);
  memory.add(Looked::unknown, {{1, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(memory.worth(Looked::unknown, {1, 2, 3}), 0.5);
  EXPECT_EQ(memory.worth(Looked::unsure, {1, 2, 3}), 1.0);
  memory.add(Looked::unknown, {{1, 2, 3}});
  EXPECT_EQ(memory.worth(Looked::unknown, {1, 2, 3}), 0.25);
}

}  // namespace
}  // namespace mapscore::testing
