// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;

class BadRecording : public TinyStudy {
 protected:
  [[nodiscard]] Outcome sweep() const {
    return mapscore({"sweep", study(), "-o", results(), "-q"});
  }

  /// Nobody may take what is there for results.
  void expect_no_results() const {
    expect_refused(mapscore({"table", results()}), {"results", "mapscore sweep"});
  }
};

TEST_F(BadRecording, WithATruncatedImage) {
  const std::string image = path("tiny/depth/000002.png");
  const std::string whole = bytes_of(image);
  write_text(image, whole.substr(0, whole.size() / 2));
  expect_refused(sweep(), {"depth/000002.png", "is not the image of this recording",
                           "copy the recording anew"});
  expect_no_results();
  write_text(image, whole);
  expect_done(sweep());
  expect_done(mapscore({"table", results()}));
}

TEST_F(BadRecording, WithAMissingFrame) {
  fs::remove(path("tiny/label/000001.png"));
  expect_refused(sweep(), {"label/000001.png", "missing"});
  EXPECT_FALSE(fs::exists(results()));
}

TEST_F(BadRecording, OfAnotherFormatVersion) {
  replace("tiny/recording.yaml", "format_version: 1", "format_version: 7");
  expect_refused(sweep(), {"recording.yaml:1", "format 7", "reads 1"});
  EXPECT_FALSE(fs::exists(results()));
}

TEST_F(BadRecording, WithoutTruthCanNotBeScored) {
  write_text(path("map.csv"), "i,j,k,class\n0,0,0,crate\n");
  replace("tiny/recording.yaml", "has_truth: true", "has_truth: false");
  fs::remove(path("tiny/hashes.txt"));
  expect_refused(mapscore({"score", path("map.csv"), "--truth", path("tiny")}),
                 {"tiny", "no truth"});
  expect_refused(sweep(), {"truth"});
  expect_no_results();
}

TEST_F(BadRecording, MapsThatDoNotFitIt) {
  const auto score = [&](const std::string& text) {
    write_text(path("map.csv"), text);
    return mapscore({"score", path("map.csv"), "--truth", path("tiny")});
  };
  expect_refused(score("i,j,k,class\n0,0,0,elephant\n"), {"map.csv", "'elephant'", "--legend"});
  expect_refused(score("i,j,k,class\n0,zero,0,crate\n"),
                 {"map.csv:2", "'zero'", "no whole number"});
}

}  // namespace
}  // namespace mapscore::testing
