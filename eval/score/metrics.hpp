// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/score/counts.hpp"

#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// A named figure; nullopt is undefined (0/0, or not finite) and printed `-`.
struct Metric {
  std::string name;
  std::optional<double> value;

  bool operator==(const Metric&) const = default;
};

/// part / whole; nullopt when whole is 0.
[[nodiscard]] std::optional<double> ratio(std::int64_t part, std::int64_t whole);

/// Harmonic mean of precision true_predicted / predicted and recall found / visible. nullopt when
/// nothing is predicted and nothing is visible; 0 when one of the two is empty or nothing was hit.
[[nodiscard]] std::optional<double> f1(std::int64_t true_predicted, std::int64_t predicted,
                                       std::int64_t found, std::int64_t visible);

/// |P in S| / |P|.
[[nodiscard]] std::optional<double> precision(const ClassCounts& counts);
/// |V in P| / |V|.
[[nodiscard]] std::optional<double> recall(const ClassCounts& counts);
[[nodiscard]] std::optional<double> f1(const ClassCounts& counts);
/// |V in P| / (|V| + |P outside S|).
[[nodiscard]] std::optional<double> iou(const ClassCounts& counts);

/// All figures of one class, or of pooled counts, always in this order: precision, recall, f1, iou;
/// recall_4, f1_4, iou_4; for each tolerance t precision_tT, recall_tT, f1_tT; where distances were
/// scored, for each tau precision_Xcm, recall_Xcm, f_Xcm, then accuracy_mean_m, accuracy_p95_m,
/// completeness_mean_m, completeness_p95_m; ap, brier, ece; box_iou, box_25, box_50, box_75; where
/// thin parts were scored, thin_precision, thin_recall, thin_f1; where instances were scored, those
/// of instance_metrics.
[[nodiscard]] std::vector<Metric> metrics_of(const ClassCounts& counts);

/// Each figure's mean over the classes where it is defined. All list the same figures in one order;
/// there is at least one.
[[nodiscard]] std::vector<Metric> mean_over_classes(
    const std::vector<std::vector<Metric>>& classes);

/// The mean of every figure over the detected classes with visible voxels; a class for which a
/// figure is undefined is left out of that figure's mean. Figures of instances are those of
/// macro_instance_metrics. Two of them again by the names they go by, at the end: mpa (recall) and
/// miou (iou). Empty when there is no such class. Throws Error when counts and table differ in
/// size.
[[nodiscard]] std::vector<Metric> macro_metrics(const Counts& counts, const ClassTable& table);

/// The figure of that name, or nullopt when it is undefined. Throws Error when there is none.
[[nodiscard]] std::optional<double> value_of(const std::vector<Metric>& metrics,
                                             const std::string& name);

}  // namespace mapscore::eval
