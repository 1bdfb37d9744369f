// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/object_table.hpp"

#include <fmt/format.h>

#include <optional>

namespace mapscore::eval {
namespace {

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.3f}", *value) : "-";
}

std::optional<double> share(std::int64_t part, std::int64_t of) {
  return of ? std::optional(static_cast<double>(part) / static_cast<double>(of)) : std::nullopt;
}

std::vector<std::string> row_of(const std::string& name, const ObjectCounts& c) {
  std::vector<std::string> row{name};
  for (const std::int64_t count : {c.truth, c.found, c.missed(), c.falsely()})
    row.push_back(std::to_string(count));
  row.push_back(number(share(c.found, c.objects)));
  row.push_back(number(share(c.found, c.truth)));
  row.push_back(number(c.mean(c.iou_sum)));
  row.push_back(number(c.mean(c.centre_sum_m)));
  row.push_back(c.found ? number(c.centre_max_m) : "-");
  for (const double sum : c.size_sum_m) row.push_back(number(c.mean(sum)));
  for (const double sum : c.size_share_sum) row.push_back(number(c.mean(100.0 * sum)));
  return row;
}

}  // namespace

Table object_table(const std::vector<ObjectCounts>& counts, const ClassTable& table) {
  Table scores;
  scores.columns = {"class",    "truth",          "found",          "missed",
                    "false",    "precision",      "recall",         "box IoU",
                    "centre_m", "max_m",          "size_x_m",       "size_y_m",
                    "size_z_m", "size_x_percent", "size_y_percent", "size_z_percent"};
  ObjectCounts all;
  for (const SemanticClass& c : table.classes) {
    const ObjectCounts& of_class = counts.at(c.id);
    if (!c.detect || (of_class.truth == 0 && of_class.objects == 0)) continue;
    scores.rows.push_back(row_of(c.name, of_class));
    all += of_class;
  }
  scores.rows.push_back(row_of("all", all));
  return scores;
}

}  // namespace mapscore::eval
