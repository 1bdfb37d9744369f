// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/regression_report.hpp"

#include "core/error.hpp"
#include "eval/report/tables/table_formats.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace mapscore::eval {
namespace {

constexpr std::size_t kShownRows = 40;
constexpr std::size_t kHandful = 5;  ///< rows that need no summary by class

std::string method_of(const JudgedFigure& figure) {
  if (figure.role == Role::lattice_ceiling) return "lattice ceiling";
  return figure.method + (figure.role == Role::registration_ceiling ? " (ceiling)" : "");
}

std::string doses_text(const Cell& cell) {
  std::string text;
  for (const auto& [path, value] : cell.doses)
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
    const SeedSummary& difference = most.difference;
    table.rows.push_back({name_of(most.verdict), method_of(most), most.metric, most.group,
                          fmt::format("{} of {}", cells, group.size()), doses_text(most.cell),
                          cell_text(most.before, "{:.4f}"), cell_text(most.after, "{:.4f}"),
                          change_of(most, "{:+.4f}"), cell_text(difference.low, "{:+.4f}"),
                          cell_text(difference.high, "{:+.4f}"), fmt::format("{}", most.allowed),
                          fallen ? causes_of(most) : "-"});
  }
  return table;
}

/// Of each class how much of it got worse, and its worst figure; the worst class first.
Table class_table(const std::vector<Group>& groups) {
  struct Fallen {
    const JudgedFigure* worst;
    std::size_t figures, of;
    std::set<std::vector<std::pair<std::string, std::string>>> cells, all_cells;
  };
  std::vector<std::pair<std::string, Fallen>> classes;
  for (const Group& group : groups) {
    auto place = std::ranges::find(classes, group.front()->group, [](auto& c) { return c.first; });
    if (place == classes.end())
      place = classes.insert(place, {group.front()->group, {group.front(), 0, 0, {}, {}}});
    for (const JudgedFigure* figure : group) {
      ++place->second.of;
      place->second.all_cells.insert(figure->cell.doses);
      if (!is_fallen(*figure)) continue;
      ++place->second.figures;
      place->second.cells.insert(figure->cell.doses);
    }
  }
  Table table;
  table.columns = {"class",  "figures worse", "cells worse", "worst change",
                   "metric", "method",        "worst at"};
  for (const auto& [name, fallen] : classes)
    if (fallen.figures > 0)
      table.rows.push_back({name, fmt::format("{} of {}", fallen.figures, fallen.of),
                            fmt::format("{} of {}", fallen.cells.size(), fallen.all_cells.size()),
                            change_of(*fallen.worst, "{:+.4f}"), fallen.worst->metric,
                            method_of(*fallen.worst), doses_text(fallen.worst->cell)});
  return table;
}

Table all_figures(const Judgement& judgement) {
  Table table;
  table.columns = {"role", "method", "cell",   "class", "metric",  "before",  "after", "change",
                   "low",  "high",   "spread", "pairs", "allowed", "verdict", "grown"};
  for (const JudgedFigure& figure : judgement.figures) {
    const SeedSummary& difference = figure.difference;
    table.rows.push_back(
        {name_of(figure.role), figure.method, doses_text(figure.cell), figure.group, figure.metric,
         nine_digits(figure.before), nine_digits(figure.after), change_of(figure, "{:.9g}"),
         nine_digits(difference.low), nine_digits(difference.high), name_of(difference.kind),
         std::to_string(difference.seeds), fmt::format("{}", figure.allowed),
         name_of(figure.verdict), causes_of(figure)});
  }
  return table;
}

/// Which frames lost most; empty where none were traced.
std::string frames_text(const Judgement& judgement) {
  constexpr std::size_t kFrames = 3;
  if (!judgement.trace) return "";
  const auto& [method, cell, group, losses] = *judgement.trace;
  const std::string of =
      fmt::format("{} of {}, first seed, at {}", group, method, doses_text(cell));
  if (losses.empty())
    return fmt::format("no frame by itself lost voxels ({}): it lies in how frames are fused", of);
  std::string text = fmt::format("frames that lost most by themselves ({}): ", of);
  for (std::size_t n = 0; n < std::min(losses.size(), kFrames); ++n)
    text += fmt::format("{}frame {} found {} -> {}, false {} -> {}", n > 0 ? "; " : "",
                        losses[n].frame, losses[n].before.found, losses[n].after.found,
                        losses[n].before.falses, losses[n].after.falses);
  return text + fmt::format("; {} frames lost some", losses.size());
}

