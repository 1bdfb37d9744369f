// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/pictures.hpp"

#include "core/error.hpp"
#include "eval/lab/map_frame.hpp"
#include "eval/report/axes.hpp"
#include "eval/report/pictures/map_pictures.hpp"
#include "eval/report/pictures/view.hpp"
#include "eval/results/plan.hpp"
#include "eval/study/picture_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// Width of a column where there are several.
constexpr int kColumn_px = 640;
/// What the names of the pictures from the views of error_views end in.
constexpr std::array<const char*, 2> kViewNames{"", "_close"};

std::string wanted_value(const SweepAxis& axis, const PictureChoice& choice) {
  for (const auto& [path, value] : choice.doses)
    if (path == axis.path) return value;
  return axis.values[axis.values.size() / 2];
}

/// Of points over ranges, the first with the wanted doses.
Cell chosen_point(const Study& study, const PictureChoice& choice) {
  for (Cell& cell : cells(study))
    if (std::ranges::all_of(choice.doses, [&](const auto& dose) {
          return std::ranges::find(cell.doses, dose) != cell.doses.end();
        }))
      return cell;
  throw Error("sweep: the study has no point with these doses; see `mapscore table RESULTS`");
}

void check_paths(const Study& study, const PictureChoice& choice) {
  for (const auto& [path, value] : choice.doses) {
    const auto axis = std::ranges::find(study.sweep, path, &SweepAxis::path);
    std::string swept;
    for (const SweepAxis& a : study.sweep) swept += " " + a.path;
    if (axis == study.sweep.end())
      throw Error(fmt::format("{}: the study does not sweep it; swept:{}", path, swept));
    std::string values;
    for (const std::string& v : axis->values) values += " " + v;
    if (std::ranges::find(axis->values, value) == axis->values.end())
      throw Error(fmt::format("{}: the study has no value {}; values:{}", path, value, values));
  }
}

/// ASCII, since OpenCV writes nothing else.
std::string title_of(const Study& study, const TrialSpec& spec, std::optional<int> frame) {
  std::string title = spec.method;
  for (const auto& [path, value] : spec.cell.doses) {
    std::string text = figure_axis(study, {path, {value}}).text(0);
    for (const auto& [letter, ascii] : {std::pair{"σ", "sigma"}, {"×", "x"}})
      if (const std::size_t at = text.find(letter); at != std::string::npos)
        text.replace(at, std::string(letter).size(), ascii);
    title += ", " + text;
  }
  title += fmt::format(", seed {}", spec.seed_index);
  return frame ? title + fmt::format(", frame {}", *frame) : title;
}

std::optional<sim::View> chosen_view(const Study& study, const PictureChoice& choice) {
  if (choice.view || !study.picture_view) return choice.view;
  return view_of_numbers(*study.picture_view);
}

/// The same view in a picture of that width.
sim::View narrowed(sim::View view, int width_px) {
  view.height_px = std::max(1, view.height_px * width_px / view.width_px);
  view.width_px = width_px;
  return view;
}

std::vector<fs::path> paint_all(const std::vector<JudgedMap>& maps, const ClassTable& table,
                                const std::vector<sim::View>& views, const sim::View& plan,
                                ScenePainter& painter, const fs::path& folder) {
  std::vector<fs::path> files;
  const auto save = [&](const std::string& name, const cv::Mat3b& picture) {
    files.push_back(write_picture(folder / (name + ".png"), picture));
  };
  std::vector<CaptionedColumn> columns;
  for (const JudgedMap& map : maps) {
    save("map_" + map.name, captioned(class_picture(map, table, painter, views.front()), map.title,
                                      class_legend(map, table)));
    save("map_and_truth_" + map.name, map_beside_truth(map, table, painter, plan));
    CaptionedColumn column{map.title, {}, error_legend(map)};
    for (std::size_t i = 0; i < views.size(); ++i) {
      column.pictures.push_back(error_picture(map, painter, views[i]));
      save("errors_" + map.name + kViewNames.at(i),
           captioned(column.pictures.back(), column.title, column.legend));
    }
    columns.push_back(std::move(column));
  }
  save("errors", in_columns(columns, columns.size() > 1 ? kColumn_px
                                                        : columns.front().pictures.front().cols));
  return files;
}

/// The time that a moving scene is drawn at: that of the map, or of the depth image of the frame
/// that is shown.
std::optional<double> drawn_time(const Study& study, const ClassTable& table,
                                 const Recording& recording, const PictureChoice& choice) {
  if (recording.info().motion.empty() || study.score.unit == ScoreUnit::map)
    return study.score.at_s;
  const int frame = fullest_frame(recording, table, 0, recording.frame_count());
  const double offset_ms = resolve(study, chosen_cell(study, choice)).faults.time_offset_ms;
  return recording.depth_stamp_s(recording.depth_of(frame, offset_ms / 1000.0));
}

}  // namespace

Cell chosen_cell(const Study& study, const PictureChoice& choice) {
  if (points_of(study.sampling) > 0) return chosen_point(study, choice);
  check_paths(study, choice);
  decltype(Cell::doses) doses;
  for (const SweepAxis& axis : study.sweep)
    doses.emplace_back(axis.path, wanted_value(axis, choice));
  const std::vector<Cell> all = cells(study);
  const auto cell = std::ranges::find(all, doses, &Cell::doses);
  if (cell == all.end())
    throw Error("sweep: the study has no such cell; see `mapscore table RESULTS`");
  return *cell;
}

int fullest_frame(const Recording& recording, const ClassTable& table, int first, int end) {
  int fullest = first;
  std::int64_t most = -1;
  for (int index = first; index < end; ++index) {
    const Frame frame = recording.read(index, {.color = false, .label = true, .depth = false});
    const std::int64_t pixels =
        std::count_if(frame.label.begin(), frame.label.end(),
                      [&](InstanceId id) { return table.detected(table.class_of(id)); });
    if (pixels > most) fullest = index;
    most = std::max(most, pixels);
  }
  return fullest;
}

JudgedMap judged_trial(const Study& study, const TrialRun& run, const Task& task,
                       const ClassTable& table, const TrialSpec& spec, std::optional<int> frame) {
  const LatticeTruth& truth = run.truth();
  return judged_map(spec.method, title_of(study, spec, frame), MapSnapshot(run.map().voxels()),
                    run.threshold(), truth.surface, truth.view.visible, table,
                    map_frame(task.config, task.seed_index).T_map_world());
}

Pictures draw_pictures(const Study& study, const ClassTable& table, const Recording& recording,
                       const PictureChoice& choice, const fs::path& folder,
                       const std::function<std::vector<JudgedMap>()>& judged_maps) {
  if (!recording.info().has_truth)
    return {{}, recording.folder().string() + ": has no truth, so its maps cannot be judged"};
  std::unique_ptr<ScenePainter> painter;
  try {
    painter = std::make_unique<ScenePainter>(study, recording,
                                             drawn_time(study, table, recording, choice));
  } catch (const Error& error) {
    return {{}, error.what()};
  }
  fs::create_directories(folder);
  const std::vector<JudgedMap> maps = judged_maps();
  if (maps.empty()) return {{}, "its method is a command, whose maps are not kept"};
  const std::optional<sim::View> chosen = chosen_view(study, choice);
  const std::vector<sim::View> views = error_views(maps, chosen, depth_camera_poses(recording));
  const sim::View plan = chosen ? narrowed(*chosen, kColumn_px) : plan_view(maps, kColumn_px);
  return {paint_all(maps, table, views, plan, *painter, folder), ""};
}

}  // namespace mapscore::eval
