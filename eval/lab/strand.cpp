// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/strand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

namespace mapscore::eval {
namespace {

/// They hold all free space too, and are many times as large.
constexpr std::size_t kCarvingTrialsOfAStrand = 4;

/// The lattice of a trial, of those of one plan.
auto lattice_of(const TaskList& tasks, std::size_t position) {
  return std::pair(tasks.seed_index(position), tasks.config(position).voxel_m);
}

/// The strands of so many lattices at a time by turns; those of one stand together.
void take_turns(const TaskList& tasks, std::size_t lattices,
                std::vector<std::vector<std::size_t>>& strands) {
  std::vector<std::tuple<std::size_t, std::size_t, std::vector<std::size_t>>> turns;
  std::size_t lattice = 0, turn = 0;
  for (std::vector<std::size_t>& strand : strands) {
    if (!turns.empty()) {
      const bool same =
          lattice_of(tasks, strand.front()) == lattice_of(tasks, std::get<2>(turns.back()).front());
      turn = same ? turn + 1 : 0;
      lattice += same ? 0 : 1;
    }
    turns.emplace_back(lattice / lattices, turn, std::move(strand));
  }
  std::ranges::stable_sort(
      turns, {}, [](const auto& at) { return std::pair(std::get<0>(at), std::get<1>(at)); });
  for (std::size_t n = 0; n < strands.size(); ++n) strands[n] = std::move(std::get<2>(turns[n]));
}

}  // namespace

std::vector<Strand> strands_of(const TaskList& tasks, const std::vector<std::size_t>& missing,
                               std::size_t most, std::size_t lattices) {
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
  take_turns(tasks, lattices, strands);
  return {strands.begin(), strands.end()};
}

}  // namespace mapscore::eval
