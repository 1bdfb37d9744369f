// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/sensors/lidar.hpp"

#include "core/error.hpp"
#include "sim/sensors/ray_cast.hpp"
#include "sim/world/drawn_scene.hpp"
#include "sim/world/motion.hpp"
#include "sim/world/mujoco_session.hpp"
#include "tests/sim/robot/drive_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mapscore::sim::testing {
namespace {

LidarRanges scan(const Lidar& lidar, const Pose& T_world_base) {
  return lidar.scans({{0.0, T_world_base}}, 1)[0];
}

constexpr float kNothing = std::numeric_limits<float>::infinity();

/// A room of 6 m x 4 m about the origin, its walls 0.1 m thick, with a round pillar.
const char* kRoom =
    "<body name='wall_1'><geom type='box' pos='3.05 0 1' size='0.05 2.1 1'/></body>"
    "<body name='wall_2'><geom type='box' pos='-3.05 0 1' size='0.05 2.1 1'/></body>"
    "<body name='wall_3'><geom type='box' pos='0 2.05 1' size='3.1 0.05 1'/></body>"
    "<body name='wall_4'><geom type='box' pos='0 -2.05 1' size='3.1 0.05 1'/></body>"
    "<body name='pillar_1'><geom type='cylinder' pos='1.5 0.8 1' size='0.2 1'/></body>";

/// The same in closed form.
double room_range(const Eigen::Vector2d& from, double angle_rad) {
  const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
  double range = 1e9;
  const Eigen::Vector2d half(3.0, 2.0);
  for (int axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0.0) continue;
    range = std::min(range, (std::copysign(half[axis], along[axis]) - from[axis]) / along[axis]);
  }
  const Eigen::Vector2d to_pillar = Eigen::Vector2d(1.5, 0.8) - from;
  const double nearest = to_pillar.dot(along);
  const double square = 0.04 - to_pillar.squaredNorm() + nearest * nearest;
  if (square >= 0.0 && nearest > 0.0) range = std::min(range, nearest - std::sqrt(square));
  return range;
}

TEST(Lidar, MeasuresARoomAsItsClosedForm) {
  const Lidar lidar(floor_world(kRoom));
  EXPECT_TRUE(lidar.T_base_lidar().translation().isApprox(Eigen::Vector3d(0.095, 0, 0.201), 1e-12));
  const Pose T_world_base = planar_pose(-0.7, 0.4, 0.6);
  const Pose T_world_lidar = T_world_base * lidar.T_base_lidar();
  const LidarRanges ranges = scan(lidar, T_world_base);
  ASSERT_EQ(ranges.size(), 360u);
  int on_pillar = 0;
  for (int beam = 0; beam < 360; ++beam) {
    const double angle_rad = 0.6 - M_PI + beam * lidar.angle_step_rad();
    const double expected = room_range(T_world_lidar.translation().head<2>(), angle_rad);
    EXPECT_NEAR(ranges[beam], expected, 1e-6 * expected) << beam;
    const Eigen::Vector2d end =
        T_world_lidar.translation().head<2>() +
        expected * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
    on_pillar += (end - Eigen::Vector2d(1.5, 0.8)).norm() < 0.21;
  }
  EXPECT_GT(on_pillar, 5);
}

TEST(Lidar, FarIsInfiniteAndNearIsZero) {
  const World world = floor_world(
      "<body name='wall_1'><geom type='box' pos='3.05 0 1' size='0.05 2 1'/></body>"
      "<body name='box_1'><geom type='box' pos='-0.2 0 0.2' size='0.1 0.1 0.2'/></body>");
  LidarSettings settings;
  settings.beams = 4;
  settings.range_max_m = 2.0;
  settings.range_min_m = 0.3;
  const LidarRanges ranges = scan(Lidar(world, settings), Pose::Identity());
  EXPECT_EQ(ranges, (LidarRanges{0.0f, kNothing, kNothing, kNothing}));
  settings.range_max_m = 3.0;
  EXPECT_FLOAT_EQ(scan(Lidar(world, settings), Pose::Identity())[2], 2.905f);
}

TEST(Lidar, SeesWhatTheRendererDraws) {
  const std::string things =
      "<body name='pane_1'><geom type='box' pos='1 0 1' size='0.01 3 1' rgba='1 1 1 0.3'/></body>"
      "<body name='hull_1'><geom type='box' pos='2 0 1' size='0.01 3 1' group='3'/></body>"
      "<body name='wall_1'><geom type='box' pos='3 0 1' size='0.01 3 1'/></body>";
  const auto forward_m = [&](const char* classes) {
    const SceneFolder folder;
    const World world = World::load(
        {folder.write("scene.xml", mjcf(things)), folder.write("c.yaml", classes), robot_file()},
        {});
    LidarSettings settings;
    settings.first_angle_rad = 0.0;
    return scan(Lidar(world, settings), Pose::Identity())[0];
  };
  EXPECT_FLOAT_EQ(forward_m("classes: [{name: pane}, {name: wall}]"), 2.99f - 0.095f);
  EXPECT_FLOAT_EQ(forward_m("classes: [{name: pane, opaque: true}, {name: wall}]"), 0.99f - 0.095f);
}

