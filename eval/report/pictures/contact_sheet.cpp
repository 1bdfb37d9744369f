// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/contact_sheet.hpp"

#include "core/segmentation/registered_cloud.hpp"
#include "eval/lab/trial_run.hpp"
#include "eval/report/axes.hpp"
#include "eval/report/pictures/caption.hpp"
#include "eval/report/pictures/pictures.hpp"
#include "eval/results/plan.hpp"
#include "eval/study/leaf_yaml.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

constexpr int kRows = 4, kGap_px = 6, kRowLabel_px = 44, kTitle_px = 26, kScale_px = 30;
constexpr int kSheet_px = 1600, kText_px = 11;
constexpr double kDimmed = 0.35;

/// What the largest misregistration of a study does to the calibration, and how the study calls it.
struct LargestFault {
  Calibration believed;
  std::string name;
};

/// How far the middle of the depth image lands from where it belongs in the colour image, for a
/// surface 2 m away, pixels.
double shift_px(const Calibration& truth, const Calibration& believed) {
  const Eigen::Vector3d point = truth.depth.back_project(truth.depth.cx_px, truth.depth.cy_px, 2.0);
  return (believed.color.project(believed.T_color_depth * point) -
          truth.color.project(truth.T_color_depth * point))
      .norm();
}

std::string name_of(const sim::Misregistration& dose) {
  std::string doses;
  sim::Misregistration::fields(dose, [&]<class T>(const T& member, const Field& field) {
    if constexpr (std::same_as<T, double> || std::same_as<T, Degrees>)
      if (member != T{}) doses += ", " + figure_axis(field, {Leaf<T>::text(member)}).value_text(0);
  });
  return "registered" + (doses.empty() ? ", largest fault" : doses);
}

std::optional<LargestFault> largest_fault(const Study& study, const Recording& recording) {
  const Calibration& truth = recording.info().calibration;
  std::optional<LargestFault> largest;
  double most = 0.0;
  for (const TrialSpec& spec : trials(study)) {
    if (spec.seed_index != 0 || spec.method != study.methods.front().name) continue;
    const Task task = task_of(study, spec, Labels::detected, recording.content_hash());
    const Calibration believed = believed_calibration(truth, task);
    const double shift = shift_px(truth, believed);
    if (shift <= most) continue;
    most = shift;
    largest = LargestFault{believed, name_of(task.config.faults.misregistration)};
  }
  return largest;
}

cv::Mat1b grey_levels(const cv::Mat1w& depth, const Calibration& calibration) {
  cv::Mat1b levels;
  const double low = calibration.range_min_m * kDepthUnitsPerMetre;
  const double high = calibration.range_max_m * kDepthUnitsPerMetre;
  depth.convertTo(levels, CV_8U, 255.0 / (high - low), -255.0 * low / (high - low));
  return levels;
}

cv::Mat3b depth_picture(const cv::Mat1w& depth, const Calibration& calibration) {
  cv::Mat3b picture;
  cv::applyColorMap(grey_levels(depth, calibration), picture, cv::COLORMAP_TURBO);
  picture.setTo(cv::Scalar::all(0), depth == 0);
  return picture;
}

cv::Vec3b colour_of(const ClassTable& table, ClassId class_id) {
  const Colour& colour = table.classes.at(class_id).colour;
  return {colour.b, colour.g, colour.r};
}

cv::Mat3b label_picture(const Frame& frame, const ClassTable& table) {
  cv::Mat3b picture = frame.color * kDimmed;
  for (int v = 0; v < picture.rows; ++v)
    for (int u = 0; u < picture.cols; ++u)
      if (const ClassId id = table.class_of(frame.label(v, u)); table.detected(id))
        picture(v, u) = colour_of(table, id);
  return picture;
}

/// Gives a pixel between two of one class that class.
void close_gaps(cv::Mat1w& classes, int dv, int du) {
  const cv::Mat1w before = classes.clone();
  for (int v = dv; v + dv < classes.rows; ++v)
    for (int u = du; u + du < classes.cols; ++u)
      if (before(v, u) == kBackground && before(v - dv, u - du) == before(v + dv, u + du))
        classes(v, u) = before(v - dv, u - du);
}

/// Class that registration hands to each depth pixel, background where none. Gaps of one pixel,
/// which no colour pixel falls on, are closed for the eye.
cv::Mat1w registered_classes(const Frame& frame, const ClassTable& table,
                             const Calibration& believed) {
  cv::Mat1w classes(frame.depth.size(), kBackground);
  const RegisteredCloud cloud = register_depth(frame.depth, believed);
  for (int v = 0; v < frame.label.rows; ++v) {
    for (int u = 0; u < frame.label.cols; ++u) {
      const ClassId id = table.class_of(frame.label(v, u));
      const int source = cloud.source(u, v);
      if (table.detected(id) && source != RegisteredCloud::kNone)
        classes(source / classes.cols, source % classes.cols) = id;
    }
  }
  close_gaps(classes, 0, 1);
  close_gaps(classes, 1, 0);
  return classes;
}

