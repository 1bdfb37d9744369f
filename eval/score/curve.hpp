// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/prediction.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace mapscore::eval {

/// Voxels of the map that share class and probability: what a threshold gains by falling to it.
struct ProbabilityStep {
  double probability = 0.0;
  std::int64_t predicted = 0, true_predicted = 0, found = 0;

  bool operator==(const ProbabilityStep&) const = default;
};

/// Counts of one class at every threshold at once. Integers that add over frames, trials and
/// classes.
struct ClassCurve {
  std::int64_t visible = 0;            ///< |V_c|
  std::vector<ProbabilityStep> steps;  ///< by falling probability, each probability once

  /// Pools.
  ClassCurve& operator+=(const ClassCurve& other);
  bool operator==(const ClassCurve&) const = default;
};

/// Score of the prediction with `threshold`.
struct CurvePoint {
  double threshold = 0.0;
  std::int64_t predicted = 0, true_predicted = 0, found = 0;
  std::optional<double> precision, recall, f1;
};

/// One step of a calibration plot: predicted voxels with a probability in [low, high), the last bin
/// closed.
struct ReliabilityBin {
  double low = 0.0, high = 0.0;
  std::int64_t voxels = 0;
  std::optional<double> mean_probability, share_true;
};

/// Curves by class id. Occupied voxels with a class count, whatever their probability. Throws Error
/// when the map or V has a class that is not below `class_count`.
[[nodiscard]] std::vector<ClassCurve> curves_of(const MapSnapshot& map, const SurfaceTruth& surface,
                                                const VisibleTruth& visible,
                                                std::size_t class_count);

/// Points by falling threshold, one for each probability that occurs.
[[nodiscard]] std::vector<CurvePoint> points_of(const ClassCurve& curve);

/// AP = sum (R_i - R_(i-1)) P_i over points_of, R_0 = 0; nullopt when nothing is visible.
[[nodiscard]] std::optional<double> average_precision(const ClassCurve& curve);

/// The highest threshold with the greatest F1; nullopt when no voxel has a class. Choose it on
/// seeds that are not scored.
[[nodiscard]] std::optional<double> best_f1_threshold(const ClassCurve& curve);

/// Brier score: mean of (p - y)^2 over the voxels with a class, y = 1 where the voxel is in S of
/// its class; nullopt when there is none.
[[nodiscard]] std::optional<double> brier(const ClassCurve& curve);

/// Equal bins over [0, 1]; empty ones have no values. `bins` >= 1.
[[nodiscard]] std::vector<ReliabilityBin> reliability(const ClassCurve& curve, int bins = 10);

}  // namespace mapscore::eval
