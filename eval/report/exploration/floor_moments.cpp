// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/exploration/floor_moments.hpp"

#include "core/error.hpp"
#include "eval/lab/map_frame.hpp"
#include "eval/recording/grid_file.hpp"
#include "eval/report/figures/layout.hpp"
#include "files/csv.hpp"
#include "files/file_bytes.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr double kFloorMargin_m = 0.2, kMomentPanel_in = 2.4;

/// Rows of numbers below the head of a CSV file.
std::vector<std::vector<double>> numbers_in(const std::filesystem::path& file,
                                            std::size_t columns) {
  const std::string text = read_file(file);
  TextLines lines(text);
  static_cast<void>(lines.next());
  std::vector<std::vector<double>> rows;
  while (const auto line = lines.next()) {
    auto numbers = parse_numbers(*line, columns);
    if (!numbers || numbers->size() != columns)
      throw Error(fmt::format("{}:{}: is no line of {} numbers; remove {} to explore it anew",
                              shown(file), lines.number(), columns, shown(file.parent_path())));
    rows.push_back(std::move(*numbers));
  }
  return rows;
}

Eigen::AlignedBox2d known_box(const std::vector<ShownMoment>& moments) {
  Eigen::AlignedBox2d box;
  for (const ShownMoment& moment : moments) {
    const GridFrame& frame = moment.floor.frame();
    for (GridCell cell; cell.row < frame.height; ++cell.row)
      for (cell.column = 0; cell.column < frame.width; ++cell.column)
        if (moment.floor.at(cell) != kUnknownCell) box.extend(moment.floor.centre_of(cell));
    for (const Eigen::Vector2d& p : moment.way_map) box.extend(p);
  }
  return {box.min().array() - kFloorMargin_m, box.max().array() + kFloorMargin_m};
}

/// Position of a cell's colour in the palette.
char shade_of(Occupancy value) {
  return value == kUnknownCell ? '1' : value == kFreeCell ? '2' : '0';
}

void add_moment(const ShownMoment& moment, const Eigen::AlignedBox2d& box, FigureSheet& sheet) {
  const OccupancyGrid& floor = moment.floor;
  const double step = floor.frame().resolution_m;
  const GridCell low = floor.cell_of(box.min()), high = floor.cell_of(box.max());
  const Eigen::Vector2d p_low = floor.centre_of(low);
  Panel panel{fmt::format("{:.1f} m, {:.0f} %", moment.driven_m, 100.0 * moment.coverage), "x (m)",
              "y (m)"};
  panel.settings = {fmt::format("set xrange [{:.4f}:{:.4f}]; set yrange [{:.4f}:{:.4f}]",
                                box.min().x(), box.max().x(), box.min().y(), box.max().y()),
                    "set border 15; set tics out; set xtics 2; set ytics 2; unset grid",
                    "set palette maxcolors 3 defined (0 '#464646', 1 '#DEDEDE', 2 '#FFFFFF'); "
                    "set cbrange [-0.5:2.5]; unset colorbox"};
  if (!sheet.style.width_mm) panel.settings.emplace_back("set ylabel offset 0,0");
  const auto points = [&](const char* what, const std::vector<Eigen::Vector2d>& list) {
    const std::string data = sheet.start_block(what, "x y");
    for (const Eigen::Vector2d& p : list)
      sheet.data += fmt::format("{:.3f} {:.3f}\n", p.x(), p.y());
    return data;
  };
  const std::string grid = sheet.start_block("grid", "a line a row: 0 occupied, 1 unknown, 2 free");
  for (GridCell cell = low; cell.row <= high.row; ++cell.row)
    for (cell.column = low.column; cell.column <= high.column; ++cell.column) {
      sheet.data += shade_of(floor.at_or_unknown(cell));
      sheet.data += cell.column < high.column ? ' ' : '\n';
    }
  panel.elements.push_back(
      fmt::format("{} matrix using ({:.4f}+{:.4f}*$1):({:.4f}+{:.4f}*$2):3 with image notitle",
                  grid, p_low.x(), step, p_low.y(), step));
  if (!moment.frontier_map.empty())
    panel.elements.push_back(points("frontiers", moment.frontier_map) +
                             " using 1:2 with points pt 7 ps 0.25 lc rgb '#D55E00' notitle");
  panel.elements.push_back(points("way", moment.way_map) +
                           " using 1:2 with lines lw 1.5 lc rgb '#0072B2' notitle");
  panel.elements.push_back(points("start", {moment.way_map.front()}) +
                           " using 1:2 with points pt 7 ps 0.9 lc rgb '#009E73' notitle");
  panel.elements.push_back(points("robot", {moment.way_map.back()}) +
                           " using 1:2 with points pt 6 ps 1.2 lw 1.6 lc rgb '#0072B2' notitle");
  sheet.panels.push_back(std::move(panel));
}

}  // namespace

