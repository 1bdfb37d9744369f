// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/curves.hpp"
#include "eval/report/figures/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr std::size_t kPanelsShown = 3;
constexpr double kThresholdHeight_in = 2.0;
constexpr double kNarrowUnit_in = 1.2;  ///< no room for six numbers below

/// Values of the x axis that have a panel; all methods share one where nothing is swept.
std::vector<std::size_t> values_shown(const StudyLayout& layout) {
  if (layout.bars()) return {0};
  std::vector<std::size_t> all(layout.x().at.size());
  if (all.size() > kPanelsShown && !layout.named()) return {0, all.size() / 2, all.size() - 1};
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::size_t middle_column(const StudyLayout& layout) {
  return layout.columns().size() / 2;
}

/// Position in the trials of the curve's point in a panel.
std::optional<std::size_t> trial_of(const Curve& curve, std::size_t value,
                                    const StudyLayout& layout) {
  if (!layout.bars()) return layout.trial(curve, middle_column(layout), value);
  for (std::size_t x = 0; x < layout.x().at.size(); ++x)
    if (const auto trial = layout.trial(curve, 0, x)) return trial;
  return std::nullopt;
}

/// Panels side by side, filled from one block of data after the other.
class ThresholdFigure {
 public:
  ThresholdFigure(const StudySummary& summary, const StudyLayout& layout, std::vector<Curve> curves,
                  std::string name)
      : summary_(summary),
        layout_(layout),
        curves_(std::move(curves)),
        values_(values_shown(layout)) {
    sheet_.name = std::move(name);
    sheet_.columns = static_cast<int>(values_.size());
    sheet_.style = layout.style();
    sheet_.least_panel_in = kLeastInRow_in;
    sheet_.panel_width_in = sheet_.style.panel_width_in(sheet_.columns, sheet_.least_panel_in);
    sheet_.panel_height_in = kThresholdHeight_in;
    for (const Curve& curve : curves_) sheet_.add_legend(curve.legend(), curve.name);
  }

  [[nodiscard]] const std::vector<Curve>& curves() const { return curves_; }

  /// Both axes from 0 to 1.
  [[nodiscard]] Panel unit_panel(const std::string& x_label, const std::string& y_label) const {
    const bool narrow = sheet_.panel_width_in < kNarrowUnit_in;
    return {"",
            x_label,
            y_label,
            true,
            {fmt::format("set xrange [0:1.02]; set xtics {}", narrow ? 0.5 : 0.2),
             "set yrange [0:1.02]; set ytics 0.2"}};
  }

  /// One row: `fill(counts, curve, position of the curve, panel)` for every curve of every panel.
  template <class Fill>
  void add_row(const Panel& like, bool titles, Fill fill) {
    for (const std::size_t value : values_) {
      Panel panel = like;
      panel.title = titles && !layout_.bars() ? layout_.x().text(value) : "";
      panel.y_tic_labels = value == values_.front();
      if (!panel.y_tic_labels) panel.y_label.clear();
      for (std::size_t c = 0; c < curves_.size(); ++c) {
        const Curve& curve = curves_[c];
        const auto trial = trial_of(curve, value, layout_);
        if (!trial) continue;
        head_ = layout_.bars() ? curve.name : curve.name + "; " + layout_.x().text(value);
        fill(pooled_counts(summary_.trials[*trial], summary_.table), curve, c, panel);
      }
      sheet_.panels.push_back(std::move(panel));
    }
  }

  /// Starts a block of the data file; returns `data index N`.
  [[nodiscard]] std::string block(const std::string& what, const std::string& columns) {
    return sheet_.start_block(head_ + "; " + what, columns);
  }
  void write(const std::string& line) { sheet_.data += line + '\n'; }
  void explain(const std::string& style, const std::string& title) {
    sheet_.add_legend(style, title);
  }

  [[nodiscard]] FigureSheet finish(const std::string& caption) {
    const std::string& column = layout_.columns()[middle_column(layout_)];
    sheet_.caption = study_caption(summary_) + (column.empty() ? "" : " At " + column + '.') +
                     " Counts pooled over classes and seeds. " + caption;
    return std::move(sheet_);
  }

 private:
  const StudySummary& summary_;
  const StudyLayout& layout_;
  std::vector<Curve> curves_;
  FigureSheet sheet_;
  std::vector<std::size_t> values_;
  std::string head_;  ///< of the curve and panel that are being filled
};

/// Bins of pixels as those of voxels.
std::vector<ReliabilityBin> bins_of(const Reliability& pixels) {
  std::vector<ReliabilityBin> bins;
  constexpr auto kBins = static_cast<double>(Reliability::kBins);
  for (const ConfidenceBin& bin : pixels.bins) {
    const auto at = static_cast<double>(bins.size());
    bins.push_back({at / kBins, (at + 1) / kBins, bin.count,
                    ratio(bin.confidence_sum_nano, bin.count * kBillion),
                    ratio(bin.right, bin.count)});
  }
  return bins;
}

/// What labels have one of, whatever the method: the curves of the first, without its name.
std::vector<Curve> curves_of_labels(const StudyLayout& layout) {
  std::vector<Curve> curves;
  for (Curve curve : layout.curves()) {
    if (curve.method != layout.curves().front().method) continue;
    const std::size_t rest = curve.name.find(", ");
    curve.name = rest == curve.name.npos ? "network" : curve.name.substr(rest + 2);
    curves.push_back(std::move(curve));
  }
  return curves;
}

/// Two rows: the share that is true over the mean probability, and the share of each bin.
/// `bins_of(counts)` gives the bins of what is counted, "voxels" or "pixels".
void add_reliability(ThresholdFigure& figure, const FigureStyle& style, const std::string& counted,
                     const auto& bins_of) {
  const double bar = 0.8 / kReliabilityBins / static_cast<double>(figure.curves().size());
  std::vector<std::string> bars;  // of the lower row, in the order of its panels and curves
  Panel upper = figure.unit_panel("", "share that is true");
  upper.elements = {"x with lines lw 0.8 dt (4,3) lc rgb '#666666' notitle"};
  figure.add_row(
      upper, true, [&](const ClassCounts& counts, const Curve& curve, std::size_t c, Panel& panel) {
        const std::string block = figure.block(
            "reliability",
            fmt::format("low high {0} share_of_{0} mean_probability share_true", counted));
        const std::vector<ReliabilityBin> bins = bins_of(counts);
        std::int64_t all = 0;
        for (const ReliabilityBin& bin : bins) all += bin.voxels;
        for (const ReliabilityBin& bin : bins)
          figure.write(fmt::format("{:.1f} {:.1f} {} {} {} {}", bin.low, bin.high, bin.voxels,
                                   figure_number(ratio(bin.voxels, all)),
                                   figure_number(bin.mean_probability),
                                   figure_number(bin.share_true)));
        panel.elements.push_back(curve.marked_line(block + " using 5:6", 1.0));
        const double offset = 0.1 / kReliabilityBins + (static_cast<double>(c) + 0.5) * bar;
        bars.push_back(
            style.grey
                ? curve.marked_line(
                      fmt::format("{} using ($1+{}):4", block, 0.5 / kReliabilityBins), 1.0)
                : fmt::format("{} using ($1+{:.5f}):4:({:.5f}) with boxes fs solid 1 noborder lc "
                              "rgb '{}' notitle",
                              block, offset, bar, curve.colour));
      });
  Panel lower = figure.unit_panel("probability", "share of the " + counted);
  std::size_t next = 0;
  figure.add_row(lower, false, [&](const ClassCounts&, const Curve&, std::size_t, Panel& panel) {
    panel.elements.push_back(bars[next++]);
  });
  figure.explain("lines lw 0.8 dt (4,3) lc rgb '#666666'", "as true as probable");
}

}  // namespace

