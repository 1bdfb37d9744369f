// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/localize/localization_table.hpp"

#include <fmt/format.h>

#include <numbers>
#include <numeric>
#include <optional>

namespace mapscore::eval {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string nees_text(const std::optional<double>& nees) {
  return nees ? fmt::format("{:.5g}", *nees) : "";
}

std::string frame_row(const std::string& source, std::size_t seed, const FrameError& frame) {
  return fmt::format("{},{},{:.6f},{:.5f},{},{:.6f},{},{:.6f},{:.5f},{},{}\n", seed, frame.stamp_s,
                     frame.position_m, frame.heading_rad * kDegrees, nees_text(frame.nees),
                     frame.sigma_m, frame.converged ? 1 : 0, frame.distance_m,
                     frame.rotation_rad * kDegrees, nees_text(frame.spatial_nees), source);
}

std::string converged_row(const std::string& source, std::size_t seed,
                          const LocalizationScore& score) {
  if (!score.converged_s) return fmt::format("{:<16} {:>5} {:>11}\n", source, seed, "never");
  const std::string share = score.nees_share ? fmt::format("{:.3f}", *score.nees_share) : "-";
  return fmt::format("{:<16} {:>5} {:>11.2f} {:>9.4f} {:>9.4f} {:>10.3f} {:>10.3f} {:>10}\n",
                     source, seed, *score.converged_s, score.position_m.mean, score.position_m.p95,
                     score.heading_deg.mean, score.heading_deg.p95, share);
}

/// Nothing but poses.
TrialResult result_of(const LocalizationScore& score) {
  TrialResult result;
  result.counts = zero_counts(1, {.tolerances = {}, .distances_m = {}, .asked = {.poses = true}});
  result.counts[kBackground].poses = PoseCounts::of(score.all);
  result.accounting.frames = score.all.position.count;
  return result;
}

}  // namespace

std::string frame_errors_csv(std::span<const SourceScores> sources) {
  std::string csv =
      "seed,stamp_s,position_error_m,heading_error_deg,nees,sigma_m,converged,distance_m,"
      "rotation_deg,nees6,source\n";
  for (const SourceScores& of : sources)
    for (std::size_t seed = 0; seed < of.seeds.size(); ++seed)
      for (const FrameError& frame : of.seeds[seed].frames)
        csv += frame_row(of.source, seed, frame);
  return csv;
}

std::string scores_csv(std::span<const SourceScores> sources) {
  std::string csv = "source,seed,frames,pairs";
  for (const Metric& metric : pose_metrics({})) csv += ',' + metric.name;
  for (const SourceScores& of : sources)
    for (std::size_t seed = 0; seed < of.seeds.size(); ++seed) {
      const TrajectoryErrors& errors = of.seeds[seed].all;
      csv += fmt::format("\n{},{},{},{}", of.source, seed, errors.position.count,
                         errors.relative_position.count);
      for (const Metric& metric : pose_metrics(errors)) csv += ',' + cell_text(metric.value, "{}");
    }
  return csv + '\n';
}

std::string converged_rows(std::span<const SourceScores> sources) {
  std::string rows =
      fmt::format("{:<16} {:>5} {:>11} {:>9} {:>9} {:>10} {:>10} {:>10}\n", "source", "seed",
                  "converged_s", "mean_m", "p95_m", "mean_deg", "p95_deg", "nees_share");
  for (const SourceScores& of : sources)
    for (std::size_t seed = 0; seed < of.seeds.size(); ++seed)
      rows += converged_row(of.source, seed, of.seeds[seed]);
  return rows;
}

StudySummary pose_summary(const Study& study, std::span<const SourceScores> sources) {
  StudySummary summary{study, {}, "", {}, {}, {}, {}};
  summary.study.sweep = {{"localization.source", {}}};
  summary.table.classes.resize(1);
  summary.table.classes.front().detect = true;  // so that its group has metrics
  for (const SourceScores& of : sources) {
    SweepAxis& axis = summary.study.sweep.front();
    ResultLine line;
    line.method = study.methods.front().name;
    line.cell = {static_cast<int>(axis.values.size()), {{axis.path, of.source}}};
    for (const LocalizationScore& score : of.seeds) {
      line.seeds.push_back(static_cast<int>(line.seeds.size()));
      pool_into(line.pooled, line.results.emplace_back(result_of(score)).counts);
    }
    axis.values.push_back(of.source);
    summary.trials.push_back(line);
    summary.registration_ceilings.push_back(line);  // nobody draws them
    summary.lattice_ceilings.push_back(std::move(line));
  }
  return summary;
}

Table trajectory_scores_table(const StudySummary& summary) {
  Table table;
  table.caption = {
      "all frames, in space; of several seeds roots and means of all together "
      "(docs/metrics.md, \"Trajectories\")"};
  if (summary.study.seeds > 1)
    table.caption.push_back(summary.study.seeds < kSeedsForInterval
                                ? "ate_m low, high: least and greatest of the seeds"
                                : "ate_m low, high: 95 % interval of the mean of the seeds");
  table.columns = {"source", "frames", "pairs"};
  const std::vector<Metric> names = pose_metrics({});
  for (const Metric& metric : names) {
    table.columns.push_back(metric.name);
    if (metric.name == "ate_m") table.columns.insert(table.columns.end(), {"low", "high"});
  }
  for (const ResultLine& line : summary.trials) {
    const PoseCounts& counts = line.pooled[kBackground].poses.value();
    std::vector<std::string> row{line.cell.doses.front().second, std::to_string(counts.frames),
                                 std::to_string(counts.pairs)};
    for (const Metric& metric : names) {
      const Estimate of = estimate(line, summary.table, kPooled, metric.name);
      row.push_back(cell_text(of.pooled, "{:.4f}"));
      if (metric.name == "ate_m")
        row.insert(row.end(), {cell_text(of.over_seeds.low, "{:.4f}"),
                               cell_text(of.over_seeds.high, "{:.4f}")});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace mapscore::eval
