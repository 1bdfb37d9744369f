// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/label_images.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <numeric>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

/// Instances 1 and 2 are crates, 3 is a wall.
ClassTable crates_and_wall() {
  ClassTable table;
  table.classes.push_back({1, "crate", {}, true});
  table.classes.push_back({2, "wall", {}, false});
  table.instances.push_back({1, "crate_1", 1});
  table.instances.push_back({2, "crate_2", 1});
  table.instances.push_back({3, "wall_1", 2});
  return table;
}

TEST(LabelImages, CountsOneImageByHand) {
  const ClassTable table = crates_and_wall();
  const cv::Mat1w truth = (cv::Mat1w(2, 4) << 0, 1, 2, 3,   //
                           9, 1, 2, 3);                     // 9 is in no table: background
  const cv::Mat1w labels = (cv::Mat1w(2, 4) << 0, 1, 1, 1,  //
                            2, 1, 0, 1);
  const LabelComparison comparison =
      compare_labels(truth, labels, table, class_id_legend(table), "image");
  const ConfusionMatrix& matrix = comparison.pixels;
  EXPECT_EQ(matrix.columns(), 3u);
  EXPECT_EQ(matrix.at(0, 0), 1);
  EXPECT_EQ(matrix.at(0, 2), 1);
  EXPECT_EQ(matrix.at(1, 1), 3);
  EXPECT_EQ(matrix.at(1, 0), 1);
  EXPECT_EQ(matrix.at(2, 1), 2);
  EXPECT_EQ(matrix.total(), 8);
  // Accuracy 1/2, 3/4, 0/2; IoU 1/3, 3/6, 0/3.
  EXPECT_EQ(label_class_metrics(comparison, 1),
            (std::vector<Metric>{{"accuracy", 0.75}, {"iou", 0.5}, {"boundary_f", 1.0}}));
  const std::vector<Metric> metrics = label_metrics(comparison);
  EXPECT_EQ(value_of(metrics, "pa"), 0.5);
  EXPECT_DOUBLE_EQ(*value_of(metrics, "mpa"), (0.5 + 0.75 + 0.0) / 3);
  EXPECT_DOUBLE_EQ(*value_of(metrics, "miou"), (1.0 / 3 + 0.5 + 0.0) / 3);
  EXPECT_DOUBLE_EQ(*value_of(metrics, "fwiou"), (2 * 1.0 / 3 + 4 * 0.5 + 2 * 0.0) / 8);
}

TEST(LabelImages, AClassWithoutPixelsInTheTruthIsInNoMean) {
  const ClassTable table = crates_and_wall();
  const cv::Mat1w truth = (cv::Mat1w(1, 2) << 1, 1), labels = (cv::Mat1w(1, 2) << 1, 2);
  const LabelComparison comparison =
      compare_labels(truth, labels, table, class_id_legend(table), "image");
  const auto values = [](const std::vector<Metric>& metrics) {
    std::vector<std::optional<double>> of;
    for (const Metric& metric : metrics) of.push_back(metric.value);
    return of;
  };
  using Values = std::vector<std::optional<double>>;
  EXPECT_EQ(values(label_metrics(comparison)), (Values{0.5, 0.5, 0.5, 0.5, 0.0}));
  EXPECT_EQ(label_class_metrics(comparison, 2)[0].value, std::nullopt);
  EXPECT_EQ(label_class_metrics(comparison, 2)[1].value, 0.0);
  EXPECT_EQ(values(label_metrics({ConfusionMatrix(3), std::vector<EdgeCounts>(3)})), Values(5));
}

TEST(LabelImages, AgreesWithCountingPixelByPixel) {
  const ClassTable table = crates_and_wall();
  RandomStream random(1, "label images");
  cv::Mat1w truth(40, 50), labels(40, 50);
  std::vector<std::int64_t> expected(9);
  for (int v = 0; v < truth.rows; ++v)
    for (int u = 0; u < truth.cols; ++u) {
      const bool repeat = u > 0 && random.uniform() < 0.6;
      truth(v, u) = repeat ? truth(v, u - 1) : static_cast<std::uint16_t>(5 * random.uniform());
      labels(v, u) = repeat ? labels(v, u - 1) : static_cast<std::uint16_t>(3 * random.uniform());
      ++expected[static_cast<std::size_t>(3 * table.class_of(truth(v, u)) + labels(v, u))];
    }
  const LabelComparison comparison =
      compare_labels(truth, labels, table, class_id_legend(table), "image");
  const ConfusionMatrix& matrix = comparison.pixels;
  for (std::size_t n = 0; n < 9; ++n) EXPECT_EQ(matrix.at(n / 3, n % 3), expected[n]);
}

TEST(LabelImages, ALegendGivesIdsTheirClass) {
  const ClassTable table = crates_and_wall();
  const LabelLegend legend = [](std::uint16_t id) -> std::optional<ClassId> {
    if (id == 700) return 1;
    if (id == 255) return 0;
    if (id == 4) return 8;  // no class of the table
    return std::nullopt;
  };
  const cv::Mat1w truth = (cv::Mat1w(1, 3) << 1, 0, 3);
  const cv::Mat1w labels = (cv::Mat1w(1, 3) << 700, 255, 700);
  const ConfusionMatrix matrix = compare_labels(truth, labels, table, legend, "image").pixels;
  EXPECT_EQ(matrix.trace(), 2);
  EXPECT_EQ(matrix.at(2, 1), 1);
  for (const int unknown : {4, 6}) {
    const cv::Mat1w bad = (cv::Mat1w(1, 3) << 700, 255, unknown);
    EXPECT_THAT([&] { (void)compare_labels(truth, bad, table, legend, "image"); },
                ThrowsMessage<Error>(
                    AllOf(HasSubstr("image: id " + std::to_string(unknown) + " at column 2, row 0"),
                          Not(HasSubstr("\n")))));
  }
}

