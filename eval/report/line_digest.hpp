// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/results/store.hpp"
#include "eval/score/counts.hpp"
#include "eval/score/metric.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

struct BestThreshold;
struct Estimate;
struct ResultLine;

/// What tables and figures ask of a line of results, formed while these are read one after the
/// other: a few kilobytes a seed less than the results themselves. Immutable.
class LineDigest {
 public:
  /// Of these groups of StudySummary::groups(). Pools the counts of a line from a store.
  LineDigest(ResultLine& line, const ClassTable& table, const std::vector<std::string>& groups);

  /// As estimate(); nothing for another group.
  [[nodiscard]] std::optional<Estimate> estimate(std::string_view group,
                                                 const std::string& metric) const;
  /// As metrics_of_group of the line's pooled counts; nothing for another group.
  [[nodiscard]] std::optional<std::vector<Metric>> pooled_metrics(std::string_view group) const;
  /// Of the detected classes together, over all seeds; plain counts, curve and labels alone.
  [[nodiscard]] const ClassCounts& pooled() const { return pooled_; }
  /// Of each seed.
  [[nodiscard]] const std::vector<Accounting>& accountings() const { return accountings_; }

 private:
  struct Group {
    std::string name;
    std::vector<std::string> metrics;  ///< the two of the best threshold last
    std::vector<double> values;        ///< by metric: pooled, then a seed each; NaN is undefined
  };
  /// `by_seed`: of each seed the metrics, which are none or as many as `pooled`.
  [[nodiscard]] static Group formed(const std::string& name, const std::vector<Metric>& pooled,
                                    const std::vector<std::vector<double>>& by_seed,
                                    const BestThreshold& best);
  [[nodiscard]] const Group* find(std::string_view group) const;

  std::size_t seeds_;
  std::vector<Group> groups_;
  ClassCounts pooled_;
  std::vector<Accounting> accountings_;
};

}  // namespace mapscore::eval
