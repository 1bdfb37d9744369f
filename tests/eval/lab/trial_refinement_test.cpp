// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/refinement/map_refinement.hpp"
#include "eval/lab/trial_run.hpp"
#include "eval/lab/truth_cache.hpp"
#include "eval/results/study_store.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"

#include <algorithm>

namespace mapscore::eval {
namespace {

using testing::study_of;

class RefinedTrial : public testing::TinyExperiment {
 protected:
  /// The map of a study's first trial when it is over, and what it was scored.
  struct Finished {
    SemanticMap map;
    TrialResult result;
  };
  [[nodiscard]] Finished finish(const std::string& refinement) const {
    // Under label errors, so that there is something to mend.
    const Study study = study_of(
        "detect: all\nmap_origin_m: [0, 0, 0]\n"
        "faults: {labels: {boundary_px: 2}, misregistration: {magnitude_m: 0.03}}\n",
        {"methods.direct.refinement=" + refinement});
    const Plan planned = plan(study);
    const ClassTable detected = detected_table(study, table());
    FrameCache frames(recording(),
                      {.color = true, .label = true, .depth = true, .depth_label = true},
                      std::size_t{1} << 24);
    TruthCache truths(recording(), detected, frames, 1);
    PoseSources poses(recording());
    const Task task = planned.tasks[0];
    TrialRun run(task, recording(), detected, truths, poses);
    for (int index = 0; index < recording().frame_count(); ++index) run.advance(*frames.get(index));
    TrialResult result = run.finish();
    run.map().save(folder() / "map.ot");
    return {SemanticMap::load(folder() / "map.ot"), std::move(result)};
  }
};

bool equal(const SemanticMap& a, const SemanticMap& b) {
  const std::vector<BelievedVoxel> left = a.believed_voxels(), right = b.believed_voxels();
  return std::ranges::equal(left, right, [](const BelievedVoxel& x, const BelievedVoxel& y) {
    return x.key == y.key && std::ranges::equal(x.beliefs.entries(), y.beliefs.entries());
  });
}

TEST_F(RefinedTrial, IsTheFinishedMapRefined) {
  Finished plain = finish("{none: {}}");
  const Finished refined =
      finish("{crf: {smoothness_weight: 2, smoothness_sigma_m: 0.1, appearance_weight: 0}}");
  EXPECT_FALSE(equal(plain.map, refined.map));
  Crf params;
  params.smoothness_weight = 2;
  params.smoothness_sigma_m = 0.1;
  params.appearance_weight = 0;
  refine(plain.map, params);
  EXPECT_TRUE(equal(plain.map, refined.map));
  EXPECT_NE(plain.result.counts, refined.result.counts);
}

TEST_F(RefinedTrial, ReadsColoursWhereAppearanceWeighs) {
  const Finished without = finish("{crf: {appearance_weight: 0}}");
  const Finished with = finish("{crf: {appearance_weight: 30, appearance_sigma_colour: 5}}");
  EXPECT_FALSE(equal(without.map, with.map));
  EXPECT_TRUE(std::ranges::any_of(with.map.believed_voxels(), [](const BelievedVoxel& voxel) {
    return voxel.colour.has_value();
  }));
  EXPECT_TRUE(std::ranges::none_of(without.map.believed_voxels(), [](const BelievedVoxel& voxel) {
    return voxel.colour.has_value();
  }));
}

TEST_F(RefinedTrial, AnotherRefinementIsAnotherKey) {
  const auto key = [&](const std::string& refinement) {
    return plan(study_of("", {"methods.direct.refinement=" + refinement})).tasks[0].key;
  };
  EXPECT_EQ(key("{none: {}}"), plan(study_of("")).tasks[0].key);
  EXPECT_NE(key("{crf: {}}"), key("{none: {}}"));
  EXPECT_NE(key("{crf: {iterations: 3}}"), key("{crf: {}}"));
}

}  // namespace
}  // namespace mapscore::eval
