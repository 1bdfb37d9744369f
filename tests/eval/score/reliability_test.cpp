// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/reliability.hpp"

#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace mapscore::eval {
namespace {

struct Verdict {
  double confidence;
  bool is_right;
};

Reliability tallied(const std::vector<Verdict>& verdicts) {
  Reliability tally;
  for (const auto& [confidence, is_right] : verdicts) tally.add(confidence, is_right);
  return tally;
}

/// Guo et al., equation 3, bin by bin over the list; bins are open above, the last is closed.
double plain_error(const std::vector<Verdict>& verdicts) {
  double error = 0;
  for (int m = 0; m < 10; ++m) {
    double count = 0, right = 0, sum = 0;
    for (const auto& [confidence, is_right] : verdicts) {
      if (confidence < m / 10.0 || (confidence >= (m + 1) / 10.0 && m < 9)) continue;
      count += 1;
      right += is_right ? 1 : 0;
      sum += confidence;
    }
    if (count > 0)
      error += count / static_cast<double>(verdicts.size()) * std::abs(right / count - sum / count);
  }
  return error;
}

TEST(ReliabilityOfVerdicts, ErrorIsThatOfAPlainCount) {
  RandomStream stream(3, "test", {0});
  for (const int count : {1, 2, 10, 1000}) {
    std::vector<Verdict> verdicts;
    for (int n = 0; n < count; ++n) {
      const double confidence = stream.uniform();
      verdicts.push_back({confidence, stream.uniform() < confidence * confidence});
    }
    EXPECT_NEAR(*tallied(verdicts).error(), plain_error(verdicts), 1e-8) << count;
  }
}

TEST(ReliabilityOfVerdicts, ByHand) {
  EXPECT_EQ(Reliability().error(), std::nullopt);
  EXPECT_EQ(tallied({{1.0, true}, {1.0, true}}).error(), 0.0);
  EXPECT_EQ(tallied({{1.0, true}, {1.0, false}}).error(), 0.5);
  EXPECT_EQ(tallied({{0.0, false}}).error(), 0.0);
  // Two in the bin from 0.5 on, of which one is right, and a sure one that is wrong.
  EXPECT_NEAR(*tallied({{0.56, true}, {0.58, false}, {0.9, false}}).error(),
              (std::abs(1 - 1.14) + 0.9) / 3, 1e-12);
  const Reliability tally = tallied({{0.3, true}, {0.2999, true}, {0.0, false}, {1.0, false}});
  EXPECT_EQ(tally.bins[3].count, 1) << "0.3 begins a bin";
  EXPECT_EQ(tally.bins[2].count, 1);
  EXPECT_EQ(tally.bins[0].count, 1);
  EXPECT_EQ(tally.bins[9].count, 1);
}

TEST(ReliabilityOfVerdicts, HalvesPool) {
  std::vector<Verdict> all;
  RandomStream stream(4, "test", {0});
  for (int n = 0; n < 200; ++n) all.push_back({stream.uniform(), stream.uniform() < 0.5});
  Reliability pooled = tallied({all.begin(), all.begin() + 70});
  pooled += tallied({all.begin() + 70, all.end()});
  EXPECT_EQ(pooled, tallied(all));
  Reliability thrice, once;
  thrice.add(0.7, true, 3);
  for (int n = 0; n < 3; ++n) once.add(0.7, true);
  EXPECT_EQ(thrice, once);
}

}  // namespace
}  // namespace mapscore::eval
