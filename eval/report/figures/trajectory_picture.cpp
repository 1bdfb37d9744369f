// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/trajectory_picture.hpp"

#include "core/error.hpp"
#include "eval/report/figures/layout.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr double kThinnestM =
    1e-3;  ///< axis of a drawn ellipse; gnuplot takes 0 for its own default
constexpr double kLongestSide_in = 6.2, kHighest_in = 7.5, kMargin_m = 0.25;
/// A way that leaves its home by so much is drawn in a square, its grid of at most kMostCells along
/// a side.
constexpr double kFarAway_m = 100.0, kMostCells = 2000.0;
constexpr double kThinnest_lw = 1.4, kStep_lw = 0.6;
constexpr double kTurned_rad = 1e-9;  ///< a grid turned by less lies along the map's axes
constexpr const char* kTruthColour = "#999999";
/// Occupied, neither, unknown, free.
constexpr const char* kPalette =
    "set palette maxcolors 4 defined (0 '#464646', 1 '#A0A0A0', 2 '#DEDEDE', 3 '#FFFFFF'); "
    "set cbrange [-0.5:3.5]; unset colorbox";

/// Position of a cell's colour in kPalette.
char colour_of(Occupancy value) {
  if (value == kUnknownCell) return '2';
  if (value == kFreeCell) return '3';
  return value == kOccupiedCell ? '0' : '1';
}

void check(const std::vector<Eigen::Vector2d>& points, const std::string& name) {
  for (const Eigen::Vector2d& p : points)
    if (!p.allFinite())
      throw Error(fmt::format("trajectory '{}': point ({}, {}) m is not finite; leave it out", name,
                              p.x(), p.y()));
}

/// Ends of the cells of one axis of the picture, on a lattice of edge `step_m` from `origin_m`.
struct Cells {
  double origin_m, step_m;
  long first, end;

  [[nodiscard]] double centre(long cell) const {
    return origin_m + (static_cast<double>(cell) + 0.5) * step_m;
  }
  [[nodiscard]] double low() const { return origin_m + static_cast<double>(first) * step_m; }
  [[nodiscard]] double high() const { return origin_m + static_cast<double>(end) * step_m; }
};

Cells cells_over(double low, double high, double origin_m, double step_m) {
  return {origin_m, step_m, std::lround(std::floor((low - origin_m) / step_m)),
          std::lround(std::ceil((high - origin_m) / step_m))};
}

/// One picture, put together part by part; a part is a block of data and its elements of `plot`.
class TrajectoryFigure {
 public:
  TrajectoryFigure(const OccupancyGrid& grid, std::span<const DrawnTrajectory> trajectories,
                   const TrajectoryNotes& notes, const FigureStyle& style)
      : grid_(grid), trajectories_(trajectories), notes_(notes) {
    sheet_.name = notes.name;
    sheet_.style = style;
    sheet_.to_scale = true;
    for (const DrawnTrajectory& trajectory : trajectories)
      check(trajectory.points_map, trajectory.name);
    check(notes.waypoints_map, "waypoints");
  }

  [[nodiscard]] FigureSheet finish() {
    lay_out();
    add_grid();
    add_lines();
    for (std::size_t t = 0; t < trajectories_.size(); ++t) add_ellipses(t);
    add_waypoints();
    add_ends();
    panel_.title = notes_.title;
    panel_.x_label = "x (m)";
    panel_.y_label = "y (m)";
    sheet_.panels.push_back(std::move(panel_));
    sheet_.caption = caption();
    return std::move(sheet_);
  }

 private:
  [[nodiscard]] std::string colour(std::size_t trajectory) const {
    if (trajectory == 0) return kTruthColour;
    return sheet_.style.grey ? grey_tone(trajectory - 1) : palette_colour(trajectory - 1);
  }

  [[nodiscard]] std::string dash(std::size_t trajectory) const {
    if (sheet_.style.grey) return grey_dash(trajectory - 1);
    return trajectory == 1 ? "1" : "(7,3)";
  }

  /// The later a line is drawn, the thinner it is: where lines run as one, each still shows.
  [[nodiscard]] double width(std::size_t trajectory) const {
    const auto above = static_cast<double>(trajectories_.size() - 1 - trajectory);
    return trajectory == 0 ? kThinnest_lw + kStep_lw * std::max(4.0, above)
                           : kThinnest_lw + kStep_lw * above;
  }

