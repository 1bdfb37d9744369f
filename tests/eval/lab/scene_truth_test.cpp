// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#ifdef MAPSCORE_SIMULATOR

#include "eval/truth/distance.hpp"
#include "eval/truth/sample_counter.hpp"
#include "eval/truth/surface_truth.hpp"
#include "tests/sim/render/rendered_frames.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

// From MJCF to truth: what MuJoCo draws is what the truth counts, and what it does not draw neither
// counts nor buries.

namespace mapscore::eval {
namespace {

using sim::World;
using sim::testing::load_text;
using sim::testing::mjcf;

SurfaceTruth truth_of(const World& world, double edge_m, double epsilon_m) {
  return surface_truth(world.shapes(), world.classes(), map_from_world({0.0031, 0.0017, 0}, 0.2),
                       {edge_m, epsilon_m, 2});
}

ClassId class_named(const World& world, const std::string& name) {
  for (const SemanticClass& c : world.classes().classes)
    if (c.name == name) return c.id;
  ADD_FAILURE() << "no class " << name;
  return kBackground;
}

/// Every type of geom that is drawn, some by way of a mesh, around the origin at eye level.
World every_geom() {
  const std::string head = R"(
    <asset>
      <mesh name="wedge" vertex="0 0 0  .5 0 0  0 .6 0  .5 .6 0  0 0 .4  0 .6 .4"/>
      <mesh name="scaled" scale=".5 .7 1.3" vertex="0 0 0  .5 0 0  0 .6 0  .5 .6 0  0 0 .4  0 .6 .4"/>
      <mesh name="mirrored" scale="-1 .7 1" vertex="0 0 0  .5 0 0  0 .6 0  .5 .6 0  0 0 .4  0 .6 .4"/>
      <mesh name="far" refpos="1 2 3" refquat="1 .2 .3 -.1" vertex="1 2 3  1.5 2 3  1 2.6 3  1 2 3.4"/>
      <hfield name="hill" nrow="5" ncol="6" size=".5 .4 .3 .1" elevation="0 .2 0 .5 0 .1  .3 1 .2 .4 .9 0  .1 .3 .8 .2 .6 .2  0 .7 .1 .9 .3 .5  .2 0 .4 0 .8 0"/>
    </asset>)";
  const std::string bodies = R"(
    <geom name="ground" type="plane" size="0 0 1"/>
    <body name="shelf_1" pos="0 0 .7"><geom type="plane" size=".3 .4 1"/></body>
    <body name="ball_1" pos="1.1 0 1.3"><geom type="sphere" size=".2"/></body>
    <body name="egg_1" pos=".9 .6 1.2" euler="30 20 10"><geom type="ellipsoid" size=".1 .3 .2"/></body>
    <body name="can_1" pos=".4 1 1.1" euler="50 0 20"><geom type="cylinder" size=".12 .2"/></body>
    <body name="pill_1" pos="-.2 1.1 1.2" euler="40 30 0"><geom type="capsule" size=".08 .2"/></body>
    <body name="crate_1" pos="-.8 .8 1.1" euler="10 20 30"><geom type="box" size=".1 .2 .15"/></body>
    <body name="wedge_1" pos="-1.2 .1 1.1" euler="15 25 70"><geom type="mesh" mesh="wedge" pos=".1 0 .1" euler="0 30 0"/></body>
    <body name="scaled_1" pos="-1 -.5 1.1" euler="0 0 20"><geom type="mesh" mesh="scaled"/></body>
    <body name="mirrored_1" pos="-.2 -1.2 1.1" euler="10 0 20"><geom type="mesh" mesh="mirrored"/></body>
    <body name="far_1" pos=".3 -1.1 1.1"><geom type="mesh" mesh="far"/></body>
    <body name="field_1" pos=".9 -.7 1.1" euler="0 -30 10"><geom type="sdf" mesh="scaled"/></body>
    <body name="hill_1" pos="0 0 1.5" euler="0 -20 0"><geom type="hfield" hfield="hill"/></body>
    <body name="under_1" pos="0 .2 2.6" euler="0 170 0"><geom type="hfield" hfield="hill"/></body>
    <body name="fitted_1" pos="0 0 .9" euler="20 0 0"><geom type="box" mesh="wedge"/></body>)";
  return load_text(mjcf(bodies, head));
}

/// Samples of all frames taken from around the scene, from eye level.
SampleCounter samples_around(const World& world, double edge_m, const Pose& T_map_world) {
  sim::Renderer renderer(world, false);
  SampleCounter samples(edge_m);
  for (int n = 0; n < 12; ++n) {
    const double angle = 2 * std::numbers::pi * n / 12 + 0.05;
    const Pose T_world_base =
        planar_pose(-2.6 * std::cos(angle), -2.6 * std::sin(angle), angle + 0.02 * n);
    const Frame frame = sim::testing::frame_at(renderer, T_world_base);
    samples.add(frame, world.calibration(), world.classes(), T_map_world * frame.T_world_base);
  }
  return samples;
}

