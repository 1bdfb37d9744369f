// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

#include <cstdint>
#include <string_view>

namespace mapscore::sim {

/// Name of the random stream of discs.
struct DiscStream {
  std::uint64_t seed;
  std::string_view purpose;
  std::uint64_t frame, instance;
};
/// 255 on the pixels of `window` that random discs cover; of the window's size. Every pixel of the
/// plane is the centre of a disc (dx^2 + dy^2 <= radius^2, n pixels) with the chance 1 - (1 -
/// share)^(1/n), so that every pixel is covered with the chance `share`, 0 to 1. A centre's draw is
/// fixed by `stream` and its place: it depends on neither window nor share. Row and column of the
/// window are above -2^20.
[[nodiscard]] cv::Mat1b random_discs(const cv::Rect& window, double share, double radius_px,
                                     const DiscStream& stream);

}  // namespace mapscore::sim
