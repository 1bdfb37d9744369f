// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/lattice_votes.hpp"

#include <algorithm>
#include <span>
#include <tuple>

namespace mapscore::eval {
namespace {

/// The leading votes that `same` holds for, together with the first.
template <class Same>
std::span<const LatticeVote> run_of(std::span<const LatticeVote> votes, Same same) {
  std::size_t count = 1;
  while (count < votes.size() && same(votes[0], votes[count])) ++count;
  return votes.first(count);
}

/// Votes for the class with most of them; they come sorted by class.
std::span<const LatticeVote> winners_of(std::span<const LatticeVote> votes) {
  std::span<const LatticeVote> winners;
  while (!votes.empty()) {
    const auto of_class = run_of(
        votes, [](const LatticeVote& a, const LatticeVote& b) { return a.class_id == b.class_id; });
    if (of_class.size() > winners.size()) winners = of_class;
    votes = votes.subspan(of_class.size());
  }
  return winners;
}

std::uint32_t instance_of(std::span<const LatticeVote> winners) {
  std::vector<std::uint32_t> instances;
  for (const LatticeVote& vote : winners) instances.push_back(vote.instance);
  std::ranges::sort(instances);
  std::uint32_t best = 0;
  std::ptrdiff_t most = 0;
  for (auto from = instances.begin(); from != instances.end();) {
    const auto to = std::upper_bound(from, instances.end(), *from);
    if (to - from > most) {
      most = to - from;
      best = *from;
    }
    from = to;
  }
  return best;
}

MapVoxel voxel_of_winners(std::span<const LatticeVote> winners) {
  double sum = 0.0;
  for (const LatticeVote& vote : winners) sum += vote.probability;
  return {unpack(winners[0].packed_key), winners[0].class_id,
          sum / static_cast<double>(winners.size()), winners[0].occupied};
}

}  // namespace

LatticeMap count_votes(std::vector<LatticeVote> votes, bool has_instances) {
  std::ranges::sort(votes, {}, [](const LatticeVote& vote) {
    return std::tuple(vote.packed_key, !vote.occupied, vote.class_id, vote.number);
  });
  LatticeMap map;
  for (std::span<const LatticeVote> rest(votes); !rest.empty();) {
    const auto of_voxel = run_of(rest, [](const LatticeVote& a, const LatticeVote& b) {
      return a.packed_key == b.packed_key;
    });
    const auto counted = run_of(of_voxel, [](const LatticeVote& a, const LatticeVote& b) {
      return a.occupied == b.occupied;
    });
    const auto winners = winners_of(counted);
    map.voxels.push_back(voxel_of_winners(winners));
    if (has_instances) map.instances.push_back(instance_of(winners));
    rest = rest.subspan(of_voxel.size());
  }
  return map;
}

}  // namespace mapscore::eval
