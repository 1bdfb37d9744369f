// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/outline_picture.hpp"

#include "core/calibration/outline_evidence.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"
#include "eval/report/pictures/caption.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <set>

namespace mapscore::eval {
namespace {

constexpr int kScale = 2, kZoom = 4;  // of the whole image; of the part, over that
constexpr int kOutlineColumn_px = 900;
constexpr float kNearOutline_px = 6.0F;
const Colour kStep{20, 20, 20}, kPart{128, 128, 128};

/// Where a calibration puts the steps of a depth image, in pixels of the colour image.
std::vector<cv::Point2d> steps_in_color(const DepthEdges& edges, const Calibration& calibration) {
  std::vector<cv::Point2d> places;
  for (const DepthEdge& edge : edges.steps) {
    const Eigen::Vector3d p = calibration.T_color_depth * edge.point.cast<double>();
    if (!(p.z() > 0.05)) continue;
    const Eigen::Vector2d at = calibration.color.project(p);
    places.emplace_back(at.x(), at.y());
  }
  return places;
}

/// `part` of the colour image, `scale` times as large: outlines between pixels, steps as dots.
cv::Mat3b drawn(const OutlineField& field, const std::vector<Detection>& detections,
                const ClassTable& table, const std::vector<cv::Point2d>& steps,
                const cv::Rect& part, int scale) {
  cv::Mat3b picture(part.height * scale, part.width * scale, cv::Vec3b(255, 255, 255));
  const auto colour_of = [&](std::uint16_t owner) {
    return bgr(table.classes.at(detections.at(owner - std::size_t{1}).class_id).colour);
  };
  const int thick = std::max(1, scale / 2);
  for (int v = part.y; v < part.y + part.height; ++v)
    for (int u = part.x; u < part.x + part.width; ++u) {
      const std::uint16_t own = field.owner(v, u);
      const cv::Point corner((u - part.x) * scale, (v - part.y) * scale);
      const auto line = [&](int next_v, int next_u, cv::Point from, cv::Point to) {
        if (next_v >= field.owner.rows || next_u >= field.owner.cols) return;
        const std::uint16_t other = field.owner(next_v, next_u);
        if (own != other)
          cv::line(picture, corner + from, corner + to, colour_of(own != 0 ? own : other), thick);
      };
      line(v, u + 1, {scale, 0}, {scale, scale});
      line(v + 1, u, {0, scale}, {scale, scale});
    }
  for (const cv::Point2d& step : steps) {
    const cv::Point at(static_cast<int>(std::lround((step.x + 0.5 - part.x) * scale)),
                       static_cast<int>(std::lround((step.y + 0.5 - part.y) * scale)));
    if (cv::Rect(0, 0, picture.cols, picture.rows).contains(at))
      cv::circle(picture, at, scale >= 2 * kScale ? scale / 4 : 0, bgr(kStep), cv::FILLED);
  }
  cv::rectangle(picture, cv::Rect(0, 0, picture.cols, picture.rows), cv::Scalar(160, 160, 160));
  return picture;
}

/// The part of the image, a quarter as wide and high, that has most steps near outlines.
cv::Rect fullest_part(const OutlineField& field, const std::vector<cv::Point2d>& steps) {
  const cv::Size size(std::max(field.owner.cols / kZoom, 1), std::max(field.owner.rows / kZoom, 1));
  cv::Mat1f near(field.owner.size(), 0.0F);
  const cv::Rect image({0, 0}, field.owner.size());
  for (const cv::Point2d& step : steps) {
    const cv::Point at(static_cast<int>(std::lround(step.x)),
                       static_cast<int>(std::lround(step.y)));
    if (image.contains(at) && std::abs(field.distance(at)) < kNearOutline_px) near(at) += 1.0F;
  }
  cv::Mat1d sums;
  cv::integral(near, sums, CV_64F);
  cv::Rect best({0, 0}, size);
  double most = -1;
  for (int v = 0; v + size.height <= image.height; v += 8)
    for (int u = 0; u + size.width <= image.width; u += 8) {
      const double sum = sums(v + size.height, u + size.width) - sums(v, u + size.width) -
                         sums(v + size.height, u) + sums(v, u);
      if (sum > most) most = sum, best = {{u, v}, size};
    }
  return best;
}

}  // namespace

cv::Mat3b outline_picture(const Sight& sight, const ClassTable& table,
                          const std::vector<TitledCalibration>& calibrations) {
  const CameraModel& color = sight.believed().color;
  const OutlineField field = outline_field(sight.detections(), color.width_px, color.height_px, 16);
  const DepthEdges edges = find_depth_edges(sight.depth(), sight.believed(), kCalibrationEdges);
  std::vector<LegendEntry> legend;
  std::set<ClassId> shown;
  for (const Detection& detection : sight.detections())
    if (shown.insert(detection.class_id).second) {
      const SemanticClass& c = table.classes.at(detection.class_id);
      legend.push_back({c.colour, "outline of " + c.name});
    }
  legend.push_back({kStep, "step of depth"});
  legend.push_back({kPart, fmt::format("drawn below, {} times as large", kZoom)});
  std::vector<CaptionedColumn> columns;
  const cv::Rect part = fullest_part(field, steps_in_color(edges, calibrations.back().calibration));
  for (const TitledCalibration& one : calibrations) {
    const auto steps = steps_in_color(edges, one.calibration);
    const auto draw = [&](const cv::Rect& what, int scale) {
      return drawn(field, sight.detections(), table, steps, what, scale);
    };
    cv::Mat3b whole = draw({0, 0, color.width_px, color.height_px}, kScale);
    cv::rectangle(whole, kScale * part.tl(), kScale * part.br(), bgr(kPart), kScale);
    columns.push_back({one.title, {whole, draw(part, kScale * kZoom)}, {}});
  }
  columns.front().legend = legend;
  return in_columns(columns, kOutlineColumn_px);
}

}  // namespace mapscore::eval
