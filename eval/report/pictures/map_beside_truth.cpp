// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/map_beside_truth.hpp"

#include "eval/report/pictures/caption.hpp"
#include "eval/report/pictures/map_pictures.hpp"
#include "eval/report/pictures/view.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

constexpr int kText_px = 18, kStrip_px = 44, kLeft_px = 18;
constexpr double kLongestScale = 0.3;  ///< of a panel's width

/// The longest of 1, 2 and 5 times a power of ten that has room.
double scale_length_m(double room_m) {
  const double decade = std::pow(10.0, std::floor(std::log10(room_m)));
  double length = decade;
  for (const double step : {2.0, 5.0})
    if (step * decade <= room_m) length = step * decade;
  return length;
}

/// A white strip; with a scale of metres where it is known how long they are.
cv::Mat3b scale_strip(const sim::View& view, bool shown) {
  const auto metre_px = pixels_per_metre(view);
  cv::Mat3b strip(metre_px ? kStrip_px : 0, view.width_px, cv::Vec3b::all(255));
  if (!metre_px || !shown) return strip;
  const double length_m = scale_length_m(kLongestScale * view.width_px / *metre_px);
  const int y = kStrip_px / 2;
  const int right = kLeft_px + static_cast<int>(std::lround(length_m * *metre_px));
  const cv::Scalar ink = cv::Scalar::all(30);
  cv::line(strip, {kLeft_px, y}, {right, y}, ink, 3);
  for (const int x : {kLeft_px, right}) cv::line(strip, {x, y - 7}, {x, y + 7}, ink, 3);
  write_text(strip, fmt::format("{:.6g} m", length_m), {right + 12, y}, kText_px);
  return strip;
}

CaptionedColumn panel(std::string title, const cv::Mat3b& picture, const cv::Mat3b& strip,
                      std::vector<LegendEntry> legend) {
  cv::Mat3b below = picture;
  if (!strip.empty()) cv::vconcat(picture, strip, below);
  return {std::move(title), {below}, std::move(legend)};
}

}  // namespace

cv::Mat3b map_beside_truth(const JudgedMap& map, const ClassTable& table, ScenePainter& painter,
                           const sim::View& view) {
  const auto painted = [&](const std::vector<sim::Cube>& cubes) {
    return painter.paint_through(view, cubes);
  };
  const cv::Mat3b blank = scale_strip(view, false);
  return in_columns({panel("truth, as far as it was seen", painted(truth_cubes(map, table)),
                           scale_strip(view, true), truth_legend(map, table)),
                     panel("map: " + map.title, painted(class_cubes(map, table)), blank,
                           class_legend(map, table)),
                     panel("errors", painted(error_cubes(map)), blank, error_legend(map))},
                    view.width_px);
}

}  // namespace mapscore::eval
