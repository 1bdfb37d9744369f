// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/network_labels.hpp"

#include "core/error.hpp"
#include "core/segmentation/detection.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "tests/support/tiny_recording.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <functional>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// The tiny recording and beside it a folder of label images: 56 where the crate is, 7 where the
/// wall is, else 0.
class NetworkFolder : public ::testing::Test {
 protected:
  NetworkFolder() {
    fs::create_directory(labels());
    for (int frame = 0; frame < recording_.frame_count(); ++frame) {
      cv::Mat1w image = recording_.read(frame).label.clone();
      image.setTo(56, image == 1);
      image.setTo(7, image == 2);
      write(frame, image);
    }
    write_classes("classes: [{name: crate, label: 56}, {name: wall, label: 7, detect: false}]\n");
  }

  [[nodiscard]] fs::path labels() const { return temporary_.path() / "labels"; }
  [[nodiscard]] fs::path image(int frame) const {
    return labels() / fmt::format("{:06}.png", frame);
  }
  void write(int frame, const cv::Mat1w& labels) const {
    write_file(image(frame), encode_png(labels));
  }
  void write_classes(const std::string& text) const {
    write_file(temporary_.path() / "classes.yaml", text);
  }
  void write_scores(const std::string& text) {
    write_file(temporary_.path() / "scores.csv", text);
    scores_ = temporary_.path() / "scores.csv";
  }
  [[nodiscard]] NetworkImages images(ClassMasks masks = ClassMasks::components) const {
    return {labels(), temporary_.path() / "classes.yaml", masks, scores_};
  }
  [[nodiscard]] NetworkLabels read(ClassMasks masks = ClassMasks::components) const {
    return {images(masks), recording_, recording_.info().table};
  }
  [[nodiscard]] std::string refusal(ClassMasks masks = ClassMasks::components) const {
    try {
      (void)content_of(images(masks));
      read(masks).check();
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  }
  [[nodiscard]] const Recording& recording() const { return recording_; }

 private:
  [[nodiscard]] fs::path written() const {
    testing::write_tiny_recording(temporary_.path() / "tiny");
    return temporary_.path() / "tiny";
  }

  testing::TemporaryFolder temporary_;
  Recording recording_ = Recording::open(written());
  std::optional<fs::path> scores_;
};

TEST_F(NetworkFolder, OfPerfectLabelsGivesTheDetectionsOfTheTruth) {
  const NetworkLabels network = read();
  network.check();
  for (int frame = 0; frame < recording().frame_count(); ++frame) {
    const NetworkDetections found = network.of(frame);
    const auto expected = detections_of(recording().read(frame).label, recording().info().table);
    const auto detections = detections_of(found.instances, found.table);
    ASSERT_EQ(detections.size(), expected.size());
    for (std::size_t n = 0; n < expected.size(); ++n) {
      EXPECT_EQ(detections[n].class_id, expected[n].class_id);
      EXPECT_EQ(detections[n].box, expected[n].box);
      EXPECT_EQ(cv::countNonZero(detections[n].mask != expected[n].mask), 0);
      EXPECT_GE(detections[n].instance, recording().info().table.instances.size());
    }
  }
}

/// Two crates apart, of values a and b.
cv::Mat1w two_crates(cv::Size size, int a, int b) {
  cv::Mat1w image = cv::Mat1w::zeros(size);
  image(cv::Rect(2, 2, 5, 5)).setTo(a);
  image(cv::Rect(20, 2, 5, 5)).setTo(b);
  return image;
}

TEST_F(NetworkFolder, MasksAreComponentsClassesOrValues) {
  const cv::Size size = recording().read(0).label.size();
  const auto masks = [&](ClassMasks how) {
    const NetworkDetections found = read(how).of(0);
    return detections_of(found.instances, found.table).size();
  };
  write(0, two_crates(size, 56, 56));
  EXPECT_EQ(masks(ClassMasks::components), 2u);
  EXPECT_EQ(masks(ClassMasks::classes), 1u);
  cv::Mat1w touching = two_crates(size, 56 * 256 + 1, 56 * 256 + 2);
  touching(cv::Rect(7, 2, 13, 5)).setTo(56 * 256 + 2);
  write(0, touching);
  EXPECT_EQ(masks(ClassMasks::instances), 2u);
  EXPECT_EQ(masks(ClassMasks::components), 0u) << "14337 is no class there";
}

TEST_F(NetworkFolder, SeveralLabelsOfOneClass) {
  write_classes(
      "classes: [{name: crate, label: [56, 60]}, {name: wall, label: 7, detect: false}]\n");
  write(0, two_crates(recording().read(0).label.size(), 56, 60));
  const NetworkDetections found = read().of(0);
  EXPECT_EQ(detections_of(found.instances, found.table).size(), 2u);
  EXPECT_EQ(refusal(), "accepted");
}

TEST_F(NetworkFolder, AListOfInstancesSaysWhatValuesAre) {
  write_classes(
      "classes: [{name: crate}]\ninstances: [{id: 9, class: crate}, {id: 11, class: crate}]\n");
  write(0, two_crates(recording().read(0).label.size(), 9, 11));
  const NetworkDetections found = read(ClassMasks::instances).of(0);
  EXPECT_EQ(detections_of(found.instances, found.table).size(), 2u);
  EXPECT_THAT(refusal(ClassMasks::components), HasSubstr("write masks: instances"));
}

TEST_F(NetworkFolder, ScoresAreOfPixelValues) {
  write(1, two_crates(recording().read(0).label.size(), 56 * 256 + 1, 56 * 256 + 2));
  write_scores(fmt::format("image,id,score\n000001.png,{},0.25\n000001.png,{},0.75\n", 56 * 256 + 2,
                           56 * 256 + 1));
  const auto by_name = read(ClassMasks::instances).of(1);
  const std::size_t first = recording().info().table.instances.size();
  EXPECT_EQ(by_name.scores.at(first), 0.75);
  EXPECT_EQ(by_name.scores.at(first + 1), 0.25);
  write_scores(fmt::format("stamp_s,id,score\n{},{},0.5\n", recording().color_stamp_s(1) + 0.01,
                           56 * 256 + 1));
  const auto by_stamp = read(ClassMasks::instances).of(1);
  EXPECT_EQ(by_stamp.scores.at(first), 0.5);
  EXPECT_EQ(by_stamp.scores.at(first + 1), 1.0);
}

TEST_F(NetworkFolder, ScoresOfPixelsAreOfTheDetectionsThatHoldThem) {
  write(1, two_crates(recording().read(0).label.size(), 56, 56));
  write_scores("image,u,v,score\n000001.png,21,3,0.25\n000001.png,2,2,0.75\n000001.png,0,0,0\n");
  const auto found = read().of(1);
  const std::size_t first = recording().info().table.instances.size();
  EXPECT_EQ(found.scores.at(first), 0.75);
  EXPECT_EQ(found.scores.at(first + 1), 0.25) << "of one class, which a value cannot tell apart";
  EXPECT_EQ(found.scores.at(0), 1.0);
  EXPECT_EQ(refusal(), "accepted");
  write_scores(fmt::format("stamp_s,u,v,score\n{},6,6,0.5\n", recording().color_stamp_s(1)));
  EXPECT_EQ(read().of(1).scores.at(first), 0.5);
  EXPECT_EQ(read().of(1).scores.at(first + 1), 1.0);
}

TEST_F(NetworkFolder, AStampedScoreIsOfTheNearestImage) {
  std::string list;  // 15 ms apart
  for (int frame = 0; frame < recording().frame_count(); ++frame)
    list += fmt::format("{:.3f} {}\n", 0.5 + 0.015 * frame, recording().color_path(frame));
  write_file(recording().folder() / "color.txt", list);
  const Recording fast = Recording::open(recording().folder());
  write_scores("stamp_s,id,score\n0.516,56,0.5\n0.531,56,0.75\n0.49,56,0.25\n");
  const NetworkLabels network(images(), fast, fast.info().table);
  const std::size_t crate = fast.info().table.instances.size();
  EXPECT_EQ(network.of(0).scores.at(crate), 0.25);
  EXPECT_EQ(network.of(1).scores.at(crate), 0.5);
  EXPECT_EQ(network.of(2).scores.at(crate), 0.75);
  EXPECT_EQ(network.of(3).scores.at(crate), 1.0);
}

TEST_F(NetworkFolder, ScoresOfWhichNoneIsOfAPixelAreRefused) {
  write_scores("image,id,score\n000001.png,57,0.5\n");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("scores.csv: no id is a pixel value of its image"),
                               HasSubstr("57 of 000001.png"), HasSubstr("56")));
  write_scores("image,id,score\n000001.png,57,0.5\n000002.png,56,0.5\n");
  EXPECT_EQ(refusal(), "accepted") << "a network may list what it suppressed";
}