FigureSheet precision_recall_figure(const StudySummary& summary, const StudyLayout& layout) {
  ThresholdFigure figure(summary, layout, layout.curves(), "precision_recall");
  const auto fill = [&](const ClassCounts& counts, const Curve& curve, std::size_t, Panel& panel) {
    const std::string line = figure.block("over the threshold", "recall precision threshold");
    for (const CurvePoint& point : points_of(counts.curve))
      figure.write(fmt::format("{} {} {:.3f}", figure_number(point.recall),
                               figure_number(point.precision), point.threshold));
    const std::string mark = figure.block("at the working threshold", "recall precision");
    figure.write(figure_number(recall(counts)) + ' ' + figure_number(precision(counts)));
    panel.elements.push_back(fmt::format("{} using 1:2 with lines {} notitle", line, curve.line()));
    panel.elements.push_back(
        fmt::format("{} using 1:2 with points {} notitle", mark, curve.mark(1.3)));
  };
  figure.add_row(figure.unit_panel("recall", "precision"), true, fill);
  return figure.finish(
      "Along a line the threshold falls from left to right; the mark is the threshold that all "
      "other figures are made at.");
}

FigureSheet reliability_figure(const StudySummary& summary, const StudyLayout& layout) {
  ThresholdFigure figure(summary, layout, layout.curves(), "reliability");
  add_reliability(figure, layout.style(), "voxels",
                  [](const ClassCounts& counts) { return reliability(counts.curve); });
  return figure.finish(
      "Voxels with a class by their probability, in bins of a tenth. Below the diagonal the map is "
      "surer than it should be, above it less sure.");
}

std::optional<FigureSheet> pixel_reliability_figure(const StudySummary& summary,
                                                    const StudyLayout& layout) {
  const auto has_pixels = [&](const ResultLine& line) {
    const ClassCounts counts = pooled_counts(line, summary.table);
    return counts.labels && counts.labels->pixels.error();
  };
  if (std::ranges::none_of(summary.trials, has_pixels)) return std::nullopt;
  ThresholdFigure figure(summary, layout, curves_of_labels(layout), "pixel_reliability");
  add_reliability(figure, layout.style(), "pixels", [](const ClassCounts& counts) {
    return bins_of(counts.labels.value_or(LabelCounts{}).pixels);
  });
  return figure.finish(
      "Pixels, background too, by the probability that the network gives its class, in bins of a "
      "tenth; the same for all methods. Below the diagonal the network is surer than it should be, "
      "above it less sure.");
}

}  // namespace mapscore::eval
