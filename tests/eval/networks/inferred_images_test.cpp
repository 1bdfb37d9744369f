// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/networks/inferred_images.hpp"

#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "tests/eval/networks/tiny_networks.hpp"
#include "tests/support/tiny_recording.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <stdexcept>

namespace mapscore::eval::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kClasses =
    "classes: [{name: crate, label: 1}, {name: wall, label: 2, detect: false}]\n";

class InferredImages : public ::testing::Test {
 protected:
  InferredImages() {
    mapscore::testing::write_tiny_recording(folder() / "tiny");
    classes(kClasses);
  }

  [[nodiscard]] const fs::path& folder() const { return temporary_.path(); }
  [[nodiscard]] Recording recording() const { return Recording::open(folder() / "tiny"); }
  void classes(const std::string& text) const { write_file(folder() / "classes.yaml", text); }
  [[nodiscard]] NetworkModel network(const std::string& name) const {
    return {tiny_network(name), folder() / "classes.yaml"};
  }
  [[nodiscard]] NetworkImages inferred(const NetworkModel& model, int jobs = 1,
                                       const std::string& results = "results") const {
    return inferred_images(model, recording(), folder() / results, jobs,
                           [this](int, int) { ++frames_; });
  }
  [[nodiscard]] std::string refusal(const std::string& name) const {
    return refusal_of([&] { (void)inferred(network(name)); });
  }
  /// Every file below `below`, by its path from there.
  [[nodiscard]] std::map<std::string, std::string> files(const std::string& below) const {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder() / below))
      if (entry.is_regular_file())
        found[fs::relative(entry.path(), folder() / below)] = read_file(entry.path());
    return found;
  }

  mutable int frames_ = 0;

 private:
  mapscore::testing::TemporaryFolder temporary_;
};

TEST_F(InferredImages, AreThoseOfTheRecordingWhereTheNetworkIsRight) {
  const Recording of = recording();
  const NetworkLabels labels(inferred(network("crate")), of, of.info().table);
  for (int frame = 0; frame < of.frame_count(); ++frame) {
    const NetworkDetections found = labels.of(frame);
    const cv::Mat1b crate = of.read(frame).label == 1, seen = found.instances != 0;
    EXPECT_EQ(cv::countNonZero(crate != seen), 0);
    ASSERT_EQ(found.scores.size(), of.info().table.instances.size() + 1);
    const double e = std::exp(2.55), background = std::exp(1.0);
    EXPECT_NEAR(found.scores.back(), e / (e + background + 1.0), 1e-6);
    const auto verdicts = labels.verdicts_of(frame);
    const cv::Mat1b sure = verdicts->thousandths == 775;  // 0.774996
    EXPECT_EQ(cv::countNonZero(crate & ~sure), 0);
    EXPECT_EQ(cv::countNonZero(crate & (verdicts->classes != 1)), 0);
  }
}

TEST_F(InferredImages, ScoreEachComponentByTheMeanOfItsOwnPixels) {
  // The left crate is fully red, the right one half of it, so that their probabilities differ.
  cv::Mat3b image(48, 64, cv::Vec3b(128, 128, 128));
  image(cv::Rect(2, 3, 10, 10)).setTo(cv::Vec3b(0, 0, 255));
  image(cv::Rect(30, 20, 10, 10)).setTo(cv::Vec3b(0, 0, 255));
  image(cv::Rect(30, 20, 5, 10)).setTo(cv::Vec3b(0, 0, 170));
  const fs::path color = folder() / "tiny/color/000001.png";
  write_file(color, encode_png(image));
  fs::remove(folder() / "tiny/hashes.txt");
  const Recording of = recording();
  const NetworkLabels labels(inferred(network("crate")), of, of.info().table);
  const auto probability = [](double red) {
    const double e = std::exp(0.01 * red);
    return e / (e + std::exp(1.0) + 1.0);
  };
  const NetworkDetections found = labels.of(1);
  EXPECT_NEAR(found.scores.at(found.instances(4, 4)), probability(255), 1e-6);
  EXPECT_NEAR(found.scores.at(found.instances(22, 38)), (probability(255) + probability(170)) / 2,
              1e-6);
}

