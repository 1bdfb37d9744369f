// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/odometry/motion_prior.hpp"

#include <cstddef>
#include <numbers>

/// Numbers that tracking and loops of VisualOdometry share.
namespace mapscore::odometry_numbers {

inline constexpr double kDegree = std::numbers::pi / 180.0;
/// Key frames whose planes the local map keeps, and of how many near ones it is made anew.
inline constexpr std::size_t kHorizon = 60;
/// A scan that contradicts the prior, or is to end a loss, is believed where it has this share of
/// the support of the last one that was.
inline constexpr double kStillSeen = 0.75;

/// Of the filter's covariance where a scan confirmed it: what its errors show (docs/odometry.md).
inline constexpr double kStatedPart = 0.25;

/// Of a key frame's place against the map it is put into.
inline Covariance6 key_frame_floor() {
  return sigmas6(0.00015, 0.00015, 0.005 * kDegree, 0.005 * kDegree);
}
/// How far a robot that is lost may be from where it believes to be.
inline Covariance6 lost_jump() {
  return sigmas6(0.5, 0.05, 2.0 * kDegree, 30.0 * kDegree);
}

}  // namespace mapscore::odometry_numbers
