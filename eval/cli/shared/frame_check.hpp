// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "eval/cli/shared/map_score.hpp"
#include "eval/cli/shared/truth_source.hpp"
#include "eval/truth/surface_truth.hpp"

#include <span>
#include <string>

namespace mapscore::eval {

/// A motion in words: its shift in metres, its yaw, pitch and roll in degrees
/// (R = Rz(yaw) Ry(pitch) Rx(roll)).
[[nodiscard]] std::string motion_text(const Pose& motion);

/// What --transform takes: tx ty tz qx qy qz qw, to a hundredth of a millimetre 1000 km from the
/// origin.
[[nodiscard]] std::string transform_text(const Pose& T);

/// Another unit of length that the points of a map and the surfaces suggest by their bounds, and
/// the flag that mends it; empty where none does. `scale`: metres in a unit, as the map was read.
[[nodiscard]] std::string unit_trouble(std::span<const Eigen::Vector3d> map,
                                       const SurfaceTruth& surface, double scale);

/// Whether a map lies where its truth does, in words for a note; empty where nothing is odd. Odd
/// are: fewer than one in four of its occupied voxels on or beside a surface, fewer than one in
/// four of its detected classes' voxels on or beside a surface of their class, fewer than half of
/// those within upright surfaces (an occupied voxel above and below) on or beside a surface. Then
/// it says what is wrong, where that can be told: the unit, the axes, or a motion that explains the
/// map better, or else that the classes do not fit; so it does where none is detected. Throws
/// Error, with the bounds of both and the same, when fewer than one in a hundred lie on or beside a
/// surface.
[[nodiscard]] std::string frame_note(const MapFlags& flags, const InputMap& map,
                                     const SurfaceTruth& surface, TruthSource& source);

}  // namespace mapscore::eval
