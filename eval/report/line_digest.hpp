// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/score/counts.hpp"
#include "eval/score/metric.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

struct ResultLine;
struct Estimate;

/// What tables and figures ask of a line of results, formed while these were in memory: a few
/// kilobytes a seed less than the results themselves. Immutable.
class LineDigest {
 public:
  /// Of these groups of StudySummary::groups().
  LineDigest(const ResultLine& line, const ClassTable& table,
             const std::vector<std::string>& groups);

  /// As estimate(); nothing for another group.
  [[nodiscard]] std::optional<Estimate> estimate(std::string_view group,
                                                 const std::string& metric) const;
  /// As metrics_of_group of the line's pooled counts; nothing for another group.
  [[nodiscard]] std::optional<std::vector<Metric>> pooled_metrics(std::string_view group) const;
  /// Of the detected classes together, over all seeds; plain counts alone.
  [[nodiscard]] const ClassCounts& pooled() const { return pooled_; }

 private:
  struct Group {
    std::string name;
    std::vector<std::string> metrics;  ///< the two of the best threshold last
    std::vector<double> values;        ///< by metric: pooled, then a seed each; NaN is undefined
  };
  [[nodiscard]] const Group* find(std::string_view group) const;

  std::size_t seeds_;
  std::vector<Group> groups_;
  ClassCounts pooled_;
};

}  // namespace mapscore::eval
