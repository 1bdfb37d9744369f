// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/tiny_study.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <thread>

// A network that runs in the loop, by the built program.

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// The tiny study with a network of tests/network in the part of the label images.
class NetworkInTheLoop : public TinyStudy {
 protected:
  NetworkInTheLoop() {
    write_text(path("classes.yaml"),
               "classes: [{name: crate, label: 1}, {name: wall, label: 2, detect: false}]\n");
    perceive(fmt::format("{{network: {{model: {}, classes: classes.yaml}}}}", model("crate")));
  }

  [[nodiscard]] static std::string model(const std::string& name) {
    return fmt::format("{}/tests/network/{}.onnx", MAPSCORE_SOURCE_DIR, name);
  }
  void perceive(const std::string& how) const {
    write_text(study(),
               fmt::format("{}perception: {}\nscore: {{labels: true}}\n", std::string(kText), how));
  }
  [[nodiscard]] Outcome sweep(const std::string& to, const std::vector<std::string>& more) const {
    std::vector<std::string> words{"sweep", study(), "-o", path(to)};
    words.insert(words.end(), more.begin(), more.end());
    return mapscore(words);
  }
  [[nodiscard]] std::string tidy(const std::string& results) const {
    return mapscore({"table", path(results), "--tidy"}).out;
  }
  /// The folder that a network's label images are in.
  [[nodiscard]] fs::path inferred(const std::string& results) const {
    return fs::directory_iterator(path(results) + "/networks")->path();
  }
};

TEST_F(NetworkInTheLoop, GivesTheRowsOfItsLabelImages) {
  expect_done(sweep("results", {"-q"}));
  const std::string folder = fs::absolute(inferred("results"));
  perceive(
      fmt::format("{{images: {{folder: {0}, classes: {0}/classes.yaml, scores: "
                  "{0}/scores.csv, confidence: {0}/confidence}}}}",
                  folder));
  expect_done(sweep("of_images", {"-q"}));
  EXPECT_EQ(tidy("of_images"), tidy("results"));
  for (const char* metric : {"label_iou", "label_pq", "label_fwiou", "label_boundary_f",
                             "label_pixel_ece", "label_score_bin", "label_taken_for:crate"})
    EXPECT_THAT(tidy("results"), HasSubstr(metric));
}

TEST_F(NetworkInTheLoop, ScoreReadsItsFolderByItsClassFile) {
  expect_done(sweep("results", {"-q"}));
  const std::string folder = inferred("results");
  const auto score = [&] {
    return mapscore({"score", folder, "--truth", path("tiny"), "--detect", "crate", "--tidy",
                     "--legend", folder + "/classes.yaml"});
  };
  const Outcome scored = score();
  expect_done(scored);
  const std::string rows = tidy("results"), key = ",crate,label_iou,";
  const std::size_t at = rows.find(key) + key.size();
  EXPECT_THAT(scored.out, HasSubstr("crate,iou," + rows.substr(at, rows.find('\n', at) - at)));
  write_text(folder + "/classes.yaml", "classes: [{name: crate, label: 9}]\n");
  expect_refused(score(), {"no class", "1"});
}

TEST_F(NetworkInTheLoop, TenDosesInferEachFrameOnceAndASecondSweepNone) {
  const std::string doses =
      "sweep={faults.misregistration.magnitude_m: [0, 1e-3, 2e-3, 3e-3, 4e-3, 5e-3, 6e-3, 7e-3, "
      "8e-3, 9e-3]}";
  const Outcome first = sweep("results", {"--set", doses});
  expect_done(first);
  EXPECT_THAT(first.err, HasSubstr("networks 4/4 frames"));
  const fs::file_time_type made = fs::last_write_time(inferred("results") / "scores.csv");
  const Outcome more = sweep("results", {"--set", doses, "--set", "seeds=3"});
  expect_done(more);
  EXPECT_THAT(more.err, Not(HasSubstr("networks")));
  EXPECT_EQ(fs::last_write_time(inferred("results") / "scores.csv"), made);
  EXPECT_EQ(std::distance(fs::directory_iterator(results() + "/networks"), {}), 1);
}

