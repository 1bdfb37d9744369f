// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/lattice_check.hpp"

#include "eval/score/voxel_score.hpp"
#include "tests/eval/score/score_cases.hpp"

#include <gmock/gmock.h>

namespace mapscore::eval {
namespace {

using ::testing::HasSubstr;

ClassTable cup_and_chair() {
  ClassTable table;
  table.classes.push_back({testing::kCup, "cup", {}, true});
  table.classes.push_back({testing::kChair, "chair", {}, true});
  return table;
}

/// The note on a cup's floor of 10 x 10 voxels that touches a chair's along one side, mapped with
/// an offset: every voxel that both touch goes to the chair, but belongs to the cup.
std::string note_of(int offset, ClassId of_cup, ClassId of_both) {
  std::set<std::pair<VoxelKey, ClassId>> surface;
  std::map<VoxelKey, ClassId> owners, labels;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 20; ++j) {
      const VoxelKey key{i, j, 0}, mapped{i, j + offset, 0};
      const bool is_cup = j < 10, is_both = j == 9;
      surface.insert({key, is_cup ? testing::kCup : testing::kChair});
      if (is_both) surface.insert({key, testing::kChair});
      owners[key] = is_cup ? testing::kCup : testing::kChair;
      labels[mapped] = is_both ? of_both : is_cup ? of_cup : testing::kChair;
    }
  const ClassTable table = cup_and_chair();
  LatticeCheck check(table);
  check.add(score_voxels(testing::map_of(labels), 0.5, testing::surface_of(surface),
                         testing::visible_of(owners), 3));
  return check.note();
}

TEST(LatticeCheck, IsSilentWhereTouchingClassesShareVoxels) {
  EXPECT_EQ(note_of(0, testing::kCup, testing::kCup), "");
  EXPECT_EQ(note_of(0, testing::kCup, testing::kChair), "") << "recall is .95";
}

TEST(LatticeCheck, CatchesSurfaceThatIsSomewhereElse) {
  // 10 of 200 voxels beyond the chair, 10 of the cup on the chair; 10 of 200 are not mapped.
  EXPECT_THAT(note_of(1, testing::kCup, testing::kCup),
              HasSubstr("a precision of 0.900 and maps 0.950 of the visible voxels"));
}

TEST(LatticeCheck, CatchesLabelsThatAreExchanged) {
  EXPECT_THAT(note_of(0, testing::kChair, testing::kChair), HasSubstr("a precision of 0.550"));
}

}  // namespace
}  // namespace mapscore::eval
