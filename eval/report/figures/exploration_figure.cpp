// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/exploration_figure.hpp"

#include "core/error.hpp"
#include "eval/lab/map_frame.hpp"
#include "eval/recording/grid_file.hpp"
#include "eval/report/figures/curves.hpp"
#include "eval/report/figures/layout.hpp"
#include "files/csv.hpp"
#include "files/file_bytes.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr int kCurveSteps = 120;
constexpr double kFloorMargin_m = 0.2, kMomentPanel_in = 2.4;

/// A panel's row: what stands along its axes.
struct CurveRow {
  const char *name, *x_label, *y_label;
  CurveAxis axis;
  std::function<std::optional<double>(const ExplorationCurve&, double)> value;
};

/// F1 of the last scored point up to there; none before the first.
std::optional<double> f1_at(const ExplorationCurve& curve, double driven_m) {
  std::optional<double> f1;
  for (const CoveragePoint& point : curve)
    if (point.map && point.driven_m <= driven_m) f1 = point.map->f1;
  return f1;
}

std::vector<CurveRow> curve_rows() {
  const auto coverage = [](CurveAxis axis) {
    return [axis](const ExplorationCurve& curve, double at) {
      return std::optional(coverage_at(curve, at, axis));
    };
  };
  return {{"coverage over the way", "way driven (m)", "coverage", CurveAxis::metres,
           coverage(CurveAxis::metres)},
          {"F1 over the way", "way driven (m)", "F1 of the map", CurveAxis::metres, f1_at},
          {"coverage over time", "time of the drive (s)", "coverage", CurveAxis::seconds,
           coverage(CurveAxis::seconds)}};
}

std::string scene_of_group(const ExplorationGroup& group) {
  for (const auto& [path, value] : group.doses)
    if (path == kSceneAxis) return value;
  return "";
}

/// "next best view, direct": the doses but for the scene, and the method of several.
std::string line_name(const Study& study, const ExplorationGroup& group) {
  std::string name;
  for (const auto& [path, value] : group.doses)
    if (path != kSceneAxis) name += (name.empty() ? "" : ", ") + spaced(value);
  if (study.methods.size() > 1 || name.empty())
    name += (name.empty() ? "" : ", ") + method_title(study, group.method);
  return name;
}

double budget_of(const ExplorationGroup& group, CurveAxis axis) {
  const ExplorationSettings& settings = group.runs.front()->planned.config.exploration;
  return axis == CurveAxis::metres ? settings.budget_m : settings.budget_s;
}

/// Where the last exploration of a scene ended, up to the budget.
double end_of(const std::vector<const ExplorationGroup*>& groups, CurveAxis axis) {
  double end = 0.0;
  for (const ExplorationGroup* group : groups)
    for (const FinishedExploration* run : group->runs)
      end = std::max(
          end, std::min(budget_of(*group, axis),
                        axis == CurveAxis::metres ? run->kept.driven_m : run->kept.duration_s));
  return std::max(end, 1e-3);
}

/// One figure of curves, put together panel by panel.
class CurvesFigure {
 public:
  CurvesFigure(const Study& study, const std::vector<ExplorationGroup>& groups,
               const FigureStyle& style)
      : study_(study) {
    sheet_.name = "exploration_curves";
    sheet_.style = style;
    for (const ExplorationGroup& group : groups) {
      scenes_.try_emplace(scene_of_group(group)).first->second.push_back(&group);
      const std::string name = line_name(study, group);
      if (std::ranges::find(names_, name) == names_.end()) names_.push_back(name);
    }
    sheet_.columns = static_cast<int>(scenes_.size());
    sheet_.panel_width_in = scenes_.size() == 1 ? 4.0 : 2.4;
  }

  [[nodiscard]] FigureSheet finish() {
    for (const CurveRow& row : curve_rows()) {
      bool first = true;
      for (const auto& [scene, groups] : scenes_) {
        add_panel(row, scene, groups, first);
        first = false;
      }
    }
    for (std::size_t n = 0; n < names_.size(); ++n)
      sheet_.add_legend("lines " + line(n), names_[n]);
    sheet_.caption = caption();
    return std::move(sheet_);
  }

 private:
  [[nodiscard]] std::string colour(std::size_t n) const {
    return sheet_.style.grey ? grey_tone(n) : palette_colour(n);
  }
  [[nodiscard]] std::string line(std::size_t n) const {
    return fmt::format("lw 1.6 dt {} lc rgb '{}'", sheet_.style.grey ? grey_dash(n) : "1",
                       colour(n));
  }

