// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/placement/pose_belief.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

// Errors of a whole trajectory: ATE and RPE of J. Sturm, N. Engelhard, F. Endres, W. Burgard, D.
// Cremers, A benchmark for the evaluation of RGB-D SLAM systems (IROS 2012), and NEES. Definitions
// and equations: docs/metrics.md, "Trajectories".

namespace mapscore::eval {

/// Squared errors added up, in the order of the frames.
struct SquareSum {
  std::int64_t count = 0;
  double sum = 0.0;

  void add(double squared) {
    ++count;
    sum += squared;
  }
  /// Root of the mean square; nothing where nothing was counted.
  [[nodiscard]] std::optional<double> rms() const;
};

/// Normalised errors of the frames that have one.
struct NeesTally {
  std::int64_t count = 0;     ///< frames
  std::int64_t in_band = 0;   ///< of them within the 95 % band
  std::int64_t infinite = 0;  ///< of them with kInfiniteNees and more: the covariance is singular
  double sum = 0.0;           ///< of the finite ones

  /// Share in the band; nothing without a frame.
  [[nodiscard]] std::optional<double> share() const;
  /// Mean; nothing without a frame or with an infinite one.
  [[nodiscard]] std::optional<double> mean() const;
};

/// A NEES of this and more counts as infinite, so that sums of many stay exact.
inline constexpr double kInfiniteNees = 1e9;

/// Metres of the true way between the two poses of a pair, and how far off it a pair may be.
inline constexpr double kPairWay = 1.0, kPairSlack = 0.1;

/// What a trajectory is scored by. Add up over trajectories, then form roots and means.
struct TrajectoryErrors {
  SquareSum position;           ///< of each frame, m^2: ATE as it stands
  SquareSum aligned;            ///< the same after the rigid motion that makes it least
  SquareSum rotation;           ///< of each frame, rad^2, as it stands
  SquareSum relative_position;  ///< of each pair, m^2: RPE
  SquareSum relative_rotation;  ///< of each pair, rad^2
  /// x y yaw, three degrees of freedom. Not of beliefs that state no covariance, nor of those that
  /// call an axis certain and are right within 1e-9 m or rad.
  NeesTally planar;
  NeesTally spatial;  ///< all axes, six degrees of freedom; of beliefs with all variances
};

/// Pairs of poses a metre of way apart. For each pose i of the true trajectory the later pose j
/// whose way from i, along the straight lines between neighbours, is nearest to kPairWay; of
/// equally near ones the first. No pair where that is farther off than kPairSlack.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> pairs_of_way(
    std::span<const Pose> truth);

/// The rigid motion T_a_b that makes the sum of squared distances |p_a - T_a_b p_b| least: S.
/// Umeyama, Least-squares estimation of transformation parameters between two point patterns
/// (1991), without scale. Of positions on one line, which leave the turn about it open, one of the
/// best.
[[nodiscard]] Pose rigid_alignment(std::span<const Pose> a, std::span<const Pose> b);

/// Angle of a rotation, 0 to pi, exact for small ones too.
[[nodiscard]] double rotation_angle(const Eigen::Matrix3d& rotation);

/// Errors of believed poses against true ones, frame by frame, both T_world_base. Throws Error when
/// there are none, or not as many of both.
[[nodiscard]] TrajectoryErrors trajectory_errors(std::span<const Pose> truth,
                                                 std::span<const PoseBelief> believed);

/// As above, of poses alone: there is no NEES.
[[nodiscard]] TrajectoryErrors trajectory_errors(std::span<const Pose> truth,
                                                 std::span<const Pose> believed);

}  // namespace mapscore::eval
