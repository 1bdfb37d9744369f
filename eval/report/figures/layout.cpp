// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/layout.hpp"

#include "eval/report/figures/geometry.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
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

FigureAxis axis_of_methods(const Study& study) {
  std::vector<std::string> titles;
  for (const MethodSettings& method : study.methods)
    titles.push_back(method_title(study, method.name));
  return axis_of_names("method", std::move(titles));
}

/// At most so many positions of `all`, from the first to the last; one: the middle.
std::vector<std::size_t> spread(std::size_t all, std::size_t most) {
  if (most == 1) return {all / 2};
  std::vector<std::size_t> positions;
  for (std::size_t n = 0; n < std::min(all, most); ++n)
    positions.push_back(most >= all ? n : (n * (all - 1) + (most - 1) / 2) / (most - 1));
  return positions;
}

/// In print as many numbers as have panels side by side; all names.
std::vector<std::size_t> values_shown(const FigureAxis& axis, const FigureStyle& style) {
  const std::size_t all = axis.values.size();
  if (!style.width_mm || !axis.numeric) return spread(all, std::max<std::size_t>(all, 2));
  const double room = (style.page_in() + kGap_in) / (kLeastInRow_in + kGap_in);
  return spread(all, std::max<std::size_t>(2, static_cast<std::size_t>(room)));
}

constexpr double kLine_in = 0.11, kOneLine_in = 0.16;
constexpr double kTurned = 0.57;  ///< sine of 35 degrees
constexpr double kShareOfPlace = 0.97;

/// Letters of the longest line.
std::size_t longest_line(const std::string& name) {
  std::size_t longest = 0, line = 0;
  for (const char letter : name) {
    line = letter == '\n' ? 0 : line + 1;
    longest = std::max(longest, line);
  }
  return longest;
}

double width_in(const std::vector<std::string>& names, double font_pt) {
  std::size_t longest = 0;
  for (const std::string& name : names) longest = std::max(longest, longest_line(name));
  return text_width_in(longest, font_pt);
}

/// gnuplot takes a label of a tic with a `%` for a format of numbers.
std::string without_format(const std::string& name) {
  std::string doubled;
  for (const char letter : name) doubled.append(letter == '%' ? 2 : 1, letter);
  return doubled;
}

std::string setting_of(const std::vector<std::string>& names, const std::string& turn,
                       double font_pt) {
  std::string tics;
  for (std::size_t i = 0; i < names.size(); ++i)
    tics += fmt::format("{}{} {}", i > 0 ? ", " : "", gnuplot_quoted(without_format(names[i])), i);
  return fmt::format("set xtics ({}) {} font ',{}'", tics, turn, font_pt);
}

}  // namespace

std::string palette_colour(std::size_t n) {
  return std::string(kColours[n % kColours.size()]);
}

std::string Curve::line() const {
  return fmt::format("lw 1.4 dt {} lc rgb '{}'", dash, colour);
}

std::string Curve::mark(double size) const {
  return fmt::format("pt {} ps {} lw 0.5 lc rgb '{}'", point, size, colour);
}

std::string Curve::marked_line(const std::string& data, double size) const {
  return fmt::format("{0} with lines {1} notitle, {0} with points {2} notitle", data, line(),
                     mark(size));
}

std::string Curve::legend() const {
  return fmt::format("linespoints pt {} ps 0.9 {}", point, line());
}

Curve curve_of(const Study& study, const std::string& method, std::size_t n,
               const FigureStyle& style) {
  return {method_title(study, method),
          method,
          0,
          style.grey ? grey_tone(n) : palette_colour(n),
          kPoints[n % kPoints.size()],
          style.grey ? grey_dash(n) : "1"};
}