TEST(SceneTruth, HoldsEveryDepthSampleOfEveryDrawnShape) {
  const World world = every_geom();
  const Pose T_map_world = map_from_world({0.0031, 0.0017, 0}, 0.2);
  // A drawn facet lies within 0.5 mm of its surface, a stored depth within 0.1 mm of the drawn one.
  constexpr double kReach_m = 0.0005 + 0.5 / kDepthUnitsPerMetre;
  for (const double edge_m : {0.01, 0.05}) {
    const auto truth =
        surface_truth(world.shapes(), world.classes(), T_map_world, {edge_m, kReach_m, 2});
    const SampleCounter samples = samples_around(world, edge_m, T_map_world);
    std::map<std::string, std::uint64_t> seen, strays;
    for (const SampleCount& count : samples.counts()) {
      const std::string& name = world.classes().classes.at(count.class_id).name;
      seen[name] += count.samples;
      if (!truth.contains(count.key, count.class_id)) strays[name] += count.samples;
    }
    for (const SemanticClass& c : world.classes().classes) {
      EXPECT_GT(seen[c.name], 1000u) << c.name;
      EXPECT_EQ(strays[c.name], 0u) << c.name << " of " << seen[c.name] << " edge " << edge_m;
    }
  }
}

const char* const kCased = R"(
  <body name="ball_1" pos="1 1 .5"><geom type="sphere" size=".1"/></body>
  <body name="case_1" pos="1 1 .5"><geom type="box" size=".2 .2 .2" )";

std::size_t rows_of_class(const World& world, const std::string& name) {
  return truth_of(world, 0.02, 0.0005).count(class_named(world, name));
}

TEST(SceneTruth, GlassIsNeitherTruthNorBuriesUnlessOpaque) {
  const World bare =
      load_text(mjcf("<body name='ball_1' pos='1 1 .5'><geom type='sphere' size='.1'/></body>"));
  const std::size_t ball = rows_of_class(bare, "ball");
  ASSERT_GT(ball, 100u);
  const std::string glass = mjcf(std::string(kCased) + "rgba='1 1 1 .99'/></body>");
  const std::string classes = "classes: [{name: ball}, {name: case}]\n";
  const std::string opaque = "classes: [{name: ball}, {name: case, opaque: true}]\n";
  EXPECT_EQ(rows_of_class(load_text(glass, classes), "ball"), ball);
  EXPECT_EQ(rows_of_class(load_text(glass, classes), "case"), 0u);
  EXPECT_EQ(rows_of_class(load_text(glass, opaque), "ball"), 0u);  // buried
  EXPECT_GT(rows_of_class(load_text(glass, opaque), "case"), 1000u);
  // A material's alpha counts as a geom's own.
  const World material = load_text(mjcf(std::string(kCased) + "material='pane'/></body>",
                                        "<asset><material name='pane' rgba='1 1 1 .5'/></asset>"),
                                   classes);
  EXPECT_EQ(rows_of_class(material, "ball"), ball);
  EXPECT_EQ(rows_of_class(material, "case"), 0u);
}

TEST(SceneTruth, HiddenGroupsAreNeitherTruthNorBury) {
  const std::string classes = "classes: [{name: ball}, {name: case}]\n";
  for (int group = 0; group < 6; ++group) {
    SCOPED_TRACE(group);
    const World world =
        load_text(mjcf(fmt::format("{}group='{}'/></body>", kCased, group)), classes);
    const bool drawn = group < 3;
    EXPECT_EQ(rows_of_class(world, "case") > 0, drawn);
    EXPECT_EQ(rows_of_class(world, "ball") > 0, !drawn);
  }
}

TEST(SceneTruth, TheRobotIsNeitherTruthNorBuries) {
  // Within the robot's post, a cylinder of radius 0.15 from the floor to 1 m.
  const World inside =
      load_text(mjcf("<body name='ball_1' pos='0 0 .5'><geom type='sphere' size='.1'/></body>"));
  const World outside =
      load_text(mjcf("<body name='ball_1' pos='2 0 .5'><geom type='sphere' size='.1'/></body>"));
  const SurfaceTruth truth = truth_of(inside, 0.02, 0.0005);
  EXPECT_EQ(truth.count(1), truth.voxels().size());
  const Pose T_map_world = map_from_world({2, 0, 0}, 0);
  const ClassTable& table = inside.classes();
  EXPECT_EQ(surface_truth(inside.shapes(), table, Pose::Identity(), {0.02, 0.0005, 1}).count(1),
            surface_truth(outside.shapes(), table, T_map_world, {0.02, 0.0005, 1}).count(1));
}

TEST(SceneTruth, FloorsOfAnyHeightAreTakenAtEpsilonZero) {
  struct Case {
    const char* z;
    bool below, above;
  };
  for (const Case& c : {Case{"0", true, true}, Case{"1e-9", false, true},
                        Case{"-1e-9", true, false}, Case{"1e-4", false, true}}) {
    SCOPED_TRACE(c.z);
    // By the body: a geom's own offset below some 1e-6 m MuJoCo takes for none.
    const World world = load_text(mjcf("<body name='floor_1' pos='0 0 " + std::string(c.z) +
                                       "'><geom type='plane' size='1 1 1'/></body>"));
    const auto truth =
        surface_truth(world.shapes(), world.classes(), Pose::Identity(), {0.05, 0, 1});
    EXPECT_EQ(truth.contains({3, 3, -1}, 1), c.below);
    EXPECT_EQ(truth.contains({3, 3, 0}, 1), c.above);
    // 42 x 42 columns: the 40 crossed and one touched on each side, at +-1 m.
    EXPECT_EQ(truth.voxels().size(), 42u * 42u * (c.below + c.above));
  }
}

}  // namespace
}  // namespace mapscore::eval

#endif  // MAPSCORE_SIMULATOR
