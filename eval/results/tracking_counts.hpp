// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/odometry/visual_odometry.hpp"
#include "eval/localization/visual_run.hpp"
#include "eval/score/metric.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Whether no depth image vouches for such a pose, or one alone, which may show a place that looks
/// the same.
[[nodiscard]] constexpr bool is_untracked(Tracking tracking) {
  return tracking == Tracking::unsure || tracking == Tracking::blind ||
         tracking == Tracking::lost || tracking == Tracking::restarted ||
         tracking == Tracking::relocated;
}

/// How the poses of a recording's depth images came about (Tracking), each image once, and how many
/// loops were closed.
struct TrackingCounts {
  std::int64_t images_started = 0;
  std::int64_t images_tracked = 0;
  std::int64_t images_slipped = 0;
  std::int64_t images_unsure = 0;
  std::int64_t images_beside = 0;
  std::int64_t images_blind = 0;
  std::int64_t images_lost = 0;
  std::int64_t images_restarted = 0;
  std::int64_t images_relocated = 0;
  std::int64_t loops_closed = 0;

  static auto counts() {
    return std::to_array<CountField<TrackingCounts>>({
        {"images_started", &TrackingCounts::images_started},
        {"images_tracked", &TrackingCounts::images_tracked},
        {"images_slipped", &TrackingCounts::images_slipped},
        {"images_unsure", &TrackingCounts::images_unsure},
        {"images_beside", &TrackingCounts::images_beside},
        {"images_blind", &TrackingCounts::images_blind},
        {"images_lost", &TrackingCounts::images_lost},
        {"images_restarted", &TrackingCounts::images_restarted},
        {"images_relocated", &TrackingCounts::images_relocated},
        {"loops_closed", &TrackingCounts::loops_closed},
    });
  }
  [[nodiscard]] static TrackingCounts of(const VisualTrajectory& visual);

  [[nodiscard]] std::int64_t images() const;
  /// Those that are (is_untracked).
  [[nodiscard]] std::int64_t untracked() const;
  /// Names of the counts of such images that are not 0: images_blind, images_lost.
  [[nodiscard]] std::vector<std::string> untracked_names() const;
  /// Those that are there: `1 started, 2433 tracked, 2 slipped of 2436 depth images; 4 loops
  /// closed`.
  [[nodiscard]] std::string text() const;

  bool operator==(const TrackingCounts&) const = default;
};

}  // namespace mapscore::eval
