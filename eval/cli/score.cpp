// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/map_file.hpp"
#include "eval/cli/options.hpp"
#include "eval/cli/truth_source.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/report/summary.hpp"
#include "eval/report/table.hpp"

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <set>

namespace mapscore::eval {
namespace {

struct ScoreFlags {
  std::string map, truth, format = "text";
  double threshold = 0.25;
  LatticeFlags lattice;
  WorkFlags work;
};

std::vector<std::string> row_of(const std::string& group, const Counts& counts,
                                const ClassTable& table) {
  const std::vector<Metric> metrics = metrics_of_group(counts, table, group);
  std::vector<std::string> row{group};
  for (const char* name : {"precision", "recall", "f1", "iou", "f1_t1", "f_2cm"}) {
    const auto value = metrics.empty() ? std::nullopt : value_of(metrics, name);
    row.push_back(value ? fmt::format("{:.3f}", *value) : "-");
  }
  return row;
}

std::vector<std::string> counts_of(const ClassCounts& c) {
  std::vector<std::string> cells;
  for (const std::int64_t count :
       {c.predicted, c.true_predicted, c.false_near, c.false_leak, c.false_floating, c.visible,
        c.found, c.missed_mislabelled, c.missed_unlabelled, c.missed_unmapped})
    cells.push_back(std::to_string(count));
  return cells;
}

std::vector<ClassId> classes_of(const MapSnapshot& map) {
  std::set<ClassId> classes;
  for (const MapVoxel& voxel : map.voxels()) classes.insert(voxel.best_class);
  return {classes.begin(), classes.end()};
}

void score(const ScoreFlags& flags) {
  if (std::filesystem::path(flags.truth).extension() == ".xml")
    throw Error(flags.truth + ": a scene says what is there, not what was seen; give a recording");
  const MapSnapshot map(
      read_map(flags.map, flags.lattice.voxel_m, Recording::open(flags.truth).info().table));
  const SourceTruth source = truth_of(flags.truth, flags.lattice, classes_of(map), flags.work.jobs,
                                      flags.work.memory_bytes);
  const Counts counts = source.truth.score(map, flags.threshold, source.truth.view(0),
                                           source.table.classes.size(), {});

  Table table;
  table.caption = {fmt::format("{} against {}", flags.map, flags.truth)};
  table.columns = {"class",     "precision", "recall",      "F1",         "IoU",     "F1 tol. 1",
                   "F at 2 cm", "predicted", "true",        "near",       "leak",    "floating",
                   "visible",   "found",     "mislabelled", "unlabelled", "unmapped"};
  for (const SemanticClass& c : source.table.classes) {
    const ClassCounts& of_class = counts[c.id];
    if (!c.detect && of_class.predicted == 0) continue;
    table.rows.push_back(row_of(c.name, counts, source.table));
    for (std::string& cell : counts_of(of_class)) table.rows.back().push_back(std::move(cell));
  }
  table.rows.push_back(row_of(std::string(kPooled), counts, source.table));
  for (std::string& cell : counts_of(pool_detected(counts, source.table)))
    table.rows.back().push_back(std::move(cell));
  std::cout << (flags.format == "csv"    ? to_csv(table)
                : flags.format == "json" ? to_json(table)
                                         : to_text(table));
}

}  // namespace

void add_score(CLI::App& program) {
  auto* verb = program.add_subcommand("score", "Score any map against the truth of a recording");
  const auto flags = std::make_shared<ScoreFlags>();
  verb->add_option("MAP", flags->map, ".ot of mapscore, or .csv of i,j,k,class")->required();
  verb->add_option("--truth", flags->truth, "Recording")->required();
  verb->add_option("--threshold", flags->threshold, "Least probability of a predicted voxel [0.25]")
      ->check(finite_within(0.0, 1.0));
  verb->add_option("--format", flags->format, "text, csv or json [text]")
      ->check(CLI::IsMember({"text", "csv", "json"}));
  flags->lattice.add_to(*verb, true);
  flags->work.add_to(*verb);
  verb->footer(
      "Examples:\n"
      "  mapscore score map.ot --truth /data/apartment\n"
      "  mapscore score other.csv --truth /data/apartment --voxel_m 0.05 --origin_m 0 0 0.02");
  verb->callback([flags] { score(*flags); });
}

}  // namespace mapscore::eval
