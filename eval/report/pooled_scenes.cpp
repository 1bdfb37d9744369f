// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pooled_scenes.hpp"

#include "eval/report/line_digest.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace mapscore::eval {
namespace {

using Doses = decltype(Cell::doses);

/// The line of one seed each that all parts have, each the sum of theirs.
ResultLine sum_of(std::vector<ResultLine> parts, Doses doses, const ClassTable& table,
                  const std::vector<std::string>& groups) {
  ResultLine line{parts.front().role, parts.front().method, {0, std::move(doses)}, {}, {}, {}};
  for (const int seed : parts.front().seeds)
    if (std::ranges::all_of(parts, [&](const ResultLine& part) {
          return std::ranges::count(part.seeds, seed) > 0;
        }))
      line.seeds.push_back(seed);
  line.in_store = [parts = std::move(parts), seeds = line.seeds](std::size_t n) {
    TrialResult sum;
    for (const ResultLine& part : parts) {
      const auto place = std::ranges::find(part.seeds, seeds.at(n)) - part.seeds.begin();
      const TrialResult result = part.in_store(static_cast<std::size_t>(place));
      pool_into(sum.counts, result.counts);
      sum.accounting += result.accounting;
    }
    return sum;
  };
  line.digest = std::make_shared<const LineDigest>(line, table, groups);
  line.pooled.clear();
  return line;
}

/// Adds the sums of as many scenes to lines of one role. What not every scene has there stays
/// without one: it would look like that of all.
void add_sums(const StudySummary& summary, std::size_t scenes,
              const std::vector<std::string>& groups, std::vector<ResultLine>& lines) {
  std::map<std::pair<Doses, std::string>, std::vector<ResultLine>> parts;
  for (const ResultLine& line : lines) {
    Doses doses = line.cell.doses;
    for (auto& [path, value] : doses)
      if (path == kSceneAxis) value = kAllScenes;
    parts[{std::move(doses), line.method}].push_back(line);
  }
  for (auto& [place, of] : parts) {
    if (of.size() < scenes) continue;
    ResultLine sum = sum_of(std::move(of), place.first, summary.table, groups);
    if (!sum.seeds.empty()) lines.push_back(std::move(sum));
  }
}

/// In the order of the grid, whose cells are counted anew.
void sort_lines(const Study& study, std::vector<ResultLine>& lines) {
  std::map<Doses, int> index;
  for (const Cell& cell : cells(study)) index[cell.doses] = cell.index;
  const std::vector<std::string> methods = method_names(study);
  for (ResultLine& line : lines) line.cell.index = index.at(line.cell.doses);
  std::ranges::stable_sort(lines, {}, [&](const ResultLine& line) {
    return std::pair(line.cell.index, std::ranges::find(methods, line.method) - methods.begin());
  });
}

}  // namespace

void add_pooled_scenes(StudySummary& summary, const std::vector<std::string>& groups) {
  const auto axis = std::ranges::find(summary.study.sweep, kSceneAxis, &SweepAxis::path);
  if (summary.study.scenes.empty() || axis->values.size() < 2) return;
  const std::size_t scenes = axis->values.size();
  axis->values.emplace_back(kAllScenes);
  for (auto* lines : {&summary.trials, &summary.registration_ceilings, &summary.lattice_ceilings}) {
    add_sums(summary, scenes, groups, *lines);
    sort_lines(summary.study, *lines);
  }
}

}  // namespace mapscore::eval
