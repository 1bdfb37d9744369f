// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/script.hpp"

#include "core/error.hpp"
#include "eval/report/figures/gnuplot.hpp"
#include "files/file_bytes.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <system_error>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

constexpr double kDotsPerInch = 150.0, kPointsPerInch = 72.0;
/// The resolution that the cairo terminals take font sizes for.
constexpr double kFontUnitsPerInch = 96.0;
/// Width of all panels of a figure that fills a page.
constexpr double kPanels_in = 6.6;
constexpr double kFont_pt = 8.0, kCaption_pt = 6.5;
/// Mean width of a letter of DejaVu Sans over its size.
constexpr double kLetterWidth = 0.53;
constexpr double kLeft_in = 0.62, kRight_in = 0.12, kTop_in = 0.3, kXLabel_in = 0.29,
                 kXLabelMiddle_in = 0.12;
constexpr double kGap_in = 0.14, kGapWithLabels_in = 0.42, kTitleGap_in = 0.24;
constexpr double kLegendRow_in = 0.17, kCaptionRow_in = 0.125, kLegendEntry_in = 0.8;

std::vector<std::string> wrapped(const std::string& text, double width_in, double font_pt) {
  const auto letters =
      static_cast<std::size_t>(width_in * kPointsPerInch / (kLetterWidth * font_pt));
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (lines.empty() || lines.back().size() + word.size() + 1 > letters)
      lines.push_back(word);
    else
      lines.back() += " " + word;
  }
  return lines;
}

/// Letters between the quotes that follow `title`, in an element of the legend.
std::size_t title_length(const std::string& element) {
  constexpr std::string_view kTitle = "title '";
  const std::size_t at = element.find(kTitle);
  return at == std::string::npos ? 0 : element.rfind('\'') - at - kTitle.size();
}

/// Where everything lies, in inches from the low left corner of the sheet.
class Geometry {
 public:
  explicit Geometry(const FigureSheet& sheet)
      : sheet_(sheet),
        rows_((static_cast<int>(sheet.panels.size()) + sheet.columns - 1) / sheet.columns),
        title_gap_in_(has_titles_inside() ? kTitleGap_in : 0.0),
        x_gap_in_(has_tics_inside() ? kGapWithLabels_in : kGap_in),
        width_in_(kLeft_in + sheet.columns * (sheet.panel_width_in + x_gap_in_) - x_gap_in_ +
                  kRight_in),
        caption_(wrapped(sheet.caption, width_in_ - 0.2, kCaption_pt)) {
    std::size_t longest = 0;
    for (const std::string& entry : sheet.legend) longest = std::max(longest, title_length(entry));
    const double entry_in = kLegendEntry_in + text_width_in(longest, kFont_pt);
    const int entries = static_cast<int>(sheet.legend.size());
    const int columns = std::clamp(static_cast<int>(width_in_ / entry_in), 1, std::max(1, entries));
    legend_rows_ = (entries + columns - 1) / columns;
  }

  [[nodiscard]] double width_in() const { return width_in_; }
  [[nodiscard]] double height_in() const {
    return kTop_in + rows_ * (sheet_.panel_height_in + row_gap_in()) - row_gap_in() + x_label_in() +
           sheet_.x_tics_in + below_in();
  }
  [[nodiscard]] const std::vector<std::string>& caption() const { return caption_; }
  [[nodiscard]] int legend_rows() const { return legend_rows_; }

  [[nodiscard]] std::string margins(int panel) const {
    const int row = panel / sheet_.columns, column = panel % sheet_.columns;
    const double left = kLeft_in + column * (sheet_.panel_width_in + x_gap_in_);
    const double bottom = bottom_in(row);
    return margins(left, left + sheet_.panel_width_in, bottom, bottom + sheet_.panel_height_in);
  }
  /// Height of the middle of a panel's x label as a share of the sheet.
  [[nodiscard]] double x_label(int panel) const {
    return (bottom_in(panel / sheet_.columns) - sheet_.x_tics_in - kXLabelMiddle_in) / height_in();
  }
  [[nodiscard]] std::string legend_margins() const {
    return margins(0.05, width_in_ - 0.05, caption_in(), below_in());
  }
  /// Height of a line of the caption as a share of the sheet.
  [[nodiscard]] double caption_line(std::size_t line) const {
    return (caption_in() - 0.06 - static_cast<double>(line) * kCaptionRow_in) / height_in();
  }

