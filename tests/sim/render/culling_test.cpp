// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/render/offscreen.hpp"
#include "sim/render/scene_view.hpp"
#include "sim/world/drawn_scene.hpp"
#include "tests/sim/render/rendered_frames.hpp"

#include <thread>

namespace mapscore::sim {
namespace {

using testing::different_pixels;
using testing::expect_same;
using testing::shapes_room;

TEST(RenderRepeats, BitForBitAlsoBetweenThreads) {
  const World world = shapes_room();
  const Pose T_world_base = planar_pose(0.1, 0.05, 0.2);
  std::vector<Frame> frames(3);
  const auto render = [&](Frame& frame, bool warm_up) {
    Renderer renderer(world, true);
    if (warm_up) (void)testing::frame_at(renderer, planar_pose(0.5, 0.3, 1.0));
    frame = testing::frame_at(renderer, T_world_base);
  };
  render(frames[0], true);
  {
    std::jthread first([&] { render(frames[1], false); });
    std::jthread second([&] { render(frames[2], true); });
  }
  expect_same(frames[0], frames[1]);
  expect_same(frames[0], frames[2]);
}

/// Both passes of the depth camera's view with every geom of the scene in the buffer.
TEST(RenderCulling, ChangesNothing) {
  const World world = shapes_room();
  const Calibration& calibration = world.calibration();
  for (const bool shadows : {false, true}) {
    Renderer renderer(world, shadows);
    Offscreen offscreen(world.model());
    SceneBuffer everything(world.model(), world.drawn(), world.drawn().geoms.size());
    for (const mjvGeom& geom : world.drawn().geoms) everything.add(geom);
    for (const double yaw : {-2.5, -0.7, 0.0, 0.4, 1.3}) {
      const Pose T_world_base = planar_pose(0.4, -0.2, yaw);
      const Pose T_world_color =
          T_world_base * calibration.T_base_depth * calibration.T_color_depth.inverse();
      const Frame frame = testing::frame_at(renderer, T_world_base);
      cv::Mat3b pixels;
      everything.look_through(gl_camera(calibration.color, T_world_color));
      everything.show_colours(shadows);
      offscreen.draw(640, 480, everything.scene());
      offscreen.read(pixels);
      cv::flip(pixels, pixels, 0);
      EXPECT_EQ(different_pixels(pixels, frame.color), 0)
          << "shadows " << shadows << ", yaw " << yaw;
    }
  }
}

TEST(RenderCulling, LeavesOutWhatIsBehindAndBeside) {
  const CameraModel camera = CameraModel::from_hfov(640, 480, M_PI / 3);
  const Frustum frustum(camera, Pose::Identity());  // looks along z, x right, y down
  EXPECT_TRUE(frustum.may_see({0, 0, 3}, 0.1));
  EXPECT_TRUE(frustum.may_see({2.0, 0, 3}, 0.5));
  EXPECT_FALSE(frustum.may_see({0, 0, -3}, 0.1));
  EXPECT_FALSE(frustum.may_see({5, 0, 3}, 0.5));
  EXPECT_FALSE(frustum.may_see({0, -5, 3}, 0.5));
  mjvLight lamp{};
  lamp.type = mjLIGHT_SPOT;
  lamp.pos[1] = -4;                                        // above the eye
  EXPECT_TRUE(frustum.may_shade({0, -3, 1}, 0.1, lamp));   // between lamp and view
  EXPECT_FALSE(frustum.may_shade({0, 5, 1}, 0.1, lamp));   // below the view
  EXPECT_FALSE(frustum.may_shade({9, -3, 1}, 0.1, lamp));  // beside both
  mjvLight sun{};
  sun.type = mjLIGHT_DIRECTIONAL;
  sun.dir[1] = 1;  // shines down
  EXPECT_TRUE(frustum.may_shade({0, -30, 3}, 0.1, sun));
  EXPECT_FALSE(frustum.may_shade({0, 5, 3}, 0.1, sun));
}

}  // namespace
}  // namespace mapscore::sim
