// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/report/pictures/judgement.hpp"
#include "eval/report/pictures/scene.hpp"
#include "sim/render/renderer.hpp"

namespace mapscore::eval {

/// Truth, map and errors side by side from one view, in the pale scene: the visible voxels of the
/// detected classes, the predicted ones, both in the colours of their classes, and the verdicts;
/// below them a scale in metres where the view looks straight down, and legends with how many
/// voxels there are. Voxels that things cover are seen through them. Each panel is as wide as the
/// view.
[[nodiscard]] cv::Mat3b map_beside_truth(const JudgedMap& map, const ClassTable& table,
                                         ScenePainter& painter, const sim::View& view);

}  // namespace mapscore::eval