TEST_F(NetworkInTheLoop, JobsAndShardsGiveTheSameBytes) {
  expect_done(sweep("one", {"-q", "-j", "1"}));
  expect_done(sweep("two", {"-q", "-j", "2"}));
  expect_done(sweep("shards", {"-q", "--shard", "1/2"}));
  expect_done(sweep("shards", {"-q", "--shard", "2/2"}));
  expect_done(sweep("shards", {"-q"}));
  EXPECT_EQ(tidy("two"), tidy("one"));
  EXPECT_EQ(tidy("shards"), tidy("one"));
  for (const std::string name : {"two", "shards"})
    for (const char* file : {"000003.png", "scores.csv", "label.txt", "network.txt"})
      EXPECT_EQ(bytes_of(inferred(name) / file), bytes_of(inferred("one") / file)) << name << file;
}

TEST_F(NetworkInTheLoop, TrialAndMapSeeWhatRunSees) {
  for (const std::vector<std::string>& faults :
       {std::vector<std::string>{}, {"--set", "faults.labels.boundary_px=1"}}) {
    std::vector<std::string> run{"run", study(), "-o", results(), "-q"};
    std::vector<std::string> trial{"trial",     study(),   "-o", path("trial"),
                                   "--results", results(), "-q"};
    run.insert(run.end(), faults.begin(), faults.end());
    trial.insert(trial.end(), faults.begin(), faults.end());
    expect_done(mapscore(run));
    expect_done(mapscore(trial));
    expect_done(mapscore({"map", path("trial"), "-o", path("map.ot"), "-q"}));
    std::string of_run;
    for (const auto& entry : fs::recursive_directory_iterator(results() + "/runs"))
      if (entry.path().filename() == "map.ot") of_run = bytes_of(entry.path());
    EXPECT_GT(of_run.size(), 300u);
    EXPECT_EQ(bytes_of(path("map.ot")), of_run);
    fs::remove_all(path("trial"));
    fs::remove_all(results() + "/runs");
  }
}

TEST_F(NetworkInTheLoop, KilledWhileInferringLeavesNothingHalf) {
  expect_done(sweep("whole", {"-q"}));
  const std::string name = inferred("whole").filename();
  for (const int wait_ms : {20, 40, 45, 50, 55, 60, 70, 100}) {
    Process process(mapscore_command({"sweep", study(), "-o", results(), "-q"}));
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    process.kill();
    if (fs::exists(results() + "/networks/" + name)) {
      EXPECT_EQ(contents_of(results() + "/networks/" + name), contents_of(inferred("whole")));
    }
  }
  expect_done(sweep("results", {"-q"}));
  EXPECT_EQ(contents_of(results() + "/networks"), contents_of(path("whole/networks")));
  EXPECT_EQ(tidy("results"), tidy("whole"));
}

TEST_F(NetworkInTheLoop, ResultsAreReadAfterTheyAreMoved) {
  expect_done(sweep("results", {"-q"}));
  const Outcome listed = mapscore({"trials", results()});
  expect_done(listed);
  fs::create_directory(path("there"));
  for (const char* one : {"results", "tiny", "classes.yaml", "study.yaml"})
    fs::rename(path(one), path(std::string("there/") + one));
  const Outcome figures = mapscore({"figures", path("there/results")});
  expect_done(figures);
  fs::remove_all(path("there/results/networks"));
  expect_done(mapscore({"figures", path("there/results")}));
}

