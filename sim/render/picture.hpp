// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/render/offscreen.hpp"
#include "sim/render/renderer.hpp"

#include <opencv2/core.hpp>

#include <span>

namespace mapscore::sim {

/// Draws `view` of `world` and the cubes at twice the resolution and halves it, on white. BGR.
/// Throws Error when the view cannot be drawn (no size, eye on target, unknown hidden class).
[[nodiscard]] cv::Mat3b draw_picture(const World& world, Offscreen& offscreen, const View& view,
                                     std::span<const Cube> cubes);

}  // namespace mapscore::sim
