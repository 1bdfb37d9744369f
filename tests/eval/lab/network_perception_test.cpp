// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/lab/bench.hpp"
#include "eval/results/input_files.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::TinyExperiment;

/// The tiny recording and label images of a network beside it: 56 where the crate is, else 0.
class NetworkPerception : public TinyExperiment {
 protected:
  NetworkPerception() {
    fs::create_directory(folder() / "labels");
    for (int frame = 0; frame < recording().frame_count(); ++frame) write(frame, crate_of(frame));
    write_file(folder() / "classes.yaml", "classes: [{name: crate, label: 56}]\n");
  }

  [[nodiscard]] cv::Mat1w crate_of(int frame) const {
    cv::Mat1w image = cv::Mat1w::zeros(recording().read(frame).label.size());
    image.setTo(56, recording().read(frame).label == 1);
    return image;
  }
  void write(int frame, const cv::Mat1w& image) const {
    write_file(folder() / "labels" / fmt::format("{:06}.png", frame), encode_png(image));
  }
  [[nodiscard]] Study study(const std::string& lines,
                            const std::string& perception = kImages) const {
    return parse_study(
        "recording: tiny\nmethods:\n  direct: {segmentation: {direct: {}}}\n"
        "score: {labels: true}\nperception: " +
            perception + lines,
        folder() / "study.yaml");
  }
  [[nodiscard]] Task task(const Study& of) const {
    return task_of(of, trials(of)[0], Labels::detected, recording().content_hash());
  }
  [[nodiscard]] TrialResult result(const Task& of) const {
    Bench bench(recording(), table(), false, std::size_t{1} << 24);
    const auto run = bench.start(of);
    bench.run(*run);
    return run->finish();
  }
  [[nodiscard]] static Counts without_boxes(Counts counts) {
    for (ClassCounts& of_class : counts) of_class.boxes = {};
    return counts;
  }

  static constexpr const char* kImages = "{images: {folder: labels, classes: classes.yaml}}\n";
  static constexpr const char* kFaults =
      "faults: {misregistration: {magnitude_m: 0.02}, pose: {sigma_xy_m: 0.01}, depth: {preset: "
      "astra}, time_offset_ms: 500}\n";
};

TEST_F(NetworkPerception, OfThePerfectMasksGivesTheScoresOfTheTrueLabels) {
  for (const char* faults : {"", kFaults}) {
    const Study images = study(faults), labels = study(faults, "labels\n");
    const TrialResult of_images = result(task(images)), of_labels = result(task(labels));
    EXPECT_EQ(without_boxes(of_images.counts), without_boxes(of_labels.counts)) << faults;
    EXPECT_EQ(of_images.accounting, of_labels.accounting);
    EXPECT_EQ(of_images.counts[1].boxes.detections, 0) << "no instance of the truth is named";
    EXPECT_EQ(of_images.counts[1].boxes.unseen, recording().frame_count());
  }
}

TEST_F(NetworkPerception, ErrorsShowInTheImageAndInTheMap) {
  const TrialResult exact = result(task(study("")));
  EXPECT_EQ(exact.counts[1].labels->right_px, exact.counts[1].labels->true_px);
  EXPECT_EQ(exact.counts[1].labels->instances_found, recording().frame_count());
  write(0, cv::Mat1w::zeros(crate_of(0).size()));
  const TrialResult missed = result(task(study("")));
  EXPECT_EQ(missed.counts[1].labels->instances_found, recording().frame_count() - 1);
  EXPECT_LT(missed.counts[1].labels->right_px, exact.counts[1].labels->right_px);
  EXPECT_EQ(missed.accounting.detections, exact.accounting.detections - 1);
}

TEST_F(NetworkPerception, FaultsOfLabelsActOnItsMasksToo) {
  const TrialResult exact = result(task(study("")));
  const TrialResult grown = result(task(study("faults: {labels: {boundary_px: 2}}\n")));
  EXPECT_GT(grown.counts[1].labels->named_px, exact.counts[1].labels->named_px);
  EXPECT_EQ(grown.counts[1].labels->right_px, exact.counts[1].labels->right_px);
  const TrialResult none = result(task(study("faults: {labels: {miss: 1, miss_area_px: 1e6}}\n")));
  EXPECT_LT(none.accounting.detections, exact.accounting.detections);
}

TEST_F(NetworkPerception, ScoresReachTheMap) {
  const TrialResult plain = result(task(study("")));
  std::string rows = "image,id,score\n";
  for (int frame = 0; frame < recording().frame_count(); ++frame)
    rows += fmt::format("{:06}.png,56,0.5\n", frame);
  write_file(folder() / "scores.csv", rows);
  const char* scored = "{images: {folder: labels, classes: classes.yaml, scores: scores.csv}}\n";
  const TrialResult halved = result(task(study("", scored)));
  EXPECT_NE(halved.counts[1].curve, plain.counts[1].curve);
  EXPECT_EQ(value_of(plain.counts[1].labels->metrics(), "label_score_ece"), 0.0);
  EXPECT_EQ(value_of(halved.counts[1].labels->metrics(), "label_score_ece"), 0.5);
  EXPECT_THROW((void)study("faults: {labels: {scores: 0.5}}\n", scored), Error);
}

