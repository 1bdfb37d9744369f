// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/score/counts.hpp"
#include "eval/score/metric.hpp"

#include <optional>
#include <vector>

namespace mapscore::eval {

/// |P in S| / |P|.
[[nodiscard]] inline std::optional<double> precision(const ClassCounts& counts) {
  return ratio(counts.true_predicted, counts.predicted);
}
/// |V in P| / |V|.
[[nodiscard]] inline std::optional<double> recall(const ClassCounts& counts) {
  return ratio(counts.found, counts.visible);
}
[[nodiscard]] inline std::optional<double> f1(const ClassCounts& counts) {
  return f1(counts.true_predicted, counts.predicted, counts.found, counts.visible);
}
/// |V in P| / (|V| + |P outside S|).
[[nodiscard]] inline std::optional<double> iou(const ClassCounts& counts) {
  return ratio(counts.found, counts.visible + counts.predicted - counts.true_predicted);
}

/// All figures of one class, or of pooled counts, always in this order: precision, recall, f1, iou;
/// recall_4, f1_4, iou_4; for each tolerance t precision_tT, recall_tT, f1_tT; where distances were
/// scored, for each tau precision_Xcm, recall_Xcm, f_Xcm, then accuracy_mean_m, accuracy_p95_m,
/// completeness_mean_m, completeness_p95_m; ap, brier, ece; then those of each part that was
/// counted, in the order of ClassCounts::parts().
[[nodiscard]] std::vector<Metric> metrics_of(const ClassCounts& counts);

/// The mean of every figure over the detected classes with visible voxels; a class for which a
/// figure is undefined is left out of that figure's mean. Figures of instances are those of
/// macro_instance_metrics. Two of them again by the names they go by, at the end: mpa (recall) and
/// miou (iou). Empty when there is no such class. Throws Error when counts and table differ in
/// size.
[[nodiscard]] std::vector<Metric> macro_metrics(const Counts& counts, const ClassTable& table);

}  // namespace mapscore::eval
