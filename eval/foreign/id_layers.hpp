// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/detection.hpp"
#include "eval/foreign/trial_sheet.hpp"

#include <opencv2/core.hpp>

#include <functional>
#include <vector>

namespace mapscore::eval {

/// The detections of a frame as images of ids, and what the ids mean.
struct IdLayers {
  std::vector<cv::Mat1w> images;         ///< at least one; more where masks overlap
  std::vector<TrialDetection> meanings;  ///< in the order of the detections, `frame` empty
};

/// Each detection goes into the first layer where its mask is free. Ids are those of the instances,
/// or 1, 2, ... where two are equal. `size`: of the colour image. Throws Error for a detection that
/// does not fit it, and for more than 65535.
[[nodiscard]] IdLayers id_layers(const std::vector<Detection>& detections, cv::Size size);

/// The detections that these ids mean, in the order of `meanings`; an id without a pixel is none.
/// `classes`: those that are detected are read. `layer(n)` gives the image of a layer.
[[nodiscard]] std::vector<Detection> detections_of(const std::vector<TrialDetection>& meanings,
                                                   const std::vector<SemanticClass>& classes,
                                                   const std::function<cv::Mat1w(int)>& layer);

}  // namespace mapscore::eval
