// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/script.hpp"

#include "core/error.hpp"
#include "eval/report/figures/font.hpp"
#include "eval/report/figures/geometry.hpp"
#include "eval/report/figures/gnuplot.hpp"
#include "files/file_bytes.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

constexpr double kScreenDotsPerInch = 150.0;
/// Of a y label in print from where gnuplot puts it, in letters; a line is two letters high.
constexpr double kLabelOffset = 0.5;
/// The resolution that the cairo terminals take font sizes for, and that of an SVG.
constexpr double kFontUnitsPerInch = 96.0;

std::string plot_command(const std::vector<std::string>& elements) {
  std::string command = "  plot ";
  for (std::size_t i = 0; i < elements.size(); ++i)
    command += (i > 0 ? ", \\\n       " : "") + elements[i];
  return command + '\n';
}

/// `set terminal` of each format.
std::string terminals(const FigureSheet& sheet, const Geometry& geometry) {
  const double dots = sheet.style.dots_per_inch();
  const double width_in = geometry.width_in(), height_in = geometry.height_in();
  const std::string font =
      fmt::format("font {}", gnuplot_quoted(fmt::format("{},{}", sheet.style.font, kFont_pt)));
  return fmt::format(
             "  if (format eq 'png') {{\n"
             "    set terminal pngcairo noenhanced size {:.0f},{:.0f} {} fontscale {:.4f} "
             "linewidth "
             "{:.4f} pointscale {} background '#FFFFFF'\n"
             "  }}\n",
             std::round(width_in * dots), std::round(height_in * dots), font,
             dots / kFontUnitsPerInch, dots / kPointsPerInch, dots / kScreenDotsPerInch) +
         fmt::format(
             "  if (format eq 'pdf') {{\n"
             "    set terminal pdfcairo noenhanced size {:.3f}in,{:.3f}in {} fontscale {:.4f} "
             "linewidth 2 pointscale 0.6\n"
             "  }}\n",
             width_in, height_in, font, kPointsPerInch / kFontUnitsPerInch) +
         fmt::format(
             "  if (format eq 'svg') {{\n"
             "    set terminal svg noenhanced standalone size {:.0f},{:.0f} {} fontscale {:.4f} "
             "linewidth {:.4f} background '#FFFFFF'\n"
             "  }}\n",
             std::round(width_in * kFontUnitsPerInch), std::round(height_in * kFontUnitsPerInch),
             font, kFontUnitsPerInch / kPointsPerInch, kFontUnitsPerInch / kPointsPerInch);
}

std::string header_of(const FigureSheet& sheet, const Geometry& geometry) {
  return fmt::format(
      "# `gnuplot {0}.gp` in this folder draws {0}.png, .pdf and .svg from {0}.dat.\n"
      "data = '{0}.dat'\n"
      "set encoding utf8\n"
      "set datafile missing '-'\n"
      "do for [format in 'png pdf svg'] {{\n"
      "{1}"
      "  set output '{0}.'.format\n"
      "  set multiplot\n"
      "  set border 3 lc rgb '#444444' lw 0.7\n"
      "  set tics nomirror scale 0.5 textcolor rgb '#222222'\n"
      "  set format x '%g'\n"
      "  set grid lc rgb '#D0D0D0' lw 0.4 dt 1\n"
      "  unset key\n",
      sheet.name, terminals(sheet, geometry));
}

std::string text_of(const FigureSheet& sheet, const Panel& panel, const std::string& margins,
                    double x_label_at) {
  std::string text = "\n  " + margins + '\n';
  text += fmt::format("  set title {} font ',{}' offset 0,-0.6\n", gnuplot_quoted(panel.title),
                      kTitle_pt);
  text += panel.x_label.empty()
              ? "  unset label 2\n"
              : fmt::format("  set label 2 {} at graph 0.5, screen {:.5f} center\n",
                            gnuplot_quoted(panel.x_label), x_label_at);
  const auto further_lines = static_cast<double>(std::ranges::count(panel.y_label, '\n'));
  text += fmt::format("  set ylabel {} offset {},0\n", gnuplot_quoted(panel.y_label),
                      sheet.style.width_mm ? kLabelOffset - further_lines : 1.2);
  text += panel.y_tic_labels ? "  set format y '%g'\n" : "  set format y ''\n";
  for (const std::string& setting : panel.settings) text += "  " + setting + '\n';
  return text + plot_command(panel.elements);
}

std::string legend_and_caption(const FigureSheet& sheet, const Geometry& geometry) {
  std::string text = "\n  " + geometry.legend_margins() + '\n';
  text +=
      "  unset label; unset object; unset arrow; unset title; unset xlabel; unset ylabel; unset "
      "border; unset tics; unset "
      "grid\n"
      "  set xrange [0:1]; set yrange [0:1]\n";
  text += fmt::format(
      "  set key center center horizontal maxrows {} Left reverse samplen {} width 1 noenhanced\n",
      std::max(1, geometry.legend_rows()), sheet.style.grey ? 5.0 : 2.5);
  const std::vector<std::string>& caption = geometry.caption();
  for (std::size_t line = 0; line < caption.size(); ++line)
    text += fmt::format(
        "  set label {} at screen 0.5,{:.5f} center font ',{}' textcolor rgb '#333333'\n",
        gnuplot_quoted(caption[line]), geometry.caption_line(line), sheet.style.small_pt());
  std::vector<std::string> keys;
  for (const FigureKey& key : sheet.legend)
    keys.push_back(fmt::format("NaN with {} title {}", key.plotting, gnuplot_quoted(key.title)));
  if (keys.empty()) keys.emplace_back("NaN notitle");
  return text + plot_command(keys) + "  unset label\n";
}

std::string all_letters_script(const FigureSheet& asked) {
  const FigureSheet sheet = arranged(asked);
  const Geometry geometry(sheet);
  std::string script = header_of(sheet, geometry);
  for (std::size_t i = 0; i < sheet.panels.size(); ++i)
    if (!sheet.panels[i].elements.empty())
      script += text_of(sheet, sheet.panels[i], geometry.margins(static_cast<int>(i)),
                        geometry.x_label(static_cast<int>(i)));
  script += legend_and_caption(sheet, geometry) +
            "  unset multiplot\n  set output\n  reset\n  set encoding utf8\n  set datafile "
            "missing '-'\n}\n";
  return sheet.style.grey ? greyed(std::move(script)) : script;
}

/// The script that gnuplot can draw; letters that it cannot are said once, below.
std::string script_of(FigureSheet sheet) {
  const std::string whole = all_letters_script(sheet);
  if (drawable(whole) == whole) return whole;
  sheet.caption += " ?: letters that the fonts here do not have.";
  return drawable(all_letters_script(sheet));
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
  check_whole(aside / (sheet.name + ".svg"), "</svg>");
}

}  // namespace

std::string FigureSheet::start_block(const std::string& what, const std::string& names) {
  data += fmt::format("{}# {}\n# {}\n", blocks > 0 ? "\n\n" : "", what, names);
  return fmt::format("data index {}", blocks++);
}

void FigureSheet::add_legend(const std::string& with, const std::string& title) {
  legend.push_back({with, title});
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
    for (const char* suffix : {".dat", ".gp", ".png", ".pdf", ".svg"})
      fs::rename(aside / (sheet.name + suffix), folder / (sheet.name + suffix));
  } catch (...) {
    fs::remove_all(aside, ignored);
    throw;
  }
  fs::remove_all(aside, ignored);
  return {folder / (sheet.name + ".png"), folder / (sheet.name + ".pdf"),
          folder / (sheet.name + ".svg")};
}

}  // namespace mapscore::eval
