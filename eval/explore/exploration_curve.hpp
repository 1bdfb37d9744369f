// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <vector>

namespace mapscore::eval {

/// How a map stands against the visible surface of its scene (docs/exploration.md, "Scores").
struct MapState {
  double precision = 0.0, recall = 0.0, f1 = 0.0;  ///< of the detected classes, pooled
  double known_m3 = 0.0;                           ///< volume that the map calls free or occupied
};

/// An exploration after one of its frames.
struct CoveragePoint {
  double stamp_s = 0.0, driven_m = 0.0;
  int views = 0;                   ///< chosen until then
  double coverage = 0.0;           ///< seen share of the visible surface, background included
  double coverage_detected = 0.0;  ///< of that of the detected classes
  std::optional<MapState> map;     ///< where the map was scored
};

/// The points of an exploration, by stamp.
using ExplorationCurve = std::vector<CoveragePoint>;

/// What a curve is read over.
enum class CurveAxis { metres, seconds };

/// Metres or seconds at the first point that covers `share`; nothing where none does.
[[nodiscard]] std::optional<double> reaches(const ExplorationCurve& curve, double share,
                                            CurveAxis axis);

/// Coverage after a way or a time: that of the last point that is not beyond; 0 before the first.
[[nodiscard]] double coverage_at(const ExplorationCurve& curve, double at, CurveAxis axis);

/// Mean coverage from 0 to `until`, of a coverage that stays between two points and after the last:
/// the area under the curve by its width, from 0 to 1. `until` > 0.
[[nodiscard]] double area_under(const ExplorationCurve& curve, double until, CurveAxis axis);

}  // namespace mapscore::eval
