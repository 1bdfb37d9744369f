// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/mujoco_session.hpp"

#include "core/error.hpp"

#include <mutex>

namespace mapscore::sim {
namespace {

/// MuJoCo asks that an error handler does not return.
[[noreturn]] void raise(const char* message) {
  throw Error("MuJoCo: " + one_line(message));
}

}  // namespace

void quiet_mujoco() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (!mju_user_error) mju_user_error = raise;
    if (!mju_user_warning) mju_user_warning = [](const char*) {};
  });
}

std::string one_line(const std::string& message) {
  std::string line;
  for (const char c : message) {
    if (c != '\n' && c != '\r') {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += "; ";
    }
  }
  while (!line.empty() && (line.back() == ' ' || line.back() == ';')) line.pop_back();
  return line;
}

std::string element_name(const mjModel& model, mjtObj type, int id) {
  const char* name = mj_id2name(&model, type, id);
  return name ? name : "";
}

Pose pose_of(const mjtNum* position, const mjtNum* rotation) {
  using RowMajor3 = Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor>;
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Map<const RowMajor3>(rotation).cast<double>();
  pose.translation() = Eigen::Map<const Eigen::Matrix<mjtNum, 3, 1>>(position).cast<double>();
  return pose;
}

}  // namespace mapscore::sim
