// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

#include <opencv2/core.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// A patch of colour and what it stands for.
struct LegendEntry {
  Colour colour;
  std::string text;
};

[[nodiscard]] inline cv::Scalar bgr(const Colour& colour) {
  return {double(colour.b), double(colour.g), double(colour.r)};
}

/// Writes a line of ASCII text; `at` is its left end, `height_px` that of a capital, centred on
/// at.y.
void write_text(cv::Mat3b& picture, const std::string& text, cv::Point at, int height_px,
                const Colour& colour = {30, 30, 30});
[[nodiscard]] int text_width(const std::string& text, int height_px);

/// Pictures of one size, from top to bottom, with a title above and a legend below.
struct CaptionedColumn {
  std::string title;  ///< may be empty
  std::vector<cv::Mat3b> pictures;
  std::vector<LegendEntry> legend;  ///< may be empty
};

/// The columns from left to right on white, their pictures scaled to `column_px` wide and the text
/// sized to be read when the sheet is printed as wide as a page. Lines that are too long are
/// broken. The pictures of a row must have one shape.
[[nodiscard]] cv::Mat3b in_columns(const std::vector<CaptionedColumn>& columns, int column_px);

/// The picture as it is with a title above it and the legend in lines below it.
[[nodiscard]] cv::Mat3b captioned(const cv::Mat3b& picture, const std::string& title,
                                  const std::vector<LegendEntry>& legend);

/// Writes a PNG aside, then renames it; leaves nothing behind after a failure. Throws Error.
std::filesystem::path write_picture(const std::filesystem::path& file, const cv::Mat3b& picture);

}  // namespace mapscore::eval
