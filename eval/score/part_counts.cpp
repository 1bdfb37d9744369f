// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/part_counts.hpp"

#include <cmath>
#include <numbers>
#include <optional>

namespace mapscore::eval {
namespace {

/// Of a whole, in a sum's second count.
constexpr double kParts = 1e12;

struct WholeAndParts {
  std::int64_t whole, parts;
};

/// Rounded to whole parts; of a sum that is not negative and below 2^63.
WholeAndParts split(double sum) {
  const double whole = std::floor(sum);
  const auto parts = std::llround((sum - whole) * kParts);
  if (parts == std::llround(kParts)) return {std::llround(whole) + 1, 0};
  return {std::llround(whole), parts};
}

double joined(std::int64_t whole, std::int64_t parts) {
  return static_cast<double>(whole) + static_cast<double>(parts) / kParts;
}

}  // namespace

PoseCounts PoseCounts::of(const TrajectoryErrors& errors) {
  PoseCounts counts;
  const auto put = [&](double sum, std::int64_t PoseCounts::*whole,
                       std::int64_t PoseCounts::*parts) {
    const WholeAndParts number = split(sum);
    counts.*whole = number.whole;
    counts.*parts = number.parts;
  };
  counts.frames = errors.position.count;
  counts.pairs = errors.relative_position.count;
  put(errors.position.sum, &PoseCounts::position, &PoseCounts::position_parts);
  put(errors.aligned.sum, &PoseCounts::aligned, &PoseCounts::aligned_parts);
  put(errors.rotation.sum, &PoseCounts::rotation, &PoseCounts::rotation_parts);
  put(errors.relative_position.sum, &PoseCounts::relative_position,
      &PoseCounts::relative_position_parts);
  put(errors.relative_rotation.sum, &PoseCounts::relative_rotation,
      &PoseCounts::relative_rotation_parts);
  counts.nees_frames = errors.planar.count;
  counts.nees_in_band = errors.planar.in_band;
  counts.nees_infinite = errors.planar.infinite;
  put(errors.planar.sum, &PoseCounts::nees, &PoseCounts::nees_parts);
  counts.nees6_frames = errors.spatial.count;
  counts.nees6_in_band = errors.spatial.in_band;
  counts.nees6_infinite = errors.spatial.infinite;
  put(errors.spatial.sum, &PoseCounts::nees6, &PoseCounts::nees6_parts);
  return counts;
}

std::vector<Metric> PoseCounts::metrics() const {
  return pose_metrics(
      {.position = {frames, joined(position, position_parts)},
       .aligned = {frames, joined(aligned, aligned_parts)},
       .rotation = {frames, joined(rotation, rotation_parts)},
       .relative_position = {pairs, joined(relative_position, relative_position_parts)},
       .relative_rotation = {pairs, joined(relative_rotation, relative_rotation_parts)},
       .planar = {nees_frames, nees_in_band, nees_infinite, joined(nees, nees_parts)},
       .spatial = {nees6_frames, nees6_in_band, nees6_infinite, joined(nees6, nees6_parts)}});
}

std::vector<Metric> pose_metrics(const TrajectoryErrors& errors) {
  const auto in_units = [](const std::optional<double>& value, double units) {
    return value ? std::optional(*value * units) : std::nullopt;
  };
  constexpr double kDegrees = 180.0 / std::numbers::pi, kPercent = 100.0;
  return {{"ate_m", errors.position.rms()},
          {"ate_aligned_m", errors.aligned.rms()},
          {"ate_deg", in_units(errors.rotation.rms(), kDegrees)},
          {"rpe_percent", in_units(errors.relative_position.rms(), kPercent / kPairWay)},
          {"rpe_deg_per_m", in_units(errors.relative_rotation.rms(), kDegrees / kPairWay)},
          {"nees_share", errors.planar.share()},
          {"nees_mean", errors.planar.mean()},
          {"nees6_share", errors.spatial.share()},
          {"nees6_mean", errors.spatial.mean()}};
}

}  // namespace mapscore::eval
