// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/robot/clearance.hpp"
#include "sim/robot/drive_model.hpp"
#include "sim/robot/waypoint_controller.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace mapscore::sim {

/// What physics did to the robot, over all time steps.
struct DriveHealth {
  double deepest_wheel_m = 0.0;     ///< of a wheel in the floor
  double longest_airborne_s = 0.0;  ///< of a wheel without contact
  double largest_tilt_rad = 0.0;    ///< of the base against the vertical
  std::size_t bump_contacts = 0;    ///< contacts of bumper, mast or head, summed over time steps
};

/// The robot in motion: one state of a DriveModel, stepped. Not thread-safe.
class DrivePhysics {
 public:
  explicit DrivePhysics(const DriveModel& drive)
      : drive_(drive), data_(mj_makeData(drive.model.get())) {}

  /// Stands the robot upright on the floor at `floor_m` and lets it settle for a second; time and
  /// wheel angles then count from here.
  void settle(const PlanarPose& start, double floor_m);

  /// Turns a command of the base into wheel speeds, which the motors get to evenly over the `steps`
  /// that follow: a jump would make the wheels spin.
  void command(const VelocityCommand& command, int steps);
  /// One time step. Throws Error when the state is not finite any more, or the robot tips over or
  /// falls.
  void step();

  [[nodiscard]] double time_s() const { return static_cast<double>(steps_) * step_s(); }
  [[nodiscard]] double step_s() const { return drive_.model->opt.timestep; }
  [[nodiscard]] Pose T_world_base() const;
  [[nodiscard]] PlanarPose planar() const { return mapscore::planar(T_world_base()); }
  [[nodiscard]] WheelTicks ticks(int ticks_per_turn) const;
  /// What the robot touches most from the side, with any part; nothing where it only stands.
  [[nodiscard]] std::optional<Obstacle> touched() const;
  [[nodiscard]] const DriveHealth& health() const { return health_; }

 private:
  void observe_contacts();
  void check_state();

  const DriveModel& drive_;
  DataPtr data_;
  std::size_t steps_ = 0;
  std::array<double, 2> wheel_zero_rad_{}, airborne_s_{};
  std::array<double, 2> wheel_step_radps_{};  ///< change of the wheels' speed with each step
  int ramp_steps_ = 0;                        ///< for which it goes on
  DriveHealth health_;
};

}  // namespace mapscore::sim
