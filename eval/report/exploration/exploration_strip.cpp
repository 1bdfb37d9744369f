// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/exploration/exploration_strip.hpp"

#include "eval/recording/recording.hpp"
#include "eval/report/pictures/caption.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace mapscore::eval {
namespace {

constexpr int kStripColumn_px = 320, kStripFloor_px = 360;
const cv::Scalar kWayInk(178, 114, 0), kFrontierInk(0, 94, 213);

Eigen::AlignedBox2d box_of_last(const std::vector<ShownMoment>& moments) {
  Eigen::AlignedBox2d box;
  const OccupancyGrid& floor = moments.back().floor;
  for (GridCell cell; cell.row < floor.frame().height; ++cell.row)
    for (cell.column = 0; cell.column < floor.frame().width; ++cell.column)
      if (floor.at(cell) != kUnknownCell) box.extend(floor.centre_of(cell));
  return {box.min().array() - 0.2, box.max().array() + 0.2};
}

/// The floor from above, y up, as wide as a column.
cv::Mat3b floor_picture(const ShownMoment& moment, const Eigen::AlignedBox2d& box) {
  const double px_per_m =
      std::min(kStripColumn_px / box.sizes().x(), kStripFloor_px / box.sizes().y());
  const int height = static_cast<int>(std::lround(box.sizes().y() * px_per_m));
  cv::Mat3b picture(height, kStripColumn_px);
  const double margin_m = 0.5 * (kStripColumn_px / px_per_m - box.sizes().x());
  const auto world_x = [&](double u) { return box.min().x() - margin_m + u / px_per_m; };
  const auto pixel = [&](const Eigen::Vector2d& p) {
    return cv::Point(static_cast<int>(std::lround((p.x() - box.min().x() + margin_m) * px_per_m)),
                     static_cast<int>(std::lround((box.max().y() - p.y()) * px_per_m)));
  };
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < kStripColumn_px; ++u) {
      const Eigen::Vector2d p(world_x(u + 0.5), box.max().y() - (v + 0.5) / px_per_m);
      const Occupancy value = moment.floor.at_or_unknown(moment.floor.cell_of(p));
      const int grey = value == kUnknownCell ? 222 : value == kFreeCell ? 255 : 70;
      picture(v, u) = cv::Vec3b::all(static_cast<std::uint8_t>(grey));
    }
  for (const Eigen::Vector2d& p : moment.frontier_map)
    cv::circle(picture, pixel(p), 1, kFrontierInk, cv::FILLED, cv::LINE_AA);
  for (std::size_t n = 1; n < moment.way_map.size(); ++n)
    cv::line(picture, pixel(moment.way_map[n - 1]), pixel(moment.way_map[n]), kWayInk, 2,
             cv::LINE_AA);
  cv::circle(picture, pixel(moment.way_map.back()), static_cast<int>(0.22 * px_per_m), kWayInk, 2,
             cv::LINE_AA);
  return picture;
}

/// The frame that was taken last before a moment.
int frame_at(const Recording& recording, double stamp_s) {
  int frame = 0;
  for (int n = 0; n < recording.frame_count(); ++n)
    if (recording.color_stamp_s(n) <= stamp_s) frame = n;
  return frame;
}

}  // namespace

std::optional<cv::Mat3b> exploration_strip(const FinishedExploration& run) {
  if (!std::filesystem::exists(run.folder / "recording")) return std::nullopt;
  const Recording recording = Recording::open(run.folder / "recording");
  const std::vector<ShownMoment> moments = read_moments(run);
  const Eigen::AlignedBox2d box = box_of_last(moments);
  std::vector<CaptionedColumn> columns;
  for (const ShownMoment& moment : moments) {
    Frame frame;
    recording.read_color(frame_at(recording, moment.stamp_s), {.color = true, .label = false},
                         frame);
    columns.push_back(
        {fmt::format("{:.1f} m, {:.0f} % seen", moment.driven_m, 100.0 * moment.coverage),
         {frame.color, floor_picture(moment, box)},
         {}});
  }
  return in_columns(columns, kStripColumn_px);
}

}  // namespace mapscore::eval
