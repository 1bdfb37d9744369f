// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/baseline.hpp"

#include "files/file_bytes.hpp"
#include "tests/eval/report/synthetic_summary.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;
using ::testing::SizeIs;

TEST(Baseline, HoldsTrialsAndCeilings) {
  const Baseline baseline = baseline_of(testing::summary_of(2));
  EXPECT_THAT(baseline.lines, SizeIs(2 * 2 * 3));
  EXPECT_THAT(detected_names(baseline.table), ElementsAre("cup", "chair"));
  EXPECT_EQ(baseline.build, "build");
  EXPECT_EQ(baseline.recording_hash, "recording");
}

TEST(Baseline, FormsTheFiguresOfTheResults) {
  const StudySummary summary = testing::summary_of(3);
  const Baseline baseline = baseline_of(summary);
  for (const char* group : {"pooled", "macro", "cup", "chair"})
    for (const char* metric : {"precision", "recall", "f1", "iou"}) {
      const Estimate whole = estimate(summary.trials[1], summary.table, group, metric);
      const Estimate kept = estimate(baseline.lines[1], baseline.table, group, metric);
      EXPECT_TRUE(whole.pooled);
      EXPECT_EQ(kept.pooled, whole.pooled) << group << metric;
      EXPECT_EQ(kept.by_seed, whole.by_seed) << group << metric;
    }
}

TEST(Baseline, OfSeveralBuildsIsRefused) {
  StudySummary summary = testing::summary_of(2);
  summary.builds.insert("other");
  expect_error("made by 2 builds", [&] { (void)baseline_of(summary); });
}

TEST(Baseline, TellsNoFigureItHasNoCountsFor) {
  const std::vector<std::string> metrics = voxel_metrics(baseline_of(testing::summary_of(2)));
  EXPECT_THAT(metrics, Contains("f1"));
  for (const char* none : {"ap", "brier", "accuracy_p95_m"})
    EXPECT_THAT(metrics, Not(Contains(none)));
}

class BaselineFile : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "baseline.json"; }
  void write(const std::string& text) const { std::ofstream(file()) << text; }
  [[nodiscard]] std::string text() const {
    std::ifstream stream(file());
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void expect_refused(const std::string& part) const {
    expect_error(part, [&] { (void)read_baseline(file()); });
  }

 private:
  mapscore::testing::TemporaryFolder folder_;
};

/// Whose study can be read back.
StudySummary plain_summary() {
  StudySummary summary = testing::summary_of(2);
  set_leaf(summary.study, "trajectory.waypoints_m_deg", "[[0, 0, 0]]");
  return summary;
}

/// Results with tolerances and distances too.
StudySummary rich_summary() {
  StudySummary summary = plain_summary();
  for (auto* lines : {&summary.trials, &summary.registration_ceilings, &summary.lattice_ceilings})
    for (ResultLine& line : *lines) {
      line.pooled.clear();
      for (TrialResult& result : line.results) {
        for (ClassCounts& c : result.counts) {
          c.at_tolerance = {{1, c.true_predicted, c.found}};
          c.accuracy = DistanceTally({0.01, 0.02});
          c.accuracy.add(0.015, 1 + c.true_predicted);
          c.accuracy.add(kUnreached, 3);
        }
        pool_into(line.pooled, result.counts);
      }
    }
  return summary;
}

TEST_F(BaselineFile, ReadsBackWhatWasWritten) {
  Baseline written = baseline_of(rich_summary());
  written.yields = {{"direct", written.lines[0].cell, {{{"cup", {3, 1}}}, {}}}};
  write_baseline(written, file());
  const Baseline read = read_baseline(file());
  EXPECT_EQ(read.scoring_version, kScoringVersion);
  EXPECT_EQ(read.recording_hash, "recording");
  EXPECT_EQ(read.build, "build");
  EXPECT_EQ(to_yaml(read.study), to_yaml(written.study));
  // 2 doses x 2 methods, the registration ceiling of each method, one lattice ceiling.
  ASSERT_THAT(read.lines, SizeIs(2 * 2 + 2 + 1));
  for (std::size_t n = 0; n < 2 * 2; ++n) {
    EXPECT_EQ(read.lines[n].role, written.lines[n].role);
    EXPECT_EQ(read.lines[n].method, written.lines[n].method);
    EXPECT_EQ(read.lines[n].cell.doses, written.lines[n].cell.doses);
    EXPECT_EQ(read.lines[n].seeds, written.lines[n].seeds);
    EXPECT_EQ(read.lines[n].pooled, written.lines[n].pooled);
    for (std::size_t seed = 0; seed < read.lines[n].results.size(); ++seed)
      EXPECT_EQ(read.lines[n].results[seed].counts, written.lines[n].results[seed].counts);
  }
  ASSERT_THAT(read.yields, SizeIs(1));
  EXPECT_EQ(read.yields[0].cell.doses, written.lines[0].cell.doses);
  EXPECT_EQ(read.yields[0].frames, written.yields[0].frames);
  const Estimate tau = estimate(read.lines[0], read.table, "cup", "precision_2cm");
  EXPECT_GT(tau.pooled.value(), 0.9);
  const std::string before = text();
  write_baseline(read, file());
  EXPECT_EQ(text(), before);
  EXPECT_FALSE(std::filesystem::exists(file().string() + ".partial"));
}

TEST_F(BaselineFile, IsRefusedWhenMissingOrBroken) {
  expect_refused("is not there; make it with `mapscore check RESULTS --baseline FILE --update`");
  write("what,class,metric,value\n");
  expect_refused("no baseline of this mapscore");
  write_baseline(baseline_of(plain_summary()), file());
  const std::string good = text();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string bad = good;
    EXPECT_NE(bad.find(from), std::string::npos) << from;
    bad.replace(bad.find(from), from.size(), to);
    write(bad);
    return bad;
  };
  with("\"format\": 3", "\"format\": 2");
  expect_refused("no baseline of this mapscore");
  with("\"cup\":[100,", "\"cup\":[101,");
  expect_refused("was edited, merged or cut");
  with("\"seed\":1", "\"seed\":2");
  expect_refused("was edited, merged or cut");
  write(good + ' ');
  expect_refused("was edited, merged or cut");
  const auto forged = [&](const std::string& from, const std::string& to) {
    std::string text = with(from, to);
    const std::size_t hash = text.find("\"hash\": \"") + 9, body = hash + 32 + 3;
    write(text.replace(hash, 32, hash_of(std::string_view(text).substr(body))));
  };
  forged("\"predicted\"", "\"predicated\"");
  expect_refused("no baseline of this mapscore");
  forged("\"cup\":[100,", "\"cup\":[-1,");
  expect_refused("predicted: is no count");
  forged("\"cup\":[100,", "\"cup\":[1.5,");
  expect_refused("predicted: is no count");
  forged("\"cup\":[100,", "\"cap\":[100,");
  expect_refused("no baseline of this mapscore");
  forged("\"role\":\"trial\"", "\"role\":\"trail\"");
  expect_refused("unknown role");
  write(good.substr(0, good.size() / 2));
  expect_refused("no baseline of this mapscore; write it anew with");
}

TEST_F(BaselineFile, IsNotWrittenWhereItCanNotBe) {
  write("in the way");
  expect_error("cannot be written",
               [&] { write_baseline(baseline_of(testing::summary_of(2)), file() / "b.json"); });
}

}  // namespace
}  // namespace mapscore::eval
