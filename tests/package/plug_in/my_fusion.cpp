// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// A fusion rule of one's own: counts the draws that each class won, times a weight.

#include <core/fusion/fusion_rule.hpp>

namespace {

using mapscore::ClassBeliefs, mapscore::ClassProbability, mapscore::VoxelHit;

struct WeightedVote {
  static constexpr std::string_view kKind = "weighted_vote";
  static constexpr std::string_view kMeaning = "the class that won most draws";
  double weight = 1;

  static void fields(auto& s, auto&& visit, auto&& draws) {
    draws();
    visit(s.weight, mapscore::Field{"weight", "of each draw", mapscore::above(0)});
  }

  void fuse(std::span<const VoxelHit> hits, int, ClassBeliefs& beliefs) const {
    for (const VoxelHit& hit : hits) beliefs.weight_of(hit.class_id) += weight * hit.draws;
  }
  ClassBeliefs merged(const ClassBeliefs& a, const ClassBeliefs& b) const {
    ClassBeliefs sum = a;
    for (const ClassProbability& entry : b.entries())
      sum.weight_of(entry.class_id) += entry.probability;
    return sum;
  }

  bool operator==(const WeightedVote&) const = default;
};

const mapscore::FusionPlugIn<WeightedVote> plug_in;

}  // namespace
