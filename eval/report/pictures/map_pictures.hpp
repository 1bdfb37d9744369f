// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/pose.hpp"
#include "eval/report/pictures/caption.hpp"
#include "eval/report/pictures/judgement.hpp"
#include "eval/report/pictures/scene.hpp"
#include "sim/render/renderer.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace mapscore::eval {

/// The predicted voxels in the colours of their classes, in the pale scene.
[[nodiscard]] cv::Mat3b class_picture(const JudgedMap& map, const ClassTable& table,
                                      ScenePainter& painter, const sim::View& view);
/// True, near, leak, floating and missed voxels in the pale scene.
[[nodiscard]] cv::Mat3b error_picture(const JudgedMap& map, ScenePainter& painter,
                                      const sim::View& view);

/// Truth, map and errors side by side from one view, in the pale scene: the visible voxels of the
/// detected classes, the predicted ones, both in the colours of their classes, and the verdicts;
/// below them a scale in metres where the view looks straight down, and legends with how many
/// voxels there are. Voxels that things cover are seen through them. Each panel is as wide as the
/// view.
[[nodiscard]] cv::Mat3b map_beside_truth(const JudgedMap& map, const ClassTable& table,
                                         ScenePainter& painter, const sim::View& view);

/// Maps of several voxel sizes from one view, two in a row, in the colours of their classes and
/// with their titles above them; the last ends with the legend of the classes. In the form of
/// [R, figure 9].
[[nodiscard]] cv::Mat3b resolution_picture(const std::vector<JudgedMap>& maps,
                                           const ClassTable& table, ScenePainter& painter,
                                           const sim::View& view);

/// Classes and verdicts with how many voxels they have in all, in view or not.
[[nodiscard]] std::vector<LegendEntry> truth_legend(const JudgedMap& map, const ClassTable& table);
[[nodiscard]] std::vector<LegendEntry> class_legend(const JudgedMap& map, const ClassTable& table);
[[nodiscard]] std::vector<LegendEntry> error_legend(const JudgedMap& map);

/// Throws Error unless a picture of this name can be written as what its ending says: .png.
void check_picture_name(const std::filesystem::path& file);

/// Draws the errors of one map into a PNG with title and legend: from `view`, or, without one, over
/// all that could be seen and, below, where most errors are, from where one of the cameras was.
/// Throws Error when the file cannot be written or the view cannot be drawn.
void draw_error_picture(const std::filesystem::path& file, const JudgedMap& map,
                        ScenePainter& painter, const std::optional<sim::View>& view,
                        const std::vector<Pose>& T_world_depth = {});

}  // namespace mapscore::eval
