// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/frame.hpp"
#include "sim/world/world.hpp"

#include <opencv2/core.hpp>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace mapscore::sim {

/// A coloured cube drawn into a picture, its lightest side in its own colour.
struct Cube {
  Eigen::Vector3d centre_world;
  double edge_m = 0.05;
  Eigen::Matrix3d R_world_cube = Eigen::Matrix3d::Identity();
  Colour colour;
};

/// View of a picture: where the eye is and what it looks at, world frame, metres.
struct View {
  Eigen::Vector3d eye_m{0, 0, 2};
  Eigen::Vector3d target_m{0, 0, 0};
  double vfov_deg = 45;
  int width_px = 1280, height_px = 960;
  std::vector<std::string> hidden_classes;  ///< left out of the picture, e.g. the ceiling
  bool ghost_scene = false;  ///< draw the scene pale and lit plainly, so that cubes stand out
  /// Draw everything plain, in the colour of its class, background grey, and lit plainly. Goes
  /// before ghost_scene.
  bool class_colours = false;
  /// Leave out what lies flat between the eye and the room below it: what is wider than 1 m both
  /// ways, more than 0.9 m above the target and wholly below the eye.
  bool open_ceiling = false;
};

/// When a camera looks, and where the robot stands then.
struct Instant {
  double stamp_s = 0.0;
  Pose T_world_base = Pose::Identity();
};

/// Off-screen renderer of one world on OSMesa: one context, used by one thread (the one that made
/// it). Renders repeat bit for bit, also between contexts of different threads.
class Renderer {
 public:
  /// `coarse` lights boxes at their corners alone: several times as fast where they are many, as in
  /// pictures, but not as true to nearby lights.
  Renderer(const World& world, bool shadows, bool coarse = false);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Renders both cameras of the robot standing at `T_world_base`: colour and instance ids from the
  /// colour camera; depth (16-bit, out of range = 0) and instance ids from the depth camera.
  [[nodiscard]] Frame render(int index, double stamp_s, const Pose& T_world_base);

  /// The colour camera's side (color, label) at one instant, the depth camera's (depth,
  /// depth_label) at another, each with the scene's configuration of that instant. Stamp and pose
  /// of the frame are the depth's.
  [[nodiscard]] Frame render(int index, const Instant& color, const Instant& depth);

  /// One side alone: fills `color` and `label`.
  void render_color(const Instant& instant, Frame& frame);
  /// One side alone: fills `depth` and `depth_label`, stamp and pose.
  void render_depth(const Instant& instant, Frame& frame);

  /// Planar depth in metres before it is stored (float, 0 = none beyond the far plane), at the pose
  /// of loading, for tests.
  [[nodiscard]] cv::Mat1f render_metric_depth(const Pose& T_world_base);

  /// A picture of the scene, optionally with cubes drawn into it. BGR.
  [[nodiscard]] cv::Mat3b picture(const View& view, std::span<const Cube> cubes = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mapscore::sim
