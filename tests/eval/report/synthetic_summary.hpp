// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/summary.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace mapscore::eval::testing {

/// Classes: 1 cup and 2 chair are detected, 3 wall is not.
inline ClassTable synthetic_table() {
  ClassTable table;
  table.classes.push_back({1, "cup", {255, 0, 0}, true});
  table.classes.push_back({2, "chair", {0, 0, 255}, true});
  table.classes.push_back({3, "wall", {200, 200, 200}, false});
  return table;
}

inline Study synthetic_study(std::vector<std::string> methods, std::vector<SweepAxis> sweep,
                             int seeds) {
  Study study;
  study.name = "synthetic";
  study.scene = "room.xml";
  study.seeds = seeds;
  for (std::string& name : methods) study.methods.push_back({std::move(name), Direct{}, {}});
  study.sweep = std::move(sweep);
  return study;
}

/// All that is right has a probability of 0.9, what is wrong 0.5.
inline ClassCurve synthetic_curve(const ClassCounts& c) {
  const std::int64_t false_count = c.predicted - c.true_predicted;
  ClassCurve curve{c.visible, 10'000'000 * c.true_predicted + 250'000'000 * false_count, {}};
  curve.steps.push_back(
      {900, c.true_predicted, c.true_predicted, c.found, 900'000'000 * c.true_predicted});
  if (false_count > 0) curve.steps.push_back({500, false_count, 0, 0, 500'000'000 * false_count});
  return curve;
}

/// 100 predicted and 200 visible voxels, `false_share` of the former false, `missed` of the latter
/// missed; the causes take a half, a quarter and the rest.
inline ClassCounts synthetic_counts(double false_share, double missed_share) {
  ClassCounts c;
  c.predicted = 100;
  c.visible = 200;
  const auto false_count = static_cast<std::int64_t>(100 * false_share + 0.5);
  const auto missed_count = static_cast<std::int64_t>(200 * missed_share + 0.5);
  c.true_predicted = c.predicted - false_count;
  c.found = c.visible - missed_count;
  c.false_near = false_count / 2;
  c.false_leak = false_count / 4;
  c.false_floating = false_count - c.false_near - c.false_leak;
  c.missed_mislabelled = missed_count / 2;
  c.missed_unlabelled = missed_count / 4;
  c.missed_unmapped = missed_count - c.missed_mislabelled - c.missed_unlabelled;
  c.curve = synthetic_curve(c);
  return c;
}

/// Both detected classes at each seed; chairs have 0.04 more of their voxels false, and miss 0.2,
/// cups 0.1.
template <class FalseShare>
ResultLine synthetic_line(Role role, const std::string& method, const Cell& cell, int seeds,
                          FalseShare false_share) {
  ResultLine line{role, method, cell, {}, {}, {}};
  for (int seed = 0; seed < seeds; ++seed) {
    Counts counts(4);
    counts[1] = synthetic_counts(false_share(seed), 0.1);
    counts[2] = synthetic_counts(false_share(seed) + 0.04, 0.2);
    line.seeds.push_back(seed);
    line.results.push_back({counts, {}});
    pool_into(line.pooled, counts);
  }
  return line;
}

/// Method m at cell c and seed s: a share of 0.02 (1 + 2 m + c) + 0.01 s of its predicted voxels is
/// false. Ceilings: registration 0.02 (1 + 2 m), lattice 0.
inline StudySummary synthetic_summary(Study study) {
  StudySummary summary{std::move(study), synthetic_table(), "recording", {"build"}, {}, {}, {}};
  for (const Cell& cell : cells(summary.study)) {
    for (std::size_t m = 0; m < summary.study.methods.size(); ++m) {
      const std::string& name = summary.study.methods[m].name;
      const double ceiling = 0.02 * (1.0 + 2.0 * static_cast<double>(m));
      const auto line = [&](Role role, auto false_share) {
        return synthetic_line(role, name, cell, summary.study.seeds, false_share);
      };
      summary.trials.push_back(
          line(Role::trial, [&](int seed) { return ceiling + 0.02 * cell.index + 0.01 * seed; }));
      summary.registration_ceilings.push_back(
          line(Role::registration_ceiling, [&](int) { return ceiling; }));
      summary.lattice_ceilings.push_back(line(Role::lattice_ceiling, [](int) { return 0.0; }));
    }
  }
  return summary;
}

/// Two methods at two doses.
inline StudySummary summary_of(int seeds) {
  return synthetic_summary(synthetic_study(
      {"direct", "erosion"}, {{"faults.misregistration.magnitude_m", {"0", "0.01"}}}, seeds));
}

}  // namespace mapscore::eval::testing
