// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/geometry.hpp"

#include "files/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>

namespace mapscore::eval {
namespace {

/// Mean width of a letter of DejaVu Sans over its size.
constexpr double kLetterWidth = 0.53;
constexpr double kTop_in = 0.3, kXLabel_in = 0.29, kXLabelMiddle_in = 0.12;
constexpr double kTitleGap_in = 0.24, kTextRow_in = 0.125;
constexpr double kLegendRow_in = 0.17, kCaptionRow_in = 0.125, kLegendEntry_in = 0.8;
/// A panel in print: its greatest height over its width, and its least height.
constexpr double kTallest = 0.8, kLowest_in = 0.85;

/// A text's letters of UTF-8.
std::vector<std::string> letters_of(const std::string& text) {
  std::vector<std::string> letters;
  for (const char byte : text)
    if (letters.empty() || (static_cast<unsigned char>(byte) & 0xc0u) != 0x80)
      letters.emplace_back(1, byte);
    else
      letters.back() += byte;
  return letters;
}

/// Of a letter over the mean one: capitals and others are broader, CJK is square.
double breadth(const std::string& letter) {
  constexpr std::string_view kBroad = "mw%@&";
  if (letter.size() > 2) return 1.9;
  const bool broad =
      (letter[0] >= 'A' && letter[0] <= 'Z') || kBroad.find(letter[0]) != kBroad.npos;
  return broad ? 1.5 : letter.size() > 1 ? 1.2 : 1.0;
}

/// Whether a panel that is not the first of its row has numbers at its left.
bool has_numbers_inside(const FigureSheet& sheet) {
  for (std::size_t i = 0; i < sheet.panels.size(); ++i)
    if (i % static_cast<std::size_t>(sheet.columns) != 0 && sheet.panels[i].y_tic_labels)
      return true;
  return false;
}

/// Height of all lines but the first of the longest of these texts.
double further_rows_in(const FigureSheet& sheet, std::string Panel::*text) {
  std::ptrdiff_t most = 0;
  for (const Panel& panel : sheet.panels)
    most = std::max(most, std::ranges::count(panel.*text, '\n'));
  return kTextRow_in * static_cast<double>(most);
}

/// Panels of a sheet in fewer columns, for which a place may stay empty.
class Arrangement {
 public:
  Arrangement(const FigureSheet& sheet, std::size_t columns)
      : from_(sheet.panels),
        asked_(static_cast<std::size_t>(sheet.columns)),
        columns_(columns),
        own_numbers_(has_numbers_inside(sheet)) {
    for (const Panel& panel : from_)
      if (!panel.x_label.empty()) axes_.insert(panel.x_label);
    const auto untitled = [](const Panel& panel) { return panel.title.empty(); };
    if (std::ranges::none_of(from_, untitled))
      one_after_the_other();
    else
      block_below_block();
    for (std::size_t i = 0; i < panels_.size(); ++i) label(i);
  }

  [[nodiscard]] std::vector<Panel> panels() { return std::move(panels_); }

 private:
  /// Every panel says itself what it shows.
  void one_after_the_other() {
    for (std::size_t i = 0; i < from_.size(); ++i) put(i);
  }

  /// All rows of the first columns, then all rows of the next, below their own titles.
  void block_below_block() {
    const std::size_t rows = (from_.size() + asked_ - 1) / asked_;
    for (std::size_t first = 0; first < asked_; first += columns_)
      for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = first; column < first + columns_; ++column)
          put(column < asked_ ? row * asked_ + column : from_.size());
  }

  void put(std::size_t source) {
    panels_.push_back(source < from_.size() ? from_[source] : Panel{});
    own_tics_.push_back(own_numbers_ && source < from_.size() && from_[source].y_tic_labels);
    y_labels_.push_back(source < from_.size() ? from_[source / asked_ * asked_].y_label : "");
  }

  /// y on the left, x where no panel follows below.
  void label(std::size_t i) {
    Panel& panel = panels_[i];
    const bool left = i % columns_ == 0;
    const bool followed = i + columns_ < panels_.size() && !panels_[i + columns_].elements.empty();
    panel.y_label = left ? y_labels_[i] : "";
    panel.y_tic_labels = left || own_tics_[i];
    if (axes_.size() > 1) return;  // each has its own
    panel.x_label = followed || panel.elements.empty() || axes_.empty() ? "" : *axes_.begin();
  }