 private:
  /// Of the plotted area of a row's panels.
  [[nodiscard]] double bottom_in(int row) const {
    return height_in() - kTop_in - row * (sheet_.panel_height_in + row_gap_in()) -
           sheet_.panel_height_in;
  }
  [[nodiscard]] double caption_in() const {
    return 0.08 + static_cast<double>(caption_.size()) * kCaptionRow_in;
  }
  [[nodiscard]] double below_in() const { return caption_in() + legend_rows_ * kLegendRow_in; }
  [[nodiscard]] double x_label_in() const {
    const auto labelled = [](const Panel& panel) { return !panel.x_label.empty(); };
    return std::ranges::any_of(sheet_.panels, labelled) ? kXLabel_in : kGap_in;
  }
  [[nodiscard]] double row_gap_in() const { return kGap_in + title_gap_in_ + sheet_.x_tics_in; }
  [[nodiscard]] bool has_titles_inside() const {
    const auto below = std::min<std::ptrdiff_t>(sheet_.columns, std::ssize(sheet_.panels));
    return std::any_of(sheet_.panels.begin() + below, sheet_.panels.end(),
                       [](const Panel& panel) { return !panel.title.empty(); });
  }
  [[nodiscard]] bool has_tics_inside() const {
    for (std::size_t i = 0; i < sheet_.panels.size(); ++i)
      if (i % static_cast<std::size_t>(sheet_.columns) != 0 && sheet_.panels[i].y_tic_labels)
        return true;
    return false;
  }
  [[nodiscard]] std::string margins(double left, double right, double bottom, double top) const {
    return fmt::format(
        "set lmargin at screen {:.5f}; set rmargin at screen {:.5f}; set bmargin at screen {:.5f}; "
        "set tmargin at screen {:.5f}",
        left / width_in_, right / width_in_, bottom / height_in(), top / height_in());
  }

  const FigureSheet& sheet_;
  int rows_, legend_rows_ = 0;
  double title_gap_in_, x_gap_in_, width_in_;
  std::vector<std::string> caption_;
};

std::string plot_command(const std::vector<std::string>& elements) {
  std::string command = "  plot ";
  for (std::size_t i = 0; i < elements.size(); ++i)
    command += (i > 0 ? ", \\\n       " : "") + elements[i];
  return command + '\n';
}

std::string header_of(const FigureSheet& sheet, const Geometry& geometry) {
  return fmt::format(
      "# `gnuplot {0}.gp` in this folder draws {0}.png and {0}.pdf from {0}.dat.\n"
      "data = '{0}.dat'\n"
      "set encoding utf8\n"
      "set datafile missing '-'\n"
      "do for [format in 'png pdf'] {{\n"
      "  if (format eq 'png') {{\n"
      "    set terminal pngcairo noenhanced size {1:.0f},{2:.0f} font 'DejaVu Sans,{5}' fontscale "
      "{6:.4f} "
      "linewidth {7:.4f} pointscale 1 background '#FFFFFF'\n"
      "  }} else {{\n"
      "    set terminal pdfcairo noenhanced size {3:.3f}in,{4:.3f}in font 'DejaVu Sans,{5}' "
      "fontscale {8:.4f} "
      "linewidth 2 pointscale 0.6\n"
      "  }}\n"
      "  set output '{0}.'.format\n"
      "  set multiplot\n"
      "  set border 3 lc rgb '#444444' lw 0.7\n"
      "  set tics nomirror scale 0.5 textcolor rgb '#222222'\n"
      "  set grid lc rgb '#D0D0D0' lw 0.4 dt 1\n"
      "  unset key\n",
      sheet.name, std::round(geometry.width_in() * kDotsPerInch),
      std::round(geometry.height_in() * kDotsPerInch), geometry.width_in(), geometry.height_in(),
      kFont_pt, kDotsPerInch / kFontUnitsPerInch, kDotsPerInch / kPointsPerInch,
      kPointsPerInch / kFontUnitsPerInch);
}

std::string text_of(const Panel& panel, const std::string& margins, double x_label_at) {
  std::string text = "\n  " + margins + '\n';
  text += fmt::format("  set title {} font ',7.5' offset 0,-0.6\n", gnuplot_quoted(panel.title));
  text += panel.x_label.empty()
              ? "  unset label 2\n"
              : fmt::format("  set label 2 {} at graph 0.5, screen {:.5f} center\n",
                            gnuplot_quoted(panel.x_label), x_label_at);
  text += fmt::format("  set ylabel {} offset 1.2,0\n", gnuplot_quoted(panel.y_label));
  text += panel.y_tic_labels ? "  set format y '%g'\n" : "  set format y ''\n";
  for (const std::string& setting : panel.settings) text += "  " + setting + '\n';
  return text + plot_command(panel.elements);
}

