// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/shape.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

struct mjModel_;

namespace mapscore::sim {

struct DrawnScene;
struct Motion;

/// Where the robot is at an instant.
struct StampedPose {
  double stamp_s = 0.0;
  Pose T_world_base = Pose::Identity();
};

/// Files that make a world.
struct WorldFiles {
  std::filesystem::path scene;  ///< MJCF
  /// Default: SCENE stem + .classes.yaml if it exists.
  std::optional<std::filesystem::path> classes;
  /// MJCF with body base_footprint, cameras color and depth; empty: none.
  std::filesystem::path robot;
};

/// What the camera settings of a study override in the robot's MJCF.
struct CameraOverrides {
  int width_px = 640, height_px = 480;  ///< both cameras; the fields of view stay
  double range_min_m = 0.6, range_max_m = 8.0;
  /// Of the body that holds the colour camera, which both cameras move with: z in base_footprint,
  /// heading, and turn downwards about its y axis after that. Default: as the MJCF has it.
  std::optional<double> height_m{}, pan_rad{}, tilt_rad{};
};

/// A compiled scene with the robot attached, its class table and its exact drawn surfaces.
/// Immutable after loading and safe to share between threads.
class World {
 public:
  /// Without a robot there is no calibration, and nothing to render frames with.
  /// Throws Error when a file is missing, MuJoCo refuses it (with MuJoCo's own reason), a class
  /// pattern is doubled or unknown, or a drawn geom is of a kind that the truth cannot hold.
  [[nodiscard]] static World load(const WorldFiles& files, const CameraOverrides& cameras);

  /// A world of nothing but surfaces and the classes that their instances belong to, as a recording
  /// holds them, to make pictures of: no robot, no cameras, no hash. Throws Error when a class or
  /// mesh cannot be used.
  [[nodiscard]] static World of_shapes(std::vector<Shape> shapes, const ClassTable& table);

  /// The same world with joints that move; see MovingScene. `shapes` and `drawn` stay those of the
  /// pose of loading. Throws Error when the scene has no such joint, or one that is neither hinge
  /// nor slide.
  [[nodiscard]] World moving(Motion motion) const;
  /// The world as it stands at one instant of its motion.
  [[nodiscard]] World at(double stamp_s) const;
  /// None where nothing moves.
  [[nodiscard]] const Motion* motion() const;

  [[nodiscard]] const ClassTable& classes() const;
  [[nodiscard]] const Calibration& calibration() const;
  /// Drawn surfaces in the world frame, the robot's left out.
  [[nodiscard]] const std::vector<Shape>& shapes() const;
  /// Names of bodies with drawn geoms that no class matches.
  [[nodiscard]] const std::vector<std::string>& unmatched_bodies() const;
  /// Whether it has a light of its own; else the cameras' head light alone lights it.
  [[nodiscard]] bool has_light() const;
  /// Content hash of scene, class file and robot (file bytes and included files as compiled).
  [[nodiscard]] const std::string& hash() const;
  [[nodiscard]] const mjModel_& model() const;
  /// Instance id of each geom of the model (of each shape, where the world is made of shapes); 0
  /// for background. Robot geoms: see `robot_geom`.
  [[nodiscard]] const std::vector<InstanceId>& geom_instances() const;
  [[nodiscard]] bool robot_geom(int geom) const;
  /// What renderers draw; see sim/world/drawn_scene.hpp.
  [[nodiscard]] const DrawnScene& drawn() const;

 private:
  friend class MovingScene;
  struct State;
  explicit World(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

/// A world at one instant of its motion after the other. A world without a motion is always as it
/// was loaded. Kinematics alone: joint limits, contacts and constraints do not act. Used by one
/// thread at a time.
class MovingScene {
 public:
  explicit MovingScene(const World& world);
  ~MovingScene();
  MovingScene(const MovingScene&) = delete;
  MovingScene& operator=(const MovingScene&) = delete;

  void move_to(double stamp_s);

  /// What renderers draw at that instant; valid until the next move.
  [[nodiscard]] const DrawnScene& drawn() const;
  /// Poses T_world_shape of the world's shapes at that instant, in their order.
  [[nodiscard]] const std::vector<Pose>& poses() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

[[nodiscard]] std::string mujoco_version();

}  // namespace mapscore::sim