TEST_F(NetworkPerception, IsReadOnceForAllTrials) {
  write_file(folder() / "scores.csv", "image,id,score\n000000.png,56,0.5\n");
  const Task of =
      task(study("", "{images: {folder: labels, classes: classes.yaml, scores: scores.csv}}\n"));
  Bench bench(recording(), table(), false, std::size_t{1} << 24);
  const auto first = bench.start(of);
  fs::remove(folder() / "scores.csv");
  const auto second = bench.start(of);
  bench.run(*first);
  bench.run(*second);
  EXPECT_EQ(first->finish().counts, second->finish().counts);
}

TEST_F(NetworkPerception, TheKeyHoldsTheContentOfWhatIsRead) {
  const std::string key = task(study("")).key;
  fs::copy(folder() / "labels", folder() / "elsewhere");
  fs::copy(folder() / "classes.yaml", folder() / "same.yaml");
  EXPECT_EQ(task(study("", "{images: {folder: elsewhere, classes: same.yaml}}\n")).key, key);
  write_file(folder() / "same.yaml",
             "classes: [{name: crate, label: 56}, {name: wall, label: 2}]\n");
  EXPECT_NE(task(study("", "{images: {folder: labels, classes: same.yaml}}\n")).key, key);
  write_file(folder() / "scores.csv", "image,id,score\n");
  EXPECT_NE(
      task(study("", "{images: {folder: labels, classes: classes.yaml, scores: scores.csv}}\n"))
          .key,
      key);
  write(3, cv::Mat1w::zeros(crate_of(3).size()));
  EXPECT_NE(task(study("")).key, key);
  EXPECT_THAT(task(study("")).description, Not(HasSubstr("labels\n")));
}

TEST_F(NetworkPerception, CeilingsAreThoseOfTheTrueLabels) {
  const Plan of_images = plan(study(kFaults)), of_labels = plan(study(kFaults, "labels\n"));
  const PlannedTrial images = of_images.trials[0], labels = of_labels.trials[0];
  EXPECT_NE(of_images.tasks[images.task].key, of_labels.tasks[labels.task].key);
  EXPECT_EQ(of_images.tasks[images.registration_ceiling].key,
            of_labels.tasks[labels.registration_ceiling].key);
  EXPECT_EQ(of_images.tasks[images.lattice_ceiling].key,
            of_labels.tasks[labels.lattice_ceiling].key);
}

TEST_F(NetworkPerception, IsSweptBesideLabelsWithItsOwnParameters) {
  const Study swept = study("sweep: {perception: [labels, simulated, images]}\n");
  const Plan all = plan(swept);
  ASSERT_EQ(all.trials.size(), 3u);
  EXPECT_EQ(all.trials[2].spec.cell.doses.front(),
            (std::pair<std::string, std::string>("perception", "images")));
  EXPECT_EQ(all.tasks[all.trials[0].task].key, task(study("", "labels\n")).key);
  EXPECT_EQ(all.tasks[all.trials[1].task].key, task(study("", "simulated\n")).key);
  EXPECT_EQ(all.tasks[all.trials[2].task].key, task(study("")).key);
  EXPECT_EQ(parse_study(to_yaml(swept), folder() / "study.yaml"), swept);
}

TEST_F(NetworkPerception, ImagesThatDoNotFitAreRefusedBeforeAnyTrial) {
  check_network_labels(study(""), recording());
  write(2, cv::Mat1w(crate_of(2).size(), std::uint16_t{9}));
  try {
    check_network_labels(study("", "labels\n"), recording());
    check_network_labels(study("sweep: {perception: [labels, images]}\n", "labels\n"), recording());
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("perception.images.folder: is missing"));
  }
  try {
    check_network_labels(study("sweep: {perception: [labels, images]}\n"), recording());
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("25.0 % of the pixels"));
  }
}

/// The tiny recording and a network that sees the crate where it is, by tests/network.
class RunningNetwork : public NetworkPerception {
 protected:
  RunningNetwork() {
    write_file(folder() / "channels.yaml",
               "classes: [{name: crate, label: 1}, {name: wall, label: 2, detect: false}]\n");
    kept_.keep_in(folder() / "results");
  }

  [[nodiscard]] Study running(const std::string& lines, const std::string& name = "crate",
                              const std::string& more = "") const {
    return study(lines, fmt::format("{{network: {{model: {}/tests/network/{}.onnx, classes: "
                                    "channels.yaml{}}}}}\n",
                                    MAPSCORE_SOURCE_DIR, name, more));
  }
  [[nodiscard]] TrialResult of_network(const Task& of) const {
    Bench bench(kept_, table(), false, std::size_t{1} << 24);
    const auto run = bench.start(of);
    bench.run(*run);
    return run->finish();
  }
  [[nodiscard]] fs::path inferred() const {
    const fs::directory_iterator folders(folder() / "results/networks");
    return folders->path();
  }