std::string legend_and_caption(const FigureSheet& sheet, const Geometry& geometry) {
  std::string text = "\n  " + geometry.legend_margins() + '\n';
  text +=
      "  unset label; unset title; unset xlabel; unset ylabel; unset border; unset tics; unset "
      "grid\n"
      "  set xrange [0:1]; set yrange [0:1]\n";
  text += fmt::format(
      "  set key center center horizontal maxrows {} Left reverse samplen 2.5 width 1 noenhanced\n",
      std::max(1, geometry.legend_rows()));
  const std::vector<std::string>& caption = geometry.caption();
  for (std::size_t line = 0; line < caption.size(); ++line)
    text += fmt::format(
        "  set label {} at screen 0.5,{:.5f} center font ',{}' textcolor rgb '#333333'\n",
        gnuplot_quoted(caption[line]), geometry.caption_line(line), kCaption_pt);
  return text +
         plot_command(sheet.legend.empty() ? std::vector<std::string>{"NaN notitle"}
                                           : sheet.legend) +
         "  unset label\n";
}

std::string script_of(const FigureSheet& sheet) {
  const Geometry geometry(sheet);
  std::string script = header_of(sheet, geometry);
  for (std::size_t i = 0; i < sheet.panels.size(); ++i)
    script += text_of(sheet.panels[i], geometry.margins(static_cast<int>(i)),
                      geometry.x_label(static_cast<int>(i)));
  return script + legend_and_caption(sheet, geometry) +
         "  unset multiplot\n  set output\n  reset\n  set encoding utf8\n  set datafile missing "
         "'-'\n}\n";
}

/// gnuplot leaves a picture cut short where the disk is full, and is content.
void check_whole(const fs::path& picture, std::string_view end) {
  constexpr std::size_t kTail = 32;
  const std::string bytes = read_file(picture);
  const std::string_view tail =
      std::string_view(bytes).substr(bytes.size() - std::min(kTail, bytes.size()));
  if (tail.find(end) == tail.npos)
    throw Error(picture.filename().string() +
                ": gnuplot could not write it to its end; check the free space");
}

/// Script, numbers and pictures, in a folder that holds nothing else.
void draw_into(const fs::path& aside, const FigureSheet& sheet) {
  fs::create_directories(aside);
  write_file(aside / (sheet.name + ".dat"), sheet.data);
  write_file(aside / (sheet.name + ".gp"), script_of(sheet));
  run_gnuplot(aside, sheet.name + ".gp");
  check_whole(aside / (sheet.name + ".png"), "IEND");
  check_whole(aside / (sheet.name + ".pdf"), "%%EOF");
}

}  // namespace

std::string FigureSheet::start_block(const std::string& what, const std::string& names) {
  data += fmt::format("{}# {}\n# {}\n", blocks > 0 ? "\n\n" : "", what, names);
  return fmt::format("data index {}", blocks++);
}

void FigureSheet::add_legend(const std::string& style, const std::string& title) {
  legend.push_back(fmt::format("NaN with {} title {}", style, gnuplot_quoted(title)));
}

double panel_width_in(int columns) {
  return std::clamp(kPanels_in / columns, 1.5, 3.3);
}

double text_width_in(std::size_t letters, double font_pt) {
  return static_cast<double>(letters) * kLetterWidth * font_pt / kPointsPerInch;
}

void make_folder(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem)
    throw Error(folder.string() + ": cannot be made (" + problem.message() +
                "); choose another folder");
}

std::vector<fs::path> draw(const FigureSheet& sheet, const fs::path& folder) {
  make_folder(folder);
  const fs::path aside = folder / (sheet.name + ".partial");
  std::error_code ignored;
  fs::remove_all(aside, ignored);
  try {
    draw_into(aside, sheet);
    for (const char* suffix : {".dat", ".gp", ".png", ".pdf"})
      fs::rename(aside / (sheet.name + suffix), folder / (sheet.name + suffix));
  } catch (...) {
    fs::remove_all(aside, ignored);
    throw;
  }
  fs::remove_all(aside, ignored);
  return {folder / (sheet.name + ".png"), folder / (sheet.name + ".pdf")};
}

}  // namespace mapscore::eval
