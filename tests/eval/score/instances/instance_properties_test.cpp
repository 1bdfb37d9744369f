// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/eval/score/instances/plain_instance_score.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using testing::cups_and_chairs;
using testing::instance_case;
using testing::InstanceCase;
using testing::kChair;
using testing::kCup;
using testing::PlainInstanceScore;
using testing::surface_of;
using testing::visible_of;

TEST(InstanceProperties, AgreesWithThePlainOne) {
  int found = 0, missed = 0, wrong = 0, unseen = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const InstanceCase made = instance_case(seed);
    const MapSnapshot map(made.map);
    for (const bool numbered : {false, true}) {
      const PredictedInstances predicted =
          numbered ? objects_of(map, 0.2, made.numbers) : pieces_of(map, 0.2);
      const auto counts = score_instances(predicted, surface_of(made.surface),
                                          visible_of(made.owners), cups_and_chairs());
      const PlainInstanceScore plain(made, predicted);
      for (const ClassId c : {kCup, kChair}) {
        ASSERT_EQ(counts[c], plain.of(c)) << "seed " << seed << ", class " << c;
        found += static_cast<int>(counts[c].true_positive);
        missed += static_cast<int>(counts[c].false_negative);
        wrong += static_cast<int>(counts[c].false_positive);
        unseen += static_cast<int>(counts[c].void_predicted);
      }
    }
  }
  for (const int happened : {found, missed, wrong, unseen}) EXPECT_GT(happened, 50);
}

TEST(InstanceProperties, TruthAgainstItselfIsPerfect) {
  int scored = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const InstanceCase made = instance_case(seed);
    std::vector<MapVoxel> map;
    std::vector<NumberedVoxel> numbers;
    std::set<std::pair<VoxelKey, ClassId>> surface;
    for (const auto& [key, owner] : made.owners) {
      map.push_back({key, cups_and_chairs().class_of(owner), 1.0, true});
      numbers.push_back({key, owner});
      surface.insert({key, owner});
    }
    const auto counts =
        score_instances(objects_of(MapSnapshot(map), 0.5, numbers), surface_of(surface),
                        visible_of(made.owners), cups_and_chairs());
    for (const Metric& metric : macro_instance_metrics(counts, cups_and_chairs())) {
      EXPECT_EQ(metric.value, 1.0) << metric.name;
      ++scored;
    }
  }
  EXPECT_GT(scored, 200);
}

TEST(InstanceProperties, RatiosLieInTheirRangeAndBelongTogether) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const InstanceCase made = instance_case(seed);
    const auto counts =
        score_instances(pieces_of(MapSnapshot(made.map), 0.2), surface_of(made.surface),
                        visible_of(made.owners), cups_and_chairs());
    for (const InstanceCounts& c : counts) {
      const std::vector<Metric> metrics = c.metrics();
      for (const Metric& metric : metrics) {
        const double value = metric.value.value_or(0.0);
        EXPECT_TRUE(value >= 0.0 && value <= 1.0) << metric.name;
      }
      if (const auto sq = value_of(metrics, "sq")) {
        EXPECT_NEAR(*value_of(metrics, "pq"), *sq * *value_of(metrics, "rq"), 1e-15);
      }
      for (std::size_t t = 1; t < kInstancePercents.size(); ++t)
        EXPECT_LE(instance_ap(c, t), instance_ap(c, t - 1));
    }
  }
}

TEST(InstanceProperties, PoolsByAddition) {
  const auto counts_of = [](std::uint64_t seed) {
    const InstanceCase made = instance_case(seed);
    return score_instances(pieces_of(MapSnapshot(made.map), 0.2), surface_of(made.surface),
                           visible_of(made.owners), cups_and_chairs());
  };
  InstanceCounts forth, back;
  std::int64_t predictions = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const InstanceCounts cup = counts_of(seed)[kCup];
    for (const InstanceStep& step : cup.steps) predictions += step.predicted;
    forth += cup;
    back += counts_of(19 - seed)[kCup];
  }
  EXPECT_EQ(forth, back);
  EXPECT_EQ(forth.true_positive + forth.false_positive, predictions);
  for (std::size_t n = 1; n < forth.steps.size(); ++n)
    EXPECT_GT(forth.steps[n - 1].score, forth.steps[n].score);

  const auto one = counts_of(3);
  InstanceCounts detected = one[kCup];
  detected += one[kChair];
  EXPECT_EQ(pool_detected_instances(one, cups_and_chairs()), detected);
}

}  // namespace
}  // namespace mapscore::eval
