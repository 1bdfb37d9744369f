// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/regression_report.hpp"

#include "core/error.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace mapscore::eval {
namespace {

constexpr std::size_t kShownRows = 40;

std::string method_of(const JudgedFigure& figure) {
  if (figure.role == Role::lattice_ceiling) return "lattice ceiling";
  return figure.method + (figure.role == Role::registration_ceiling ? " (ceiling)" : "");
}

std::string cell_of(const JudgedFigure& figure) {
  std::string text;
  for (const auto& [path, value] : figure.cell.doses)
    text += (text.empty() ? "" : ", ") + path.substr(path.rfind('.') + 1) + '=' + value;
  return text.empty() ? "-" : text;
}

std::string change_of(const JudgedFigure& figure, std::string_view format) {
  return figure.after ? fmt::format(fmt::runtime(format), *figure.after - *figure.before) : "-";
}

std::string causes_of(const JudgedFigure& figure) {
  std::string text;
  for (const auto& [cause, growth] : figure.grown)
    text += fmt::format("{}{} +{}", text.empty() ? "" : ", ", cause, growth);
  return text.empty() ? "-" : text;
}

/// The figures of a method, metric and class at all cells, worst first.
using Group = std::vector<const JudgedFigure*>;

/// In the order of their worst figures; without registration ceilings that are a trial at dose 0.
std::vector<Group> groups_of(const Judgement& judgement) {
  using Figure = std::tuple<std::string, std::string, std::string, std::optional<double>,
                            std::optional<double>>;
  const auto figure_of = [](const JudgedFigure& f) {
    return Figure{f.method, f.metric, f.group, f.before, f.after};
  };
  std::set<Figure> of_trials;
  for (const JudgedFigure& figure : judgement.figures)
    if (figure.role == Role::trial) of_trials.insert(figure_of(figure));
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> places;
  std::vector<Group> groups;
  for (const JudgedFigure& figure : judgement.figures) {
    if (figure.role == Role::registration_ceiling && of_trials.contains(figure_of(figure)))
      continue;
    const auto place =
        places.try_emplace({method_of(figure), figure.metric, figure.group}, groups.size());
    if (place.second) groups.emplace_back();
    groups[place.first->second].push_back(&figure);
  }
  return groups;
}

bool is_fallen(const JudgedFigure& figure) {
  return figure.verdict == Standing::worse || figure.verdict == Standing::missing;
}

Table group_table(const std::vector<Group>& groups, bool fallen) {
  Table table;
  table.columns = {"verdict", "method", "metric", "class", "cells",   "worst at", "before",
                   "after",   "change", "low",    "high",  "allowed", "grown"};
  if (!fallen) table.columns[5] = "best at";
  for (const Group& group : groups) {
    const auto counts = [&](const JudgedFigure* figure) {
      return fallen ? is_fallen(*figure) : figure->verdict == Standing::better;
    };
    const auto cells = std::ranges::count_if(group, counts);
    if (cells == 0) continue;
    const JudgedFigure& most =
        fallen ? *group.front()
               : **std::ranges::max_element(group, {}, [&](const JudgedFigure* figure) {
                   return counts(figure) ? figure->gain().value() : -1.0;
                 });
    const SeedSummary& difference = most.paired.difference;
    table.rows.push_back({name_of(most.verdict), method_of(most), most.metric, most.group,
                          fmt::format("{} of {}", cells, group.size()), cell_of(most),
                          cell_text(most.before, "{:.4f}"), cell_text(most.after, "{:.4f}"),
                          change_of(most, "{:+.4f}"), cell_text(difference.low, "{:+.4f}"),
                          cell_text(difference.high, "{:+.4f}"), fmt::format("{}", most.allowed),
                          fallen ? causes_of(most) : "-"});
  }
  return table;
}

Table all_figures(const Judgement& judgement) {
  Table table;
  table.columns = {"role", "method", "cell",   "class", "metric",  "before",  "after", "change",
                   "low",  "high",   "spread", "pairs", "allowed", "verdict", "grown"};
  for (const JudgedFigure& figure : judgement.figures) {
    const SeedSummary& difference = figure.paired.difference;
    table.rows.push_back({name_of(figure.role), figure.method, cell_of(figure), figure.group,
                          figure.metric, nine_digits(figure.before), nine_digits(figure.after),
                          change_of(figure, "{:.9g}"), nine_digits(difference.low),
                          nine_digits(difference.high), name_of(difference.kind),
                          std::to_string(difference.seeds), fmt::format("{}", figure.allowed),
                          name_of(figure.verdict), causes_of(figure)});
  }
  return table;
}

std::string conclusion(const Judgement& judgement, const std::string& results) {
  const std::size_t fallen = judgement.count(Standing::worse) + judgement.count(Standing::missing);
  const std::string changed =
      judgement.same_seeds
          ? fmt::format("changed: {} of {} trials", judgement.changed, judgement.trials)
          : "changed: not told, other seeds";
  const std::string figures =
      !judgement.compared() ? "nothing could be compared"
      : fallen == 0         ? fmt::format("all {} figures hold", judgement.figures.size())
                    : fmt::format("{} of {} figures got worse", fallen, judgement.figures.size());
  const std::size_t better = judgement.count(Standing::better);
  return fmt::format("{}: {}{}{}; {}\n", shown(results), figures,
                     better > 0 ? fmt::format(", {} better", better) : "",
                     judgement.same_recording ? "" : "; another recording", changed);
}

std::string text_report(const Judgement& judgement, const std::string& results,
                        std::string (*to)(const Table&)) {
  const std::vector<Group> groups = groups_of(judgement);
  std::string text;
  for (const bool fallen : {true, false}) {
    Table table = group_table(groups, fallen);
    if (table.rows.empty()) continue;
    const std::size_t more = table.rows.size() - std::min(table.rows.size(), kShownRows);
    table.rows.resize(table.rows.size() - more);
    text += to(table);
    if (more > 0) text += fmt::format("and {} rows more; --format csv has all figures\n", more);
    text += '\n';
  }
  return text + conclusion(judgement, results);
}

std::string sentence_of(const Group& group) {
  const JudgedFigure& worst = *group.front();
  const std::string what = fmt::format("{} of {}, {}", worst.metric, method_of(worst), worst.group);
  if (!worst.after) return what + ": missing at " + cell_of(worst);
  return fmt::format("{}: {:.4f} -> {:.4f} ({:+.4f}, allowed {}) at {}; grown: {}", what,
                     *worst.before, *worst.after, *worst.after - *worst.before, worst.allowed,
                     cell_of(worst), causes_of(worst));
}

std::string junit_report(const Judgement& judgement, const std::string& results) {
  std::string cases;
  std::size_t failures = 0;
  const std::vector<Group> groups = groups_of(judgement);
  for (const Group& group : groups) {
    const JudgedFigure& worst = *group.front();
    cases += fmt::format("  <testcase classname={} name={}", xml_quoted(method_of(worst)),
                         xml_quoted(worst.metric + " " + worst.group));
    if (is_fallen(worst)) {
      ++failures;
      cases += fmt::format("><failure message={}/></testcase>\n", xml_quoted(sentence_of(group)));
    } else {
      cases += worst.verdict == Standing::not_judged ? "><skipped/></testcase>\n" : "/>\n";
    }
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name={} tests=\"{}\" "
      "failures=\"{}\">\n{}</testsuite>\n",
      xml_quoted("mapscore check " + results), groups.size(), failures, cases);
}

/// Text of a workflow command: one line, in which % starts an escape.
std::string github_text(const std::string& text) {
  std::string escaped;
  for (const char letter : shown(text)) escaped += letter == '%' ? "%25" : std::string(1, letter);
  return escaped;
}

std::string github_report(const Judgement& judgement, const std::string& results) {
  std::string text;
  for (const Group& group : groups_of(judgement))
    if (is_fallen(*group.front()))
      text += "::error title=mapscore check::" + github_text(sentence_of(group)) + '\n';
  for (const auto& row : group_table(groups_of(judgement), false).rows)
    text += "::notice title=mapscore check::" +
            github_text(fmt::format("{} of {}, {}: {} -> {} at {}", row[2], row[1], row[3], row[6],
                                    row[7], row[5])) +
            '\n';
  return text + conclusion(judgement, results);
}

}  // namespace

std::string regression_report(const Judgement& judgement, const std::string& results,
                              const std::string& format) {
  if (format == "text") return text_report(judgement, results, to_text);
  if (format == "markdown") return text_report(judgement, results, to_markdown);
  if (format == "csv") return to_csv(all_figures(judgement));
  if (format == "json") return to_json(all_figures(judgement));
  if (format == "junit") return junit_report(judgement, results);
  if (format == "github") return github_report(judgement, results);
  throw Error("no format '" + format + "' of a check");
}

}  // namespace mapscore::eval
