// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/planar_pose.hpp"
#include "sim/robot/odometry.hpp"
#include "sim/world/mujoco_session.hpp"
#include "sim/world/world.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::sim {

/// What a geom is to the drive.
enum class GeomRole { none, scene, wheel, caster, bump };

/// The robot on its wheels among the scene's standing geoms: the model whose physics a drive steps.
/// Only geometry comes from the scene; its joints, actuators, contact settings and options stay
/// behind. Pinned: time step 2 ms, gravity 9.81 m/s^2 along -z, integrator implicitfast, Newton
/// solver, elliptic friction cones with impratio 10, no medium, no wind, no reset on bad states.
/// Arrays of two are left, right.
struct DriveModel {
  ModelPtr model;
  ModelPtr probe;  ///< the same with bumper, mast and head wider by the clearance; never stepped
  int base_body = 0, base_qpos = 0;
  std::array<int, 2> wheel_qpos{}, wheel_actuator{}, wheel_geom{};
  WheelGeometry wheels;
  std::vector<GeomRole> role;           ///< by geom
  std::vector<std::string> scene_body;  ///< by geom: body of the scene, empty for the robot's
};

/// `robot` is the MJCF that the world was loaded with: a body `base_footprint`, in it hinge joints
/// `wheel_left` and `wheel_right` at equal height with velocity actuators and geoms of the same
/// names (cylinder or ellipsoid; the size along x is the radius), and further geoms that collide:
/// those named `caster...` roll on the floor, all others bump. Throws Error naming the file and
/// what it lacks.
[[nodiscard]] DriveModel make_drive_model(const World& world, const std::filesystem::path& robot,
                                          double clearance_m);

/// Puts the robot upright at a place of the world, its base at z = `z_m`; kinematics are to be
/// done.
void stand_upright(const DriveModel& drive, const PlanarPose& place, double z_m, mjData& data);

}  // namespace mapscore::sim