TEST(Lidar, TiltsWithTheBase) {
  const Lidar lidar(floor_world(kRoom));
  Pose tilted = Pose::Identity();
  tilted.linear() =
      exp_rotation({0, 0.3, 0});  // nose down: the floor ahead is nearer than the wall
  const Pose T_world_lidar = tilted * lidar.T_base_lidar();
  EXPECT_NEAR(scan(lidar, tilted)[180], T_world_lidar.translation().z() / std::sin(0.3), 1e-6);
}

// Many beams from one place against one ray each.
TEST(Lidar, ATurnEqualsSingleRays) {
  const World world =
      World::load({std::filesystem::path(MAPSCORE_SOURCE_DIR) / "scenes" / "apartment.xml",
                   std::nullopt, robot_file()},
                  {});
  const Lidar lidar(world);
  const ModelPtr model(mj_copyModel(nullptr, &world.model()));
  for (int geom = 0; geom < model->ngeom; ++geom) model->geom_group[geom] = 5;
  for (const mjvGeom& geom : world.drawn().geoms) model->geom_group[geom.objid] = 0;
  const DataPtr data(mj_makeData(model.get()));
  mj_kinematics(model.get(), data.get());
  for (const Pose& T_world_base : {planar_pose(2.8, 4.9, 0.1), planar_pose(6.4, 1.6, 2.0)}) {
    const Pose T_world_lidar = T_world_base * lidar.T_base_lidar();
    const LidarRanges ranges = scan(lidar, T_world_base);
    for (int beam = 0; beam < 360; ++beam) {
      const double angle_rad = -M_PI + beam * lidar.angle_step_rad();
      const Eigen::Vector3d along =
          T_world_lidar.linear() * Eigen::Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0.0);
      const double range_m =
          cast_ray(*model, *data, T_world_lidar.translation().data(), along.data());
      EXPECT_EQ(ranges[beam], static_cast<float>(range_m)) << beam;
    }
  }
}

TEST(Lidar, AnyNumberOfJobsGivesTheSameBytes) {
  const Lidar lidar(floor_world(kRoom));
  std::vector<StampedPose> poses;
  for (int i = 0; i < 100; ++i)
    poses.push_back({0.0, planar_pose(-2.0 + 0.03 * i, 0.01 * i, 0.1 * i)});
  const std::vector<LidarRanges> one = lidar.scans(poses, 1);
  EXPECT_EQ(one, lidar.scans(poses, 2));
  EXPECT_EQ(one, lidar.scans(poses, 5));
  EXPECT_EQ(one[37], scan(lidar, poses[37].T_world_base));
}

TEST(Lidar, EachTurnSeesTheSceneAtItsStamp) {
  const World loaded = floor_world(
      "<body name='gate_1' pos='1 0 0.5'><joint name='slide' type='slide' axis='1 0 0'/>"
      "<geom type='box' size='0.05 1 0.5'/></body>");
  const World world = loaded.moving({"", "", {"slide"}, {1.0, 3.0}, {0.0, 2.0}});
  LidarSettings settings;
  settings.first_angle_rad = 0.0;
  const Lidar lidar(world, settings);
  // out of order, so that nothing of a turn may stay behind
  const std::vector<StampedPose> poses = {
      {3.5, Pose::Identity()}, {1.0, Pose::Identity()}, {2.0, planar_pose(0.25, 0, 0)}};
  const std::vector<LidarRanges> turns = lidar.scans(poses, 1);
  EXPECT_FLOAT_EQ(turns[0][0], 2.95f - 0.095f);
  EXPECT_FLOAT_EQ(turns[1][0], 0.95f - 0.095f);
  EXPECT_FLOAT_EQ(turns[2][0], 1.95f - 0.095f - 0.25f);
  EXPECT_EQ(turns, lidar.scans(poses, 3));
  EXPECT_EQ(turns[1], Lidar(loaded, settings).scans({{3.5, Pose::Identity()}}, 1)[0]);
}

TEST(Lidar, RefusesWhatCannotBe) {
  const World world = floor_world();
  LidarSettings none, backwards;
  none.beams = 0;
  backwards.range_min_m = 13.0;
  EXPECT_THROW(Lidar(world, none), Error);
  EXPECT_THROW(Lidar(world, backwards), Error);
  EXPECT_THROW(Lidar(load_text(mjcf("<geom size='1'/>"))), Error);  // a robot without the site
  EXPECT_THROW((void)Lidar(world).scans({{0.0, Pose::Identity()}}, 0), Error);
}

}  // namespace
}  // namespace mapscore::sim::testing
