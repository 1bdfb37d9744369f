// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "sim/world/world.hpp"

#include <memory>
#include <vector>

namespace mapscore::sim {

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

}  // namespace mapscore::sim
