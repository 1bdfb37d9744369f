// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/layout.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace mapscore::eval {
namespace {

/// Okabe and Ito's palette without black, which the lattice ceiling has, and yellow, which is faint
/// on white.
constexpr std::array<std::string_view, 7> kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                   "#56B4E9", "#E69F00", "#666666"};
/// Disc, square, triangle, diamond, triangle down, pentagon, filled and then open.
constexpr std::array<int, 12> kPoints{7, 5, 9, 13, 11, 15, 6, 4, 8, 12, 10, 14};
/// Solid, long dashes, dash and dot; the ceilings have the others.
constexpr std::array<int, 4> kDashes{1, 5, 4, 6};

/// Texts of all combinations of the axes from the third on, the last fastest, as cells() orders
/// them.
std::vector<std::string> tail_texts(const std::vector<FigureAxis>& axes) {
  std::vector<std::string> texts{""};
  for (std::size_t axis = 2; axis < axes.size(); ++axis) {
    std::vector<std::string> longer;
    for (const std::string& text : texts)
      for (std::size_t value = 0; value < axes[axis].values.size(); ++value)
        longer.push_back(text + ", " + axes[axis].text(value));
    texts = std::move(longer);
  }
  return texts;
}

Curve styled(Curve curve, std::size_t method, std::size_t methods, std::size_t order) {
  const std::size_t colour = methods > 1 ? method : curve.tail;
  curve.colour = palette_colour(colour);
  curve.point = kPoints[order % kPoints.size()];
  curve.dash = methods > 1 ? kDashes[curve.tail % kDashes.size()] : 1;
  return curve;
}

FigureAxis axis_of_methods(const Study& study) {
  FigureAxis axis{"method", "", false, {}, {}, "method"};
  for (const MethodSettings& method : study.methods) {
    axis.at.push_back(static_cast<double>(axis.at.size()));
    axis.values.push_back(method.name);
  }
  return axis;
}

}  // namespace

std::string palette_colour(std::size_t n) {
  return std::string(kColours[n % kColours.size()]);
}

StudyLayout::StudyLayout(const StudySummary& summary) : bars_(summary.study.sweep.empty()) {
  std::vector<FigureAxis> axes;
  for (const SweepAxis& axis : summary.study.sweep)
    axes.push_back(figure_axis(summary.study, axis));
  x_ = bars_ ? axis_of_methods(summary.study) : axes.front();
  if (axes.size() > 1) {
    columns_.clear();
    for (std::size_t value = 0; value < axes[1].values.size(); ++value)
      columns_.push_back(axes[1].text(value));
  }
  const std::vector<std::string> tails = tail_texts(axes);
  tails_ = tails.size();
  const std::vector<MethodSettings>& methods = summary.study.methods;
  for (std::size_t m = 0; m < methods.size(); ++m)
    for (std::size_t tail = 0; tail < tails.size(); ++tail)
      curves_.push_back(styled({methods[m].name + tails[tail], methods[m].name, tail, "", 7, 1}, m,
                               methods.size(), curves_.size()));
  for (std::size_t i = 0; i < summary.trials.size(); ++i) {
    const ResultLine& line = summary.trials[i];
    trials_[{line.method, static_cast<std::size_t>(line.cell.index)}] = i;
  }
}

std::string StudyLayout::figure_name(const std::string& stem) const {
  return stem + "_by_" + (x_.numeric ? "dose" : x_.key);
}

std::optional<std::size_t> StudyLayout::trial(const Curve& curve, std::size_t column,
                                              std::size_t x) const {
  if (bars_ && x_.values.at(x) != curve.method) return std::nullopt;
  const std::size_t cell = bars_ ? 0 : (x * columns_.size() + column) * tails_ + curve.tail;
  const auto found = trials_.find({curve.method, cell});
  return found == trials_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace mapscore::eval