/// The depth camera's view: depth in grey, and the class that each pixel was handed in its colour.
cv::Mat3b registered_picture(const Frame& frame, const ClassTable& table,
                             const Calibration& believed) {
  cv::Mat3b picture;
  cv::cvtColor(225 - 0.6 * grey_levels(frame.depth, believed), picture, cv::COLOR_GRAY2BGR);
  picture.setTo(cv::Scalar::all(255), frame.depth == 0);
  const cv::Mat1w classes = registered_classes(frame, table, believed);
  for (int v = 0; v < picture.rows; ++v)
    for (int u = 0; u < picture.cols; ++u)
      if (classes(v, u) != kBackground) picture(v, u) = colour_of(table, classes(v, u));
  return picture;
}

/// Colours of the depth column, with metres.
void draw_depth_scale(cv::Mat3b& sheet, cv::Rect place, const Calibration& calibration) {
  const std::string low = fmt::format("{:.6g} m", calibration.range_min_m);
  const std::string high = fmt::format("{:.6g} m", calibration.range_max_m);
  const int left = text_width(low, kText_px) + 8, right = text_width(high, kText_px) + 8;
  const int middle = place.y + place.height / 2;
  cv::Mat1b ramp(10, place.width - left - right);
  for (int x = 0; x < ramp.cols; ++x) ramp.col(x).setTo(255 * x / std::max(1, ramp.cols - 1));
  cv::Mat3b colours;
  cv::applyColorMap(ramp, colours, cv::COLORMAP_TURBO);
  colours.copyTo(sheet(cv::Rect(place.x + left, middle - 5, ramp.cols, ramp.rows)));
  write_text(sheet, low, {place.x, middle}, kText_px);
  write_text(sheet, high, {place.x + place.width - right + 8, middle}, kText_px);
}

std::vector<CaptionedColumn> columns_of(const std::vector<Frame>& frames, const ClassTable& table,
                                        const Calibration& truth,
                                        const std::optional<LargestFault>& fault) {
  std::vector<CaptionedColumn> columns{
      {"colour", {}, {}}, {"depth", {}, {}}, {"labels", {}, {}}, {"registered, no fault", {}, {}}};
  if (fault) columns.push_back({fault->name, {}, {}});
  for (const Frame& frame : frames) {
    columns[0].pictures.push_back(frame.color);
    columns[1].pictures.push_back(depth_picture(frame.depth, truth));
    columns[2].pictures.push_back(label_picture(frame, table));
    columns[3].pictures.push_back(registered_picture(frame, table, truth));
    if (fault) columns[4].pictures.push_back(registered_picture(frame, table, fault->believed));
  }
  return columns;
}

cv::Mat3b put_together(const std::vector<CaptionedColumn>& columns,
                       const std::vector<Frame>& frames, const Calibration& calibration) {
  const int count = static_cast<int>(columns.size()), rows = static_cast<int>(frames.size());
  const int width = (kSheet_px - kRowLabel_px) / count - kGap_px;
  const int height = width * calibration.color.height_px / calibration.color.width_px;
  cv::Mat3b sheet(kTitle_px + rows * (height + kGap_px) + kScale_px,
                  kRowLabel_px + count * (width + kGap_px), cv::Vec3b::all(255));
  for (int c = 0; c < count; ++c) {
    const int x = kRowLabel_px + c * (width + kGap_px);
    const CaptionedColumn& column = columns[static_cast<std::size_t>(c)];
    write_text(sheet, column.title, {x + 2, kTitle_px / 2}, kText_px + 1);
    for (int r = 0; r < rows; ++r) {
      const cv::Rect place(x, kTitle_px + r * (height + kGap_px), width, height);
      cv::resize(column.pictures[static_cast<std::size_t>(r)], sheet(place), place.size(), 0, 0,
                 cv::INTER_AREA);
    }
    if (c == 1)
      draw_depth_scale(sheet, {x, sheet.rows - kScale_px, width, kScale_px - 4}, calibration);
  }
  for (int r = 0; r < rows; ++r)
    write_text(sheet, fmt::format("#{}", frames[static_cast<std::size_t>(r)].index),
               {4, kTitle_px + r * (height + kGap_px) + height / 2}, kText_px);
  return sheet;
}

}  // namespace

cv::Mat3b contact_sheet(const Study& study, const ClassTable& table, const Recording& recording,
                        const std::vector<int>& chosen) {
  std::vector<int> shown = chosen;
  const int rows = chosen.empty() ? std::min(kRows, recording.frame_count()) : 0;
  for (int row = 0; row < rows; ++row)
    shown.push_back(fullest_frame(recording, table, row * recording.frame_count() / rows,
                                  (row + 1) * recording.frame_count() / rows));
  std::vector<Frame> frames;
  for (const int frame : shown) frames.push_back(recording.read(frame, {.color = true}));
  const Calibration& truth = recording.info().calibration;
  const std::vector<CaptionedColumn> columns =
      columns_of(frames, table, truth, largest_fault(study, recording));
  std::vector<LegendEntry> legend;
  for (const SemanticClass& c : table.classes)
    if (c.detect) legend.push_back({c.colour, c.name});
  return captioned(put_together(columns, frames, truth), "", legend);
}

}  // namespace mapscore::eval
