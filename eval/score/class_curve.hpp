// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace mapscore::eval {

/// Steps of a curve lie a thousandth apart: step k and above is the prediction at threshold k /
/// 1000.
inline constexpr int kCurveSteps = 1000;
/// Bins of the reliability diagram.
inline constexpr int kReliabilityBins = 10;

/// floor(1000 p + 1e-9): the step of a probability, or threshold, in [0, 1].
[[nodiscard]] inline int thousandth_of(double probability) {
  return static_cast<int>(kCurveSteps * probability + 1e-9);
}

/// Voxels of one class whose probability, in thousandths rounded down, is `thousandth`.
struct CurveStep {
  int thousandth = 0;                          ///< 0 to 1000
  std::int64_t predicted = 0;                  ///< voxels
  std::int64_t true_predicted = 0;             ///< of them in S
  std::int64_t found = 0;                      ///< of them in V
  std::int64_t probability_sum_billionth = 0;  ///< of their p, each rounded to 1e-9

  /// Adds the voxels of another step.
  CurveStep& operator+=(const CurveStep& other);
  bool operator==(const CurveStep&) const = default;
};

/// Counts of one class at every threshold at once: integers that add over frames, trials and
/// classes.
struct ClassCurve {
  std::int64_t visible = 0;  ///< |V_c|
  /// Sum of (p - y)^2, each rounded to 1e-9; y = 1 where the voxel is in S of its class, else 0.
  std::int64_t squared_error_billionth = 0;
  std::vector<CurveStep> steps;  ///< by falling thousandth; steps without a voxel are left out

  /// Pools, in time linear in the steps.
  ClassCurve& operator+=(const ClassCurve& other);
  bool operator==(const ClassCurve&) const = default;
};

/// Score of the prediction with `threshold`.
struct CurvePoint {
  double threshold = 0.0;
  std::int64_t predicted = 0, true_predicted = 0, found = 0;
  std::optional<double> precision, recall, f1;
};

/// One bar of the reliability diagram: voxels with a class and a probability in [low, high), the
/// last bin closed.
struct ReliabilityBin {
  double low = 0.0, high = 0.0;
  std::int64_t voxels = 0;
  std::optional<double> mean_probability, share_true;  ///< nothing without voxels
};

/// Points by falling threshold, one for each step that holds a voxel.
[[nodiscard]] std::vector<CurvePoint> points_of(const ClassCurve& curve);

/// The prediction at `threshold`, which lies on a whole thousandth: the last point that is not
/// below it. Without a threshold nothing is predicted, as above all of them.
[[nodiscard]] CurvePoint point_at(const ClassCurve& curve, std::optional<double> threshold);

/// AP = sum (R_i - R_(i-1)) P_i over points_of, R_0 = 0; nullopt when nothing is visible.
[[nodiscard]] std::optional<double> average_precision(const ClassCurve& curve);

/// The highest threshold with the greatest F1 (to 1e-12); nullopt when no voxel has a class. Choose
/// it on seeds that are not scored.
[[nodiscard]] std::optional<double> best_f1_threshold(const ClassCurve& curve);

/// Brier score: mean of (p - y)^2 over the voxels with a class; nullopt when there is none.
[[nodiscard]] std::optional<double> brier(const ClassCurve& curve);

/// kReliabilityBins equal bins over [0, 1].
[[nodiscard]] std::vector<ReliabilityBin> reliability(const ClassCurve& curve);

/// Expected calibration error: |mean p - share true| of the bins, weighted by their voxels; nullopt
/// when no voxel has a class.
[[nodiscard]] std::optional<double> expected_calibration_error(const ClassCurve& curve);

}  // namespace mapscore::eval
