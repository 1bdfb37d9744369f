// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/baseline.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "files/csv.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <tuple>

namespace mapscore::eval {
namespace {

constexpr std::array kKept{"precision", "recall", "f1", "iou", "f1_t1", "f_2cm"};
constexpr const char* kHeader = "what,class,metric,value";

std::string description_of(const ResultLine& line) {
  std::string text = fmt::format("{} {}", name_of(line.role), line.method);
  for (const auto& [path, value] : line.cell.doses) text += fmt::format(" {}={}", path, value);
  return text;
}

std::string six_decimals(const std::optional<double>& value) {
  return cell_text(value, "{:.6f}");
}

std::optional<double> parse_value(const std::string& text, const std::string& where) {
  if (text == "-") return std::nullopt;
  if (const auto value = parse_number(text)) return value;
  throw Error(where + ": '" + text + "' is no number; write the baseline again with --write");
}

}  // namespace

std::vector<BaselineRow> baseline_of(const StudySummary& summary) {
  std::vector<BaselineRow> rows;
  for (const auto* lines :
       {&summary.trials, &summary.registration_ceilings, &summary.lattice_ceilings})
    for (const ResultLine& line : *lines)
      for (const std::string& group : summary.groups())
        for (const Metric& metric : pooled_metrics(line, summary.table, group))
          if (std::ranges::count(kKept, metric.name) > 0)
            rows.push_back({description_of(line), group, metric.name, metric.value});
  return rows;
}

void write_baseline(const std::vector<BaselineRow>& rows, const std::filesystem::path& file) {
  std::string text = std::string(kHeader) + '\n';
  for (const BaselineRow& row : rows)
    text += csv_line({row.what, row.group, row.metric, six_decimals(row.value)});
  write_whole_file(file, text);
}

std::vector<BaselineRow> read_baseline(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream)
    throw Error(file.string() +
                ": no baseline there; make one with `mapscore check RESULTS --baseline " +
                file.string() + " --write`");
  std::vector<BaselineRow> rows;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::string where = fmt::format("{}:{}", file.string(), number);
    if (number == 1) {
      if (line != kHeader) throw Error(where + ": not a baseline; its first line is " + kHeader);
      continue;
    }
    const auto cells = csv_cells(line, 4);
    if (!cells || cells->size() != 4) throw Error(where + ": needs four columns: " + kHeader);
    rows.push_back({(*cells)[0], (*cells)[1], (*cells)[2], parse_value((*cells)[3], where)});
  }
  if (rows.empty()) throw Error(file.string() + ": the baseline holds no figure; write it again");
  return rows;
}

std::vector<Fall> falls(const std::vector<BaselineRow>& baseline,
                        const std::vector<BaselineRow>& now, double allowed) {
  std::map<std::tuple<std::string, std::string, std::string>, std::optional<double>> values;
  for (const BaselineRow& row : now) values[{row.what, row.group, row.metric}] = row.value;
  std::vector<Fall> fallen;
  for (const BaselineRow& row : baseline) {
    if (!row.value) continue;
    const auto found = values.find({row.what, row.group, row.metric});
    const std::optional<double> value = found == values.end() ? std::nullopt : found->second;
    if (!value || *value < *row.value - allowed) fallen.push_back({row, value});
  }
  return fallen;
}

Table fall_table(const std::vector<Fall>& fallen) {
  Table table;
  table.columns = {"what", "class", "metric", "baseline", "now", "change"};
  for (const Fall& fall : fallen)
    table.rows.push_back(
        {fall.baseline.what, fall.baseline.group, fall.baseline.metric,
         six_decimals(fall.baseline.value), six_decimals(fall.now),
         fall.now ? fmt::format("{:+.6f}", *fall.now - *fall.baseline.value) : "missing"});
  return table;
}

}  // namespace mapscore::eval
