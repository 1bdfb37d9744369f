// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/report/pictures/judgement.hpp"
#include "eval/report/pictures/scene.hpp"
#include "sim/render/renderer.hpp"

#include <vector>

namespace mapscore::eval {

/// Maps of several voxel sizes from one view, two in a row, in the colours of their classes and
/// with their titles above them; the last ends with the legend of the classes. In the form of
/// [R, figure 9].
[[nodiscard]] cv::Mat3b resolution_picture(const std::vector<JudgedMap>& maps,
                                           const ClassTable& table, ScenePainter& painter,
                                           const sim::View& view);

}  // namespace mapscore::eval
