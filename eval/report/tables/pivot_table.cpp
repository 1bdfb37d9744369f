// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/tables/pivot_table.hpp"

#include "core/error.hpp"
#include "eval/report/axes.hpp"
#include "eval/report/tables/accounting_counts.hpp"
#include "files/suggestion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr const char *kMethod = "method", *kClass = "class", *kMetric = "metric";
/// All swept paths together, where the points lie over ranges and so share no value.
constexpr const char* kPoint = "point";

using Texts = std::vector<std::string>;
using Doses = decltype(Cell::doses);

/// One value of a dimension, as it stands in the study and as its reader sees it.
struct Value {
  std::string name;
  Texts in_row;  ///< a cell each title of the dimension
  std::string in_column;
  Doses doses = {};  ///< of a swept path, or of a point
};

struct Dimension {
  std::string name;  ///< path, or one of the above
  Texts titles;      ///< of its columns: one, or of `point` one a path
  std::vector<Value> values;
};

/// Places figures of a study in rows and columns.
class Pivot {
 public:
  Pivot(const StudySummary& summary, const PivotQuestion& question, Reader reader)
      : summary_(summary), question_(question), reader_(reader) {
    points_of(summary.study.sampling) > 0 ? add_points() : add_axes();
    add_methods();
    add_groups();
    add_metrics();
    rows_ = named(question.rows);
    columns_ = named(question.columns);
    place_the_others();
    for (const ResultLine& line : summary.trials) lines_[{line.method, line.cell.doses}] = &line;
  }

  [[nodiscard]] Table table() {
    Table table;
    for (const std::size_t d : rows_)
      table.columns.insert(table.columns.end(), dimensions_[d].titles.begin(),
                           dimensions_[d].titles.end());
    table.keys = table.columns.size();
    const auto columns = combinations(columns_);
    for (const auto& column : columns) add_heads(column, table.columns);
    if (reader_ == Reader::program) table.columns.emplace_back("spread");
    for (const auto& row : combinations(rows_)) {
      std::vector<std::string> cells;
      for (const std::size_t d : rows_) {
        const Texts& texts = dimensions_[d].values[row.at(d)].in_row;
        cells.insert(cells.end(), texts.begin(), texts.end());
      }
      std::set<std::string> kinds;
      for (const auto& column : columns) add_cells(row, column, cells, kinds);
      if (reader_ == Reader::program) cells.push_back(fmt::format("{}", fmt::join(kinds, "/")));
      table.rows.push_back(std::move(cells));
    }
    table.caption = caption();
    return table;
  }

 private:
  using Place = std::map<std::size_t, std::size_t>;  ///< value of each dimension

  void add_axes() {
    const Study& study = summary_.study;
    const std::vector<std::string> titles = dose_columns(study, reader_);
    for (std::size_t a = 0; a < study.sweep.size(); ++a) {
      Dimension dimension{study.sweep[a].path, {titles[a]}, {}};
      for (const std::string& value : study.sweep[a].values) {
        const auto has = [&](const ResultLine& line) { return line.cell.doses[a].second == value; };
        if (std::ranges::none_of(summary_.trials, has)) continue;
        const FigureAxis shown = figure_axis(study, {study.sweep[a].path, {value}});
        dimension.values.push_back({value,
                                    {reader_ == Reader::paper ? shown.values.front() : value},
                                    reader_ != Reader::paper
                                        ? fmt::format("{} = {}", titles[a], value)
                                    : shown.unit.empty() ? shown.text(0)
                                                         : shown.value_text(0),
                                    {{study.sweep[a].path, value}}});
      }
      dimensions_.push_back(std::move(dimension));
    }
  }

  void add_points() {
    Dimension dimension{kPoint, dose_columns(summary_.study, reader_), {}};
    for (const ResultLine& line : summary_.trials) {
      if (!dimension.values.empty() && dimension.values.back().doses == line.cell.doses) continue;
      const Texts texts = dose_texts(summary_.study, line.cell, reader_);
      dimension.values.push_back(
          {kPoint, texts, fmt::to_string(fmt::join(texts, ", ")), line.cell.doses});
    }
    dimensions_.push_back(std::move(dimension));
  }

