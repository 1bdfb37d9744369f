// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/exploration/coverage_curves.hpp"

#include "eval/report/figures/curves.hpp"
#include "eval/report/figures/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr int kCurveSteps = 120;

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
    if (!sheet_.style.width_mm) panel.settings.emplace_back("set ylabel offset 0,0");
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
    const std::string starts =
        any.runs.size() == 1
            ? "One start"
            : fmt::format("Mean over {} starts; band: {}", any.runs.size(),
                          any.coverage.kind == SpreadKind::interval ? "95 % interval"
                                                                    : "least to greatest");
    return fmt::format(
        "{}: coverage of the visible surface, voxels of {:.6g} cm, and F1 of the detected classes "
        "against all of it. {}. Those that ended keep what they have.",
        study_.name, 100.0 * study_.voxel_m, starts);
  }

  const Study& study_;
  FigureSheet sheet_;
  std::map<std::string, std::vector<const ExplorationGroup*>> scenes_;
  std::vector<std::string> names_;
};

}  // namespace

FigureSheet exploration_curves(const Study& study, const std::vector<ExplorationGroup>& groups,
                               const FigureStyle& style) {
  return CurvesFigure(study, groups, style).finish();
}

}  // namespace mapscore::eval
