// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/summary.hpp"
#include "eval/report/table.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// One figure that a baseline holds fast. Higher is better for all of them.
struct BaselineRow {
  std::string what;    ///< role, method and doses
  std::string group;   ///< "pooled" or a class
  std::string metric;  ///< precision, recall, f1, iou, f1_t1, f_2cm
  std::optional<double> value;
};

/// A figure that fell, vanished, or was never in the results.
struct Fall {
  BaselineRow baseline;
  std::optional<double> now;
};

/// The figures of a study that a baseline keeps: those above, pooled and by class, for trials and
/// ceilings.
[[nodiscard]] std::vector<BaselineRow> baseline_of(const StudySummary& summary);

/// CSV: what,class,metric,value. Written aside, then renamed.
void write_baseline(const std::vector<BaselineRow>& rows, const std::filesystem::path& file);
/// Throws Error naming the file and line.
[[nodiscard]] std::vector<BaselineRow> read_baseline(const std::filesystem::path& file);

/// Rows of `baseline` that `now` misses or that are lower by more than `allowed`, absolutely.
[[nodiscard]] std::vector<Fall> falls(const std::vector<BaselineRow>& baseline,
                                      const std::vector<BaselineRow>& now, double allowed);

[[nodiscard]] Table fall_table(const std::vector<Fall>& falls);

}  // namespace mapscore::eval