  /// Everything that must be in the picture, in the map.
  [[nodiscard]] Eigen::AlignedBox2d drawn() const {
    Eigen::AlignedBox2d box;
    const GridFrame& frame = grid_.frame();
    for (GridCell cell; cell.row < frame.height; ++cell.row)
      for (cell.column = 0; cell.column < frame.width; ++cell.column)
        if (grid_.at(cell) != kUnknownCell) box.extend(grid_.centre_of(cell));
    for (const DrawnTrajectory& trajectory : trajectories_)
      for (const Eigen::Vector2d& p : trajectory.points_map) box.extend(p);
    for (const Eigen::Vector2d& p : notes_.waypoints_map) box.extend(p);
    if (box.isEmpty())
      throw Error(
          "trajectory picture: the grid knows nothing and no trajectory has a point; give "
          "one of them");
    return {box.min().array() - kMargin_m, box.max().array() + kMargin_m};
  }

  void lay_out() {
    Eigen::AlignedBox2d box = drawn();
    const double longest = box.sizes().maxCoeff();
    const bool astray = longest > kFarAway_m;
    if (astray) box = {box.center().array() - 0.5 * longest, box.center().array() + 0.5 * longest};
    const GridFrame& frame = grid_.frame();
    const bool turned = std::abs(wrapped_angle(frame.T_map_grid.yaw_rad)) > kTurned_rad;
    double step = turned ? 0.5 * frame.resolution_m : frame.resolution_m;
    while (longest > kMostCells * step) step *= 2.0;
    x_ = cells_over(box.min().x(), box.max().x(), frame.T_map_grid.x_m, step);
    y_ = cells_over(box.min().y(), box.max().y(), frame.T_map_grid.y_m, step);
    const double width = x_.high() - x_.low(), height = y_.high() - y_.low();
    const double in_per_m = std::min(kLongestSide_in / width, kHighest_in / height);
    sheet_.panel_width_in = std::max(2.0, width * in_per_m);
    sheet_.panel_height_in = sheet_.panel_width_in * height / width;
    const double tics = astray                           ? tic_step(longest, kLongestSide_in)
                        : std::max(width, height) > 12.0 ? 2.0
                                                         : 1.0;
    panel_.settings = {
        fmt::format("set xrange [{:.6g}:{:.6g}]; set xtics {}", x_.low(), x_.high(), tics),
        fmt::format("set yrange [{:.6g}:{:.6g}]; set ytics {}", y_.low(), y_.high(), tics),
        "set border 15; set tics out; unset grid; set ylabel offset 0.2,0", kPalette};
  }

  void write(const Eigen::Vector2d& p) {
    sheet_.data += fmt::format("{:.4f} {:.4f}\n", p.x(), p.y());
  }

  void add_grid() {
    const std::string of = sheet_.start_block(
        "grid", "a line a row, from the least y: 0 occupied, 1 neither, 2 unknown, 3 free");
    for (long row = y_.first; row < y_.end; ++row) {
      for (long column = x_.first; column < x_.end; ++column) {
        const GridCell cell = grid_.cell_of({x_.centre(column), y_.centre(row)});
        sheet_.data += colour_of(grid_.at_or_unknown(cell));
        sheet_.data += column + 1 < x_.end ? ' ' : '\n';
      }
    }
    panel_.elements.push_back(
        fmt::format("{} matrix using ({:.6g}+{:.6g}*$1):({:.6g}+{:.6g}*$2):3 with image notitle",
                    of, x_.centre(x_.first), x_.step_m, y_.centre(y_.first), y_.step_m));
  }

  void add_lines() {
    for (std::size_t t = 0; t < trajectories_.size(); ++t) {
      if (trajectories_[t].points_map.empty()) continue;
      const std::string of = sheet_.start_block(trajectories_[t].name, "x y");
      for (const Eigen::Vector2d& p : trajectories_[t].points_map) write(p);
      const std::string style =
          t == 0 ? fmt::format("lines lw {:.1f} lc rgb '{}'", width(t), colour(t))
                 : fmt::format("lines lw {:.1f} dt {} lc rgb '{}'", width(t), dash(t), colour(t));
      plot(of, style, trajectories_[t].name);
    }
  }

