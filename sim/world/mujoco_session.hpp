// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace mapscore::sim {

/// Owners of MuJoCo's heap objects.
struct MujocoDeleter {
  void operator()(mjSpec* spec) const { mj_deleteSpec(spec); }
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using SpecPtr = std::unique_ptr<mjSpec, MujocoDeleter>;
using ModelPtr = std::unique_ptr<mjModel, MujocoDeleter>;
using DataPtr = std::unique_ptr<mjData, MujocoDeleter>;

/// Keeps MuJoCo from printing, from writing MUJOCO_LOG.TXT and from ending the process: its errors
/// become mapscore::Error, its warnings are dropped. Handlers that the host program installed
/// before stay. Thread-safe; costs nothing after the first call.
void quiet_mujoco();

/// MuJoCo's message on one line.
[[nodiscard]] std::string one_line(const std::string& message);

/// Name of a body, geom or joint; empty where it has none.
[[nodiscard]] std::string element_name(const mjModel& model, mjtObj type, int id);

/// Pose from MuJoCo's position (3) and row-major rotation matrix (9).
[[nodiscard]] Pose pose_of(const mjtNum* position, const mjtNum* rotation);

/// World pose of a geom, its kinematics done.
[[nodiscard]] inline Pose geom_pose(const mjData& data, int geom) {
  return pose_of(data.geom_xpos + 3 * geom, data.geom_xmat + 9 * geom);
}

}  // namespace mapscore::sim