TEST_F(InferredImages, AreInferredOnceAndTheSameForAnyNumberOfJobs) {
  const NetworkImages first = inferred(network("crate"));
  EXPECT_EQ(frames_, 4);
  const auto files_of_one = files("results");
  EXPECT_EQ(inferred(network("crate"), 2), first);
  EXPECT_EQ(frames_, 4) << "inferred again";
  (void)inferred(network("crate"), 3, "others");
  EXPECT_EQ(frames_, 8);
  EXPECT_EQ(files("others"), files_of_one);
  EXPECT_EQ(files_of_one.size(), 2 * 4u + 4u) << "images, list, scores, classes and origin";
}

TEST_F(InferredImages, OfAnotherFileOrSettingAreOthers) {
  const fs::path first = inferred(network("crate")).folder;
  NetworkModel scaled = network("crate");
  scaled.scale = 0.5;
  EXPECT_NE(inferred(scaled).folder, first);
  EXPECT_NE(inferred(network("crate_any_size")).folder, first);
  fs::copy(tiny_network("crate"), folder() / "renamed.onnx");
  EXPECT_EQ(inferred({folder() / "renamed.onnx", folder() / "classes.yaml"}).folder, first);
  classes("classes: [{name: crate, label: [1, 2]}]\n");
  EXPECT_NE(inferred(network("crate")).folder, first);
}

TEST_F(InferredImages, AreThereWholeOrNotAtAll) {
  const auto stop = [](int done, int) {
    if (done == 2) throw std::runtime_error("stop");
  };
  EXPECT_THROW((void)inferred_images(network("crate"), recording(), folder() / "results", 1, stop),
               std::runtime_error);
  EXPECT_TRUE(files("results").empty());
  const NetworkImages whole = inferred(network("crate"), 1, "others");
  const fs::path left = folder() / "results/networks" /
                        (whole.folder.filename().string() + ".partial");  // by one that was killed
  fs::create_directories(left);
  write_file(left / "000009.png", "half");
  (void)inferred(network("crate"));
  EXPECT_EQ(files("results"), files("others"));
}

TEST_F(InferredImages, DepthIsRegisteredByTheTrueCalibrationToTheColourPixels) {
  const Recording of = recording();
  const NetworkLabels labels(inferred(network("near")), of, of.info().table);
  int differing = 0, near = 0;
  for (int frame = 0; frame < of.frame_count(); ++frame) {
    const cv::Mat1b crate = of.read(frame).label == 1, seen = labels.of(frame).instances != 0;
    near += cv::countNonZero(seen);
    differing += cv::countNonZero(crate != seen);
  }
  // The crate alone is nearer than 2 m; at its left edge the depth camera, beside the other, sees
  // what the colour camera does not.
  EXPECT_GT(near, 800);
  EXPECT_LT(differing, near / 5);
}

TEST_F(InferredImages, ClassesThatDoNotFitTheOutputAreRefused) {
  classes("classes: [{name: crate, label: 1}, {name: wall, label: 3}]\n");
  EXPECT_THAT(refusal("crate"),
              AllOf(HasSubstr("classes.yaml: names label 3, and the output of crate.onnx has 3 "
                              "channels, 0 to 2")));
  classes("classes: [{name: crate, label: 1}]\n");
  EXPECT_THAT(refusal("crate"),
              HasSubstr("classes.yaml: names no class of label 2, and the output of crate.onnx"));
  classes("classes: [{name: crate}]\ninstances: [{id: 1, class: crate}]\n");
  EXPECT_THAT(refusal("crate"), HasSubstr("lists instances"));
  classes("classes: [{name: crat, label: 1}, {name: wall, label: 2, detect: false}]\n");
  EXPECT_THAT(refusal("crate"), HasSubstr("the recording has no class 'crat'"));
  EXPECT_TRUE(files("results").empty());
}

TEST_F(InferredImages, ANetworkThatNeedsDepthIsRefusedWhereThereIsNone) {
  for (const auto& entry : fs::directory_iterator(folder() / "tiny/depth"))
    write_file(entry.path(), encode_png(cv::Mat1w(48, 64, std::uint16_t{0})));
  fs::remove(folder() / "tiny/hashes.txt");
  EXPECT_THAT(refusal("near"), HasSubstr("near.onnx: takes depth as its fourth channel, and no "
                                         "depth image of"));
  EXPECT_EQ(refusal("crate"), "accepted");
}

}  // namespace
}  // namespace mapscore::eval::testing