std::string conclusion(const Judgement& judgement, const std::string& results) {
  const std::size_t fallen = judgement.count(Standing::worse) + judgement.count(Standing::missing);
  const std::size_t unjudged = judgement.count(Standing::not_judged);
  const std::size_t better = judgement.count(Standing::better);
  std::string text = fmt::format("mapscore check {}: ", shown(results));
  if (!judgement.compared())
    text += "nothing could be compared";
  else if (fallen > 0)
    text += fmt::format("{} of {} figures got worse", fallen, judgement.figures.size());
  else if (unjudged > 0)
    text += fmt::format("{} of {} figures hold", judgement.figures.size() - unjudged,
                        judgement.figures.size());
  else
    text += fmt::format("all {} figures hold", judgement.figures.size());
  if (judgement.compared() && unjudged > 0) text += fmt::format(", {} not judged", unjudged);
  if (better > 0) text += fmt::format(", {} better", better);
  if (judgement.seeds < judgement.seeds_before)
    text += fmt::format("; {} of the baseline's {} seeds", judgement.seeds, judgement.seeds_before);
  if (!judgement.same_recording) text += "; another recording";
  return text + (judgement.same_seeds ? fmt::format("; changed: {} of {} trials", judgement.changed,
                                                    judgement.trials)
                                      : "; changed: not told, other seeds");
}

std::string text_report(const Judgement& judgement, const std::string& results,
                        std::string (*to)(const Table&)) {
  const std::vector<Group> groups = groups_of(judgement);
  std::string text;
  for (const bool fallen : {true, false}) {
    Table table = group_table(groups, fallen);
    if (table.rows.empty()) continue;
    if (fallen && table.rows.size() > kHandful) text += to(class_table(groups)) + '\n';
    const std::size_t more = table.rows.size() - std::min(table.rows.size(), kShownRows);
    table.rows.resize(table.rows.size() - more);
    text += to(table);
    if (more > 0) text += fmt::format("and {} rows more; --format csv has all figures\n", more);
    text += '\n';
  }
  if (judgement.trace) text += shown(frames_text(judgement)) + "\n\n";
  return text + conclusion(judgement, results) + '\n';
}

std::string sentence_of(const Group& group) {
  const JudgedFigure& worst = *group.front();
  const std::string what = fmt::format("{} of {}, {}", worst.metric, method_of(worst), worst.group);
  if (!worst.after) return what + ": missing at " + doses_text(worst.cell);
  return fmt::format("{}: {:.4f} -> {:.4f} ({:+.4f}, allowed {}) at {}; grown: {}", what,
                     *worst.before, *worst.after, *worst.after - *worst.before, worst.allowed,
                     doses_text(worst.cell), causes_of(worst));
}

/// In the form that Surefire's schema and Jenkins' ask for (tests/gate/formats.py).
std::string junit_report(const Judgement& judgement, const std::string& results) {
  std::string cases;
  std::size_t failures = 0, skipped = 0;
  const std::vector<Group> groups = groups_of(judgement);
  for (const Group& group : groups) {
    const JudgedFigure& worst = *group.front();
    cases +=
        fmt::format("  <testcase classname={} name={} time=\"0\"", xml_quoted(method_of(worst)),
                    xml_quoted(worst.metric + " " + worst.group));
    if (is_fallen(worst)) {
      ++failures;
      cases += fmt::format("><failure type=\"{}\" message={}/></testcase>\n",
                           name_of(worst.verdict), xml_quoted(sentence_of(group)));
    } else if (worst.verdict == Standing::not_judged) {
      ++skipped;
      cases += "><skipped message=\"other seeds, and too few of them\"/></testcase>\n";
    } else {
      cases += "/>\n";
    }
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name={} tests=\"{}\" "
      "failures=\"{}\" errors=\"0\" skipped=\"{}\" time=\"0\">\n  <properties>"
      "<property name=\"conclusion\" value={}/><property name=\"frames\" value={}/></properties>\n"
      "{}</testsuite>\n",
      xml_quoted("mapscore check " + results), groups.size(), failures, skipped,
      xml_quoted(conclusion(judgement, results)), xml_quoted(frames_text(judgement)), cases);
}

/// Text of a workflow command: one line, in which % starts an escape.
std::string github_text(const std::string& text) {
  std::string escaped;
  for (const char letter : shown(text)) escaped += letter == '%' ? "%25" : std::string(1, letter);
  return escaped;
}

std::string github_command(const char* command, const std::string& text) {
  return fmt::format("::{} title=mapscore check::{}\n", command, github_text(text));
}

std::string github_report(const Judgement& judgement, const std::string& results) {
  std::string text;
  const std::vector<Group> groups = groups_of(judgement);
  for (const Group& group : groups)
    if (is_fallen(*group.front())) text += github_command("error", sentence_of(group));
  if (judgement.trace) text += github_command("error", frames_text(judgement));
  for (const auto& row : group_table(groups, false).rows)
    text += github_command("notice", fmt::format("{} of {}, {}: {} -> {} at {}", row[2], row[1],
                                                 row[3], row[6], row[7], row[5]));
  return text + conclusion(judgement, results) + '\n';
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

std::string refusal_report(const std::string& reason, const std::string& results,
                           const std::string& format) {
  if (format == "github") return github_command("error", reason);
  if (format != "junit") return "";
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name={} tests=\"1\" failures=\"0\" "
      "errors=\"1\" skipped=\"0\" time=\"0\">\n  <testcase classname=\"check\" name=\"comparable\" "
      "time=\"0\"><error type=\"refused\" message={}/></testcase>\n</testsuite>\n",
      xml_quoted("mapscore check " + results), xml_quoted(reason));
}

}  // namespace mapscore::eval