  void add_ellipses(std::size_t t) {
    if (trajectories_[t].beliefs.empty()) return;
    const std::string what = trajectories_[t].name + ", 2 sigma";
    const std::string of = sheet_.start_block(what, "x y first_axis_m second_axis_m angle_deg");
    for (const PoseEstimate& belief : trajectories_[t].beliefs) {
      PlanarEllipse e = two_sigma_ellipse(belief);
      e.first_axis_m = std::max(e.first_axis_m, kThinnestM);
      e.second_axis_m = std::max(e.second_axis_m, kThinnestM);
      sheet_.data +=
          fmt::format("{:.4f} {:.4f} {:.4f} {:.4f} {:.2f}\n", e.centre.x(), e.centre.y(),
                      e.first_axis_m, e.second_axis_m, e.angle_rad * 180.0 / std::numbers::pi);
    }
    panel_.elements.push_back(fmt::format(
        "{0} using 1:2:3:4:5 with ellipses fs transparent solid 0.2 border lc rgb '{1}' lw 0.8 lc "
        "rgb '{1}' notitle",
        of, colour(t)));
    sheet_.add_legend(
        fmt::format("boxes fs transparent solid 0.2 border lc rgb '{0}' lc rgb '{0}'", colour(t)),
        what);
  }

  void add_waypoints() {
    if (notes_.waypoints_map.empty()) return;
    const std::string of = sheet_.start_block("waypoints", "x y");
    for (const Eigen::Vector2d& p : notes_.waypoints_map) write(p);
    plot(of, "points pt 6 ps 1.0 lw 1.2 lc rgb '#333333'", "waypoint");
  }

  /// Start and end of the first trajectory, white below so that they stand out.
  void add_ends() {
    if (trajectories_.empty() || trajectories_.front().points_map.empty()) return;
    const std::vector<Eigen::Vector2d>& points = trajectories_.front().points_map;
    const std::string start = sheet_.start_block("start", "x y");
    write(points.front());
    panel_.elements.push_back(start +
                              " using 1:2 with points pt 7 ps 2.1 lc rgb '#FFFFFF' notitle");
    plot(start, "points pt 7 ps 1.5 lc rgb '#E69F00'", "start");
    const std::string end = sheet_.start_block("end", "x y");
    write(points.back());
    panel_.elements.push_back(end + " using 1:2 with points pt 5 ps 2.0 lc rgb '#FFFFFF' notitle");
    plot(end, "points pt 5 ps 1.4 lc rgb '#CC79A7'", "end");
  }

  void plot(const std::string& of, const std::string& style, const std::string& name) {
    panel_.elements.push_back(fmt::format("{} using 1:2 with {} notitle", of, style));
    sheet_.add_legend(style, name);
  }

  [[nodiscard]] std::string caption() const {
    const bool ellipses = std::any_of(trajectories_.begin(), trajectories_.end(),
                                      [](const DrawnTrajectory& t) { return !t.beliefs.empty(); });
    return fmt::format(
        "{}{}Occupancy grid, cells of {:.6g} cm: occupied dark, free white, unknown grey.{}",
        notes_.caption, notes_.caption.empty() ? "" : " ", 100.0 * grid_.frame().resolution_m,
        ellipses ? " Ellipses: 2 sigma of the believed position." : "");
  }

  const OccupancyGrid& grid_;
  std::span<const DrawnTrajectory> trajectories_;
  const TrajectoryNotes& notes_;
  FigureSheet sheet_;
  Panel panel_;
  Cells x_{}, y_{};
};

}  // namespace

PlanarEllipse two_sigma_ellipse(const PoseEstimate& belief) {
  if (!belief.covariance.allFinite())
    throw Error(fmt::format("belief at ({}, {}) m: its covariance is not finite; leave it out",
                            belief.mean.x_m, belief.mean.y_m));
  const double xx = belief.covariance(0, 0), xy = belief.covariance(0, 1),
               yy = belief.covariance(1, 1);
  const double mean = (xx + yy) / 2, spread = std::hypot((xx - yy) / 2, xy);  // of the eigenvalues
  const auto full_axis = [](double variance) { return 4.0 * std::sqrt(std::max(0.0, variance)); };
  return {{belief.mean.x_m, belief.mean.y_m},
          full_axis(mean + spread),
          full_axis(mean - spread),
          wrapped_angle(belief.mean.yaw_rad + std::atan2(2 * xy, xx - yy) / 2)};
}

FigureSheet trajectory_figure(const OccupancyGrid& grid,
                              std::span<const DrawnTrajectory> trajectories,
                              const TrajectoryNotes& notes, const FigureStyle& style) {
  return TrajectoryFigure(grid, trajectories, notes, style).finish();
}

}  // namespace mapscore::eval
