// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <gmock/gmock.h>

#include <cstdint>
#include <map>
#include <set>
#include <sstream>

namespace mapscore::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using Cells = std::vector<std::string>;

/// Rows of a CSV without quotes.
std::vector<Cells> rows_of(const std::string& csv) {
  std::vector<Cells> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

bool is_count(const std::string& metric) {
  static const std::set<std::string> kCounts{
      "predicted",          "true_predicted",    "visible",           "found",    "false_near",
      "false_leak",         "false_floating",    "visible_4",         "found_4",  "missed_unmapped",
      "missed_mislabelled", "missed_unlabelled", "true_predicted_t1", "found_t1", "boxes",
      "boxes_unseen"};
  return kCounts.contains(metric);
}

class TinyRun : public TinyStudy {
 protected:
  /// Value by class and metric of the only trial, from a sweep of one dose and seed.
  [[nodiscard]] std::map<std::pair<std::string, std::string>, std::string> swept(
      const std::string& set) const {
    const std::string into = path("swept");
    expect_done(mapscore({"sweep", study(), "-o", into, "-q", "--set", "seeds=1", "--set",
                          "sweep={}", "--set", set}));
    std::map<std::pair<std::string, std::string>, std::string> values;
    for (const Cells& row : rows_of(mapscore({"table", into, "--tidy"}).out))
      if (row[0] == "trial" && row[1] == "direct") values[{row[3], row[4]}] = row[5];
    return values;
  }
  [[nodiscard]] Outcome run(const std::string& set) const {
    const Outcome done = mapscore({"run", study(), "-o", results(), "-q", "--set", "seeds=1",
                                   "--set", "sweep={}", "--set", set, "--method", "direct"});
    expect_done(done);
    return done;
  }
  /// The file of that name below the results folder; there must be one.
  [[nodiscard]] std::filesystem::path found(const std::string& name) const {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(results()))
      if (entry.path().filename() == name) return entry.path();
    throw std::runtime_error("no " + name);
  }
};

TEST_F(TinyRun, WritesEachFrameAndTheyAddUpToTheTrial) {
  const Outcome done = run("score.unit=frame");
  EXPECT_THAT(done.out, HasSubstr("frames.csv\n"));
  const std::vector<Cells> rows = rows_of(bytes_of(found("frames.csv")));
  EXPECT_EQ(rows.at(0), (Cells{"frame", "stamp_s", "class", "metric", "value"}));
  std::map<std::pair<std::string, std::string>, std::int64_t> sums;
  std::set<std::string> frames;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    frames.insert(rows[r][0]);
    if (is_count(rows[r][3]) && rows[r][2] != "macro")
      sums[{rows[r][2], rows[r][3]}] += std::stoll(rows[r][4]);
  }
  EXPECT_EQ(frames, (std::set<std::string>{"0", "1", "2", "3"}));
  const auto trial = swept("score.unit=frame");
  ASSERT_EQ(sums.size(), 32u);  // of crate and pooled
  for (const auto& [what, sum] : sums)
    EXPECT_EQ(std::to_string(sum), trial.at(what)) << what.first << ' ' << what.second;
  EXPECT_GT((sums[{"crate", "visible"}]), 100);
}

TEST_F(TinyRun, WritesNoFramesOfAMapThatIsScoredAsAWhole) {
  EXPECT_THAT(run("score.unit=map").out, Not(HasSubstr("frames.csv")));
  EXPECT_THROW(static_cast<void>(found("frames.csv")), std::runtime_error);
}

TEST_F(TinyRun, InstancesOfAStudyAreThoseOfItsMap) {
  const auto trial = swept("score.instances=true");
  EXPECT_THAT(mapscore({"table", path("swept")}).out, HasSubstr("PQ"));
  // The last line that `run` prints tells how to score the map that it wrote.
  const Outcome done = run("score.instances=true");
  std::istringstream words(done.out.substr(done.out.find("mapscore score ")));
  std::vector<std::string> arguments;
  std::string word;
  std::string line;
  std::getline(words, line);
  std::istringstream split(line);
  split >> word;  // the program's name
  while (split >> word) arguments.push_back(word);
  arguments.insert(arguments.end(), {"--tidy", "-q"});
  const Outcome score = mapscore(arguments);
  expect_done(score);
  int compared = 0;
  for (const Cells& row : rows_of(score.out)) {
    if (!trial.contains({row[0], row[1]}) || row[1].starts_with("box")) continue;
    EXPECT_EQ(row[2], (trial.at({row[0], row[1]}))) << row[0] << ' ' << row[1];
    compared += row[1] == "pq" || row[1] == "sq" || row[1] == "rq" || row[1].starts_with("ap_");
  }
  EXPECT_EQ(compared, 21);  // of crate, pooled, macro
  EXPECT_EQ(trial.at({"crate", "instances_true_positive"}), "1");
}

TEST_F(TinyRun, TheCommandThatScoresTheMapSaysWhatTheStudyCounts) {
  const auto command = [&](const std::string& set) {
    const std::string out = run(set).out;
    return out.substr(out.find("mapscore score "));
  };
  EXPECT_THAT(command("score.min_samples=3"), HasSubstr(" --min_samples 3"));
  EXPECT_THAT(command("score.epsilon_m=0.002"), HasSubstr(" --epsilon_m 0.002"));
  EXPECT_THAT(command("seed=1"), Not(HasSubstr("--epsilon_m")));
}

TEST_F(TinyRun, InstancesAreNotScoredUnasked) {
  const auto trial = swept("seed=1");
  EXPECT_FALSE(trial.contains({"crate", "pq"}));
  EXPECT_THAT(mapscore({"table", path("swept")}).out, Not(HasSubstr("PQ")));
}

}  // namespace
}  // namespace mapscore::testing
