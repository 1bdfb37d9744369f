// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <gmock/gmock.h>

#include <set>

namespace mapscore::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The replaying half, which needs no simulator, through every verb.
class TinySweep : public TinyStudy {
 protected:
  TinySweep() { expect_done(mapscore({"sweep", study(), "-o", results(), "-q"})); }

  /// Exchanges a colour image for another, which no method here reads.
  void change_recording() const {
    std::set<std::filesystem::path> images;
    for (const auto& entry : std::filesystem::directory_iterator(folder() / "tiny/color"))
      images.insert(entry.path());
    std::filesystem::copy_file(*images.begin(), *images.rbegin(),
                               std::filesystem::copy_options::overwrite_existing);
  }
};

TEST_F(TinySweep, PrintsAndChecksItsScores) {
  const Outcome table = mapscore({"table", results()});
  expect_done(table);
  EXPECT_THAT(table.out, HasSubstr("detected: crate"));
  const std::string baseline = path("baseline.json");
  expect_done(mapscore({"check", results(), "--baseline", baseline, "--update"}));
  const Outcome check = mapscore({"check", results(), "--baseline", baseline});
  expect_done(check);
  EXPECT_THAT(check.out, HasSubstr("figures hold; changed: 0 of"));
  expect_done(mapscore({"sweep", study(), "-o", path("moved"), "-q", "--set", "seed=99"}));
  const Outcome moved = mapscore({"check", path("moved"), "--baseline", baseline});
  EXPECT_EQ(moved.exit_code, 3) << moved.err;
  EXPECT_THAT(moved.out, HasSubstr("nothing could be compared"));
}

TEST_F(TinySweep, UpdateSaysWhatTheOldBaselineDifferedIn) {
  const std::vector<std::string> update{"check", results(), "--baseline", path("baseline.json"),
                                        "--update"};
  expect_refused(mapscore({"check", results(), "--baseline", path("baseline.json")}),
                 {"baseline.json: is not there; make it with", "--update"});
  expect_done(mapscore(update));
  change_recording();
  expect_done(mapscore({"sweep", study(), "-o", results(), "-q"}));
  const Outcome recording = mapscore(update);
  expect_done(recording);
  EXPECT_THAT(recording.err, HasSubstr("baseline.json written; the old one: recording "));
  EXPECT_THAT(recording.out, HasSubstr("figures hold; another recording; changed: 0 of"));
  expect_done(mapscore({"sweep", study(), "-o", results(), "-q", "--set", "voxel_m=0.1"}));
  const Outcome settings = mapscore(update);
  expect_done(settings);
  EXPECT_THAT(settings.err,
              HasSubstr("written; the old one: not comparable: voxel_m 0.05 -> 0.1\n"));
}

TEST_F(TinySweep, ComparesTwoRecordingsWhereItIsTold) {
  change_recording();
  expect_done(mapscore({"sweep", study(), "-o", path("after"), "-q"}));
  std::vector<std::string> compare{"compare", "--before", results(), "--after", path("after")};
  expect_refused(mapscore(compare), {"recording ", "--any_recording"});
  compare.emplace_back("--any_recording");
  const Outcome compared = mapscore(compare);
  expect_done(compared);
  EXPECT_THAT(compared.out, HasSubstr("recording "));
  expect_refused(mapscore({"compare", results(), "direct", "erosion", "--any_recording"}),
                 {"--any_recording is for --before and --after"});
}

TEST_F(TinySweep, CheckSaysWhichFigureIsMissing) {
  const std::string baseline = path("baseline.json");
  expect_done(mapscore({"check", results(), "--baseline", baseline, "--update", "--frames"}));
  replace("study.yaml", "  direct:", "  renamed:");
  expect_done(mapscore({"sweep", study(), "-o", results(), "-q"}));
  const Outcome check = mapscore({"check", results(), "--baseline", baseline});
  EXPECT_EQ(check.exit_code, 1) << check.err;
  EXPECT_EQ(check.err, "");
  EXPECT_THAT(check.out, HasSubstr("missing  direct  "));
  EXPECT_THAT(check.out, HasSubstr("figures got worse"));
  replace("baseline.json", "\"seed\":0", "\"seed\":1");
  expect_refused(mapscore({"check", results(), "--baseline", baseline}),
                 {"baseline.json: was edited, merged or cut", "--update"});
}

TEST_F(TinySweep, TakesAStudyInTheWorkingFolder) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder());
  const Outcome sweep = mapscore({"sweep", "study.yaml", "-o", "here", "-q"});
  const Outcome table = mapscore({"table", "here"});
  std::filesystem::current_path(before);
  expect_done(sweep);
  expect_done(table);
}

