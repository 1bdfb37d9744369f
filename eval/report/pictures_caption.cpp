// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures_caption.hpp"

#include "core/error.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <fstream>

namespace mapscore::eval {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
/// Height of a capital of the font at scale 1, pixels.
constexpr double kCapital_px = 21.0;
constexpr int kText_px = 12, kLine_px = 26, kSwatch_px = 14, kMargin_px = 12;

/// Legend entries broken into lines that fit.
std::vector<std::vector<LegendEntry>> lines_of(const std::vector<LegendEntry>& legend,
                                               int width_px) {
  std::vector<std::vector<LegendEntry>> lines;
  int x = width_px;
  for (const LegendEntry& entry : legend) {
    const int needed = kSwatch_px + 8 + text_width(entry.text, kText_px) + 24;
    if (x + needed > width_px - kMargin_px || lines.empty()) {
      lines.emplace_back();
      x = kMargin_px;
    }
    lines.back().push_back(entry);
    x += needed;
  }
  return lines;
}

void draw_line(cv::Mat3b& sheet, const std::vector<LegendEntry>& line, int y) {
  int x = kMargin_px;
  for (const LegendEntry& entry : line) {
    const cv::Rect swatch(x, y - kSwatch_px / 2, kSwatch_px, kSwatch_px);
    cv::rectangle(sheet, swatch, bgr(entry.colour), cv::FILLED);
    cv::rectangle(sheet, swatch, cv::Scalar::all(90), 1);
    write_text(sheet, entry.text, {x + kSwatch_px + 8, y}, kText_px);
    x += kSwatch_px + 8 + text_width(entry.text, kText_px) + 24;
  }
}

}  // namespace

void write_text(cv::Mat3b& picture, const std::string& text, cv::Point at, int height_px,
                const Colour& colour) {
  cv::putText(picture, text, {at.x, at.y + height_px / 2}, kFont, height_px / kCapital_px,
              bgr(colour), 1, cv::LINE_AA);
}

int text_width(const std::string& text, int height_px) {
  int baseline = 0;
  return cv::getTextSize(text, kFont, height_px / kCapital_px, 1, &baseline).width;
}

cv::Mat3b captioned(const cv::Mat3b& picture, const std::string& title,
                    const std::vector<LegendEntry>& legend) {
  const auto lines = lines_of(legend, picture.cols);
  const int top = title.empty() ? 0 : kLine_px + 6;
  const int below = lines.empty() ? 0 : static_cast<int>(lines.size()) * kLine_px + 8;
  cv::Mat3b sheet(picture.rows + top + below, picture.cols, cv::Vec3b::all(255));
  picture.copyTo(sheet(cv::Rect(0, top, picture.cols, picture.rows)));
  write_text(sheet, title, {kMargin_px, top / 2}, kText_px + 2);
  for (std::size_t i = 0; i < lines.size(); ++i)
    draw_line(sheet, lines[i],
              top + picture.rows + 4 + kLine_px / 2 + static_cast<int>(i) * kLine_px);
  return sheet;
}

std::filesystem::path write_picture(const std::filesystem::path& file, const cv::Mat3b& picture) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", picture, bytes, {cv::IMWRITE_PNG_COMPRESSION, 9});
  std::filesystem::path aside = file;
  aside += ".partial";
  std::ofstream stream(aside, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream)
    throw Error(file.string() + ": cannot be written; check the folder and the free space");
  std::filesystem::rename(aside, file);
  return file;
}

}  // namespace mapscore::eval
