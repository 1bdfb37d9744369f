// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/resolution_picture.hpp"

#include "eval/report/pictures/caption.hpp"
#include "eval/report/pictures/map_pictures.hpp"

#include <algorithm>
#include <cstddef>

namespace mapscore::eval {
namespace {

constexpr int kPanel_px = 900;

/// The classes that some map predicts.
std::vector<LegendEntry> legend_of(const std::vector<JudgedMap>& maps, const ClassTable& table) {
  std::vector<LegendEntry> legend;
  for (const SemanticClass& c : table.classes)
    if (std::ranges::any_of(maps, [&](const JudgedMap& map) {
          return std::ranges::any_of(map.voxels, [&](const JudgedVoxel& voxel) {
            return voxel.class_id == c.id && voxel.verdict != Verdict::missed;
          });
        }))
      legend.push_back({c.colour, c.name});
  return legend;
}

/// Two panels beside each other; white where the second one is not there.
cv::Mat3b row_of(const JudgedMap& left, const JudgedMap* right, const ClassTable& table,
                 ScenePainter& painter, const sim::View& view) {
  const auto panel = [&](const JudgedMap& map) {
    return CaptionedColumn{map.title, {class_picture(map, table, painter, view)}, {}};
  };
  const cv::Mat3b white(view.height_px, view.width_px, cv::Vec3b::all(255));
  return in_columns({panel(left), right ? panel(*right) : CaptionedColumn{" ", {white}, {}}},
                    kPanel_px);
}

}  // namespace

cv::Mat3b resolution_picture(const std::vector<JudgedMap>& maps, const ClassTable& table,
                             ScenePainter& painter, const sim::View& view) {
  cv::Mat3b sheet;
  for (std::size_t n = 0; n < maps.size(); n += 2) {
    const JudgedMap* right = n + 1 < maps.size() ? &maps[n + 1] : nullptr;
    sheet.push_back(row_of(maps[n], right, table, painter, view));
  }
  return captioned(sheet, "", legend_of(maps, table));
}

}  // namespace mapscore::eval