TEST_F(TinySweep, TableKnowsOnlyTheClassesThatWereScored) {
  expect_refused(mapscore({"table", results(), "--class", "wall"}), {"wall", "pooled", "crate"});
}

TEST_F(TinySweep, TableHasRowsAndColumnsAsAsked) {
  const Outcome table = mapscore({"table", results(), "--columns", "method", "--format", "csv"});
  expect_done(table);
  EXPECT_THAT(table.out,
              ::testing::StartsWith("magnitude_m,direct,direct low,direct high,erosion"));
  EXPECT_THAT(mapscore({"table", results(), "--where", "magnitude_m=0.030", "--method", "erosion",
                        "--rows", "class", "--metric", "precision,recall", "--format", "markdown"})
                  .out,
              HasSubstr("| class | precision | recall |\n| --- | --- | --- |\n| crate | "));
  const Outcome tidy = mapscore({"table", results(), "--tidy", "--method", "direct"});
  EXPECT_THAT(tidy.out, AllOf(HasSubstr("\ntrial,direct,"), Not(HasSubstr("erosion"))));
  const auto refused = [&](const std::vector<std::string>& flags,
                           const std::vector<std::string>& parts) {
    std::vector<std::string> command{"table", results()};
    command.insert(command.end(), flags.begin(), flags.end());
    expect_refused(mapscore(command), parts);
  };
  refused({"--where", "magnitud_m=0"}, {"is not swept", "'magnitude_m'"});
  refused({"--where", "magnitude_m=0.01"}, {"no such value", "0, 0.03"});
  refused({"--method", "errosion"}, {"'erosion'"});
  refused({"--metric", "f2"}, {"'f1'"});
  refused({"--rows", "methods"}, {"'method'"});
  refused({"--tidy", "--rows", "method"}, {"--tidy", "--rows"});
}

TEST_F(TinySweep, TitlesStandInPapersAndChangeNoResult) {
  replace("study.yaml", "erosion: {", "erosion: {title: \"Erosion_2 & more\", ");
  replace("study.yaml", "methods:", "class_titles: {crate: box}\nmethods:");
  const Outcome again = mapscore({"sweep", study(), "-o", results()});
  expect_done(again);
  EXPECT_THAT(again.err, HasSubstr("0 trials computed, 10 already there"));
  const Outcome tex = mapscore({"table", results(), "--rows", "method,class", "--columns",
                                "magnitude_m", "--class", "crate", "--format", "tex"});
  expect_done(tex);
  EXPECT_THAT(tex.out, AllOf(HasSubstr("method & class & 0 mm & 30 mm \\\\"),
                             HasSubstr("\nErosion\\_2 \\& more & box & ")));
  replace("study.yaml", "crate: box", "crat: box");
  expect_refused(mapscore({"sweep", study(), "-o", results()}), {"class_titles", "'crate'"});
}

TEST_F(TinySweep, TwoSweptPathsThatEndAlikeKeepAColumnEach) {
  expect_done(
      mapscore({"sweep", study(), "-o", path("two"), "-q", "--set",
                "sweep={faults.misregistration.magnitude_m: [0], faults.mount.magnitude_m: [0]}"}));
  EXPECT_THAT(mapscore({"table", path("two"), "--format", "json"}).out,
              AllOf(HasSubstr("faults.misregistration.magnitude_m"),
                    HasSubstr("faults.mount.magnitude_m")));
}

TEST_F(TinySweep, TellsWhatThingsAre) {
  EXPECT_THAT(mapscore({"info", results()}).out, HasSubstr("10 of 10 trials and ceilings"));
  EXPECT_THAT(mapscore({"info", path("tiny")}).out, HasSubstr("4 frames of 64 x 48"));
}

TEST_F(TinySweep, ScoresItsOwnTruthAsPerfect) {
  expect_done(mapscore({"truth", path("tiny"), "-o", path("truth.csv")}));
  const Outcome score =
      mapscore({"score", path("truth.csv"), "--truth", path("tiny"), "--format", "csv"});
  expect_done(score);
  EXPECT_THAT(score.out, HasSubstr("\ncrate,1.000,1.000,1.000,1.000,"));
}

TEST_F(TinySweep, AnotherNameAndAMethodMoreComputeOnlyWhatIsNew) {
  replace("study.yaml", "methods:", "name: again\nmethods:");
  replace("study.yaml", "  direct:", "  plain:");
  replace("study.yaml", "sweep:", "  growing: {segmentation: {region_growing: {}}}\nsweep:");
  const Outcome more = mapscore({"sweep", study(), "-o", results()});
  expect_done(more);
  EXPECT_THAT(more.err, HasSubstr("sweep again: 4 trials computed, 10 already there"));
}

}  // namespace
}  // namespace mapscore::testing
