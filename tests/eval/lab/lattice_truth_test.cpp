// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/lattice_truth.hpp"

#include "core/error.hpp"
#include "eval/lab/truth_cache.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"
#include "tests/eval/score/sample_sets.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

using testing::sample_count;

class TinyTruth : public testing::TinyExperiment {
 protected:
  [[nodiscard]] LatticeTruth truth(const TruthOptions& options, const MapFrame& map_frame = {},
                                   int jobs = 1) {
    LatticeTruth made{
        surfaces_of(recording().read_shapes(), table(), map_frame, options.epsilon_m, jobs), {}};
    made.view = make_view(recording(), table(), frames_, map_frame, options, made.surface, jobs);
    return made;
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

TEST_F(TinyTruth, SeesAllFramesTogetherOrOne) {
  const LatticeTruth fused = truth({});
  TruthCache cache(recording(), table(), frames(), 1);
  std::size_t most = 0;
  for (int frame = 0; frame < 4; ++frame) {
    const auto one = cache.get({}, {.depth_image = frame});
    const LatticeTruth selected = truth({.frames = FrameSelection(std::to_string(frame))});
    EXPECT_TRUE(same_visible(one->view.visible, selected.view.visible));
    EXPECT_EQ(cache.get({}, {.depth_image = frame}), one);
    for (const VisibleVoxel& voxel : one->view.visible.of(1))
      EXPECT_TRUE(fused.surface.contains(voxel.key, 1));
    most = std::max(most, one->view.visible.count(1));
  }
  EXPECT_GT(most, 0u);
  EXPECT_GT(fused.view.visible.count(1), most);
}

/// Sample for sample, in the same order.
bool same_samples(const SampleSet& a, const SampleSet& b) {
  const auto same_group = [](const SampleSet::Group& x, const SampleSet::Group& y) {
    return x.key == y.key && x.first == y.first && x.count == y.count;
  };
  bool same = a.class_count() == b.class_count() && a.edge_m() == b.edge_m();
  for (ClassId c = 0; same && c < a.class_count(); ++c) {
    same = std::ranges::equal(a.groups(c), b.groups(c), same_group);
    for (const SampleSet::Group& group : a.groups(c))
      same = same && std::ranges::equal(a.offsets(c, group), b.offsets(c, group));
  }
  return same;
}

TEST_F(TinyTruth, DoesNotDependOnJobs) {
  const LatticeTruth one = truth({}, {}, 1);
  EXPECT_GT(sample_count(one.view.samples, 1), 0u);
  for (const int jobs : {2, 3, 4, 9}) {
    const LatticeTruth many = truth({}, {}, jobs);
    EXPECT_TRUE(std::ranges::equal(one.surface.voxels(), many.surface.voxels()));
    EXPECT_TRUE(same_visible(one.view.visible, many.view.visible)) << jobs;
    EXPECT_TRUE(same_samples(one.view.samples, many.view.samples)) << jobs;
  }
}

/// Every sample of the selected frames, counted by the words of the definition.
struct PlainView {
  std::map<VoxelKey, std::pair<ClassId, std::uint32_t>> visible;  ///< owner, samples
  std::map<ClassId, std::size_t> samples;
};

PlainView plain_view(const Recording& recording, const SurfaceTruth& surface,
                     const MapFrame& map_frame, const std::vector<int>& frames, int min_samples) {
  const RecordingInfo& info = recording.info();
  std::map<VoxelKey, std::map<ClassId, std::uint32_t>> counts;
  PlainView view;
  for (const int index : frames) {
    const Frame frame = recording.read(index, {.label = false, .depth = true, .depth_label = true});
    for (int v = 0; v < frame.depth.rows; ++v) {
      for (int u = 0; u < frame.depth.cols; ++u) {
        const double z = frame.depth(v, u) / 5000.0;
        if (z == 0.0 || z < info.calibration.range_min_m || z > info.calibration.range_max_m)
          continue;
        const Eigen::Vector3d p_world = frame.T_world_base * info.calibration.T_base_depth *
                                        info.calibration.depth.back_project(u, v, z);
        const ClassId c = info.table.class_of(frame.depth_label(v, u));
        ++counts[voxel_of(map_frame.T_map_world() * p_world, map_frame.edge_m)][c];
        view.samples[c] += info.table.detected(c) ? 1 : 0;
      }
    }
  }
  for (const auto& [key, by_class] : counts) {
    ClassId owner = kBackground;
    std::uint32_t total = 0, most = 0;
    for (const auto& [c, samples] : by_class) {
      if (samples > most) owner = c;
      most = std::max(most, samples);
      total += samples;
    }
    if (total >= static_cast<std::uint32_t>(min_samples) && owner != kBackground &&
        surface.contains(key, owner))
      view.visible[key] = {owner, total};
  }
  return view;
}

TEST_F(TinyTruth, OfAnySubsetOfFramesEqualsAPlainRecountAtOddLattices) {
  const std::vector<std::pair<std::string, std::vector<int>>> subsets{
      {"2", {2}}, {"3,0", {0, 3}}, {"0:4:2", {0, 2}}, {"1:", {1, 2, 3}}, {":", {0, 1, 2, 3}}};
  for (const MapFrame& map_frame :
       {MapFrame{0.05, {0, 0, 0}, 0.0}, MapFrame{0.0437, {0.0171, -3.3, 7.7}, 0.61},
        MapFrame{0.1913, {-1.01, 0.002, 0.05}, -2.9}}) {
    std::set<std::size_t> sizes;
    for (const auto& [text, frames] : subsets) {
      for (const int min_samples : {1, 4}) {
        const LatticeTruth made =
            truth({.min_samples = min_samples, .frames = FrameSelection(text)}, map_frame, 2);
        const PlainView plain =
            plain_view(recording(), made.surface, map_frame, frames, min_samples);
        const VisibleTruth& visible = made.view.visible;
        ASSERT_EQ(visible.voxels().size(), plain.visible.size()) << text;
        for (const VisibleVoxel& voxel : visible.voxels())
          EXPECT_EQ(std::pair(voxel.owner, voxel.samples), plain.visible.at(voxel.key));
        EXPECT_EQ(sample_count(made.view.samples, 1), plain.samples.at(1));
        if (min_samples == 1) sizes.insert(visible.voxels().size());
      }
    }
    EXPECT_GE(sizes.size(), 3u);  // the subsets do not all see the same
  }
}

TEST_F(TinyTruth, RefusesFramesThatAreNotThere) {
  EXPECT_THROW((void)truth({.frames = FrameSelection("4")}), Error);
  EXPECT_THROW((void)truth({.frames = FrameSelection("0:0")}), Error);
}

TEST_F(TinyTruth, OfAWholeSceneSeesAllItsSurfaceWithoutSamples) {
  const LatticeTruth made{surfaces_of(recording().read_shapes(), table(), {}, 0.0005, 1), {}};
  EXPECT_TRUE(made.view.visible.voxels().empty());
  const ViewTruth whole = whole_surface_view(made.surface, table().classes.size());
  EXPECT_TRUE(same_visible(whole.visible, whole_surface(made.surface)));
  EXPECT_GT(whole.visible.count(1), truth({}).view.visible.count(1));
  std::vector<MapVoxel> rows;
  for (const VisibleVoxel& voxel : whole.visible.voxels())
    rows.push_back({voxel.key, voxel.owner, 1.0, true});
  const Counts counts =
      made.score(MapSnapshot(std::move(rows)), 0.5, whole, table().classes.size(), {});
  EXPECT_GT(counts[1].visible, 0);
  EXPECT_EQ(counts[1].found, counts[1].visible);
  EXPECT_EQ(counts[1].true_predicted, counts[1].predicted);
  EXPECT_EQ(counts[1].accuracy.count(), counts[1].predicted);
  EXPECT_EQ(counts[1].completeness.count(), 0);
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
  EXPECT_TRUE(same_visible(again->view.visible, first->view.visible));
}

TEST_F(TinyTruth, CacheKeepsTruthsOfInstancesApart) {
  TruthCache cache(recording(), table(), frames(), 1);
  const auto classes = cache.get({}, {});
  const auto instances = cache.of_instances({}, {});
  EXPECT_NE(instances, classes);
  EXPECT_EQ(cache.get({}, {}), classes);
  EXPECT_EQ(cache.of_instances({}, {}), instances);
  // Here each class has one instance, of its own id.
  EXPECT_TRUE(same_visible(instances->view.visible, classes->view.visible));
  EXPECT_GT(sample_count(classes->view.samples, 1), 0u);
  EXPECT_EQ(sample_count(instances->view.samples, 1), 0u);
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
