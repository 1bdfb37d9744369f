// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/posed_depth.hpp"
#include "core/objects/object_box.hpp"
#include "core/segmentation/registered_cloud.hpp"

#include <opencv2/core.hpp>

#include <span>
#include <vector>

namespace mapscore {

/// What simulated perception knows of an object: its instance id in the images that it makes, and
/// boxes about its parts, or one about all of it. Map frame.
struct PerceivedModel {
  InstanceId instance = 0;
  std::vector<ObjectBox> parts;
};

/// Simulated perception [N, algorithm 1]: the instance that each depth pixel votes for, 0 for none.
/// A pixel votes for a model when the point that it measured lies in one of its boxes, each widened
/// by `tolerance_m`; of several boxes, for the one of the least volume, ties to the earlier model
/// and part. Models outside the frustum and those with fewer than `min_pixels` votes go unseen.
/// Throws Error as check(PosedDepth).
[[nodiscard]] cv::Mat1w perceive(std::span<const PerceivedModel> models, const PosedDepth& view,
                                 double tolerance_m, int min_pixels = 1);

/// Labels of depth pixels as the colour camera sees them: each colour pixel takes that of its depth
/// pixel, 0 where it has none. `cloud`: registered from the labelled depth image.
[[nodiscard]] cv::Mat1w labels_in_color(const cv::Mat1w& depth_label, const RegisteredCloud& cloud);

}  // namespace mapscore
