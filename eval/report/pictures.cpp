// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures.hpp"

#include "core/error.hpp"
#include "eval/report/figures_axes.hpp"
#include "eval/report/pictures_caption.hpp"
#include "eval/report/pictures_scene.hpp"
#include "eval/report/pictures_view.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <memory>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// Edge of a drawn cube over the voxel's, so that neighbours can be told apart.
constexpr double kCubeShare = 0.92;
constexpr int kSideBySide_px = 640;

sim::Cube cube_of(const TrialMap& map, const JudgedVoxel& voxel, const Colour& colour) {
  return {map.T_world_map * centre_of(voxel.key, map.edge_m), kCubeShare * map.edge_m,
          map.T_world_map.linear(), colour};
}

std::vector<sim::Cube> class_cubes(const TrialMap& map, const ClassTable& table) {
  std::vector<sim::Cube> cubes;
  for (const JudgedVoxel& voxel : map.voxels)
    if (voxel.verdict != Verdict::missed)
      cubes.push_back(cube_of(map, voxel, table.classes.at(voxel.class_id).colour));
  return cubes;
}

std::vector<sim::Cube> error_cubes(const TrialMap& map) {
  std::vector<sim::Cube> cubes;
  for (const JudgedVoxel& voxel : map.voxels)
    if (!voxel.covered) cubes.push_back(cube_of(map, voxel, colour_of(voxel.verdict)));
  return cubes;
}

std::vector<LegendEntry> class_legend(const TrialMap& map, const ClassTable& table) {
  std::vector<LegendEntry> legend;
  for (const SemanticClass& c : table.classes) {
    const auto voxels = std::count_if(map.voxels.begin(), map.voxels.end(), [&](const auto& voxel) {
      return voxel.class_id == c.id && voxel.verdict != Verdict::missed;
    });
    if (voxels > 0) legend.push_back({c.colour, fmt::format("{} {}", c.name, voxels)});
  }
  return legend;
}

std::vector<LegendEntry> error_legend(const TrialMap& map) {
  std::vector<LegendEntry> legend;
  for (const Verdict verdict : kVerdicts) {
    std::string text = fmt::format("{} {}", name_of(verdict), count(map.voxels, verdict));
    const auto covered = std::count_if(map.voxels.begin(), map.voxels.end(),
                                       [](const JudgedVoxel& voxel) { return voxel.covered; });
    if (verdict == Verdict::missed && covered > 0)
      text += fmt::format(" ({} of them under another class)", covered);
    legend.push_back({colour_of(verdict), std::move(text)});
  }
  return legend;
}

/// ASCII, since OpenCV writes nothing else.
std::string title_of(const TrialMap& map) {
  std::string title = map.method;
  for (const auto& [path, value] : map.cell.doses) {
    std::string text = figure_axis({path, {value}}).text(0);
    for (const auto& [letter, ascii] : {std::pair{"σ", "sigma"}, {"×", "x"}})
      if (const std::size_t at = text.find(letter); at != std::string::npos)
        text.replace(at, std::string(letter).size(), ascii);
    title += ", " + text;
  }
  title += fmt::format(", seed {}", map.seed_index);
  return map.frame ? title + fmt::format(", frame {}", *map.frame) : title;
}

/// Methods from left to right, views from top to bottom.
cv::Mat3b side_by_side(const std::vector<std::vector<cv::Mat3b>>& columns) {
  cv::Mat3b all;
  for (const std::vector<cv::Mat3b>& column : columns) {
    cv::Mat3b stacked;
    for (const cv::Mat3b& picture : column) {
      cv::Mat3b small;
      const double scale = static_cast<double>(kSideBySide_px) / picture.cols;
      cv::resize(picture, small, {}, scale, scale, cv::INTER_AREA);
      if (stacked.empty())
        stacked = small;
      else
        cv::vconcat(stacked, small, stacked);
    }
    if (all.empty())
      all = stacked;
    else
      cv::hconcat(all, stacked, all);
  }
  return all;
}

std::vector<fs::path> paint_all(const std::vector<TrialMap>& maps, const ClassTable& table,
                                const Recording& recording, ScenePainter& painter,
                                const fs::path& folder) {
  const sim::View from_above = overview(maps), close = error_view(maps, recording);
  std::vector<fs::path> files;
  std::vector<std::vector<cv::Mat3b>> columns;
  for (const TrialMap& map : maps) {
    const std::string title = title_of(map);
    const auto save = [&](const std::string& name, const cv::Mat3b& picture) {
      files.push_back(write_picture(folder / name, picture));
    };
    save("map_" + map.method + ".png", captioned(painter.paint(from_above, class_cubes(map, table)),
                                                 title, class_legend(map, table)));
    const std::vector<sim::Cube> errors = error_cubes(map);
    const cv::Mat3b wide = captioned(painter.paint(from_above, errors), title, error_legend(map));
    const cv::Mat3b near = captioned(painter.paint(close, errors), title, error_legend(map));
    save("errors_" + map.method + ".png", wide);
    save("errors_" + map.method + "_close.png", near);
    columns.push_back({wide, near});
  }
  files.push_back(write_picture(folder / "errors.png", side_by_side(columns)));
  return files;
}

}  // namespace

Pictures draw_pictures(const Study& study, const ClassTable& table, const Recording& recording,
                       const PictureChoice& choice, const fs::path& folder) {
  if (!recording.info().has_truth)
    return {{}, recording.folder().string() + ": has no truth, so its maps cannot be judged"};
  std::unique_ptr<ScenePainter> painter;
  try {
    painter = std::make_unique<ScenePainter>(study, recording);
  } catch (const Error& error) {
    return {{}, error.what()};
  }
  fs::create_directories(folder);
  const std::vector<TrialMap> maps = map_trials(study, table, recording, choice);
  return {paint_all(maps, table, recording, *painter, folder), ""};
}

}  // namespace mapscore::eval
