// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/strand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

namespace mapscore::eval {
namespace {

/// They hold all free space too, and are many times as large.
constexpr std::size_t kCarvingTrialsOfAStrand = 4;

}  // namespace

std::vector<Strand> strands_of(const TaskList& tasks, const std::vector<std::size_t>& missing,
                               std::size_t most) {
  std::map<std::string, std::size_t> kinds;     // of sights
  std::map<const Study*, std::size_t> kind_of;  // a configuration serves all seeds
  std::map<std::pair<int, std::size_t>, std::size_t> open;
  std::vector<std::vector<std::size_t>> strands;
  for (const std::size_t position : missing) {
    const Study& config = tasks.config(position);
    const auto [entry, is_new] = kind_of.try_emplace(&config);
    if (is_new)
      entry->second = kinds
                          .try_emplace(fmt::format("{} {}", config.voxel_m,
                                                   Sights::key(config, tasks.labels(position))),
                                       kinds.size())
                          .first->second;
    const std::pair key(tasks.seed_index(position), entry->second);
    const auto strand = open.find(key);
    const std::size_t fitting =
        config.occupancy.carve ? std::min(most, kCarvingTrialsOfAStrand) : most;
    if (strand != open.end() && strands[strand->second].size() < fitting) {
      strands[strand->second].push_back(position);
    } else {
      open[key] = strands.size();
      strands.push_back({position});
    }
  }
  return {strands.begin(), strands.end()};
}

}  // namespace mapscore::eval
