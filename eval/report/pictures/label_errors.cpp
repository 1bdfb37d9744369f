// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/label_errors.hpp"

#include "eval/report/colours.hpp"
#include "eval/report/pictures/caption.hpp"

#include <fmt/format.h>

#include <set>

namespace mapscore::eval {
namespace {

constexpr int kLabelColumn_px = 480, kFrameText_px = 14;

/// True and labelled class of each pixel of a frame, over its colour image.
struct LabelledFrame {
  int index = 0;
  cv::Mat3b color;
  cv::Mat1w truth, labelled;
};

LabelledFrame read_frame(const LabelFolder& labels, int index) {
  Frame frame = labels.recording.read(index, {.color = true});
  LabelledFrame read{index, frame.color, frame.label, read_label_image(labels, index)};
  for (auto& id : read.truth) id = labels.table.class_of(id);
  for (auto& id : read.labelled) id = labels.legend(id).value();
  return read;
}

/// So pale that classes and errors stand out, and dark ones too.
cv::Mat3b pale(const cv::Mat3b& color) {
  constexpr double kShare = 0.35;
  return cv::Mat3b(kShare * color + cv::Scalar::all(255 * (1 - kShare)));
}

cv::Vec3b pixel_of(const Colour& colour) {
  return {colour.b, colour.g, colour.r};
}

cv::Mat3b classes_picture(const cv::Mat3b& color, const cv::Mat1w& classes,
                          const ClassTable& table) {
  cv::Mat3b picture = pale(color);
  for (int v = 0; v < picture.rows; ++v)
    for (int u = 0; u < picture.cols; ++u)
      if (const ClassId id = classes(v, u); id != kBackground)
        picture(v, u) = pixel_of(table.classes[id].colour);
  return picture;
}

cv::Mat3b errors_picture(const LabelledFrame& frame) {
  cv::Mat3b picture = pale(frame.color);
  for (int v = 0; v < picture.rows; ++v)
    for (int u = 0; u < picture.cols; ++u) {
      const ClassId truth = frame.truth(v, u), labelled = frame.labelled(v, u);
      if (truth == labelled) continue;
      picture(v, u) = pixel_of(labelled == kBackground ? kMissedColour
                               : truth == kBackground  ? kLeakColour
                                                       : kMislabelledColour);
    }
  return picture;
}

/// The colour image with the frame's number in a corner.
cv::Mat3b numbered_picture(const LabelledFrame& frame) {
  cv::Mat3b picture = frame.color.clone();
  const std::string name = fmt::format("frame {}", frame.index);
  // The picture is scaled to the column's width, and the text should keep its size.
  const int height_px = std::max(6, kFrameText_px * picture.cols / kLabelColumn_px);
  const cv::Rect corner(0, 0, text_width(name, height_px) + 2 * height_px, 2 * height_px);
  picture(corner & cv::Rect({}, picture.size())).setTo(cv::Scalar::all(255));
  write_text(picture, name, {height_px, height_px}, height_px);
  return picture;
}

std::vector<LegendEntry> legend_of(const std::set<ClassId>& shown, const ClassTable& table) {
  std::vector<LegendEntry> legend;
  for (const ClassId id : shown)
    if (id != kBackground) legend.push_back({table.classes[id].colour, table.classes[id].name});
  return legend;
}

}  // namespace

cv::Mat3b label_errors(const LabelFolder& labels, const std::vector<int>& frames) {
  CaptionedColumn color{"colour", {}, {}}, truth{"true classes", {}, {}},
      labelled{"labels", {}, {}};
  CaptionedColumn errors{
      "errors",
      {},
      {{kMissedColour, "missed"}, {kLeakColour, "false"}, {kMislabelledColour, "mislabelled"}}};
  std::set<ClassId> shown;
  for (const int index : frames) {
    const LabelledFrame frame = read_frame(labels, index);
    shown.insert(frame.truth.begin(), frame.truth.end());
    shown.insert(frame.labelled.begin(), frame.labelled.end());
    color.pictures.push_back(numbered_picture(frame));
    truth.pictures.push_back(classes_picture(frame.color, frame.truth, labels.table));
    labelled.pictures.push_back(classes_picture(frame.color, frame.labelled, labels.table));
    errors.pictures.push_back(errors_picture(frame));
  }
  truth.legend = legend_of(shown, labels.table);
  return in_columns({color, truth, labelled, errors}, kLabelColumn_px);
}

}  // namespace mapscore::eval
