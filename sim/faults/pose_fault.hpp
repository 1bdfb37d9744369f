// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <cstdint>
#include <vector>

namespace mapscore::sim {

/// How pose noise is tied together over the frames of a drive.
enum class PoseNoiseKind {
  white,    ///< a draw of its own for every frame
  walk,     ///< steps add up: frame n carries the product of n + 1 draws
  constant  ///< one draw for the whole drive
};

/// Pose error of a dose: xi ~ N(0, covariance) in the axes of base_footprint, order x y z roll
/// pitch yaw.
struct PoseDose {
  Covariance6 covariance = Covariance6::Zero();
  PoseNoiseKind kind = PoseNoiseKind::white;
};

/// Believed poses T_world_base = T_true * Exp(xi) of a drive. Frame n draws from the stream (seed,
/// "pose", n), and draws scale with the root of the covariance, so that a fault's direction does
/// not depend on its dose. A zero covariance returns the true poses bit for bit. Throws Error when
/// the covariance is not positive semi-definite.
[[nodiscard]] std::vector<Pose> believe_poses(const std::vector<Pose>& T_world_base,
                                              const PoseDose& dose, std::uint64_t seed);

}  // namespace mapscore::sim