 private:
  Recording kept_ = recording();
};

TEST_F(RunningNetwork, GivesWhatItsLabelImagesGive) {
  for (const char* faults : {"", kFaults, "faults: {labels: {boundary_px: 2, confusion: 0.5}}\n"}) {
    const TrialResult of_model = of_network(task(running(faults)));
    const std::string images = fmt::format(
        "{{images: {{folder: {0}, classes: {0}/classes.yaml, scores: {0}/scores.csv, "
        "confidence: {0}/confidence}}}}\n",
        inferred().string());
    const TrialResult of_images = result(task(study(faults, images)));
    EXPECT_EQ(of_model.counts, of_images.counts) << faults;
    EXPECT_EQ(of_model.accounting, of_images.accounting) << faults;
    EXPECT_GT(of_model.counts[1].predicted, 0);
    EXPECT_EQ(of_model.counts[1].labels->instances_found, recording().frame_count());
  }
}

TEST_F(RunningNetwork, SeesNoFaultOfDepthCalibrationOrTime) {
  (void)of_network(task(running("", "near")));
  const fs::path first = inferred();
  (void)of_network(task(running(kFaults, "near")));
  EXPECT_EQ(inferred(), first);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder() / "results/networks"), {}), 1);
}

TEST_F(RunningNetwork, IsInferredOnceForAllCells) {
  Recording of = recording();
  of.keep_in(folder() / "results");
  std::vector<std::pair<int, int>> shown;
  const Study swept = running("sweep: {faults.misregistration.magnitude_m: [0, 0.01, 0.02]}\n");
  const auto show = [&](int done, int all) { shown.emplace_back(done, all); };
  infer_networks(swept, of, 2, show);
  ASSERT_EQ(shown.size(), 4u);
  EXPECT_EQ(shown.back(), std::pair(4, 4));
  infer_networks(swept, of, 2, show);
  EXPECT_EQ(shown.size(), 4u);
}

TEST_F(RunningNetwork, TheKeyHoldsTheContentOfItsFiles) {
  const std::string key = task(running("")).key;
  fs::copy(fs::path(MAPSCORE_SOURCE_DIR) / "tests/network/crate.onnx", folder() / "same.onnx");
  EXPECT_EQ(task(study("", "{network: {model: same.onnx, classes: channels.yaml}}\n")).key, key);
  EXPECT_NE(task(running("", "crate_any_size")).key, key);
  EXPECT_NE(task(running("", "crate", ", scale: 0.5")).key, key);
  write_file(folder() / "channels.yaml", "classes: [{name: crate, label: [1, 2]}]\n");
  EXPECT_NE(task(running("")).key, key);
  EXPECT_THAT(task(running("")).description, Not(HasSubstr("channels.yaml")));
}

TEST_F(RunningNetwork, CeilingsAreThoseOfTheTrueLabels) {
  const Plan of_network = plan(running(kFaults)), of_labels = plan(study(kFaults, "labels\n"));
  const PlannedTrial network = of_network.trials[0], labels = of_labels.trials[0];
  EXPECT_EQ(of_network.tasks[network.registration_ceiling].key,
            of_labels.tasks[labels.registration_ceiling].key);
  EXPECT_EQ(of_network.tasks[network.lattice_ceiling].key,
            of_labels.tasks[labels.lattice_ceiling].key);
}

TEST_F(RunningNetwork, IsSweptBesideTheOthersAndOverItsModels) {
  const std::string models = fmt::format("[{0}/crate.onnx, {0}/crate_any_size.onnx]",
                                         std::string(MAPSCORE_SOURCE_DIR) + "/tests/network");
  const Plan kinds = plan(running("sweep: {perception: [labels, simulated, network]}\n"));
  ASSERT_EQ(kinds.trials.size(), 3u);
  EXPECT_EQ(kinds.tasks[kinds.trials[2].task].key, task(running("")).key);
  const Plan two = plan(running("sweep: {perception.network.model: " + models + "}\n"));
  ASSERT_EQ(two.trials.size(), 2u);
  EXPECT_NE(two.tasks[two.trials[0].task].key, two.tasks[two.trials[1].task].key);
}

TEST_F(RunningNetwork, WhatIsMissingOrContradictsIsRefused) {
  const auto refusal = [&](const auto& act) -> std::string {
    try {
      act();
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal([&] { (void)study("", "network\n"); }),
              HasSubstr("perception.network.model: is missing"));
  EXPECT_THAT(refusal([&] { (void)study("", "{network: {model: a.onnx}}\n"); }),
              HasSubstr("perception.network.classes: is missing"));
  EXPECT_THAT(refusal([&] { (void)running("faults: {labels: {scores: 0.5}}\n"); }),
              HasSubstr("faults.labels.scores: stands beside perception.network"));
  EXPECT_THAT(refusal([&] { (void)result(task(running(""))); }),
              HasSubstr("no folder of results is known"));
}

}  // namespace
}  // namespace mapscore::eval