  void add_methods() {
    Dimension dimension{kMethod, {kMethod}, {}};
    for (const std::string& name : method_names(summary_.study))
      if (std::ranges::count(summary_.trials, name, &ResultLine::method) > 0)
        add_value(dimension, name, method_text(summary_.study, name, reader_));
    dimensions_.push_back(std::move(dimension));
  }

  void add_groups() {
    std::vector<std::string> groups = question_.groups;
    if (groups.empty() && places(question_, kClass)) groups = detected_names(summary_.table);
    if (question_.groups.empty()) groups.emplace_back(kPooled);
    Dimension dimension{kClass, {kClass}, {}};
    for (const std::string& group : groups)
      add_value(dimension, group,
                reader_ == Reader::paper ? class_title(summary_.study, group) : group);
    dimensions_.push_back(std::move(dimension));
  }

  void add_metrics() {
    std::vector<std::string> metrics = question_.metrics;
    if (metrics.empty())
      metrics =
          places(question_, kMetric) ? Texts{"precision", "recall", "f1", "iou"} : Texts{"f1"};
    Dimension dimension{kMetric, {kMetric}, {}};
    for (const std::string& metric : metrics) {
      for (const Value& group : dimensions_.back().values)
        if (!is_accounting(metric)) check_metric(summary_, group.name, metric);
      add_value(dimension, metric, metric_text(metric, reader_));
    }
    dimensions_.push_back(std::move(dimension));
  }

  [[nodiscard]] static bool is_accounting(const std::string& metric) {
    static const std::vector<std::string> names = accounting_names();
    return std::ranges::count(names, metric) > 0;
  }

  static void add_value(Dimension& dimension, const std::string& name, const std::string& text) {
    if (std::ranges::count(dimension.values, name, &Value::name) > 0)
      throw Error(fmt::format("{} '{}' is given twice; once is enough", dimension.name, name));
    dimension.values.push_back({name, {text}, text});
  }

  /// Positions of dimensions, none of which has a place yet.
  std::vector<std::size_t> named(const std::vector<std::string>& names) {
    std::vector<std::size_t> positions;
    for (const std::string& name : names) {
      const auto axis = swept_axis(summary_.study, name);
      const std::string whole = axis ? summary_.study.sweep[*axis].path : name;
      const auto found = std::ranges::find(dimensions_, whole, &Dimension::name);
      if (found == dimensions_.end()) {
        if (axis)
          throw Error(name +
                      ": points over ranges share no values; ask for `point`, all paths "
                      "together, or for --tidy");
        std::vector<std::string> known = swept_names(summary_.study);
        for (const Dimension& dimension : dimensions_) known.push_back(dimension.name);
        throw Error(fmt::format("'{}': neither a swept path nor method, class or metric; {}", name,
                                suggestion(name, known)));
      }
      positions.push_back(static_cast<std::size_t>(found - dimensions_.begin()));
      if (!placed_.insert(positions.back()).second)
        throw Error(fmt::format("{}: has two places in the table; keep one", whole));
    }
    return positions;
  }

  void place_the_others() {
    auto& place = rows_.empty() ? rows_ : columns_;
    const std::size_t metric = dimensions_.size() - 1;
    if (columns_.empty() && rows_.empty()) {
      columns_.push_back(metric);
      placed_.insert(metric);
    }
    const bool may_place = place.empty();
    for (std::size_t d = 0; d < dimensions_.size(); ++d) {
      if (dimensions_[d].values.size() < 2 || placed_.contains(d)) continue;
      if (!may_place)
        throw Error(
            fmt::format("{0} has {1} values and no place in the table; add it to --rows or "
                        "--columns, or choose one by {2}",
                        dimensions_[d].name, dimensions_[d].values.size(),
                        d + 3 < dimensions_.size() ? "--where" : "--" + dimensions_[d].name));
      place.push_back(d);
      placed_.insert(d);
    }
    if (!place.empty()) return;
    place.push_back(placed_.contains(metric) ? metric - 2 : metric);  // else the method
    placed_.insert(place.back());
  }

  /// Of their values, the last dimension fastest.
  [[nodiscard]] std::vector<Place> combinations(const std::vector<std::size_t>& of) const {
    std::vector<Place> all{{}};
    for (const std::size_t d : of) {
      std::vector<Place> longer;
      for (const Place& place : all)
        for (std::size_t v = 0; v < dimensions_[d].values.size(); ++v) {
          longer.push_back(place);
          longer.back()[d] = v;
        }
      all = std::move(longer);
    }
    return all;
  }

