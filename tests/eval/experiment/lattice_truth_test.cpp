// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/lattice_truth.hpp"

#include "tests/eval/experiment/tiny_experiment.hpp"

#include <algorithm>
#include <thread>

namespace mapscore::eval {
namespace {

class TinyTruth : public testing::TinyExperiment {
 protected:
  [[nodiscard]] LatticeTruth truth(const TruthOptions& options, const MapFrame& map_frame = {},
                                   int jobs = 1) {
    return make_lattice_truth(recording(), table(), frames_, map_frame, options, jobs);
  }
  [[nodiscard]] FrameCache& frames() { return frames_; }

 private:
  FrameCache frames_{recording(),
                     {.color = false, .label = false, .depth = true, .depth_label = true},
                     std::size_t{1} << 24};
};

bool same_visible(const VisibleTruth& a, const VisibleTruth& b) {
  return std::ranges::equal(a.voxels(), b.voxels());
}

TEST_F(TinyTruth, HasOneViewOfAllFramesOrOneOfEach) {
  const LatticeTruth fused = truth({});
  ASSERT_EQ(fused.views.size(), 1u);
  EXPECT_EQ(&fused.view(3), &fused.view(0));
  const LatticeTruth each = truth({.by_frame = true});
  ASSERT_EQ(each.views.size(), 4u);
  std::size_t most = 0;
  for (int frame = 0; frame < 4; ++frame) {
    for (const VisibleVoxel& voxel : each.view(frame).visible.of(1))
      EXPECT_TRUE(each.surface.contains(voxel.key, 1));
    most = std::max(most, each.view(frame).visible.count(1));
  }
  EXPECT_GT(most, 0u);
  EXPECT_GT(fused.view(0).visible.count(1), most);
}

TEST_F(TinyTruth, DoesNotDependOnJobs) {
  const LatticeTruth one = truth({}, {}, 1), three = truth({}, {}, 3);
  EXPECT_TRUE(std::ranges::equal(one.surface.voxels(), three.surface.voxels()));
  EXPECT_TRUE(same_visible(one.view(0).visible, three.view(0).visible));
}

TEST_F(TinyTruth, MovesWithItsOrigin) {
  // An origin that is whole voxels away moves every index by as many.
  const LatticeTruth here = truth({.epsilon_m = 0});
  const LatticeTruth there = truth({.epsilon_m = 0}, {0.0625, {0.125, -0.0625, 0.0}, 0.0});
  const LatticeTruth same = truth({.epsilon_m = 0}, {0.0625, Eigen::Vector3d::Zero(), 0.0});
  ASSERT_EQ(there.surface.voxels().size(), same.surface.voxels().size());
  EXPECT_NE(here.surface.voxels().size(), same.surface.voxels().size());
  for (const SurfaceVoxel& voxel : same.surface.voxels())
    EXPECT_TRUE(
        there.surface.contains({voxel.key.i - 2, voxel.key.j + 1, voxel.key.k}, voxel.class_id));
}

TEST_F(TinyTruth, DistancesAreZeroOnTheSurfaceAndNotElsewhere) {
  const LatticeTruth made = truth({.epsilon_m = 0});
  for (const SurfaceVoxel& voxel : made.surface.voxels()) {
    ASSERT_EQ(made.distance_to_class(voxel.key, voxel.class_id), 0.0);
  }
  EXPECT_GT(made.distance_to_class({0, 0, 0}, 1), 1.0);  // the crate begins 1.4 m away
}

TEST_F(TinyTruth, CacheMakesATruthOnce) {
  TruthCache cache(recording(), table(), frames(), 2);
  const auto first = cache.get({}, {});
  EXPECT_EQ(cache.get({}, {}), first);
  EXPECT_NE(cache.get({}, {.min_samples = 2}), first);
  EXPECT_EQ(cache.get({}, {}), first);
  EXPECT_NE(cache.get({0.1, Eigen::Vector3d::Zero(), 0.0}, {}),
            first);  // a third one pushes the oldest out
  const auto again = cache.get({}, {});
  EXPECT_NE(again, first);
  EXPECT_TRUE(same_visible(again->view(0).visible, first->view(0).visible));
}

TEST_F(TinyTruth, CacheServesManyThreads) {
  TruthCache cache(recording(), table(), frames(), 4);
  std::vector<std::shared_ptr<const LatticeTruth>> truths(4);
  {
    std::vector<std::jthread> threads;
    for (auto& made : truths) threads.emplace_back([&] { made = cache.get({}, {}); });
  }
  for (const auto& made : truths) EXPECT_EQ(made, truths[0]);
}

}  // namespace
}  // namespace mapscore::eval
