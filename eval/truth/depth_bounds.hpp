// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

#include <algorithm>
#include <cstdint>

namespace mapscore::eval {

/// Greatest value of a depth image by tiles of 16 x 16 pixels, to skip voxels that lie behind all
/// measured surfaces. Immutable.
class DepthBounds {
 public:
  explicit DepthBounds(const cv::Mat1w& depth)
      : tiles_(
            cv::Mat1w::zeros((depth.rows + kTile - 1) / kTile, (depth.cols + kTile - 1) / kTile)) {
    for (int v = 0; v < depth.rows; ++v) {
      const std::uint16_t* row = depth[v];
      std::uint16_t* tiles = tiles_[v / kTile];
      for (int u = 0; u < depth.cols; ++u) {
        tiles[u / kTile] = std::max(tiles[u / kTile], row[u]);
        most_ = std::max(most_, row[u]);
      }
    }
  }

  /// Of the whole image.
  [[nodiscard]] std::uint16_t most() const { return most_; }
  /// At least the greatest value in columns first_u to last_u and rows first_v to last_v, all
  /// within the image; 0 when there are none.
  [[nodiscard]] std::uint16_t most_in(int first_u, int last_u, int first_v, int last_v) const {
    std::uint16_t most = 0;
    if (first_u > last_u || first_v > last_v) return most;
    for (int v = first_v / kTile; v <= last_v / kTile; ++v) {
      const std::uint16_t* tiles = tiles_[v];
      for (int u = first_u / kTile; u <= last_u / kTile; ++u) most = std::max(most, tiles[u]);
    }
    return most;
  }

 private:
  static constexpr int kTile = 16;

  cv::Mat1w tiles_;
  std::uint16_t most_ = 0;
};

}  // namespace mapscore::eval
