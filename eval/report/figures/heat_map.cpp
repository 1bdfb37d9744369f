// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/curves.hpp"
#include "eval/report/figures/figures.hpp"
#include "eval/report/figures/iso_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace mapscore::eval {
namespace {

constexpr const char* kHeatMetric = "f1";
constexpr int kPixels = 60;  ///< of a panel's picture, along each side
constexpr int kPanelsARow = 3;
constexpr double kMostSteps = 6.0;  ///< lines of equal F1
/// From low to high: light enough for black lines, and ever lighter.
constexpr std::string_view kColourScale = "0 '#1D91C0', 0.35 '#7FCDBB', 0.7 '#C7E9B4', 1 '#FFFFD9'";
constexpr std::string_view kGreyScale = "0 '#808080', 1 '#FFFFFF'";
/// Of labels from each other and from the frame, as a share of the panel.
constexpr double kApart = 0.2, kFromFrame = 0.05;
/// White about the picture, as a share of it: room for the numbers at its corners.
constexpr double kPadding = 0.05;

/// Numbers of steps of 0.01, 0.02, 0.05 or 0.1, so that the lines stay apart.
struct Levels {
  double step = 0.1;
  int first = 0, last = 0;

  [[nodiscard]] double at(int n) const { return n * step; }
};

Levels levels_of(double least, double greatest) {
  Levels levels;
  for (const double step : {0.01, 0.02, 0.05, 0.1}) {
    levels.step = step;
    if (greatest - least <= kMostSteps * step) break;
  }
  levels.first = static_cast<int>(std::floor(least / levels.step + 1e-9));
  levels.last = static_cast<int>(std::ceil(greatest / levels.step - 1e-9));
  if (levels.last == levels.first) ++levels.last;
  return levels;
}

/// Where the labels of lines stand: near the diagonal, apart from each other.
class LabelPlaces {
 public:
  explicit LabelPlaces(const DoseGrid& grid) : grid_(grid) {}

  [[nodiscard]] std::optional<std::array<double, 2>> next(const std::vector<IsoSegment>& line) {
    std::optional<std::array<double, 2>> best;
    double least = 2.0;
    for (const IsoSegment& segment : line) {
      const std::array<double, 2> middle{0.5 * (segment.from[0] + segment.to[0]),
                                         0.5 * (segment.from[1] + segment.to[1])};
      const auto [u, v] = share_of(middle);
      if (!is_free(u, v) || std::abs(u - v) >= least) continue;
      least = std::abs(u - v);
      best = middle;
    }
    if (best) taken_.push_back(share_of(*best));
    return best;
  }

 private:
  [[nodiscard]] std::array<double, 2> share_of(const std::array<double, 2>& place) const {
    return {(place[0] - grid_.x.front()) / (grid_.x.back() - grid_.x.front()),
            (place[1] - grid_.y.front()) / (grid_.y.back() - grid_.y.front())};
  }

  [[nodiscard]] bool is_free(double u, double v) const {
    return std::min({u, v, 1 - u, 1 - v}) >= kFromFrame &&
           std::ranges::none_of(taken_, [&](const std::array<double, 2>& other) {
             return std::max(std::abs(u - other[0]), std::abs(v - other[1])) < kApart;
           });
  }

  const DoseGrid& grid_;
  std::vector<std::array<double, 2>> taken_;
};

/// A panel a curve.
class HeatMap {
 public:
  HeatMap(const StudySummary& summary, const StudyLayout& layout)
      : summary_(summary), layout_(layout) {
    double least = 1.0, greatest = 0.0;
    for (const Curve& curve : layout.curves()) {
      grids_.push_back(grid_of(curve));
      for (const auto& value : grids_.back().values) {
        least = std::min(least, value.value_or(least));
        greatest = std::max(greatest, value.value_or(greatest));
      }
    }
    levels_ = levels_of(std::min(least, greatest), greatest);
    sheet_.name = "f1_by_two_doses";
    sheet_.columns = std::min(kPanelsARow, static_cast<int>(grids_.size()));
    sheet_.style = layout.style();
    sheet_.panel_width_in = sheet_.style.panel_width_in(sheet_.columns, sheet_.least_panel_in);
    sheet_.panel_height_in = std::min(2.4, sheet_.panel_width_in);
  }

  [[nodiscard]] FigureSheet figure() {
    const auto columns = static_cast<std::size_t>(sheet_.columns);
    for (std::size_t c = 0; c < grids_.size(); ++c) {
      const bool first = c % columns == 0;
      Panel panel{layout_.curves()[c].name, c + columns >= grids_.size() ? layout_.x().title() : "",
                  first ? layout_.second()->title() : "", first, settings(grids_[c])};
      add(layout_.curves()[c].name, grids_[c], panel.elements);
      sheet_.panels.push_back(std::move(panel));
    }
    for (int n = levels_.first; n <= levels_.last; ++n)
      sheet_.add_legend(fmt::format("boxes fs solid 1 border lc rgb '#444444' lw 0.5 fc palette cb "
                                    "{:.6g}",
                                    levels_.at(n)),
                        fmt::format("F1 = {:.6g}", levels_.at(n)));
    sheet_.caption = study_caption(summary_) +
                     " F1 at tolerance 0, counts pooled over classes and seeds: measured at the "
                     "dots, linear in between; lines of equal F1.";
    return std::move(sheet_);
  }

