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

/// Voxels as cubes in the world, a little smaller than they are so that neighbours can be told
/// apart: visible ones of the truth and predicted ones in the colours of their classes, and all
/// verdicts.
[[nodiscard]] std::vector<sim::Cube> truth_cubes(const JudgedMap& map, const ClassTable& table);
[[nodiscard]] std::vector<sim::Cube> class_cubes(const JudgedMap& map, const ClassTable& table);
[[nodiscard]] std::vector<sim::Cube> error_cubes(const JudgedMap& map);

/// The predicted voxels in the colours of their classes, in the pale scene.
[[nodiscard]] cv::Mat3b class_picture(const JudgedMap& map, const ClassTable& table,
                                      ScenePainter& painter, const sim::View& view);
/// True, near, leak, floating and missed voxels in the pale scene.
[[nodiscard]] cv::Mat3b error_picture(const JudgedMap& map, ScenePainter& painter,
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
