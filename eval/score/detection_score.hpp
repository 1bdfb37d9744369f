// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/segmentation/detection.hpp"
#include "eval/score/counts.hpp"

#include <opencv2/core.hpp>

#include <vector>

namespace mapscore::eval {

/// Adds the pixels, edges and instances of a frame's detections, whose masks do not overlap, to
/// `labels` of each class that they or the truth have; classes that are not detected are
/// background, on both sides. `truth`: the recording's label image, ids of the table's instances.
/// An instance is found by a detection of its class with |both| / |either| > 1/2, so by one at
/// most. `counts` were asked for labels (zero_counts). A detection's score is that of its class
/// (Reliability).
void score_detections(const std::vector<Detection>& detections, const cv::Mat1w& truth,
                      const ClassTable& table, Counts& counts);

/// Adds how sure a network was of each pixel, and whether it was right, to `labels` of the class
/// that it names. `classes`: those it names, of the table; `thousandths`: how sure it was, 0 to
/// 1000. Classes that are not detected are background, on both sides. `truth`, `counts`: as
/// score_detections.
void score_pixels(const cv::Mat1w& classes, const cv::Mat1w& thousandths, const cv::Mat1w& truth,
                  const ClassTable& table, Counts& counts);

}  // namespace mapscore::eval
