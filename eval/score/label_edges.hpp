// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

#include <opencv2/core.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace mapscore::eval {

/// Pixels at the edges of one class in two images of class ids, the truth and another.
struct EdgeCounts {
  std::int64_t true_px = 0, found_px = 0;   ///< in the truth; of these, near one of the other
  std::int64_t named_px = 0, right_px = 0;  ///< in the other; of these, near one of the truth

  /// Pools.
  EdgeCounts& operator+=(const EdgeCounts& other);
  bool operator==(const EdgeCounts&) const = default;
};

/// Boundary F: harmonic mean of right_px / named_px and found_px / true_px, as f1.
[[nodiscard]] std::optional<double> boundary_f(const EdgeCounts& edges);

/// How far apart edges may lie: 0.75 % of the image's diagonal [Csurka et al., What is a good
/// evaluation measure for semantic segmentation?, BMVC 2013], rounded to whole pixels, at least 1.
[[nodiscard]] int edge_tolerance_px(cv::Size size);

/// Counts the edges of each class below `class_count`, by id. A pixel is at its class's edge where
/// one of its four neighbours in the image is of another class; it is near an edge of that class in
/// the other image where a pixel of one lies within `tolerance_px` of it, centre to centre.
[[nodiscard]] std::vector<EdgeCounts> count_edges(const cv::Mat1w& truth, const cv::Mat1w& named,
                                                  std::size_t class_count, int tolerance_px);

}  // namespace mapscore::eval
