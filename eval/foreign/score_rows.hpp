// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace mapscore::eval {

/// Scores of an image's detections: by their pixel value, and by one of their pixels.
struct FrameScores {
  struct AtPixel {
    int u = 0, v = 0;
    double score = 1;
  };
  std::map<std::uint16_t, double> of_value;
  std::vector<AtPixel> at_pixels;  ///< over those of values

  [[nodiscard]] bool empty() const { return of_value.empty() && at_pixels.empty(); }
};

/// By frame, the rows of a CSV `image,id,score`, `stamp_s,id,score`, `image,u,v,score` or
/// `stamp_s,u,v,score`. `images`: the label image of each frame, of `size`; `stamps_s`: its stamp,
/// ascending. A row's stamp means the nearest of them, of two as near the earlier. Throws Error
/// with file and line where a row is refused, names no image or no pixel of it, or lies
/// `max_offset_s` or more from every stamp.
[[nodiscard]] std::vector<FrameScores> read_scores(const std::filesystem::path& file,
                                                   const std::vector<std::filesystem::path>& images,
                                                   cv::Size size,
                                                   const std::vector<double>& stamps_s,
                                                   double max_offset_s);

}  // namespace mapscore::eval
