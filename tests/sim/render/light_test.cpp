// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/render/renderer.hpp"
#include "tests/sim/render/rendered_frames.hpp"

#include <gtest/gtest.h>

namespace mapscore::sim {
namespace {

using testing::kStart;
using testing::load_text;
using testing::mjcf;

constexpr const char* kWall =
    "<body name='wall_1'><geom type='box' size='.1 5 5' pos='3 0 0'/></body>";
constexpr const char* kLamp = "<light pos='0 0 2' dir='1 0 -.3' directional='true'/>";
constexpr const char* kOff = "<visual><headlight active='0'/></visual>";

/// The colour image of a scene at the start.
cv::Mat3b lit_image(const World& world) {
  Renderer renderer(world, false);
  return testing::frame_at(renderer, kStart).color;
}

TEST(Light, WithoutAnyAHeadLightTakesItsPlace) {
  const World none = load_text(mjcf(kWall)), off = load_text(mjcf(kWall, kOff));
  EXPECT_FALSE(none.has_light());
  EXPECT_FALSE(off.has_light());
  EXPECT_EQ(testing::different_pixels(lit_image(none), lit_image(off)), 0);
  EXPECT_GT(cv::mean(lit_image(off))[0], 60.0);
}

TEST(Light, OneOfTheSceneStaysAlone) {
  const World lamp = load_text(mjcf(std::string(kLamp) + kWall, kOff));
  EXPECT_TRUE(lamp.has_light());
  EXPECT_GT(testing::different_pixels(lit_image(lamp), lit_image(load_text(mjcf(kWall)))), 0);
}

}  // namespace
}  // namespace mapscore::sim
