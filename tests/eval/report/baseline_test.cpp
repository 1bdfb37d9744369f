// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/baseline.hpp"

#include "tests/eval/report/synthetic_summary.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

BaselineRow row(const std::string& metric, std::optional<double> value) {
  return {"trial direct", "pooled", metric, value};
}

TEST(Baseline, AFigureFallsByMoreThanWhatIsAllowed) {
  const std::vector<BaselineRow> baseline{row("f1", 0.5)};
  EXPECT_THAT(falls(baseline, {row("f1", 0.5)}, 0.002), IsEmpty());
  EXPECT_THAT(falls(baseline, {row("f1", 0.499)}, 0.002), IsEmpty());
  EXPECT_THAT(falls(baseline, {row("f1", 0.9)}, 0.002), IsEmpty());
  const std::vector<Fall> fallen = falls(baseline, {row("f1", 0.497)}, 0.002);
  ASSERT_THAT(fallen, SizeIs(1));
  EXPECT_EQ(fallen[0].baseline.metric, "f1");
  EXPECT_EQ(fallen[0].now, 0.497);
}

TEST(Baseline, AFigureThatIsGoneOrUndefinedFell) {
  const std::vector<BaselineRow> baseline{row("f1", 0.0)};
  EXPECT_THAT(falls(baseline, {}, 0.002), SizeIs(1));
  EXPECT_THAT(falls(baseline, {row("f1", std::nullopt)}, 0.002), SizeIs(1));
  EXPECT_THAT(falls(baseline, {row("iou", 1.0)}, 0.002), SizeIs(1));
}

TEST(Baseline, WhatWasUndefinedOrIsNewDoesNotFall) {
  EXPECT_THAT(falls({row("f1", std::nullopt)}, {}, 0.002), IsEmpty());
  EXPECT_THAT(falls({}, {row("f1", 0.1)}, 0.002), IsEmpty());
}

TEST(Baseline, HoldsTrialsAndCeilingsByClass) {
  const StudySummary summary = testing::synthetic_summary(testing::synthetic_study(
      {"direct", "erosion"}, {{"faults.misregistration.magnitude_m", {"0", "0.01"}}}, 2));
  const std::vector<BaselineRow> rows = baseline_of(summary);
  // 2 doses x 2 methods x (trial and 2 ceilings) x (pooled, macro, cup, chair) x (precision,
  // recall, f1, iou).
  EXPECT_THAT(rows, SizeIs(2 * 2 * 3 * 4 * 4));
  const auto value = [&](const std::string& what, const std::string& group) {
    for (const BaselineRow& r : rows)
      if (r.what == what && r.group == group && r.metric == "precision") return r.value;
    return std::optional<double>();
  };
  // Cell 1 of erosion: 0.08 of the cups' voxels are false at seed 0, 0.09 at seed 1; chairs 0.04
  // more.
  const std::string what = "trial erosion faults.misregistration.magnitude_m=0.01";
  EXPECT_NEAR(value(what, "cup").value(), 1 - 0.085, 1e-12);
  EXPECT_NEAR(value(what, "pooled").value(), 1 - 0.105, 1e-12);
  EXPECT_THAT(falls(rows, rows, 0.0), IsEmpty());
}

class BaselineFile : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "baseline.csv"; }
  void write(const std::string& text) const { std::ofstream(file()) << text; }
  void expect_refused(const std::string& part) const {
    expect_error(part, [&] { (void)read_baseline(file()); });
  }

 private:
  mapscore::testing::TemporaryFolder folder_;
};

TEST_F(BaselineFile, ReadsBackWhatWasWritten) {
  write_baseline({row("f1", 0.123456), row("iou", std::nullopt)}, file());
  const std::vector<BaselineRow> rows = read_baseline(file());
  ASSERT_THAT(rows, SizeIs(2));
  EXPECT_EQ(rows[0].what, "trial direct");
  EXPECT_EQ(rows[0].group, "pooled");
  EXPECT_EQ(rows[0].metric, "f1");
  EXPECT_EQ(rows[0].value, 0.123456);
  EXPECT_EQ(rows[1].value, std::nullopt);
  EXPECT_FALSE(std::filesystem::exists(file().string() + ".partial"));
}

TEST_F(BaselineFile, WhatIsRoundedByWritingDoesNotFall) {
  const std::vector<BaselineRow> now{row("f1", 2.0 / 3.0)};
  write_baseline(now, file());
  EXPECT_THAT(falls(read_baseline(file()), now, 1e-6), IsEmpty());
}

TEST_F(BaselineFile, IsRefusedWhenMissingOrBroken) {
  expect_refused("no baseline there; make one with");
  write("a,b,c\n");
  expect_refused("baseline.csv:1: not a baseline");
  write("what,class,metric,value\ntrial direct,pooled,f1,0.5x\n");
  expect_refused("baseline.csv:2: '0.5x' is no number");
  write("what,class,metric,value\ntrial direct,pooled,f1,nan\n");
  expect_refused("baseline.csv:2: 'nan' is no number");
  write("what,class,metric,value\ntrial direct,pooled,f1,0.5\n\n");
  expect_refused("baseline.csv:3: needs four columns");
  write("what,class,metric,value\n");
  expect_refused("holds no figure");
}

TEST_F(BaselineFile, IsNotWrittenWhereItCanNotBe) {
  write("in the way");
  expect_error("cannot be written", [&] { write_baseline({row("f1", 1)}, file() / "b.csv"); });
  EXPECT_THROW((void)read_baseline(file()), Error);
}

TEST(FallTable, SaysFromWhereToWhere) {
  const Table table = fall_table({{row("f1", 0.5), 0.25}, {row("iou", 0.75), std::nullopt}});
  EXPECT_THAT(table.columns, ElementsAre("what", "class", "metric", "baseline", "now", "change"));
  ASSERT_THAT(table.rows, SizeIs(2));
  EXPECT_THAT(table.rows[0],
              ElementsAre("trial direct", "pooled", "f1", "0.500000", "0.250000", "-0.250000"));
  EXPECT_THAT(table.rows[1],
              ElementsAre("trial direct", "pooled", "iou", "0.750000", "-", "missing"));
}

}  // namespace
}  // namespace mapscore::eval
