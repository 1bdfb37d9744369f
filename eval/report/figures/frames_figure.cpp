// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/frames_figure.hpp"

#include "eval/report/figures/curves.hpp"
#include "eval/score/metrics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

namespace mapscore::eval {
namespace {

constexpr double kMilliseconds = 1000.0;
constexpr double kFrameWidth_in = 6.4, kFrameHeight_in = 1.4;

/// What one panel shows of a frame, in the order of the data file's columns.
struct FramePanel {
  const char* name;
  const char* y_label;
  const char* settings;
  std::function<std::optional<double>(const FrameFigures&)> value;
};

std::array<FramePanel, 4> frame_panels() {
  return {{{"voxels", "voxels", "set yrange [0:*]",
            [](const FrameFigures& f) { return static_cast<double>(f.predicted); }},
           {"precision", "precision", "set yrange [*:1.005]",
            [](const FrameFigures& f) { return ratio(f.true_predicted, f.predicted); }},
           {"recall", "recall", "set yrange [*:1.005]",
            [](const FrameFigures& f) { return ratio(f.found, f.visible); }},
           {"time_ms", "processor time / ms", "set yrange [*:*]; set logscale y",
            [](const FrameFigures& f) { return kMilliseconds * f.times.total_s(); }}}};
}

std::string caption_of(const Study& study, const ClassTable& table) {
  return fmt::format(
      "{}: voxels of {:.6g} cm; detected: {}; each frame by itself against the surfaces of its own "
      "instant, tolerance 0. Time of one thread for registration, segmentation and mapping "
      "together.",
      study.name, 100.0 * study.voxel_m, fmt::join(detected_titles(study, table), ", "));
}

/// Ranges of a panel without a point, which gnuplot finds none for.
std::string empty_ranges(std::span<const MethodFrames> methods) {
  double first = 0.0, last = 1.0;
  if (!methods.empty() && methods.front().frames.size() > 1) {
    first = methods.front().frames.front().stamp_s;
    last = methods.front().frames.back().stamp_s;
  }
  return fmt::format("set xrange [{}:{}]; set yrange [0:1]", first, last);
}

/// Which methods leave gaps in the panel of precision.
std::string empty_caption(const Study& study, std::span<const MethodFrames> methods) {
  std::string text;
  for (const MethodFrames& method : methods) {
    const auto empty = std::ranges::count(method.frames, 0, &FrameFigures::predicted);
    if (empty > 0)
      text += fmt::format(" {} maps nothing in {} of {} frames.",
                          method_title(study, method.method), empty, method.frames.size());
  }
  return text;
}

struct Spread {
  double least = 0.0, mean = 0.0, most = 0.0, deviation = 0.0;
};

Spread spread_of(const std::vector<double>& values) {
  Spread spread;
  if (values.empty()) return spread;
  const auto [least, most] = std::ranges::minmax(values);
  const auto count = static_cast<double>(values.size());
  spread = {least, std::accumulate(values.begin(), values.end(), 0.0) / count, most, 0.0};
  double squares = 0.0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  if (values.size() > 1) spread.deviation = std::sqrt(squares / (count - 1.0));
  return spread;
}

std::vector<std::string> row_of(const MethodFrames& method) {
  std::vector<double> total_ms, segmentation_ms, mapping_ms, voxels;
  FrameFigures all;
  for (const FrameFigures& frame : method.frames) {
    total_ms.push_back(kMilliseconds * frame.times.total_s());
    segmentation_ms.push_back(kMilliseconds * frame.times.segmentation_s);
    mapping_ms.push_back(kMilliseconds * frame.times.mapping_s);
    voxels.push_back(static_cast<double>(frame.predicted));
    all.predicted += frame.predicted;
    all.true_predicted += frame.true_predicted;
    all.visible += frame.visible;
    all.found += frame.found;
  }
  const Spread time = spread_of(total_ms);
  std::vector<std::string> row{method.method};
  for (const double value : {time.most, time.mean, time.least, time.deviation,
                             spread_of(segmentation_ms).mean, spread_of(mapping_ms).mean})
    row.push_back(fmt::format("{:.2f}", value));
  row.push_back(fmt::format("{:.1f}", spread_of(voxels).mean));
  for (const auto& value : {ratio(all.true_predicted, all.predicted), ratio(all.found, all.visible),
                            f1(all.true_predicted, all.predicted, all.found, all.visible)})
    row.push_back(cell_text(value));
  return row;
}

}  // namespace

FrameFigures figures_of(const FrameResult& frame, const ClassTable& table) {
  const ClassCounts counts = pool_detected(frame.counts, table);
  return {frame.frame,    frame.stamp_s, counts.predicted, counts.true_predicted,
          counts.visible, counts.found,  frame.times};
}

FigureSheet frames_figure(const Study& study, const ClassTable& table,
                          std::span<const MethodFrames> methods, const FigureStyle& style) {
  const std::array<FramePanel, 4> panels = frame_panels();
  FigureSheet sheet;
  sheet.name = "by_frame";
  sheet.style = style;
  std::vector<Curve> curves;
  for (const MethodFrames& method : methods)
    curves.push_back(curve_of(study, method.method, curves.size(), style));
  sheet.panel_width_in = kFrameWidth_in;
  sheet.panel_height_in = kFrameHeight_in;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    Panel panel{"", p + 1 == panels.size() ? "time of the recording / s" : "", panels[p].y_label};
    const auto defined = [&](const MethodFrames& method) {
      return std::ranges::any_of(method.frames, [&](const FrameFigures& frame) {
        return panels[p].value(frame).has_value();
      });
    };
    panel.settings = {std::ranges::any_of(methods, defined) ? panels[p].settings
                                                            : empty_ranges(methods)};
    for (std::size_t m = 0; m < methods.size(); ++m)
      panel.elements.push_back(
          fmt::format("data index {} using 2:{} with lines lw 1 dt {} lc rgb '{}' notitle", m,
                      p + 3, curves[m].dash, curves[m].colour));
    sheet.panels.push_back(std::move(panel));
  }
  for (std::size_t m = 0; m < methods.size(); ++m) {
    sheet.add_legend(fmt::format("lines lw 2 dt {} lc rgb '{}'", curves[m].dash, curves[m].colour),
                     curves[m].name);
    std::string columns = "frame stamp_s";
    for (const FramePanel& panel : panels) columns += std::string(" ") + panel.name;
    sheet.start_block(methods[m].method, columns);
    for (const FrameFigures& frame : methods[m].frames) {
      sheet.data += fmt::format("{} {}", frame.frame, frame.stamp_s);
      for (const FramePanel& panel : panels) sheet.data += ' ' + figure_number(panel.value(frame));
      sheet.data += '\n';
    }
  }
  sheet.caption = caption_of(study, table) + empty_caption(study, methods);
  return sheet;
}

Table frames_table(std::span<const MethodFrames> methods) {
  Table times;
  times.columns = {"method",     "max_ms", "mean_ms",   "min_ms", "sd_ms", "segmentation_ms",
                   "mapping_ms", "voxels", "precision", "recall", "F1"};
  for (const MethodFrames& method : methods) times.rows.push_back(row_of(method));
  return times;
}

}  // namespace mapscore::eval
