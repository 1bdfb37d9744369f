// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/refinement/map_refinement.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

namespace mapscore {
namespace {

using Entries = std::vector<ClassProbability>;

/// Voxels in a row.
std::vector<VoxelKey> keys_in_row(std::size_t count) {
  std::vector<VoxelKey> keys;
  for (std::size_t i = 0; i < count; ++i) keys.push_back({static_cast<int>(i), 0, 0});
  return keys;
}

Crf smoothness_only() {
  Crf params;
  params.appearance_weight = 0;
  return params;
}

std::vector<ClassBeliefs> refined(const std::vector<ClassBeliefs>& beliefs, CrfRest rest) {
  Crf crf = smoothness_only();
  crf.rest = rest;
  return refine_beliefs(keys_in_row(beliefs.size()), 0.05, {}, beliefs, crf);
}

/// Class 3 all along, and one voxel in the middle of class 7, seen once.
std::vector<ClassBeliefs> one_wrong() {
  std::vector<ClassBeliefs> beliefs(7, ClassBeliefs(Entries{{3, 0.9}}));
  beliefs[3] = ClassBeliefs(Entries{{3, 0.1}, {7, 0.4}});
  return beliefs;
}

TEST(BeliefRefinement, WrongVoxelTakesItsNeighboursClassAndKeepsItsRest) {
  const auto after = refined(one_wrong(), CrfRest::apart);
  EXPECT_EQ(after[3].best().class_id, 3);
  EXPECT_NEAR(after[3].weight(3) + after[3].weight(7), 0.5, 1e-5);
  EXPECT_NEAR(after[0].weight(3), 0.9, 1e-2);
}

TEST(BeliefRefinement, AsALabelTheRestIsOutvotedAndOutvotesToo) {
  const auto after = refined(one_wrong(), CrfRest::label);
  EXPECT_EQ(after[3].best().class_id, 3);
  EXPECT_GT(after[3].weight(3) + after[3].weight(7), 0.52);  // 0.5 before
  std::vector<ClassBeliefs> alone(7);
  alone[3] = ClassBeliefs(Entries{{7, 0.6}});
  EXPECT_LT(refined(alone, CrfRest::label)[3].weight(7), 0.3);
  EXPECT_NEAR(refined(alone, CrfRest::apart)[3].weight(7), 0.6, 1e-6);
}

TEST(BeliefRefinement, VoxelsThatNameNothing) {
  std::vector<ClassBeliefs> beliefs = one_wrong();
  beliefs[0] = ClassBeliefs();
  EXPECT_TRUE(refined(beliefs, CrfRest::apart)[0].empty());
  EXPECT_GT(refined(beliefs, CrfRest::label)[0].weight(3), 0.0);
  const std::vector<ClassBeliefs> nothing(3);
  EXPECT_EQ(refined(nothing, CrfRest::apart), nothing);
  EXPECT_EQ(refined(nothing, CrfRest::label), nothing);
  EXPECT_TRUE(refined({}, CrfRest::apart).empty());
}

TEST(BeliefRefinement, CountsAreProbabilitiesAndOthersStayNamed) {
  const std::vector<ClassBeliefs> counts(3, ClassBeliefs(Entries{{1, 6.0}, {2, 2.0}}));
  const auto after = refined(counts, CrfRest::apart);
  EXPECT_GT(after[1].weight(1), 0.75);
  EXPECT_NEAR(after[1].weight(1) + after[1].weight(2), 1.0, 1e-5);
  const std::vector<ClassBeliefs> others(
      3, ClassBeliefs(Entries{{1, 0.5}, {2, 0.2}, {kOtherClasses, 0.3}}));
  EXPECT_NEAR(refined(others, CrfRest::apart)[1].weight(kOtherClasses), 0.3, 1e-5);
}

TEST(BeliefRefinement, VoxelAloneKeepsItsBeliefs) {
  std::vector<ClassBeliefs> beliefs = one_wrong();
  for (const ClassBeliefs& alone :
       {ClassBeliefs(Entries{{3, 0.7}, {7, 1e-9}}), ClassBeliefs(Entries{{1, 6.0}, {2, 2.0}}),
        ClassBeliefs(Entries{{7, 0.4}, {kOtherClasses, 0.6}})}) {
    beliefs.resize(7);
    beliefs.push_back(alone);
    std::vector<VoxelKey> keys = keys_in_row(8);
    keys[7].j = -5;
    for (const CrfRest rest : {CrfRest::apart, CrfRest::label}) {
      Crf crf = smoothness_only();
      crf.rest = rest;
      EXPECT_EQ(refine_beliefs(keys, 0.05, {}, beliefs, crf)[7], alone);
    }
  }
}

TEST(BeliefRefinement, SizesThatDifferAreRefused) {
  const std::vector<ClassBeliefs> beliefs(3);
  EXPECT_THROW((void)refine_beliefs(keys_in_row(2), 0.05, {}, beliefs, smoothness_only()), Error);
}

}  // namespace
}  // namespace mapscore
