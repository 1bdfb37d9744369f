// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/foreign/network_labels.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "tests/support/tiny_recording.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// The tiny recording's label images as a network's, and beside them how sure it was.
class NetworkConfidence : public ::testing::Test {
 protected:
  NetworkConfidence() {
    testing::write_tiny_recording(folder() / "tiny");
    fs::copy(folder() / "tiny/label", folder() / "labels");
    fs::create_directory(folder() / "sure");
    for (int frame = 0; frame < 4; ++frame) write(frame, 100 * frame);
    write_file(folder() / "classes.yaml",
               "classes: [{name: crate}, {name: wall, detect: false}]\n");
  }

  [[nodiscard]] const fs::path& folder() const { return temporary_.path(); }
  [[nodiscard]] fs::path image(int frame) const {
    return folder() / "sure" / fmt::format("{:06}.png", frame);
  }
  void write(int frame, int thousandths) const {
    write_file(image(frame),
               encode_png(cv::Mat1w(48, 64, static_cast<std::uint16_t>(thousandths))));
  }
  [[nodiscard]] NetworkImages images() const {
    return {.folder = folder() / "labels",
            .classes = folder() / "classes.yaml",
            .confidence = folder() / "sure"};
  }
  [[nodiscard]] std::string refusal() const {
    try {
      (void)content_of(images());
      const Recording recording = Recording::open(folder() / "tiny");
      NetworkLabels(images(), recording, recording.info().table).check();
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  }

 private:
  testing::TemporaryFolder temporary_;
};

TEST_F(NetworkConfidence, IsOfEachPixelBesideItsClass) {
  const Recording recording = Recording::open(folder() / "tiny");
  const NetworkLabels network(images(), recording, recording.info().table);
  const auto verdicts = network.verdicts_of(3);
  ASSERT_TRUE(verdicts.has_value());
  const cv::Mat1b crate = recording.read(3).label == 1, named = verdicts->classes == 1;
  EXPECT_GT(cv::countNonZero(crate), 100);
  EXPECT_EQ(cv::countNonZero(crate != named), 0);
  EXPECT_EQ(cv::countNonZero(verdicts->classes > 1), 0) << "the wall is not detected by the file";
  EXPECT_EQ(cv::countNonZero(verdicts->thousandths != 300), 0);
  NetworkImages without = images();
  without.confidence.reset();
  EXPECT_FALSE(NetworkLabels(without, recording, recording.info().table).verdicts_of(3));
}

TEST_F(NetworkConfidence, ItsContentIsPartOfTheKey) {
  NetworkImages without = images();
  without.confidence.reset();
  const std::string before = content_of(images());
  EXPECT_NE(before, content_of(without));
  write(2, 7);
  EXPECT_NE(content_of(images()), before);
}

TEST_F(NetworkConfidence, WrongImagesAreNamed) {
  EXPECT_EQ(refusal(), "accepted");
  write(1, 1001);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("sure/000001.png: holds 1001"), HasSubstr("thousandths")));
  fs::remove(image(1));
  EXPECT_THAT(refusal(), HasSubstr("sure/000001.png"));
  fs::remove_all(folder() / "sure");
  EXPECT_THAT(refusal(), HasSubstr("sure: no such folder"));
}

}  // namespace
}  // namespace mapscore::eval
