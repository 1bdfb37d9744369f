// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/frame.hpp"
#include "sim/world/world.hpp"

#include <opencv2/core.hpp>

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

  /// The colour camera's side of a frame, the robot and the scene as they stand at an instant:
  /// fills `color` and `label` (instance ids).
  void render_color(const StampedPose& instant, Frame& frame);
  /// `label` of it alone, the same bytes.
  void render_label(const StampedPose& instant, Frame& frame);
  /// The depth camera's side: fills `depth` (16-bit, out of range = 0) and `depth_label` (instance
  /// ids), stamp and pose.
  void render_depth(const StampedPose& instant, Frame& frame);

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
