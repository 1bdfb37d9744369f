// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/tiny_study.hpp"
#include "tests/support/plate_recording.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <set>
#include <sstream>

namespace mapscore::testing {
namespace {

using ::testing::HasSubstr;

/// Two recordings in one study: crate and wall, and a plate.
class TinyScenes : public TinyStudy {
 protected:
  TinyScenes() {
    write_plate_recording(folder() / "plate");
    write_text(path("two.yaml"),
               std::string("scenes: {boxed: {recording: tiny}, flat: {recording: plate}}\n") +
                   std::string(kText).substr(std::string(kText).find('\n') + 1));
  }

  [[nodiscard]] std::string tidy(const std::string& results) const {
    const Outcome table = mapscore({"table", results, "--tidy"});
    expect_done(table);
    return table.out;
  }
  /// Rows of one scene in a tidy CSV, without its column.
  [[nodiscard]] static std::multiset<std::string> rows_of(const std::string& csv,
                                                          const std::string& scene) {
    std::multiset<std::string> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t at = line.find(',' + scene + ',');
      if (at != line.npos) rows.insert(line.erase(at, scene.size() + 1));
    }
    return rows;
  }
  [[nodiscard]] static std::multiset<std::string> lines_of(const std::string& csv) {
    std::multiset<std::string> rows;
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);  // the head
    while (std::getline(lines, line)) rows.insert(line);
    return rows;
  }
};

TEST_F(TinyScenes, ATrialsFolderIsOfOneOfThem) {
  const auto trial = [&](const std::vector<std::string>& cell) {
    std::vector<std::string> arguments{"trial", path("two.yaml"), "-o", path("trial"), "-q"};
    arguments.insert(arguments.end(), cell.begin(), cell.end());
    return mapscore(arguments);
  };
  expect_refused(trial({}), {"--set sweep.scene=[boxed]"});
  expect_refused(trial({"--cell", "scene=other"}), {"other"});
  EXPECT_FALSE(std::filesystem::exists(path("trial")));
  expect_done(trial({"--cell", "scene=flat", "--cell", "magnitude_m=0.03"}));
  expect_done(mapscore({"map", path("trial"), "-o", path("map.ot"), "-q"}));
}

TEST_F(TinyScenes, ScoresAreThoseOfEachByItself) {
  expect_done(mapscore({"sweep", path("two.yaml"), "-o", results(), "-q"}));
  const std::string both = tidy(results());
  for (const auto& [scene, recording] : {std::pair{"boxed", "tiny"}, {"flat", "plate"}}) {
    write_text(study(), kText);
    replace("study.yaml", "recording: tiny", std::string("recording: ") + recording);
    expect_done(mapscore({"sweep", study(), "-o", path(scene), "-q"}));
    const auto alone = lines_of(tidy(path(scene)));
    const auto joined = rows_of(both, scene);
    EXPECT_GT(alone.size(), 100u);
    for (const std::string& row : alone) EXPECT_EQ(joined.count(row), 1u) << scene << ' ' << row;
  }
}

TEST_F(TinyScenes, NothingDependsOnShardsAndTheVerbsTakeThem) {
  expect_done(mapscore({"sweep", path("two.yaml"), "-o", results(), "-q"}));
  const std::string csv = tidy(results());
  for (const char* shard : {"1/3", "2/3", "3/3"})
    expect_done(
        mapscore({"sweep", path("two.yaml"), "-o", path("shared"), "--shard", shard, "-q"}));
  const Outcome merged = mapscore({"sweep", path("two.yaml"), "-o", path("shared")});
  expect_done(merged);
  EXPECT_THAT(merged.err, HasSubstr("0 trials computed"));
  EXPECT_EQ(tidy(path("shared")), csv);
  expect_done(mapscore({"check", results(), "--baseline", path("b.json"), "--update"}));
  expect_done(mapscore({"check", results(), "--baseline", path("b.json")}));
  const Outcome status = mapscore({"status", results()});
  expect_done(status);
  EXPECT_THAT(status.out, HasSubstr("0 failed, 0 not tried yet"));
  const Outcome dry = mapscore({"sweep", path("two.yaml"), "-o", results(), "--dry_run"});
  expect_done(dry);
  EXPECT_THAT(dry.out, HasSubstr("recording of flat: "));
  const Outcome trials = mapscore({"trials", results(), "--format", "csv"});
  expect_done(trials);
  const std::string key = trials.out.substr(trials.out.find(",flat,") - 100, 100);
  const std::size_t begin = key.rfind('\n') + 1;
  const Outcome again = mapscore({"run", results(), "--trial", key.substr(begin, 12), "-q"});
  EXPECT_THAT(again.out, HasSubstr("counts equal to those stored")) << again.err;
  expect_done(mapscore({"figures", results(), "--no_pictures"}));
}

TEST_F(TinyScenes, AllTogetherAreTheSumsOfTheirCounts) {
  expect_done(mapscore({"sweep", path("two.yaml"), "-o", results(), "-q"}));
  std::map<std::string, std::map<std::string, double>> counts;  // by scene, then count
  std::istringstream lines(tidy(results()));
  for (std::string line; std::getline(lines, line);)
    for (const char* scene : {"boxed", "flat"})
      for (const char* count : {"true_predicted", "predicted"})
        if (line.starts_with("trial,direct,") &&
            line.find(std::string(",0,") + scene + ",pooled," + count + ",") != line.npos)
          counts[scene][count] += std::stod(line.substr(line.rfind(',') + 1));
  ASSERT_EQ(counts.size(), 2u);
  const double precision = (counts["boxed"]["true_predicted"] + counts["flat"]["true_predicted"]) /
                           (counts["boxed"]["predicted"] + counts["flat"]["predicted"]);
  const Outcome table =
      mapscore({"table", results(), "--where", "scene=all", "--where", "magnitude_m=0", "--method",
                "direct", "--metric", "precision", "--format", "csv"});
  expect_done(table);
  EXPECT_THAT(table.out, HasSubstr(fmt::format("{:.9g}", precision)));
  const Outcome compared = mapscore({"compare", results(), "direct", "erosion"});
  expect_done(compared);
  EXPECT_THAT(compared.out, HasSubstr("flat"));
}

TEST_F(TinyScenes, ThereIsNoSumWhileASceneIsMissing) {
  const auto sweep = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"sweep", path("two.yaml"), "-o", results(), "-q"};
    words.insert(words.end(), more.begin(), more.end());
    expect_done(mapscore(words));
  };
  const auto table = [&](const char* scene) {
    return mapscore({"table", results(), "--interim", "--format", "csv", "--where",
                     std::string("scene=") + scene});
  };
  sweep({"--set", "sweep.scene=[boxed]"});
  EXPECT_EQ(mapscore({"sweep", path("two.yaml"), "-o", results(), "--merge_only"}).exit_code, 1);
  expect_done(table("boxed"));
  expect_refused(table("all"), {"no trial of these is there yet"});
  expect_done(mapscore({"figures", results(), "--interim", "--no_pictures"}));
  sweep({});
  expect_done(table("all"));
}

TEST_F(TinyScenes, WhatTakesOneSceneSaysSo) {
  for (const char* verb : {"run", "tolerance", "objects", "record"})
    expect_refused(mapscore({verb, path("two.yaml"), "-o", path("one")}),
                   {"scenes: there are 2", "--set sweep.scene=[boxed]"});
  expect_done(
      mapscore({"run", path("two.yaml"), "-o", path("one"), "--set", "sweep.scene=[flat]", "-q"}));
}

}  // namespace
}  // namespace mapscore::testing