  const std::vector<Panel>& from_;
  std::size_t asked_, columns_;
  bool own_numbers_;            ///< each panel at its left
  std::set<std::string> axes_;  ///< labels of x
  std::vector<Panel> panels_;
  std::vector<bool> own_tics_;  ///< by panel
  std::vector<std::string> y_labels_;
};

/// The sheet as arranged() has it, but for its legend.
FigureSheet in_width(const FigureSheet& sheet) {
  if (!sheet.style.width_mm) return sheet;
  FigureSheet fitted = sheet;
  const double gap_in = has_numbers_inside(sheet) ? kGapWithNumbers_in : kGap_in;
  fitted.columns = sheet.style.columns(sheet.columns, sheet.least_panel_in, gap_in);
  fitted.panel_width_in = sheet.style.panel_width_in(sheet.columns, sheet.least_panel_in, gap_in);
  const double width = fitted.panel_width_in;
  fitted.panel_height_in =
      sheet.to_scale ? sheet.panel_height_in * width / sheet.panel_width_in
                     : std::min(sheet.panel_height_in, std::max(kLowest_in, kTallest * width));
  if (fitted.columns < sheet.columns)
    fitted.panels = Arrangement(sheet, static_cast<std::size_t>(fitted.columns)).panels();
  const auto fit = [](std::string& text, double room_in, double font_pt) {
    text = fmt::to_string(fmt::join(wrapped(text, room_in, font_pt), "\n"));
  };
  for (Panel& panel : fitted.panels) {
    fit(panel.title, width + kGap_in, kTitle_pt);
    fit(panel.x_label, width + kGap_in, kFont_pt);
    fit(panel.y_label, fitted.panel_height_in + kGap_in + fitted.x_tics_in, kFont_pt);
  }
  return fitted;
}

}  // namespace

double text_width_in(std::size_t letters, double font_pt) {
  return static_cast<double>(letters) * kLetterWidth * font_pt / kPointsPerInch;
}

std::vector<std::string> wrapped(const std::string& text, double width_in, double font_pt) {
  const auto letters =
      static_cast<std::size_t>(width_in * kPointsPerInch / (kLetterWidth * font_pt));
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    while (word.size() > letters) {
      lines.push_back(word.substr(0, letters));
      lines.back().resize(letters - unfinished_tail(lines.back()));
      word.erase(0, lines.back().size());
    }
    if (lines.empty() || lines.back().size() + word.size() + 1 > letters)
      lines.push_back(word);
    else
      lines.back() += " " + word;
  }
  return lines;
}

std::string shortened(const std::string& text, double width_in, double font_pt) {
  const std::vector<std::string> letters = letters_of(text);
  double breadths = 0.0;
  for (const std::string& letter : letters) breadths += breadth(letter);
  const double most = width_in / text_width_in(1, font_pt);
  if (breadths <= most) return text;
  const std::string ellipsis = "\u2026";
  breadths += breadth(ellipsis);
  std::size_t head = letters.size() / 2, tail = head;  // the tail's first letter
  while (breadths > most && (head > 0 || tail < letters.size()))
    breadths -= breadth(head > letters.size() - tail ? letters[--head] : letters[tail++]);
  const std::span all(letters);
  return fmt::format("{}{}{}", fmt::join(all.first(head), ""), ellipsis,
                     fmt::join(all.subspan(tail), ""));
}

FigureSheet arranged(const FigureSheet& sheet) {
  FigureSheet fitted = in_width(sheet);
  const double room_in = Geometry(fitted).width_in() - kLegendEntry_in;
  for (FigureKey& key : fitted.legend) key.title = shortened(key.title, room_in, kFont_pt);
  return fitted;
}

