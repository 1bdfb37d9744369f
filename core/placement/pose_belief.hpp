// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/parameters.hpp"
#include "core/random_stream.hpp"

#include <array>
#include <string_view>
#include <vector>

namespace mapscore {

/// What localisation says: mean pose, and the covariance of its error in the axes of
/// base_footprint, order x y z roll pitch yaw (metres, radians).
struct PoseBelief {
  Pose T_map_odom = Pose::Identity();
  Pose T_odom_base = Pose::Identity();
  Covariance6 covariance = Covariance6::Zero();
};

/// Where a noise transform is applied. `base` turns about the robot, so that the covariance of the
/// draws equals the believed one at any distance from the origin; `odom` is [M, section 3.2], which
/// turns about the origin of the odometry frame.
enum class NoiseAt { base, odom };

/// `diagonal` draws each axis by itself [M]; `full` uses the whole covariance.
enum class CovarianceUse { diagonal, full };

constexpr auto names_of(NoiseAt) {
  return std::to_array<std::string_view>({"base", "odom"});
}
constexpr auto names_of(CovarianceUse) {
  return std::to_array<std::string_view>({"diagonal", "full"});
}

/// How poses are drawn from the belief for an observation.
struct Draws {
  int N = 1;
  NoiseAt noise_at = NoiseAt::base;
  CovarianceUse covariance = CovarianceUse::diagonal;

  static void fields(auto& s, auto&& visit) {
    visit(s.N, Field{"N", "draws from the pose belief for an observation", {1, 100000}, "N"});
    visit(s.noise_at,
          Field{"noise_at", "draw about the robot (base) or the odom origin (as the paper)"});
    visit(s.covariance, Field{"covariance", "part of the pose covariance that is drawn from"});
  }
  bool operator==(const Draws&) const = default;
};

/// The lower triangular L with L L^T = covariance, of Cholesky, diagonal 0 or more: L_ij = (E_ij -
/// sum_k<j L_ik L_jk) / L_jj in the order x y z roll pitch yaw. The column of an axis of whose
/// variance those before it leave nothing (1e-14) is zero. So semi-definite matrices have a root,
/// zero gives zero, that of a diagonal is its square roots bit for bit, and it does not depend on
/// which variance is greater. Throws Error when the matrix is not symmetric positive semi-definite.
[[nodiscard]] Covariance6 covariance_root(const Covariance6& covariance);

/// N poses T_map_base drawn from the belief. A zero covariance gives N copies of the mean, bit for
/// bit. Throws Error, nothing drawn, when N < 1 or the covariance, however it is used, is not
/// symmetric positive semi-definite. Safe from several threads, each with a stream of its own.
[[nodiscard]] std::vector<Pose> draw_poses(const PoseBelief& belief, const Draws& draws,
                                           RandomStream& stream);

}  // namespace mapscore
