// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/truth_size.hpp"

#include "eval/lab/map_frame.hpp"
#include "eval/lab/truth_cache.hpp"
#include "eval/study/grid.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace mapscore::eval {
namespace {

/// Memory that programs can have without others being swapped out, as Linux tells it; infinite on a
/// system that does not.
double available_bytes() {
  std::ifstream memory("/proc/meminfo");
  for (std::string word; memory >> word;)
    if (double kib = 0; word == "MemAvailable:" && memory >> kib) return 1024 * kib;
  return std::numeric_limits<double>::infinity();
}

}  // namespace

void add_yes_flag(CLI::App& verb, bool& yes) {
  verb.add_flag("--yes", yes, "Make a truth that takes much memory without asking");
}

void check_truth_size(const TruthCost& cost, double edge_m, bool yes) {
  if (!yes) refuse_too_large(cost, edge_m, available_bytes());
}

void check_truth_size(const Study& study, const Recording& recording, std::size_t trials,
                      bool yes) {
  Study finest = study;
  for (const Cell& cell : cells(study))
    if (const Study at = resolve(study, cell); at.voxel_m < finest.voxel_m || cell.index == 0)
      finest = at;
  const MapFrame frame = map_frame(finest, 0);
  TruthCost cost = truth_cost(shapes_of(recording).shapes, frame.T_map_world(),
                              {finest.voxel_m, finest.score.epsilon_m});
  const std::size_t lattices = study.map_origin_m ? 1 : static_cast<std::size_t>(study.seeds);
  cost.bytes *= static_cast<double>(std::min({lattices, trials, TruthCache::kLeastLattices}));
  check_truth_size(cost, finest.voxel_m, yes);
}

}  // namespace mapscore::eval
