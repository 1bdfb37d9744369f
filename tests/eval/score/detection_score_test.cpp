// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/detection_score.hpp"

#include "core/random_stream.hpp"
#include "eval/score/label_images.hpp"
#include "eval/score/metrics.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

/// Instances 1 and 2 are cups, 3 is a chair, 4 a wall, which is not detected.
ClassTable cups_and_chair() {
  ClassTable table;
  table.classes.push_back({1, "cup", {}, true});
  table.classes.push_back({2, "chair", {}, true});
  table.classes.push_back({3, "wall", {}, false});
  for (const ClassId c : {1, 1, 2, 3})
    table.instances.push_back({static_cast<InstanceId>(table.instances.size()), "one", c});
  return table;
}

Counts scored(const std::vector<Detection>& detections, const cv::Mat1w& truth,
              const ClassTable& table) {
  Counts counts = zero_counts(table.classes.size(), {.tolerances = {}, .asked = {.labels = true}});
  score_detections(detections, truth, table, counts);
  return counts;
}

TEST(DetectionScore, CountsOneImageByHand) {
  const ClassTable table = cups_and_chair();
  const cv::Mat1w truth = (cv::Mat1w(3, 4) << 1, 1, 1, 4,  //
                           2, 2, 0, 4,                     //
                           3, 3, 3, 9);                    // 9 is in no table
  // A cup on 2 of the 3 pixels of the first, a chair on a cup, a background and two chair pixels.
  const std::vector<Detection> detections{
      {1, 1, 1.0, {0, 0, 1, 0}, (cv::Mat1b(1, 2) << 255, 255), {}},
      {2, 3, 1.0, {1, 1, 2, 2}, (cv::Mat1b(2, 2) << 255, 255, 255, 255), {}}};
  const Counts counts = scored(detections, truth, table);
  EXPECT_EQ(*counts[1].labels, (LabelCounts{5, 2, 2, 2, 1, 1}));  // 2 / 3 is above 1 / 2
  EXPECT_EQ(*counts[2].labels, (LabelCounts{3, 4, 2, 1, 1, 0}));  // 2 / 5 is not
  EXPECT_EQ(*counts[0].labels, (LabelCounts{4, 6, 3, 0, 0, 0}));  // walls and 9 are background
  EXPECT_EQ(*counts[3].labels, LabelCounts{});
  const std::vector<Metric> pooled = metrics_of(pool_detected(counts, table));
  EXPECT_EQ(value_of(pooled, "label_accuracy"), (2 + 2 + 3) / 12.0);
  EXPECT_EQ(value_of(pooled, "label_instance_recall"), 1 / 3.0);
  EXPECT_EQ(value_of(pooled, "label_instance_precision"), 1 / 2.0);
}

TEST(DetectionScore, HalfTheUnionIsNotFound) {
  const cv::Mat1w truth = (cv::Mat1w(1, 2) << 1, 1);
  const std::vector<Detection> half{{1, 1, 1.0, {0, 0, 0, 0}, cv::Mat1b(1, 1, 255), {}}};
  EXPECT_EQ(scored(half, truth, cups_and_chair())[1].labels->instances_found, 0);
}

TEST(DetectionScore, TruthAgainstItselfIsPerfect) {
  ClassTable table = cups_and_chair();
  cv::Mat1w truth(40, 30);
  RandomStream stream(1, "test", {0});
  for (auto& id : truth) id = static_cast<std::uint16_t>(stream.uniform() * 5);
  for (const ClassCounts& counts : scored(detections_of(truth, table), truth, table)) {
    if (counts.labels->true_px == 0) continue;
    EXPECT_EQ(value_of(counts.labels->metrics(), "label_accuracy"), 1.0);
    EXPECT_EQ(value_of(counts.labels->metrics(), "label_iou"), 1.0);
    EXPECT_EQ(counts.labels->instances_found, counts.labels->instances);
  }
}

TEST(DetectionScore, WithAllClassesDetectedItIsThatOfLabelImages) {
  ClassTable table = cups_and_chair();
  for (SemanticClass& c : table.classes) c.detect = c.id != kBackground;
  cv::Mat1w truth(40, 30), labels(40, 30);
  RandomStream stream(2, "test", {0});
  for (auto& id : truth) id = static_cast<std::uint16_t>(stream.uniform() * 5);
  for (auto& id : labels) id = static_cast<std::uint16_t>(stream.uniform() * 4);  // classes
  ClassTable by_class = table;
  by_class.instances = {Instance{}};
  for (const ClassId c : {1, 2, 3}) by_class.instances.push_back({c, "class", c});
  const Counts counts = scored(detections_of(labels, by_class), truth, table);
  const ConfusionMatrix matrix =
      label_confusion(truth, labels, table, class_id_legend(table), "image");
  const std::vector<Metric> plain = label_metrics(matrix);
  EXPECT_EQ(value_of(metrics_of(pool_detected(counts, table)), "label_accuracy"),
            value_of(plain, "pa"));
  Counts seen = counts;
  seen[1].visible = 1;  // without a visible voxel there are no means
  EXPECT_EQ(value_of(macro_metrics(seen, table), "label_accuracy"), value_of(plain, "mpa"));
  EXPECT_EQ(value_of(macro_metrics(seen, table), "label_iou"), value_of(plain, "miou"));
}

}  // namespace
}  // namespace mapscore::eval