/// A tiny recording and a folder of perfect labels beside it.
class LabelFolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    mapscore::testing::write_tiny_recording(folder_.path() / "recording");
    fs::create_directories(labels_);
    for (int n = 0; n < 4; ++n) write_labels(n, perfect(n));
  }

  cv::Mat1w perfect(int frame) const {
    cv::Mat1w image = recording().read(frame).label.clone();
    for (auto& id : image) id = recording().info().table.class_of(id);
    return image;
  }
  const Recording& recording() const {
    if (!recording_) recording_ = Recording::open(folder_.path() / "recording");
    return *recording_;
  }
  fs::path file(int frame) const { return labels_ / fmt_name(frame); }
  static std::string fmt_name(int frame) { return "00000" + std::to_string(frame) + ".png"; }
  void write_labels(int frame, const cv::Mat1w& image) const {
    write_file(file(frame), encode_png(image));
  }
  LabelFolder folder() const {
    const ClassTable& table = recording().info().table;
    return {recording(), labels_, table, class_id_legend(table)};
  }
  ConfusionMatrix score(std::vector<int> frames = {0, 1, 2, 3}, int jobs = 2) const {
    return score_label_folder(folder(), frames, jobs).pixels;
  }

  mapscore::testing::TemporaryFolder folder_;
  fs::path labels_ = folder_.path() / "labels";
  mutable std::optional<Recording> recording_;
};

TEST_F(LabelFolderTest, TheTruthAgainstItselfIsPerfectWhateverTheBits) {
  cv::Mat narrow;
  perfect(1).convertTo(narrow, CV_8U);
  ASSERT_TRUE(cv::imwrite(file(1).string(), narrow));
  const LabelFolderScore all = score_label_folder(folder(), std::vector<int>{0, 1, 2, 3}, 2);
  EXPECT_EQ(all.pixels.total(), 4 * 64 * 48);
  for (const Metric& metric : label_metrics(all)) EXPECT_EQ(metric.value, 1.0) << metric.name;
}

TEST_F(LabelFolderTest, PoolsTheSelectedFramesOnAnyNumberOfThreads) {
  cv::Mat1w wrong = perfect(2);
  wrong(20, 30) = wrong(20, 30) == 2 ? 1 : 2;
  write_labels(2, wrong);
  EXPECT_EQ(score({2}).total() - score({2}).trace(), 1);
  EXPECT_EQ(score({0, 1, 3}).total(), score({0, 1, 3}).trace());
  EXPECT_EQ(score({0, 1, 2, 3}, 1), score({0, 1, 2, 3}, 3));
  ConfusionMatrix sum;
  for (int n = 0; n < 4; ++n) sum += score({n});
  EXPECT_EQ(sum, score());
}

TEST_F(LabelFolderTest, UndetectedClassesAreBackgroundOnBothSides) {
  cv::Mat1w wrong = perfect(1);
  wrong.setTo(0, wrong == 2);
  wrong(0, 0) = perfect(1)(0, 0) == 1 ? 2 : 1;
  write_labels(1, wrong);
  LabelFolder labels = folder();
  for (SemanticClass& c : labels.table.classes) c.detect = c.id == 1;
  const std::vector<int> frames{0, 1, 2, 3};
  const ConfusionMatrix all = score_label_folder(labels, frames, 2).pixels;
  const LabelFolderScore folded =
      score_label_folder(with_undetected_as_background(labels), frames, 2);
  // Merging rows and columns of what was counted says the same.
  std::vector<std::int64_t> merged(4);
  for (std::size_t row = 0; row < all.class_count(); ++row)
    for (std::size_t column = 0; column < all.class_count(); ++column)
      merged[2 * (row == 1) + (column == 1)] += all.at(row, column);
  for (std::size_t n = 0; n < 4; ++n) EXPECT_EQ(folded.pixels.at(n / 2, n % 2), merged[n]);
  EXPECT_EQ(folded.pixels.row_sum(2) + folded.pixels.column_sum(2), 0);
  EXPECT_EQ(folded.wrong_px, (std::vector<std::int64_t>{0, merged[1] + merged[2], 0, 0}));
  EXPECT_EQ(merged[1] + merged[2], 1);
}

TEST_F(LabelFolderTest, RefusesInOneLineWhatItCannotCount) {
  const auto refused = [&](const std::string& what, int frame) {
    EXPECT_THAT([&] { (void)score(); },
                ThrowsMessage<Error>(
                    AllOf(HasSubstr(fmt_name(frame)), HasSubstr(what), Not(HasSubstr("\n")))));
  };
  cv::Mat1w unknown = perfect(3);
  unknown(7, 5) = 77;
  write_labels(3, unknown);
  refused("id 77 at column 5, row 7", 3);
  ASSERT_TRUE(cv::imwrite(file(2).string(), cv::Mat3b(48, 64, cv::Vec3b(1, 2, 3))));
  refused("grey or palette", 2);  // of several errors that of the first frame
  write_labels(1, cv::Mat1w::zeros(48, 63));
  refused("63 x 48", 1);
  fs::remove(file(0));
  refused("missing", 0);
  EXPECT_THAT([&] { (void)score({9}); }, ThrowsMessage<Error>(HasSubstr("no frame 9")));
  fs::remove_all(labels_);
  EXPECT_THAT([&] { (void)score(); }, ThrowsMessage<Error>(HasSubstr("no such folder")));
}

}  // namespace
}  // namespace mapscore::eval
