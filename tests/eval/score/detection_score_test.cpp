// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/detection_score.hpp"

#include "core/random_stream.hpp"
#include "eval/score/label_images.hpp"
#include "eval/score/metrics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

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
  const auto plain = [&](std::size_t c) {
    const LabelCounts& of = *counts[c].labels;
    return std::array{of.true_px,   of.named_px,   of.right_px,
                      of.instances, of.detections, of.instances_found};
  };
  using Plain = std::array<std::int64_t, 6>;
  EXPECT_EQ(plain(1), (Plain{5, 2, 2, 2, 1, 1}));  // 2 / 3 is above 1 / 2
  EXPECT_EQ(plain(2), (Plain{3, 4, 2, 1, 1, 0}));  // 2 / 5 is not
  EXPECT_EQ(plain(0), (Plain{4, 6, 3, 0, 0, 0}));  // walls and 9 are background
  EXPECT_EQ(plain(3), Plain{});
  EXPECT_EQ(counts[1].labels->iou_sum_nano, 666'666'667);
  EXPECT_EQ(counts[1].labels->named_as, (std::vector<std::int64_t>{2, 2, 1, 0}));
  EXPECT_EQ(counts[2].labels->named_as, (std::vector<std::int64_t>{1, 0, 2, 0}));
  EXPECT_EQ(counts[0].labels->named_as, (std::vector<std::int64_t>{3, 0, 1, 0}));
  EXPECT_EQ(counts[1].labels->scores.error(), 0.0) << "sure of 1, and found";
  EXPECT_EQ(counts[2].labels->scores.error(), 1.0);
  // PQ of cups: 2/3 over one found, one missed and none wrong; SQ 2/3, RQ 1 / 1.5.
  const std::vector<Metric> cups = counts[1].labels->metrics();
  EXPECT_NEAR(*value_of(cups, "label_pq"), 2 / 3.0 / 1.5, 1e-9);
  EXPECT_NEAR(*value_of(cups, "label_sq"), 2 / 3.0, 1e-9);
  EXPECT_NEAR(*value_of(cups, "label_rq"), 1 / 1.5, 1e-12);
  EXPECT_EQ(value_of(counts[2].labels->metrics(), "label_pq"), 0.0);
  EXPECT_EQ(value_of(counts[2].labels->metrics(), "label_sq"), std::nullopt);
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
  const LabelComparison comparison =
      compare_labels(truth, labels, table, class_id_legend(table), "image");
  const std::vector<Metric> plain = label_metrics(comparison);
  for (std::size_t row = 0; row < counts.size(); ++row) {
    for (std::size_t column = 0; column < counts.size(); ++column)
      EXPECT_EQ(counts[row].labels->named_as.at(column), comparison.pixels.at(row, column));
    const LabelCounts& of = *counts[row].labels;
    EXPECT_EQ(comparison.edges[row],
              (EdgeCounts{of.true_edge_px, of.found_edge_px, of.named_edge_px, of.right_edge_px}));
  }
  EXPECT_EQ(value_of(metrics_of(pool_detected(counts, table)), "label_accuracy"),
            value_of(plain, "pa"));
  Counts seen = counts;
  seen[1].visible = 1;  // without a visible voxel there are no means
  EXPECT_EQ(value_of(macro_metrics(seen, table), "label_accuracy"), value_of(plain, "mpa"));
  EXPECT_EQ(value_of(macro_metrics(seen, table), "label_iou"), value_of(plain, "miou"));
  EXPECT_EQ(value_of(macro_metrics(seen, table), "label_fwiou"), value_of(plain, "fwiou"));
  EXPECT_EQ(value_of(macro_metrics(seen, table), "label_boundary_f"),
            value_of(plain, "boundary_f"));
}