 private:
  [[nodiscard]] DoseGrid grid_of(const Curve& curve) const {
    DoseGrid grid;
    const std::vector<std::size_t> xs = ascending(layout_.x()), ys = ascending(*layout_.second());
    for (const std::size_t x : xs) grid.x.push_back(layout_.x().at[x]);
    for (const std::size_t y : ys) grid.y.push_back(layout_.second()->at[y]);
    for (const std::size_t x : xs)
      for (const std::size_t y : ys) {
        const auto trial = layout_.trial_at(curve, y, x);
        grid.values.push_back(
            trial ? estimate(summary_.trials[*trial], summary_.table, kPooled, kHeatMetric).pooled
                  : std::nullopt);
      }
    return grid;
  }

  [[nodiscard]] static std::vector<std::size_t> ascending(const FigureAxis& axis) {
    std::vector<std::size_t> order(axis.at.size());
    for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
    std::ranges::sort(order, {}, [&](std::size_t n) { return axis.at[n]; });
    return order;
  }

  [[nodiscard]] std::vector<std::string> settings(const DoseGrid& grid) const {
    const auto range = [](const char* axis, const std::vector<double>& line, double length_in) {
      const double length = line.back() - line.front();
      return fmt::format("set {0}range [{1:.9g}:{2:.9g}]; set {0}tics {3:.9g}", axis,
                         line.front() - kPadding * length, line.back() + kPadding * length,
                         tic_step(length, length_in));
    };
    return {range("x", grid.x, sheet_.panel_width_in),
            range("y", grid.y, kNarrow_in),
            fmt::format("set cbrange [{:.6g}:{:.6g}]; unset colorbox", levels_.at(levels_.first),
                        levels_.at(levels_.last)),
            fmt::format("set palette defined ({})", sheet_.style.grey ? kGreyScale : kColourScale),
            "set style textbox opaque noborder margins 0.3,0.2",
            sheet_.style.width_mm ? "" : "set ylabel offset 0,0"};
  }

  void add(const std::string& name, const DoseGrid& grid, std::vector<std::string>& elements) {
    const std::string measured = sheet_.start_block(name + "; measured", "x y f1");
    for (std::size_t ix = 0; ix < grid.x.size(); ++ix)
      for (std::size_t iy = 0; iy < grid.y.size(); ++iy)
        sheet_.data += fmt::format("{:.9g} {:.9g} {}\n", grid.x[ix], grid.y[iy],
                                   figure_number(grid.at(ix, iy)));
    elements.push_back(picture(name, grid) + " using 1:2:3 with image notitle");
    elements.push_back(measured +
                       " using 1:2 with points pt 7 ps 0.4 lw 0.5 lc rgb '#000000' notitle");
    add_lines(name, grid, elements);
  }

  /// Returns `data index N`.
  [[nodiscard]] std::string picture(const std::string& name, const DoseGrid& grid) {
    std::string block = sheet_.start_block(name + "; in between", "x y f1");
    const auto place = [](const std::vector<double>& line, int n) {
      return line.front() + (n + 0.5) / kPixels * (line.back() - line.front());
    };
    for (int iy = 0; iy < kPixels; ++iy)
      for (int ix = 0; ix < kPixels; ++ix) {
        const auto value = grid.between(place(grid.x, ix), place(grid.y, iy));
        sheet_.data += fmt::format("{:.6g} {:.6g} {}\n", place(grid.x, ix), place(grid.y, iy),
                                   value ? fmt::format("{:.5f}", *value) : "NaN");
      }
    return block;
  }

  /// The lines of equal F1 with their labels. A block of which nothing is drawn holds one line.
  void add_lines(const std::string& name, const DoseGrid& grid,
                 std::vector<std::string>& elements) {
    std::string pieces, labels;
    LabelPlaces places(grid);
    for (int n = levels_.last; n >= levels_.first; --n) {
      const std::vector<IsoSegment> line = iso_line(grid, levels_.at(n));
      for (const auto& [from, to] : line)
        pieces += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g} {:.6g}\n", from[0], from[1],
                              to[0] - from[0], to[1] - from[1], levels_.at(n));
      if (const auto place = places.next(line))
        labels += fmt::format("{:.6g} {:.6g} {:.6g}\n", (*place)[0], (*place)[1], levels_.at(n));
    }
    const auto add_block = [&](const char* what, const char* columns, const std::string& lines,
                               const std::string& plotting) {
      const std::string block = sheet_.start_block(name + what, columns);
      sheet_.data += lines.empty() ? "-\n" : lines;
      if (!lines.empty()) elements.push_back(block + plotting);
    };
    add_block("; lines of equal f1", "x y dx dy f1", pieces,
              " using 1:2:3:4 with vectors nohead lw 0.8 lc rgb '#000000' notitle");
    add_block("; labels", "x y f1", labels,
              fmt::format(" using 1:2:(sprintf('%g',$3)) with labels boxed font ',{}' notitle",
                          sheet_.style.small_pt()));
  }

  const StudySummary& summary_;
  const StudyLayout& layout_;
  std::vector<DoseGrid> grids_;  ///< by curve
  Levels levels_;
  FigureSheet sheet_;
};

}  // namespace

std::optional<FigureSheet> heat_map_figure(const StudySummary& summary, const StudyLayout& layout) {
  const auto is_range = [](const FigureAxis& axis) {
    return axis.numeric && axis.values.size() > 1;
  };
  if (!layout.second() || !is_range(layout.x()) || !is_range(*layout.second())) return std::nullopt;
  return HeatMap(summary, layout).figure();
}

}  // namespace mapscore::eval
