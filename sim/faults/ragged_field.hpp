// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

#include <cstdint>

namespace mapscore::sim {

/// A random field over the pixels of `window`, standard normal at every pixel and smooth over
/// `pitch_px`: standard normals at the nodes of a lattice anchored at pixel (0, 0), interpolated
/// bilinearly with weights of unit sum of squares. The draws are fixed by (seed, "labels.ragged",
/// frame, instance) and the node's place. `window` lies in the image.
[[nodiscard]] cv::Mat1f ragged_field(const cv::Rect& window, double pitch_px, std::uint64_t seed,
                                     std::uint64_t frame, std::uint64_t instance);

}  // namespace mapscore::sim
