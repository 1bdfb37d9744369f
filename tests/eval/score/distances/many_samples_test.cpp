// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/metrics.hpp"
#include "eval/score/voxel_score.hpp"
#include "tests/eval/score/random_scene.hpp"

#include <gtest/gtest.h>

// The counts at 4 samples are those of the visible truth at min_samples 4.

namespace mapscore::eval {
namespace {

using testing::kClasses;

struct Sampled {
  testing::RandomScene scene;
  SurfaceTruth surface;
  SampleCounter samples;
  MapSnapshot map;

  explicit Sampled(std::uint64_t seed)
      : scene(testing::random_scene(seed)),
        surface(scene.surface()),
        samples(testing::counted(scene, testing::random_views(surface, seed))),
        map(testing::random_map(surface, seed)) {}

  [[nodiscard]] Counts counts(int min_samples) const {
    return score_voxels(map, 0.25, surface, visible_truth(samples, surface, min_samples), kClasses);
  }
};

TEST(ManySamples, AreThoseOfTheTruthAtFour) {
  std::int64_t few = 0, many = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Sampled sampled(seed);
    const Counts all = sampled.counts(1), at_four = sampled.counts(4);
    for (ClassId c = 0; c < kClasses; ++c) {
      EXPECT_EQ(all[c].visible_4, at_four[c].visible) << seed;
      EXPECT_EQ(all[c].found_4, at_four[c].found) << seed;
      if (all[c].visible_4 == 0) continue;
      const std::vector<Metric> of_all = metrics_of(all[c]), of_four = metrics_of(at_four[c]);
      for (const char* figure : {"recall", "f1", "iou"})
        EXPECT_EQ(value_of(of_all, std::string(figure) + "_4"), value_of(of_four, figure)) << seed;
      few += all[c].visible - all[c].visible_4;
      many += all[c].visible_4;
    }
  }
  EXPECT_GT(few, 1000);
  EXPECT_GT(many, 1000);
}

TEST(ManySamples, AreAllOfThemWhereTheTruthAsksForMore) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Sampled sampled(seed);
    for (const int min_samples : {4, 7}) {
      for (const ClassCounts& counts : sampled.counts(min_samples)) {
        EXPECT_EQ(counts.visible_4, counts.visible);
        EXPECT_EQ(counts.found_4, counts.found);
      }
    }
  }
}

}  // namespace
}  // namespace mapscore::eval
