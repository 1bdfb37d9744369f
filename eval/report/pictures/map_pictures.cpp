// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/map_pictures.hpp"

#include "core/error.hpp"
#include "eval/report/pictures/view.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mapscore::eval {
namespace {

/// Edge of a drawn cube over the voxel's, so that neighbours can be told apart.
constexpr double kCubeShare = 0.92;

sim::Cube cube_of(const JudgedMap& map, const VoxelKey& key, const Colour& colour) {
  return {map.T_world_map * centre_of(key, map.edge_m), kCubeShare * map.edge_m,
          map.T_world_map.linear(), colour};
}

/// The classes that have voxels, with how many `count` finds.
template <class Count>
std::vector<LegendEntry> legend_of(const ClassTable& table, Count count) {
  std::vector<LegendEntry> legend;
  for (const SemanticClass& c : table.classes)
    if (const auto voxels = count(c.id); voxels > 0)
      legend.push_back({c.colour, fmt::format("{} {}", c.name, voxels)});
  return legend;
}

}  // namespace

std::vector<sim::Cube> truth_cubes(const JudgedMap& map, const ClassTable& table) {
  std::vector<sim::Cube> cubes;
  for (const TrueVoxel& voxel : map.truth)
    cubes.push_back(cube_of(map, voxel.key, table.classes.at(voxel.class_id).colour));
  return cubes;
}

std::vector<sim::Cube> class_cubes(const JudgedMap& map, const ClassTable& table) {
  std::vector<sim::Cube> cubes;
  for (const JudgedVoxel& voxel : map.voxels)
    if (voxel.verdict != Verdict::missed)
      cubes.push_back(cube_of(map, voxel.key, table.classes.at(voxel.class_id).colour));
  return cubes;
}

std::vector<sim::Cube> error_cubes(const JudgedMap& map) {
  std::vector<sim::Cube> cubes;
  for (const JudgedVoxel& voxel : map.voxels)
    if (!voxel.covered) cubes.push_back(cube_of(map, voxel.key, colour_of(voxel.verdict)));
  return cubes;
}

cv::Mat3b class_picture(const JudgedMap& map, const ClassTable& table, ScenePainter& painter,
                        const sim::View& view) {
  return painter.paint(view, class_cubes(map, table));
}

cv::Mat3b error_picture(const JudgedMap& map, ScenePainter& painter, const sim::View& view) {
  return painter.paint(view, error_cubes(map));
}

std::vector<LegendEntry> truth_legend(const JudgedMap& map, const ClassTable& table) {
  return legend_of(
      table, [&](ClassId id) { return std::ranges::count(map.truth, id, &TrueVoxel::class_id); });
}

std::vector<LegendEntry> class_legend(const JudgedMap& map, const ClassTable& table) {
  return legend_of(table, [&](ClassId id) {
    return std::ranges::count_if(map.voxels, [&](const JudgedVoxel& voxel) {
      return voxel.class_id == id && voxel.verdict != Verdict::missed;
    });
  });
}

std::vector<LegendEntry> error_legend(const JudgedMap& map) {
  const auto covered = std::count_if(map.voxels.begin(), map.voxels.end(),
                                     [](const JudgedVoxel& voxel) { return voxel.covered; });
  std::vector<LegendEntry> legend;
  for (const Verdict verdict : kVerdicts) {
    std::string text = fmt::format("{} {}", name_of(verdict), count(map.voxels, verdict));
    if (verdict == Verdict::missed && covered > 0)
      text += fmt::format(" ({} under another class)", covered);
    legend.push_back({colour_of(verdict), std::move(text)});
  }
  return legend;
}

void check_picture_name(const std::filesystem::path& file) {
  if (file.extension() != ".png")
    throw Error(file.string() + ": pictures are written as .png; give the file this ending");
}

void draw_error_picture(const std::filesystem::path& file, const JudgedMap& map,
                        ScenePainter& painter, const std::optional<sim::View>& view,
                        const std::vector<Pose>& T_world_depth) {
  check_picture_name(file);
  CaptionedColumn column{map.title, {}, error_legend(map)};
  for (const sim::View& from : error_views({map}, view, T_world_depth))
    column.pictures.push_back(error_picture(map, painter, from));
  write_picture(file, in_columns({column}, column.pictures.front().cols));
}

}  // namespace mapscore::eval
