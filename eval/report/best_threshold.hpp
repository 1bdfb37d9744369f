// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/summary.hpp"
#include "eval/score/class_curve.hpp"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// F1 at a threshold that was chosen, and that threshold.
struct ChosenScore {
  std::optional<double> f1, threshold;
};

/// With fewer, each threshold would be chosen on a single other seed.
inline constexpr int kSeedsForBest = 3;

/// What choosing the threshold is worth: each seed is scored at the highest threshold with the
/// greatest F1 on the pooled curve of the other seeds. Where these have no voxel of the class,
/// nothing is predicted. Everything is undefined for fewer than kSeedsForBest seeds.
struct BestThreshold {
  std::vector<ChosenScore> by_seed;
  ChosenScore pooled;  ///< counts of the seeds, pooled; the threshold that is best on all of them
};

/// Of one class, or of pooled ones: a curve a seed. Time is linear in the steps of all curves.
[[nodiscard]] BestThreshold best_threshold(std::span<const ClassCurve> seeds);

/// Of one group of StudySummary::groups(); macro is the mean over the detected classes with visible
/// voxels. The line holds its results. Throws Error when there is no such group.
[[nodiscard]] BestThreshold best_threshold(const ResultLine& line, const ClassTable& table,
                                           std::string_view group);

}  // namespace mapscore::eval