  [[nodiscard]] bool with_spread() const { return question_.spread || reader_ == Reader::program; }

  void add_heads(const Place& column, std::vector<std::string>& heads) const {
    std::vector<std::string> parts;
    for (const std::size_t d : columns_)
      parts.push_back(dimensions_[d].values[column.at(d)].in_column);
    heads.push_back(fmt::format("{}", fmt::join(parts, ", ")));
    if (!with_spread()) return;
    const std::string head = heads.back();
    heads.insert(heads.end(), {head + " low", head + " high"});
  }

  void add_cells(const Place& row, const Place& column, std::vector<std::string>& cells,
                 std::set<std::string>& kinds) const {
    const auto value = [&](std::size_t d) -> const Value& {
      const auto in_row = row.find(d), in_column = column.find(d);
      const std::size_t v = in_row != row.end()         ? in_row->second
                            : in_column != column.end() ? in_column->second
                                                        : 0;
      return dimensions_[d].values[v];
    };
    const std::size_t axes = dimensions_.size() - 3;
    Doses doses;
    for (std::size_t d = 0; d < axes; ++d)
      doses.insert(doses.end(), value(d).doses.begin(), value(d).doses.end());
    const auto line = lines_.find({value(axes).name, doses});
    const std::string& metric = value(axes + 2).name;
    const bool count = is_accounting(metric);
    Estimate figure;
    if (line != lines_.end())
      figure = count ? accounting_estimate(*line->second, metric)
                     : estimate(*line->second, summary_.table, value(axes + 1).name, metric);
    const auto text = [&](const std::optional<double>& number) {
      if (reader_ == Reader::program) return nine_digits(number);
      return count ? cell_text(number, "{:.6g}") : cell_text(number);
    };
    cells.push_back(text(figure.pooled));
    if (figure.over_seeds.kind != SpreadKind::none) kinds.insert(name_of(figure.over_seeds.kind));
    if (with_spread())
      cells.insert(cells.end(), {text(figure.over_seeds.low), text(figure.over_seeds.high)});
  }

  [[nodiscard]] std::vector<std::string> caption() const {
    const Study& study = summary_.study;
    std::vector<std::string> fixed, lines;
    for (std::size_t d = 0; d < dimensions_.size(); ++d)
      if (!placed_.contains(d))
        fixed.push_back(fmt::format("{} {}", fmt::join(dimensions_[d].titles, ", "),
                                    fmt::join(dimensions_[d].values.front().in_row, ", ")));
    if (!summary_.interim.empty()) lines.push_back(summary_.interim);
    lines.push_back(
        fmt::format("{}{}{}", study.name, fixed.empty() ? "" : ": ", fmt::join(fixed, ", ")));
    lines.push_back(scoring_text(study) + "; counts pooled over seeds");
    for (const std::size_t d : columns_)
      if (d + 3 < dimensions_.size())
        lines.push_back(fmt::format("columns: {}", fmt::join(dimensions_[d].titles, ", ")));
    if (with_spread())
      lines.push_back(study.seeds < kSeedsForInterval
                          ? "low, high: least and greatest of the seeds"
                          : "low, high: 95 % interval of the mean over the seeds");
    if (const std::string note = summary_.lattice_note(); !note.empty())
      lines.push_back("note: " + note);
    std::ranges::copy(accounting_notes(summary_), std::back_inserter(lines));
    return lines;
  }

  const StudySummary& summary_;
  const PivotQuestion& question_;
  Reader reader_;
  std::vector<Dimension> dimensions_;  ///< swept paths, then method, class, metric
  std::vector<std::size_t> rows_, columns_;
  std::set<std::size_t> placed_;
  std::map<std::pair<std::string, Doses>, const ResultLine*> lines_;
};

}  // namespace

bool places(const PivotQuestion& question, const std::string& dimension) {
  return std::ranges::count(question.rows, dimension) +
             std::ranges::count(question.columns, dimension) >
         0;
}

Table pivot_table(const StudySummary& summary, const PivotQuestion& question, Reader reader) {
  return Pivot(summary, question, reader).table();
}

}  // namespace mapscore::eval
