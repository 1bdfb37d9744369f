// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/recorder/recorded_drive.hpp"
#include "sim/world/world.hpp"
#include "tests/sim/world/scene_files.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace mapscore::sim::testing {

inline constexpr double kDegree = M_PI / 180.0;

inline std::filesystem::path robot_file() {
  return std::filesystem::path(MAPSCORE_SOURCE_DIR) / "scenes" / "robot.xml";
}

/// Loads a scene given as text, with the robot that drives.
inline World drive_world(const std::string& scene) {
  const SceneFolder folder;
  return World::load({folder.write("scene.xml", scene), std::nullopt, robot_file()}, {});
}

/// A floor of 10 m x 10 m that does not collide by its own account, and what stands on it.
inline World floor_world(const std::string& more = "", const std::string& head = "") {
  return drive_world(
      mjcf("<body name='floor_1'><geom type='box' pos='0 0 -0.05' size='5 5 0.05' "
           "contype='0' conaffinity='0'/></body>" +
               more,
           head));
}

inline Drive drive_along(std::vector<Drive::Waypoint> waypoints) {
  Drive drive;
  drive.waypoints = std::move(waypoints);
  return drive;
}

}  // namespace mapscore::sim::testing