StudyLayout::StudyLayout(const StudySummary& summary, const FigureStyle& style)
    : style_(style), bars_(summary.study.sweep.empty()) {
  std::vector<FigureAxis> axes;
  for (const SweepAxis& axis : summary.study.sweep)
    axes.push_back(figure_axis(summary.study, axis));
  x_ = bars_ ? axis_of_methods(summary.study) : axes.front();
  if (axes.size() > 1) {
    second_ = axes[1];
    shown_ = values_shown(axes[1], style);
    columns_.clear();
    for (const std::size_t value : shown_) columns_.push_back(axes[1].text(value));
  }
  const std::vector<std::string> tails = tail_texts(axes);
  tails_ = tails.size();
  const std::vector<MethodSettings>& methods = summary.study.methods;
  const bool several = methods.size() > 1;
  for (std::size_t m = 0; m < methods.size(); ++m)
    for (std::size_t tail = 0; tail < tails.size(); ++tail) {
      const std::size_t n = curves_.size();
      const int dash = several ? kDashes[tail % kDashes.size()] : 1;
      curves_.push_back(
          {method_title(summary.study, methods[m].name) + tails[tail], methods[m].name, tail,
           style.grey ? grey_tone(n) : palette_colour(several ? m : tail),
           kPoints[n % kPoints.size()], style.grey ? grey_dash(n) : std::to_string(dash)});
    }
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
  return trial_at(curve, shown_.at(column), x);
}

std::optional<std::size_t> StudyLayout::trial_at(const Curve& curve, std::size_t value,
                                                 std::size_t x) const {
  if (bars_ && curves_.at(x).method != curve.method) return std::nullopt;
  const std::size_t values = second_ ? second_->values.size() : 1;
  const std::size_t cell = bars_ ? 0 : (x * values + value) * tails_ + curve.tail;
  const auto found = trials_.find({curve.method, cell});
  return found == trials_.end() ? std::nullopt : std::optional(found->second);
}

StudyLayout StudyLayout::with_columns(std::size_t most) const {
  StudyLayout fewer = *this;
  fewer.shown_.clear();
  fewer.columns_.clear();
  for (const std::size_t column : spread(columns_.size(), most)) {
    fewer.shown_.push_back(shown_[column]);
    fewer.columns_.push_back(columns_[column]);
  }
  return fewer;
}

std::string StudyLayout::columns_caption() const {
  if (!second_ || shown_.size() == second_->values.size()) return "";
  if (shown_.size() == 1) return fmt::format(" At {}.", columns_.front());
  return fmt::format(" {} of {} values of {}.", shown_.size(), second_->values.size(),
                     second_->name);
}

double tic_step(double range, double length_in) {
  const double steps = length_in < kNarrow_in ? 3.0 : 5.0;
  if (!(range > 0.0)) return 1.0;
  const double decade = std::pow(10.0, std::floor(std::log10(range / steps)));
  for (const double step : {1.0, 2.0, 5.0})
    if (range <= steps * step * decade * (1.0 + 1e-9)) return step * decade;
  return 10.0 * decade;
}

NameTics name_tics(const std::vector<std::string>& names, double place_in,
                   const FigureStyle& style) {
  const double font_pt = style.small_pt();
  // Digits are wider than most letters.
  const double room_in =
      kShareOfPlace * place_in - (style.width_mm ? text_width_in(1, font_pt) : 0.0);
  if (width_in(names, font_pt) <= room_in)
    return {setting_of(names, "norotate", font_pt), kOneLine_in};
  std::vector<std::string> broken = names;
  std::ptrdiff_t most_breaks = 0;
  for (std::string& name : broken) {
    std::replace(name.begin(), name.end(), ' ', '\n');
    most_breaks = std::max(most_breaks, std::count(name.begin(), name.end(), '\n'));
  }
  if (width_in(broken, font_pt) <= room_in)
    return {setting_of(broken, "norotate", font_pt),
            kOneLine_in + kLine_in * static_cast<double>(most_breaks)};
  return {setting_of(names, "rotate by 35 right", font_pt),
          kLine_in + kTurned * width_in(names, font_pt)};
}

}  // namespace mapscore::eval