  void add_panel(const CurveRow& row, const std::string& scene,
                 const std::vector<const ExplorationGroup*>& groups, bool first) {
    Panel panel{sheet_.panels.size() < scenes_.size() ? scene : "", row.x_label,
                first ? row.y_label : ""};
    panel.y_tic_labels = first;
    const double end = end_of(groups, row.axis);
    panel.settings = {fmt::format("set xrange [0:{:.6g}]; set yrange [0:1]", end),
                      "set xtics autofreq; set ytics 0.2"};
    std::vector<std::string> bands, lines;
    for (const ExplorationGroup* group : groups) {
      const std::string name = line_name(study_, *group);
      const auto n = static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin());
      const std::string data = add_block(row, scene, name, *group, end);
      bands.push_back(fmt::format("{} using 1:3:4 with filledcurves {} notitle", data,
                                  band_fill(n, colour(n), sheet_.style)));
      lines.push_back(fmt::format("{} using 1:2 with lines {} notitle", data, line(n)));
    }
    panel.elements = std::move(bands);
    panel.elements.insert(panel.elements.end(), lines.begin(), lines.end());
    sheet_.panels.push_back(std::move(panel));
  }

  std::string add_block(const CurveRow& row, const std::string& scene, const std::string& name,
                        const ExplorationGroup& group, double end) {
    const std::string data =
        sheet_.start_block(fmt::format("{}; {}; {}", row.name, scene, name), "x mean low high");
    for (int step = 0; step <= kCurveSteps; ++step) {
      const double x = end * step / kCurveSteps;
      std::vector<std::optional<double>> values;
      for (const FinishedExploration* run : group.runs)
        values.push_back(row.value(run->kept.curve, x));
      const SeedSummary summary = summarise(values, {0.0, 1.0});
      sheet_.data += fmt::format("{:.6g} {} {} {}\n", x, figure_number(summary.mean),
                                 figure_number(summary.low ? summary.low : summary.mean),
                                 figure_number(summary.high ? summary.high : summary.mean));
    }
    return data;
  }

  [[nodiscard]] std::string caption() const {
    const ExplorationGroup& any = *scenes_.begin()->second.front();
    return fmt::format(
        "{}: coverage of the visible surface, voxels of {:.6g} cm, and F1 of the detected classes "
        "against all of it. Mean over {} starts; band: {}. Those that ended keep what they have.",
        study_.name, 100.0 * study_.voxel_m, any.runs.size(),
        any.coverage.kind == SpreadKind::interval ? "95 % interval" : "least to greatest");
  }

  const Study& study_;
  FigureSheet sheet_;
  std::map<std::string, std::vector<const ExplorationGroup*>> scenes_;
  std::vector<std::string> names_;
};

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
      throw Error(fmt::format("{}:{}: is no line of {} numbers; explore again", file.string(),
                              lines.number(), columns));
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
  const double step = moment.floor.frame().resolution_m;
  const auto cells = [step](double length) { return static_cast<int>(std::ceil(length / step)); };
  const int width = cells(box.sizes().x()), height = cells(box.sizes().y());
  Panel panel{fmt::format("{:.1f} m, {:.0f} %", moment.driven_m, 100.0 * moment.coverage), "x (m)",
              "y (m)"};
  panel.settings = {fmt::format("set xrange [{:.4f}:{:.4f}]; set yrange [{:.4f}:{:.4f}]",
                                box.min().x(), box.max().x(), box.min().y(), box.max().y()),
                    "set border 15; set tics out; set xtics 2; set ytics 2; unset grid",
                    "set palette maxcolors 3 defined (0 '#464646', 1 '#DEDEDE', 2 '#FFFFFF'); "
                    "set cbrange [-0.5:2.5]; unset colorbox"};
  const auto points = [&](const char* what, const std::vector<Eigen::Vector2d>& list) {
    const std::string data = sheet.start_block(what, "x y");
    for (const Eigen::Vector2d& p : list)
      sheet.data += fmt::format("{:.3f} {:.3f}\n", p.x(), p.y());
    return data;
  };
  const std::string grid = sheet.start_block("grid", "a line a row: 0 occupied, 1 unknown, 2 free");
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const Eigen::Vector2d p = box.min() + step * Eigen::Vector2d(column + 0.5, row + 0.5);
      sheet.data += shade_of(moment.floor.at_or_unknown(moment.floor.cell_of(p)));
      sheet.data += column + 1 < width ? ' ' : '\n';
    }
  panel.elements.push_back(
      fmt::format("{} matrix using ({:.4f}+{:.4f}*$1):({:.4f}+{:.4f}*$2):3 with image notitle",
                  grid, box.min().x() + 0.5 * step, step, box.min().y() + 0.5 * step, step));
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

FigureSheet exploration_curves(const Study& study, const std::vector<ExplorationGroup>& groups,
                               const FigureStyle& style) {
  return CurvesFigure(study, groups, style).finish();
}

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
  if (moments.empty()) throw Error(run.folder.string() + ": has no moments; explore again");
  const Eigen::AlignedBox2d box = known_box(moments);
  FigureSheet sheet;
  sheet.name = "exploration_" + run.planned.name;
  sheet.style = style;
  sheet.columns = 2;
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