/// Panoptic quality of one class [Kirillov et al., equation 1], pixel by pixel, pair by pair.
double plain_quality(const cv::Mat1w& truth, const cv::Mat1w& labels, const ClassTable& truths,
                     const ClassTable& detected, ClassId id) {
  double found = 0, sum = 0, instances = 0, detections = 0;
  const auto is_there = [](const cv::Mat1w& image, InstanceId one) {
    return std::ranges::find(image, one) != image.end();
  };
  for (const Instance& detection : detected.instances) {
    if (detection.class_id != id || !is_there(labels, detection.id)) continue;
    ++detections;
    for (const Instance& instance : truths.instances) {
      if (instance.class_id != id) continue;
      double both = 0, either = 0;
      for (int v = 0; v < truth.rows; ++v)
        for (int u = 0; u < truth.cols; ++u) {
          const bool a = truth(v, u) == instance.id, b = labels(v, u) == detection.id;
          both += a && b ? 1 : 0;
          either += a || b ? 1 : 0;
        }
      if (both / either <= 0.5) continue;
      ++found;
      sum += both / either;
    }
  }
  for (const Instance& instance : truths.instances)
    if (instance.class_id == id && is_there(truth, instance.id)) ++instances;
  return sum / (found + (detections - found) / 2 + (instances - found) / 2);
}

TEST(DetectionScore, PanopticQualityIsThatOfAPlainCount) {
  const ClassTable table = cups_and_chair();
  ClassTable found = table;
  for (const ClassId c : {2, 1})
    found.instances.push_back({static_cast<InstanceId>(found.instances.size()), "one", c});
  RandomStream stream(5, "test", {0});
  int partly = 0;
  for (int n = 0; n < 20; ++n) {
    cv::Mat1w truth = cv::Mat1w::zeros(12, 16), labels = cv::Mat1w::zeros(12, 16);
    for (int block = 1; block < 7; ++block) {
      const cv::Rect place(static_cast<int>(stream.uniform() * 11),
                           static_cast<int>(stream.uniform() * 8), 5, 4);
      if (block < 5) truth(place).setTo(block);
      labels(stream.uniform() < 0.7 ? place : place - cv::Point(place.x / 2, 0)).setTo(block);
    }
    const Counts counts = scored(detections_of(labels, found), truth, table);
    for (const ClassId id : {ClassId{1}, ClassId{2}}) {
      const auto quality = value_of(counts[id].labels->metrics(), "label_pq");
      const double plain = plain_quality(truth, labels, table, found, id);
      EXPECT_NEAR(quality.value(), plain, 1e-8);
      partly += plain > 0 && plain < 1 ? 1 : 0;
    }
  }
  EXPECT_GT(partly, 10);
}

TEST(DetectionScore, PixelsAreCountedByTheClassThatIsNamed) {
  const ClassTable table = cups_and_chair();
  const cv::Mat1w truth = (cv::Mat1w(1, 6) << 1, 2, 3, 3, 4, 0);
  const cv::Mat1w named = (cv::Mat1w(1, 6) << 1, 2, 2, 2, 3, 1);
  const cv::Mat1w sure = (cv::Mat1w(1, 6) << 900, 500, 700, 700, 1000, 300);
  Counts counts = zero_counts(table.classes.size(), {.tolerances = {}, .asked = {.labels = true}});
  score_pixels(named, sure, truth, table, counts);
  Reliability cup, chair, background;
  cup.add(0.9, true);
  cup.add(0.3, false);
  chair.add(0.5, false);
  chair.add(0.7, true, 2);
  background.add(1.0, true);  // a wall named a wall: neither is detected
  EXPECT_EQ(counts[1].labels->pixels, cup);
  EXPECT_EQ(counts[2].labels->pixels, chair);
  EXPECT_EQ(counts[0].labels->pixels, background);
  EXPECT_NEAR(*value_of(counts[2].labels->metrics(), "label_pixel_ece"), (0.5 + 0.6) / 3, 1e-9);
}

}  // namespace
}  // namespace mapscore::eval
