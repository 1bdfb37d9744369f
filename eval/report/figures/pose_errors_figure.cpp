// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/pose_errors_figure.hpp"

#include "eval/report/figures/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr double kErrorHeight_in = 1.15, kLeastOfSource_in = 1.3;
constexpr double kRoomForTics_in = 2.0;  ///< for five tics along an axis of errors

/// One axis of the error in the plane.
struct ErrorRow {
  const char* label;
  double units;  ///< in one metre or radian
};
constexpr std::array<ErrorRow, 3> kErrorRows{
    {{"ahead (cm)", 100.0}, {"left (cm)", 100.0}, {"heading (deg)", 180.0 / std::numbers::pi}}};

/// Block of a source. Where it never converges it holds undefined numbers alone.
std::string add_block(FigureSheet& sheet, const PoseErrors& of) {
  std::string columns = "stamp_s";
  for (const ErrorRow& row : kErrorRows) columns += fmt::format(" {} low high", row.label);
  std::string block = sheet.start_block(of.source, columns);
  bool any = false;
  for (const FrameError& frame : of.frames) {
    if (!frame.converged) continue;
    any = true;
    sheet.data += fmt::format("{}", frame.stamp_s);
    for (std::size_t r = 0; r < kErrorRows.size(); ++r) {
      const auto axis = static_cast<Eigen::Index>(r);
      const double band = 2.0 * kErrorRows[r].units * frame.sigma[axis];
      sheet.data += fmt::format(" {:.6g} {:.6g} {:.6g}", kErrorRows[r].units * frame.error[axis],
                                -band, band);
    }
    sheet.data += '\n';
  }
  if (!any) sheet.data += "0 - - - - - - - - -\n";
  return block;
}

/// Share of the frames with a variance of an axis whose error lies within two sigma of it.
std::string within_text(const PoseErrors& of) {
  std::array<int, kErrorRows.size()> within{};
  int frames = 0;
  bool converged = false;
  for (const FrameError& frame : of.frames) {
    converged = converged || frame.converged;
    if (!frame.converged || frame.sigma.isZero(0.0)) continue;
    ++frames;
    for (std::size_t r = 0; r < kErrorRows.size(); ++r) {
      const auto axis = static_cast<Eigen::Index>(r);
      within[r] += std::abs(frame.error[axis]) <= 2.0 * frame.sigma[axis] ? 1 : 0;
    }
  }
  if (!converged) return fmt::format("{}: never converged. ", of.source);
  if (frames == 0) return fmt::format("{}: states none. ", of.source);
  const auto percent = [&](std::size_t row) { return 100.0 * within[row] / frames; };
  return fmt::format("{}: {:.0f}, {:.0f} and {:.0f} % of frames within the band. ", of.source,
                     percent(0), percent(1), percent(2));
}

/// Half an axis that 95 % of the frames have room in with their band, and a little beyond: one that
/// shows a filter's first second hides all others.
double reach_of(const PoseErrors& of, std::size_t row) {
  std::vector<double> sizes;
  const auto axis = static_cast<Eigen::Index>(row);
  for (const FrameError& frame : of.frames)
    if (frame.converged)
      sizes.push_back(std::max(std::abs(frame.error[axis]), 2.0 * frame.sigma[axis]));
  if (sizes.empty()) return 1.0;
  std::ranges::sort(sizes);
  const double most = sizes[static_cast<std::size_t>(0.95 * static_cast<double>(sizes.size() - 1))];
  return std::max(1.3 * kErrorRows[row].units * most, 1e-6);
}

std::pair<double, double> time_of(std::span<const PoseErrors> sources) {
  double first_s = 0.0, last_s = 1.0;
  for (const PoseErrors& of : sources)
    if (!of.frames.empty()) first_s = of.frames.front().stamp_s, last_s = of.frames.back().stamp_s;
  return {first_s, last_s > first_s ? last_s : first_s + 1.0};
}

}  // namespace

FigureSheet pose_errors_figure(std::span<const PoseErrors> sources, const std::string& caption,
                               const FigureStyle& style) {
  FigureSheet sheet;
  sheet.name = "errors_over_time";
  sheet.style = style;
  sheet.columns = static_cast<int>(sources.size());
  sheet.least_panel_in = kLeastOfSource_in;
  sheet.panel_width_in = style.panel_width_in(sheet.columns, kLeastOfSource_in, kGapWithNumbers_in);
  sheet.panel_height_in = kErrorHeight_in;
  const auto [first_s, last_s] = time_of(sources);
  std::vector<std::string> blocks;
  for (const PoseErrors& of : sources) blocks.push_back(add_block(sheet, of));
  for (std::size_t r = 0; r < kErrorRows.size(); ++r)
    for (std::size_t s = 0; s < sources.size(); ++s) {
      const double reach = reach_of(sources[s], r);
      const std::string colour = style.grey ? grey_tone(s) : palette_colour(s);
      Panel panel{r == 0 ? sources[s].source : "",
                  r + 1 == kErrorRows.size() ? "time of the recording (s)" : "",
                  s == 0 ? kErrorRows[r].label : ""};
      panel.settings = {
          fmt::format("set xrange [{:.9g}:{:.9g}]; set xtics {:.9g}", first_s, last_s,
                      tic_step(last_s - first_s, sheet.panel_width_in)),
          fmt::format("set yrange [{:.6g}:{:.6g}]; set ytics {:.6g}; set format y '%4g'", -reach,
                      reach, tic_step(2.0 * reach, kRoomForTics_in))};
      const std::size_t error = 2 + 3 * r;
      panel.elements = {fmt::format("{} using 1:{}:{} with filledcurves {} notitle", blocks[s],
                                    error + 1, error + 2, band_fill(s, colour, style)),
                        fmt::format("{} using 1:{} with lines lw 1 lc rgb '{}' notitle", blocks[s],
                                    error, colour)};
      sheet.panels.push_back(std::move(panel));
    }
  sheet.add_legend("lines lw 1.5 lc rgb '#444444'", "error");
  sheet.add_legend(fmt::format("boxes {}", band_fill(0, "#444444", style)),
                   "two standard deviations, as stated");
  sheet.caption = caption;
  for (const PoseErrors& of : sources) sheet.caption += within_text(of);
  sheet.caption +=
      "Error: of the true pose from the believed one, in the robot's axes. Each axis has room for "
      "95 "
      "% of the frames.";
  return sheet;
}

}  // namespace mapscore::eval