TEST_F(NetworkFolder, StampsNameImagesWhereThereIsAList) {
  std::string list;
  for (int frame = 0; frame < recording().frame_count(); ++frame) {
    fs::rename(image(frame), labels() / fmt::format("{}.png", 'a' + frame));
    list += fmt::format("{} {}.png\n", recording().color_stamp_s(frame) - 0.015, 'a' + frame);
  }
  EXPECT_THAT(refusal(), AllOf(HasSubstr("000000.png"), HasSubstr("missing")));
  write_file(labels() / "label.txt", list);
  EXPECT_EQ(refusal(), "accepted");
  write_file(labels() / "label.txt", list.substr(0, list.rfind('\n', list.size() - 2) + 1));
  EXPECT_THAT(refusal(), HasSubstr("no label image within 0.02 s of the colour image at 1.5 s"));
  write_file(labels() / "label.txt", "0 ../tiny/label/000000.png\n");
  EXPECT_THAT(refusal(), HasSubstr("leads out of the folder"));
}

TEST_F(NetworkFolder, TheContentIsThatOfImagesClassesAndScores) {
  const std::string plain = content_of(images());
  EXPECT_EQ(content_of(images(ClassMasks::classes)), plain);
  write_scores("image,id,score\n");
  const std::string scored = content_of(images());
  EXPECT_NE(scored, plain);
  write_classes("classes: [{name: crate, label: 56}]\n");
  EXPECT_NE(content_of(images()), scored);
  const std::string before = content_of(images());
  write(2, cv::Mat1w::zeros(recording().read(0).label.size()));
  EXPECT_NE(content_of(images()), before);
}

