// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/segmentation/calibration_evidence.hpp"

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace mapscore {

/// Why a detection yielded nothing.
enum class SkipReason { none, no_points, eroded_away, no_seed_point, seed_off_object };
constexpr auto names_of(SkipReason) {
  return std::to_array<std::string_view>(
      {"", "no_points", "eroded_away", "no_seed_point", "seed_off_object"});
}

/// 3D segmentation of one detection; frame depth_optical, metres. Nothing but `skipped` when it
/// failed.
struct Segment {
  [[nodiscard]] static Segment nothing(SkipReason why) {
    Segment segment;
    segment.skipped = why;
    return segment;
  }

  ClassId class_id = kBackground;
  InstanceId instance = 0;
  double score = 1.0;
  std::vector<Eigen::Vector3d> points;  ///< kept, in row-major order of their colour pixels
  Eigen::AlignedBox3d box;              ///< of the kept points
  /// Centres of the occupied voxels, ascending: of the lattice anchored at the sensor frame's
  /// origin, for region growing of its own lattice anchored at the seed point. Empty unless asked
  /// for.
  std::vector<Eigen::Vector3d> voxel_centres;
  SkipReason skipped = SkipReason::none;
  /// Probability that the method mended the frame's registration well; none of a method that mends
  /// none.
  std::optional<double> confidence = {};
  /// The frame as that method fitted it, likewise.
  std::shared_ptr<const FittedFrame> fit = {};
};

/// Whether a frame was mended with a confidence below 0.5. `segments`: all of the frame's.
[[nodiscard]] inline bool is_unsure(const std::vector<Segment>& segments) {
  return !segments.empty() && segments.front().confidence.value_or(1.0) < 0.5;
}

}  // namespace mapscore