Geometry::Geometry(const FigureSheet& sheet)
    : sheet_(sheet),
      rows_((static_cast<int>(sheet.panels.size()) + sheet.columns - 1) / sheet.columns),
      title_rows_in_(further_rows_in(sheet, &Panel::title)),
      x_label_rows_in_(further_rows_in(sheet, &Panel::x_label)),
      title_gap_in_(has_titles_inside() ? kTitleGap_in + title_rows_in_ : 0.0),
      x_gap_in_(has_numbers_inside(sheet) ? kGapWithNumbers_in : kGap_in),
      width_in_(kLeft_in + sheet.columns * (sheet.panel_width_in + x_gap_in_) - x_gap_in_ +
                kRight_in) {
  if (sheet.style.caption)
    caption_ = wrapped(sheet.caption, width_in_ - 0.2, sheet.style.small_pt());
  std::size_t longest = 0;
  for (const FigureKey& key : sheet.legend)
    longest = std::max(longest, letters_of(key.title).size());
  const double entry_in = kLegendEntry_in + text_width_in(longest, kFont_pt);
  const int entries = static_cast<int>(sheet.legend.size());
  const int columns = std::clamp(static_cast<int>(width_in_ / entry_in), 1, std::max(1, entries));
  legend_rows_ = (entries + columns - 1) / columns;
}

double Geometry::height_in() const {
  return kTop_in + title_rows_in_ + rows_ * (sheet_.panel_height_in + row_gap_in()) - row_gap_in() +
         x_label_in() + sheet_.x_tics_in + below_in();
}

std::string Geometry::margins(int panel) const {
  const int row = panel / sheet_.columns, column = panel % sheet_.columns;
  const double left = kLeft_in + column * (sheet_.panel_width_in + x_gap_in_);
  const double bottom = bottom_in(row);
  return margins(left, left + sheet_.panel_width_in, bottom, bottom + sheet_.panel_height_in);
}

double Geometry::x_label(int panel) const {
  return (bottom_in(panel / sheet_.columns) - sheet_.x_tics_in - kXLabelMiddle_in) / height_in();
}

std::string Geometry::legend_margins() const {
  return margins(0.05, width_in_ - 0.05, caption_in(), below_in());
}

double Geometry::caption_line(std::size_t line) const {
  return (caption_in() - 0.06 - static_cast<double>(line) * kCaptionRow_in) / height_in();
}

double Geometry::bottom_in(int row) const {
  return height_in() - kTop_in - title_rows_in_ - row * (sheet_.panel_height_in + row_gap_in()) -
         sheet_.panel_height_in;
}

double Geometry::caption_in() const {
  return 0.08 + static_cast<double>(caption_.size()) * kCaptionRow_in;
}

double Geometry::below_in() const {
  return caption_in() + legend_rows_ * kLegendRow_in;
}

double Geometry::x_label_in() const {
  const auto labelled = [](const Panel& panel) { return !panel.x_label.empty(); };
  return std::ranges::any_of(sheet_.panels, labelled) ? kXLabel_in + x_label_rows_in_ : kGap_in;
}

double Geometry::row_gap_in() const {
  return (has_x_labels_inside() ? x_label_in() : kGap_in) + title_gap_in_ + sheet_.x_tics_in;
}

bool Geometry::has_x_labels_inside() const {
  const auto columns = static_cast<std::size_t>(sheet_.columns);
  for (std::size_t i = 0; i + columns < sheet_.panels.size(); ++i)
    if (!sheet_.panels[i].x_label.empty() && !sheet_.panels[i + columns].elements.empty())
      return true;
  return false;
}

bool Geometry::has_titles_inside() const {
  const auto below = std::min<std::ptrdiff_t>(sheet_.columns, std::ssize(sheet_.panels));
  return std::any_of(sheet_.panels.begin() + below, sheet_.panels.end(),
                     [](const Panel& panel) { return !panel.title.empty(); });
}

std::string Geometry::margins(double left, double right, double bottom, double top) const {
  return fmt::format(
      "set lmargin at screen {:.5f}; set rmargin at screen {:.5f}; set bmargin at screen {:.5f}; "
      "set tmargin at screen {:.5f}",
      left / width_in_, right / width_in_, bottom / height_in(), top / height_in());
}

}  // namespace mapscore::eval
