// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/caption.hpp"

#include "core/whole_file.hpp"
#include "files/png.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace mapscore::eval {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
/// Height of a capital of the font at scale 1, pixels.
constexpr double kCapital_px = 21.0;

int stroke_px(int height_px) {
  return height_px < 16 ? 1 : 2;
}

/// Measures of captions, all from the height of a capital.
struct Type {
  int text_px;

  [[nodiscard]] int line_px() const { return 2 * text_px + 2; }
  [[nodiscard]] int swatch_px() const { return text_px + 3; }
  [[nodiscard]] int gap_px() const { return text_px / 2 + 2; }  ///< between swatch and text
  [[nodiscard]] int margin_px() const { return text_px; }
  [[nodiscard]] int entry_px(const LegendEntry& entry) const {
    return swatch_px() + gap_px() + text_width(entry.text, text_px);
  }
};

/// Capitals 2 mm high where a sheet fills the width of a page of 17 cm; no larger than a third of a
/// wide sheet has room for.
Type type_for(int sheet_px) {
  constexpr double kShareOfWidth = 0.0125;
  return {std::clamp(static_cast<int>(kShareOfWidth * sheet_px), 12, 18)};
}

/// Legend entries broken into lines that fit.
std::vector<std::vector<LegendEntry>> lines_of(const std::vector<LegendEntry>& legend, int width_px,
                                               const Type& type) {
  std::vector<std::vector<LegendEntry>> lines;
  int x = width_px;
  for (const LegendEntry& entry : legend) {
    if (lines.empty() || x + type.entry_px(entry) > width_px - type.margin_px()) {
      lines.emplace_back();
      x = type.margin_px();
    }
    lines.back().push_back(entry);
    x += type.entry_px(entry) + 2 * type.text_px;
  }
  return lines;
}

/// Parts of a text that are better not torn apart: what its commas separate, commas kept.
std::vector<std::string> phrases_of(const std::string& text) {
  std::vector<std::string> phrases{""};
  for (const char c : text) {
    if (c == ' ' && phrases.back().ends_with(','))
      phrases.emplace_back();
    else
      phrases.back() += c;
  }
  return phrases;
}

/// Text broken into lines that fit, between phrases; a longer phrase stands alone.
std::vector<std::string> lines_of(const std::string& text, int width_px, const Type& type) {
  std::vector<std::string> lines;
  if (text.empty()) return lines;
  for (const std::string& phrase : phrases_of(text)) {
    const std::string longer = lines.empty() ? phrase : lines.back() + ' ' + phrase;
    if (lines.empty() || text_width(longer, type.text_px) > width_px - 2 * type.margin_px())
      lines.push_back(phrase);
    else
      lines.back() = longer;
  }
  return lines;
}

void draw_line(cv::Mat3b& sheet, const std::vector<LegendEntry>& line, int y, const Type& type) {
  int x = type.margin_px();
  for (const LegendEntry& entry : line) {
    const cv::Rect swatch(x, y - type.swatch_px() / 2, type.swatch_px(), type.swatch_px());
    cv::rectangle(sheet, swatch, bgr(entry.colour), cv::FILLED);
    cv::rectangle(sheet, swatch, cv::Scalar::all(90), 1);
    write_text(sheet, entry.text, {x + type.swatch_px() + type.gap_px(), y}, type.text_px);
    x += type.entry_px(entry) + 2 * type.text_px;
  }
}

/// White, with room for so many lines.
cv::Mat3b strip(std::size_t lines, int width_px, const Type& type) {
  const int height = lines == 0 ? 0 : static_cast<int>(lines) * type.line_px() + type.gap_px();
  return cv::Mat3b(height, width_px, cv::Vec3b::all(255));
}

int middle_of_line(std::size_t line, const Type& type) {
  return type.gap_px() / 2 + type.line_px() / 2 + static_cast<int>(line) * type.line_px();
}

cv::Mat3b title_strip(const std::string& title, int width_px, const Type& type) {
  const std::vector<std::string> lines = lines_of(title, width_px, type);
  cv::Mat3b sheet = strip(lines.size(), width_px, type);
  for (std::size_t i = 0; i < lines.size(); ++i)
    write_text(sheet, lines[i], {type.margin_px(), middle_of_line(i, type)}, type.text_px);
  return sheet;
}

cv::Mat3b legend_strip(const std::vector<LegendEntry>& legend, int width_px, const Type& type) {
  const auto lines = lines_of(legend, width_px, type);
  cv::Mat3b sheet = strip(lines.size(), width_px, type);
  for (std::size_t i = 0; i < lines.size(); ++i)
    draw_line(sheet, lines[i], middle_of_line(i, type), type);
  return sheet;
}

cv::Mat3b scaled_to(const cv::Mat3b& picture, int width_px) {
  if (picture.cols == width_px) return picture;
  cv::Mat3b scaled;
  const double scale = static_cast<double>(width_px) / picture.cols;
  cv::resize(picture, scaled, {width_px, static_cast<int>(std::lround(scale * picture.rows))}, 0, 0,
             cv::INTER_AREA);
  return scaled;
}

/// Joined from left to right on white, aligned at the top.
cv::Mat3b row_of(const std::vector<cv::Mat3b>& parts) {
  int width = 0, height = 0;
  for (const cv::Mat3b& part : parts) {
    width += part.cols;
    height = std::max(height, part.rows);
  }
  cv::Mat3b row(height, width, cv::Vec3b::all(255));
  int x = 0;
  for (const cv::Mat3b& part : parts) {
    if (!part.empty()) part.copyTo(row(cv::Rect(x, 0, part.cols, part.rows)));
    x += part.cols;
  }
  return row;
}

}  // namespace

void write_text(cv::Mat3b& picture, const std::string& text, cv::Point at, int height_px,
                const Colour& colour) {
  cv::putText(picture, text, {at.x, at.y + height_px / 2}, kFont, height_px / kCapital_px,
              bgr(colour), stroke_px(height_px), cv::LINE_AA);
}

int text_width(const std::string& text, int height_px) {
  int baseline = 0;
  return cv::getTextSize(text, kFont, height_px / kCapital_px, stroke_px(height_px), &baseline)
      .width;
}

cv::Mat3b in_columns(const std::vector<CaptionedColumn>& columns, int column_px) {
  const Type type = type_for(column_px * static_cast<int>(columns.size()));
  std::vector<cv::Mat3b> titles, legends;
  std::vector<std::vector<cv::Mat3b>> rows;
  for (const CaptionedColumn& column : columns) {
    titles.push_back(title_strip(column.title, column_px, type));
    legends.push_back(legend_strip(column.legend, column_px, type));
    rows.resize(std::max(rows.size(), column.pictures.size()));
    for (std::size_t i = 0; i < column.pictures.size(); ++i)
      rows[i].push_back(scaled_to(column.pictures[i], column_px));
  }
  std::vector<cv::Mat3b> from_top{row_of(titles)};
  for (const std::vector<cv::Mat3b>& row : rows) from_top.push_back(row_of(row));
  from_top.push_back(row_of(legends));
  std::erase_if(from_top, [](const cv::Mat3b& part) { return part.empty(); });
  cv::Mat3b sheet;
  cv::vconcat(from_top, sheet);
  return sheet;
}

cv::Mat3b captioned(const cv::Mat3b& picture, const std::string& title,
                    const std::vector<LegendEntry>& legend) {
  return in_columns({{title, {picture}, legend}}, picture.cols);
}

std::filesystem::path write_picture(const std::filesystem::path& file, const cv::Mat3b& picture) {
  write_whole_file(file, encode_png(picture));
  return file;
}

}  // namespace mapscore::eval