TEST_F(NetworkFolder, WrongFilesAreNamed) {
  const cv::Size size = recording().read(0).label.size();
  struct Case {
    const char* what;
    std::function<void()> spoil;
    std::vector<std::string> said;
  };
  const std::vector<Case> cases{
      {"folder", [&] { fs::remove_all(labels()); }, {"labels: no such folder"}},
      {"empty",
       [&] {
         fs::remove_all(labels());
         fs::create_directory(labels());
       },
       {"labels: holds no label image"}},
      {"missing", [&] { fs::remove(image(2)); }, {"000002.png: label image is missing"}},
      {"size", [&] { write(1, cv::Mat1w::zeros(cv::Size(7, 5))); }, {"000001.png", "7 x 5"}},
      {"colour",
       [&] { cv::imwrite(image(1).string(), cv::Mat3b(size, cv::Vec3b(1, 2, 3))); },
       {"000001.png", "grey or palette"}},
      {"damaged", [&] { write_file(image(1), "no image"); }, {"000001.png", "not a PNG"}},
      {"ids",
       [&] { write(1, cv::Mat1w(size, std::uint16_t{41})); },
       {"labels: 25.0 % of the pixels", "classes.yaml gives no meaning: 41", "detect: false"}},
      {"all background",
       [&] {
         for (int frame = 0; frame < recording().frame_count(); ++frame)
           write(frame, cv::Mat1w::zeros(size));
       },
       {"no pixel is of a detected class, the values are 0"}},
      {"class",
       [&] { write_classes("classes: [{name: crat, label: 56}]\n"); },
       {"the recording has no class 'crat'", "crate", "detect: false"}},
      {"no image",
       [&] { write_scores("image,id,score\n000009.png,56,0.5\n"); },
       {"scores.csv:2: there is no label image '000009.png'"}},
      {"no stamp",
       [&] { write_scores("stamp_s,id,score\n77,56,0.5\n"); },
       {"scores.csv:2: there is no colour image within 0.02 s of stamp 77"}},
      {"score",
       [&] { write_scores("image,id,score\n000001.png,56,1.5\n"); },
       {"scores.csv:2: score '1.5'"}},
      {"id",
       [&] { write_scores("image,id,score\n000001.png,-1,0.5\n"); },
       {"scores.csv:2: id '-1'"}},
      {"twice",
       [&] { write_scores("image,id,score\n000001.png,56,0.5\n000001.png,56,0.6\n"); },
       {"scores.csv:3: id 56", "twice"}},
      {"head", [&] { write_scores("000001.png,56,0.5\n"); }, {"scores.csv:1", "image,id,score"}},
      {"cells", [&] { write_scores("image,id,score\n000001.png,56\n"); }, {"scores.csv:2"}},
      {"column",
       [&] { write_scores("image,u,v,score\n000001.png,64,0,0.5\n"); },
       {"scores.csv:2: '64' is no column of the image", "up to 63"}},
      {"three cells",
       [&] { write_scores("image,u,v,score\n000001.png,1,0.5\n"); },
       {"scores.csv:2: expected four cells"}},
      {"no scores", [&] { write_scores(""); }, {"scores.csv: is empty"}}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.what);
    const fs::path kept = labels().parent_path() / "kept";
    fs::remove_all(kept);
    fs::copy(labels(), kept, fs::copy_options::recursive);
    const std::string classes = read_file(labels().parent_path() / "classes.yaml");
    one.spoil();
    const std::string said = refusal();
    for (const std::string& part : one.said) EXPECT_THAT(said, HasSubstr(part));
    EXPECT_EQ(said.find('\n'), said.npos);
    fs::remove_all(labels());
    fs::rename(kept, labels());
    write_classes(classes);
    write_scores("image,id,score\n");
    ASSERT_EQ(refusal(), "accepted");
  }
}

}  // namespace
}  // namespace mapscore::eval
