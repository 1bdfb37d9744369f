// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/tiny_study.hpp"

#include <gmock/gmock.h>

#include <filesystem>

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// The tiny study with the recording's own label images in the part of a network's.
class TinyNetwork : public TinyStudy {
 protected:
  TinyNetwork() {
    fs::copy(folder() / "tiny/label", folder() / "labels");
    write_text(path("classes.yaml"),
               "classes: [{name: crate, label: 1}, {name: wall, label: 2, detect: false}]\n");
    write_text(path("network.yaml"),
               std::string(kText) +
                   "perception: {images: {folder: labels, classes: classes.yaml}}\n"
                   "score: {labels: true}\n");
  }

  [[nodiscard]] Outcome sweep(const std::string& set = "seeds=2") const {
    return mapscore({"sweep", path("network.yaml"), "-o", results(), "-q", "--set", set});
  }
};

TEST_F(TinyNetwork, IsSweptBesideTheTrueLabels) {
  expect_done(sweep("sweep={perception: [labels, images]}"));
  const Outcome table =
      mapscore({"table", results(), "--metric", "f1,label_iou,label_instance_recall", "--columns",
                "perception", "--rows", "method,metric"});
  expect_done(table);
  EXPECT_THAT(table.out, HasSubstr("perception = images"));
  EXPECT_THAT(table.out, HasSubstr("label_instance_recall  1.000"));
  const Outcome plain = mapscore({"table", results()});
  EXPECT_THAT(plain.out, HasSubstr("2D IoU"));
}

TEST_F(TinyNetwork, WhatDoesNotFitEndsTheSweepBeforeItBegins) {
  const fs::path image = folder() / "labels/000002.png", kept = folder() / "kept.png";
  fs::copy(image, kept);
  fs::remove(image);
  expect_refused(sweep(), {"000002.png: label image is missing"});
  fs::copy(folder() / "tiny/color/000002.png", image);
  expect_refused(sweep(), {"000002.png", "grey or palette"});
  write_text(image, "no image");
  expect_refused(sweep(), {"000002.png", "not a PNG"});
  fs::remove(image);
  fs::copy(kept, image);
  write_text(path("classes.yaml"), "classes: [{name: crate, label: 1}]\n");
  expect_refused(sweep(), {"labels: ", "% of the pixels", "gives no meaning: 2", "detect: false"});
  write_text(path("scores.csv"), "image,id,score\n000009.png,1,0.5\n");
  expect_refused(sweep("perception.images.scores=scores.csv"),
                 {"scores.csv:2: there is no label image '000009.png'"});
  fs::remove_all(folder() / "labels");
  expect_refused(sweep(), {"labels: no such folder"});
  fs::create_directory(folder() / "labels");
  expect_refused(sweep(), {"labels: holds no label image"});
  EXPECT_FALSE(fs::exists(folder() / "results/results.sqlite"));
}

}  // namespace
}  // namespace mapscore::testing