std::vector<ShownMoment> read_moments(const FinishedExploration& run) {
  const Pose T_map_world = map_frame(run.planned.config, run.planned.spec.seed_index).T_map_world();
  const auto way = numbers_in(run.folder / kWayFile, 4);
  const auto frontiers = numbers_in(run.folder / kFrontiersFile, 3);
  std::vector<ShownMoment> moments;
  for (const std::vector<double>& row : numbers_in(run.folder / kMomentsFile, 3)) {
    const auto number = static_cast<int>(row[0]);
    ShownMoment moment{row[1],
                       row[2],
                       coverage_at(run.kept.curve, row[1], CurveAxis::seconds),
                       load_grid(run.folder / fmt::format("floor_{}.yaml", number)),
                       {},
                       {}};
    for (const std::vector<double>& cell : frontiers)
      if (static_cast<int>(cell[0]) == number) moment.frontier_map.emplace_back(cell[1], cell[2]);
    for (const std::vector<double>& pose : way)
      if (pose[0] <= moment.stamp_s || moment.way_map.empty())
        moment.way_map.push_back((T_map_world * Eigen::Vector3d(pose[1], pose[2], 0.0)).head<2>());
    moments.push_back(std::move(moment));
  }
  return moments;
}

FigureSheet exploration_moments(const FinishedExploration& run, const FigureStyle& style) {
  const std::vector<ShownMoment> moments = read_moments(run);
  if (moments.empty())
    throw Error(fmt::format("{}: has no moments; remove {} to explore it anew",
                            shown(run.folder / kMomentsFile), shown(run.folder)));
  const Eigen::AlignedBox2d box = known_box(moments);
  FigureSheet sheet;
  sheet.name = "exploration_" + run.planned.name;
  sheet.style = style;
  sheet.columns = std::min(2, static_cast<int>(moments.size()));
  sheet.to_scale = true;
  sheet.panel_width_in = kMomentPanel_in;
  sheet.panel_height_in = kMomentPanel_in * box.sizes().y() / box.sizes().x();
  for (const ShownMoment& moment : moments) add_moment(moment, box, sheet);
  sheet.add_legend("lines lw 1.5 lc rgb '#0072B2'", "way");
  sheet.add_legend("points pt 7 ps 0.9 lc rgb '#009E73'", "start");
  sheet.add_legend("points pt 6 ps 1.2 lw 1.6 lc rgb '#0072B2'", "robot");
  sheet.add_legend("points pt 7 ps 0.4 lc rgb '#D55E00'", "frontier");
  sheet.caption = fmt::format(
      "{}: the floor as the lidar had it after the way above each panel, with the share of the "
      "visible surface seen: free white, occupied dark, unknown grey; cells of {:.6g} cm.",
      run.planned.name, 100.0 * moments.front().floor.frame().resolution_m);
  return sheet;
}

}  // namespace mapscore::eval
