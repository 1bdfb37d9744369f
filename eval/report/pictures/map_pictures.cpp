// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/map_pictures.hpp"

#include "core/error.hpp"
#include "eval/report/pictures/view.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mapscore::eval {
namespace {

/// Edge of a drawn cube over the voxel's, so that neighbours can be told apart.
constexpr double kCubeShare = 0.92;
constexpr int kScaleText_px = 18, kStrip_px = 44, kLeft_px = 18;
constexpr double kLongestScale = 0.3;  ///< of a panel's width
constexpr int kPanel_px = 900;         ///< of a map in resolution_picture

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

auto count_predicted(const JudgedMap& map, ClassId id) {
  return std::ranges::count_if(map.voxels, [&](const JudgedVoxel& voxel) {
    return voxel.class_id == id && voxel.verdict != Verdict::missed;
  });
}

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

/// The longest of 1, 2 and 5 times a power of ten that has room.
double scale_length_m(double room_m) {
  const double decade = std::pow(10.0, std::floor(std::log10(room_m)));
  double length = decade;
  for (const double step : {2.0, 5.0})
    if (step * decade <= room_m) length = step * decade;
  return length;
}

/// A white strip; with a scale of metres where it is known how long they are.
cv::Mat3b scale_strip(const sim::View& view, bool shown) {
  const auto metre_px = pixels_per_metre(view);
  cv::Mat3b strip(metre_px ? kStrip_px : 0, view.width_px, cv::Vec3b::all(255));
  if (!metre_px || !shown) return strip;
  const double length_m = scale_length_m(kLongestScale * view.width_px / *metre_px);
  const int y = kStrip_px / 2;
  const int right = kLeft_px + static_cast<int>(std::lround(length_m * *metre_px));
  const cv::Scalar ink = cv::Scalar::all(30);
  cv::line(strip, {kLeft_px, y}, {right, y}, ink, 3);
  for (const int x : {kLeft_px, right}) cv::line(strip, {x, y - 7}, {x, y + 7}, ink, 3);
  write_text(strip, fmt::format("{:.6g} m", length_m), {right + 12, y}, kScaleText_px);
  return strip;
}

CaptionedColumn panel(std::string title, const cv::Mat3b& picture, const cv::Mat3b& strip,
                      std::vector<LegendEntry> legend) {
  cv::Mat3b below = picture;
  if (!strip.empty()) cv::vconcat(picture, strip, below);
  return {std::move(title), {below}, std::move(legend)};
}

}  // namespace

cv::Mat3b class_picture(const JudgedMap& map, const ClassTable& table, ScenePainter& painter,
                        const sim::View& view) {
  return painter.paint(view, class_cubes(map, table));
}

cv::Mat3b error_picture(const JudgedMap& map, ScenePainter& painter, const sim::View& view) {
  return painter.paint(view, error_cubes(map));
}

cv::Mat3b map_beside_truth(const JudgedMap& map, const ClassTable& table, ScenePainter& painter,
                           const sim::View& view) {
  const auto painted = [&](const std::vector<sim::Cube>& cubes) {
    return painter.paint_through(view, cubes);
  };
  const cv::Mat3b blank = scale_strip(view, false);
  return in_columns({panel("truth, as far as it was seen", painted(truth_cubes(map, table)),
                           scale_strip(view, true), truth_legend(map, table)),
                     panel("map: " + map.title, painted(class_cubes(map, table)), blank,
                           class_legend(map, table)),
                     panel("errors", painted(error_cubes(map)), blank, error_legend(map))},
                    view.width_px);
}

cv::Mat3b resolution_picture(const std::vector<JudgedMap>& maps, const ClassTable& table,
                             ScenePainter& painter, const sim::View& view) {
  std::vector<CaptionedColumn> panels;
  for (const JudgedMap& map : maps)
    panels.push_back({map.title, {class_picture(map, table, painter, view)}, {}});
  const cv::Mat3b white(view.height_px, view.width_px, cv::Vec3b::all(255));
  if (panels.size() % 2 != 0) panels.push_back({" ", {white}, {}});
  cv::Mat3b sheet;
  for (std::size_t n = 0; n < panels.size(); n += 2)
    sheet.push_back(in_columns({panels[n], panels[n + 1]}, kPanel_px));
  std::vector<LegendEntry> legend;
  for (const SemanticClass& c : table.classes)
    if (std::ranges::any_of(maps,
                            [&](const JudgedMap& map) { return count_predicted(map, c.id) > 0; }))
      legend.push_back({c.colour, c.name});
  return captioned(sheet, "", legend);
}

std::vector<LegendEntry> truth_legend(const JudgedMap& map, const ClassTable& table) {
  return legend_of(
      table, [&](ClassId id) { return std::ranges::count(map.truth, id, &TrueVoxel::class_id); });
}

std::vector<LegendEntry> class_legend(const JudgedMap& map, const ClassTable& table) {
  return legend_of(table, [&](ClassId id) { return count_predicted(map, id); });
}

std::vector<LegendEntry> error_legend(const JudgedMap& map) {
  const auto covered = std::ranges::count(map.voxels, true, &JudgedVoxel::covered);
  std::vector<LegendEntry> legend;
  for (const Verdict verdict : kVerdicts) {
    std::string text = fmt::format("{} {}", name_of(verdict),
                                   std::ranges::count(map.voxels, verdict, &JudgedVoxel::verdict));
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