TEST_F(NetworkInTheLoop, DamagedImagesAreInferredAnew) {
  expect_done(sweep("whole", {"-q", "--set", "seeds=3"}));
  const auto expect_mended = [&](const char* file, const std::string& bytes) {
    fs::remove_all(results());
    expect_done(sweep("results", {"-q"}));
    write_text(inferred("results") / file, bytes);
    const Outcome again = sweep("results", {"--set", "seeds=3"});
    expect_done(again);
    EXPECT_THAT(again.err, HasSubstr("networks 4/4 frames")) << file;
    EXPECT_EQ(tidy("results"), tidy("whole"));
    EXPECT_EQ(contents_of(results() + "/networks"), contents_of(path("whole/networks")));
  };
  const fs::path of_whole = inferred("whole");
  expect_mended("000002.png", bytes_of(of_whole / "000003.png"));
  expect_mended("confidence/000001.png", "");
  expect_mended("scores.csv", "image,u,v,score\n");
  expect_mended("network.txt", "");
}

TEST_F(NetworkInTheLoop, AModelThatChangedIsNotTakenForTheOneThatWasSwept) {
  write_text(path("mine.onnx"), bytes_of(model("crate")));
  perceive("{network: {model: mine.onnx, classes: classes.yaml}}");
  expect_done(sweep("results", {"-q"}));
  const std::string trials = mapscore({"trials", results(), "--format", "csv"}).out;
  const std::string key = trials.substr(trials.find('\n') + 1, 12);
  expect_done(mapscore({"run", results(), "--trial", key, "-q"}));
  write_text(path("mine.onnx"), bytes_of(model("crate_half_size")));
  expect_refused(mapscore({"run", results(), "--trial", key, "-q"}),
                 {"network mine.onnx", "not as it was", "sweep again"});
  const Outcome figures = mapscore({"figures", results()});
  EXPECT_EQ(figures.exit_code, 2);
  EXPECT_THAT(figures.err, HasSubstr("network mine.onnx"));
  expect_done(sweep("results", {"-q"}));
  expect_done(mapscore({"figures", results()}));
}

TEST_F(NetworkInTheLoop, DetectedClassesWithoutALabelAreNamed) {
  write_text(path("classes.yaml"),
             "classes: [{name: wall, label: 1}, {name: crate, label: 2, detect: false}]\n");
  const Outcome swept = sweep("results", {});
  expect_done(swept);
  EXPECT_THAT(swept.err, HasSubstr("classes.yaml has no label for crate"));
}

TEST_F(NetworkInTheLoop, WhatDoesNotFitEndsTheSweepInOneLine) {
  const auto refused = [&](const std::string& file, const std::vector<std::string>& parts) {
    expect_refused(sweep("results", {"-q", "--set", "perception.network.model=" + file}), parts);
    EXPECT_FALSE(fs::exists(results() + "/results.sqlite"));
  };
  refused(model("five_channels"), {"five_channels.onnx", "1 x 5 x 48 x 64", "1 x 3 x 48 x 64"});
  refused(model("wide"), {"1 x 3 x 48 x 96", "48 x 64"});
  refused(model("opset_17"), {"operator set 17", "opset_version=11"});
  refused(model("nan_weights"), {"'kernel'", "not finite"});
  refused(model("overflowing"), {"000000.png", "not of finite numbers"});
  refused(model("unknown_operator"), {"no operator Det"});
  refused(model("relu6"), {"does not read operator Clip in this form"});
  refused(model("crate_softmax"), {"perception.network.output: probabilities"});
  write_text(path("cut.onnx"), bytes_of(model("crate")).substr(0, 150));
  refused("cut.onnx", {"cut.onnx", "cut short"});
  refused("none.onnx", {"none.onnx", "no such file"});
  write_text(path("classes.yaml"), "classes: [{name: crate, label: 1}]\n");
  refused(model("crate"), {"classes.yaml", "label 2", "crate.onnx has 3 channels"});
  const Outcome dry = sweep("results", {"--dry_run"});
  expect_refused(dry, {"classes.yaml", "label 2"});
}

}  // namespace
}  // namespace mapscore::testing
