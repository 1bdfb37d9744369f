// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

#include <cstdint>

namespace mapscore {

/// What a pixel of near_holes is, where it is not 0: something nearer than the range, or that or
/// nothing within it.
inline constexpr std::uint8_t kNearHole = 255, kOpenHole = 128;

inline constexpr int kHoleCell_px = 2;  ///< edge of a pixel of near_holes in the depth image

/// The middle of wide holes of a depth image that may be objects nearer than its range, at half
/// size (a cell of 2 x 2 pixels is a hole where none of them has a depth): holes (of cells that
/// hang together, 8 neighbours) that reach the image's lower border, as what stands before a robot
/// does, or touch a surface nearer than 1.3 times the range, as where a table runs under the
/// camera. One that reaches the lower and the upper border, and touches nothing near, is open: as
/// often the sky beyond a scene's floor. Any other hole has nothing within the range, or a surface
/// that gives no return, and hides nothing. The outermost 2 cells of a hole are left out, since
/// shadows are as wide. `inverse_depth`: 1/m, 0 where there is none. Thread-safe.
[[nodiscard]] cv::Mat1b near_holes(const cv::Mat1f& inverse_depth, double range_min_m);

}  // namespace mapscore
