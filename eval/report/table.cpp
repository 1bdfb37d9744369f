// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/table.hpp"

#include "files/csv.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace mapscore::eval {
namespace {

std::string spread(const SeedSummary& seeds) {
  return seeds.low && seeds.high ? fmt::format("{:.3f}..{:.3f}", *seeds.low, *seeds.high) : "-";
}

std::vector<std::string> caption_of(const StudySummary& summary, const std::string& group) {
  const Study& study = summary.study;
  std::vector<std::string> caption{
      fmt::format("{}: {} classes; detected: {}", study.name, group,
                  fmt::join(detected_names(summary.table), ", ")),
      fmt::format("voxels of {} m; {} seed{}; each {} scored; figures of counts pooled over seeds",
                  study.voxel_m, study.seeds, study.seeds == 1 ? "" : "s",
                  study.score.unit == ScoreUnit::map ? "map" : "frame"),
      study.seeds < kSeedsForInterval
          ? fmt::format("F1 spread: least and greatest of the seeds (fewer than {})",
                        kSeedsForInterval)
          : fmt::format("F1 spread: 95 % interval of the mean over seeds ({})", kIntervalMethod),
      "AP: over all thresholds; F1 best: each seed at the threshold that is best on the others; "
      "threshold: best on all seeds",
      "ceilings: lattice = true labels on the depth pixels, true pose; registration = the method "
      "at dose zero"};
  if (!summary.interim.empty()) caption.insert(caption.begin(), summary.interim);
  if (const std::string note = summary.lattice_note(); !note.empty())
    caption.push_back("note: " + note);
  if (summary.builds.size() > 1)
    caption.push_back(fmt::format("note: trials of {} builds stand side by side; sweep again",
                                  summary.builds.size()));
  if (study.score.asked.instances)
    caption.emplace_back("PQ: of instances; a predicted one is a connected piece of one class");
  return caption;
}

std::optional<double> share(std::int64_t part, std::int64_t of) {
  return of ? std::optional(static_cast<double>(part) / static_cast<double>(of)) : std::nullopt;
}

std::vector<std::string> row_of(const std::string& name, const ObjectCounts& c) {
  std::vector<std::string> row{name};
  for (const std::int64_t count : {c.truth, c.found, c.missed(), c.falsely()})
    row.push_back(std::to_string(count));
  row.push_back(cell_text(share(c.found, c.objects)));
  row.push_back(cell_text(share(c.found, c.truth)));
  row.push_back(cell_text(c.mean(c.iou_sum)));
  row.push_back(cell_text(c.mean(c.centre_sum_m)));
  row.push_back(c.found ? cell_text(c.centre_max_m) : "-");
  for (const double sum : c.size_sum_m) row.push_back(cell_text(c.mean(sum)));
  for (const double sum : c.size_share_sum) row.push_back(cell_text(c.mean(100.0 * sum)));
  return row;
}

/// A whole number or a number as such, `-` and nothing as null, anything else as text.
nlohmann::ordered_json json_of(const std::string& cell) {
  if (cell == "-" || cell.empty()) return nullptr;
  if (const auto whole = parse_whole(cell)) return *whole;
  const auto number = parse_real(cell);
  if (number && std::isfinite(*number)) return *number;
  return shown(cell);
}

nlohmann::ordered_json json_of(const Table& table) {
  nlohmann::ordered_json object{{"caption", nlohmann::ordered_json::array()},
                                {"rows", nlohmann::ordered_json::array()}};
  for (const std::string& line : table.caption) object["caption"].push_back(shown(line));
  for (const auto& row : table.rows) {
    nlohmann::ordered_json entry;
    for (std::size_t i = 0; i < row.size(); ++i) entry[shown(table.columns[i])] = json_of(row[i]);
    object["rows"].push_back(std::move(entry));
  }
  return object;
}

}  // namespace

std::string cell_text(const std::optional<double>& value, std::string_view format) {
  return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

std::string nine_digits(const std::optional<double>& value) {
  return cell_text(value, "{:.9g}");
}

std::string column_of(const SweepAxis& axis, const std::vector<SweepAxis>& sweep) {
  const auto last_part = [](const SweepAxis& of) { return of.path.substr(of.path.rfind('.') + 1); };
  const auto alike = std::count_if(sweep.begin(), sweep.end(), [&](const SweepAxis& other) {
    return last_part(other) == last_part(axis);
  });
  return alike == 1 ? last_part(axis) : axis.path;
}

Table score_table(const StudySummary& summary, const std::string& group) {
  Table table;
  table.caption = caption_of(summary, group);
  std::vector<std::pair<std::string, std::string>> metrics{
      {"precision", "precision"}, {"recall", "recall"}, {"F1", "f1"}, {"IoU", "iou"}};
  for (const auto& [title, name] : std::vector<std::pair<std::string, std::string>>{
           {"F1 tol. 1", "f1_t1"}, {"F at 2 cm", "f_2cm"}, {"PQ", "pq"}})
    if (summary.has_metric(name)) metrics.emplace_back(title, name);
  metrics.insert(metrics.end(),
                 {{"AP", "ap"}, {"F1 best", kBestF1}, {"threshold", kBestThreshold}});

  for (const SweepAxis& axis : summary.study.sweep)
    table.columns.push_back(column_of(axis, summary.study.sweep));
  table.columns.push_back("method");
  if (!summary.interim.empty()) table.columns.push_back("seeds there");
  for (const auto& [title, name] : metrics) table.columns.push_back(title);
  table.columns.insert(table.columns.end(),
                       {"F1 spread", "registration F1", "lattice precision", "lattice recall"});

  for (std::size_t i = 0; i < summary.trials.size(); ++i) {
    const ResultLine& line = summary.trials[i];
    const auto pooled = [&](const ResultLine& of, const std::string& metric) {
      return cell_text(estimate(of, summary.table, group, metric).pooled);
    };
    std::vector<std::string> row;
    for (const auto& [path, value] : line.cell.doses) row.push_back(value);
    row.push_back(line.method);
    if (!summary.interim.empty()) row.push_back(std::to_string(line.seeds.size()));
    for (const auto& [title, name] : metrics) row.push_back(pooled(line, name));
    row.push_back(spread(estimate(line, summary.table, group, "f1").over_seeds));
    row.push_back(pooled(summary.registration_ceilings[i], "f1"));
    row.push_back(pooled(summary.lattice_ceilings[i], "precision"));
    row.push_back(pooled(summary.lattice_ceilings[i], "recall"));
    table.rows.push_back(std::move(row));
  }
  return table;
}

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

std::string to_text(const Table& table) {
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) widths.push_back(shown(column).size());
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], shown(row[i]).size());
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string cell = shown(cells[i]);
      text += (i ? "  " : "") + cell + std::string(widths[i] - cell.size(), ' ');
    }
    return text.substr(0, text.find_last_not_of(' ') + 1) + '\n';
  };
  std::string text;
  for (const std::string& caption : table.caption) text += "# " + shown(caption) + '\n';
  text += line(table.columns);
  for (const auto& row : table.rows) text += line(row);
  return text;
}

std::string to_csv(const Table& table) {
  std::string text = csv_line(table.columns);
  for (const auto& row : table.rows) text += csv_line(row);
  return text;
}

std::string to_markdown(const Table& table) {
  const auto line = [](const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) {
      text += ' ';
      for (const char letter : shown(cell))
        text += std::string_view("\\|*_`<>[]").find(letter) == std::string_view::npos
                    ? std::string(1, letter)
                    : std::string{'\\', letter};
      text += " |";
    }
    return text + '\n';
  };
  std::string text;
  for (const std::string& caption : table.caption) text += shown(caption) + "  \n";
  if (!text.empty()) text += '\n';
  text += line(table.columns) + '|';
  for (std::size_t n = 0; n < table.columns.size(); ++n) text += " --- |";
  text += '\n';
  for (const auto& row : table.rows) text += line(row);
  return text;
}

std::string to_tex(const Table& table) {
  const auto line = [](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t n = 0; n < cells.size(); ++n) {
      if (n > 0) text += " & ";
      for (const char letter : shown(cells[n])) {
        if (letter == '\\' || letter == '~' || letter == '^')
          text += fmt::format("\\char{} ", static_cast<int>(letter));
        else
          text += std::string_view("&%$#_{}").find(letter) == std::string_view::npos
                      ? std::string(1, letter)
                      : std::string{'\\', letter};
      }
    }
    return text + " \\\\\n";
  };
  std::string text;
  for (const std::string& caption : table.caption) text += "% " + shown(caption) + '\n';
  text += "\\begin{tabular}{" + std::string(table.columns.size(), 'l') + "}\n\\toprule\n" +
          line(table.columns) + "\\midrule\n";
  for (const auto& row : table.rows) text += line(row);
  return text + "\\bottomrule\n\\end{tabular}\n";
}

std::string to_json(const Table& table) {
  return json_of(table).dump(2) + '\n';
}

std::string to_json(const std::vector<Table>& tables) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Table& table : tables) list.push_back(json_of(table));
  return list.dump(2) + '\n';
}

}  // namespace mapscore::eval
