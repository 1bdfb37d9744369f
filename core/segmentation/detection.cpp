// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/detection.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

namespace mapscore {
namespace {

/// The first column from `u` on whose value is not that of `u`. Looks at four at a time.
int end_of_run(const std::uint16_t* row, int u, int columns) {
  const std::uint64_t four = row[u] * 0x0001000100010001ULL;
  const int first = u;
  for (std::uint64_t next = 0; u + 4 <= columns; u += 4) {
    std::memcpy(&next, row + u, sizeof next);
    if (next != four) break;
  }
  while (u < columns && row[u] == row[first]) ++u;
  return u;
}

/// Tight box of every instance id that occurs, indexed by id; empty boxes have u_max < u_min.
std::vector<PixelBox> boxes_of(const cv::Mat1w& label, std::size_t instance_count) {
  constexpr int kBeyond = 1 << 30;
  std::vector<PixelBox> boxes(instance_count, PixelBox{kBeyond, kBeyond, -1, -1});
  for (int v = 0; v < label.rows; ++v) {
    const std::uint16_t* row = label[v];
    for (int u = 0; u < label.cols;) {
      const std::uint16_t id = row[u];
      const int first = u;
      u = end_of_run(row, u, label.cols);
      if (id == 0 || id >= instance_count) continue;
      PixelBox& box = boxes[id];
      box = {std::min(box.u_min, first), std::min(box.v_min, v), std::max(box.u_max, u - 1), v};
    }
  }
  return boxes;
}

/// Throws Error unless ids are positions and every class exists.
void check(const ClassTable& table) {
  for (std::size_t id = 0; id < table.classes.size(); ++id)
    if (table.classes[id].id != id)
      throw Error("class table: class " + table.classes[id].name + " has id " +
                  std::to_string(table.classes[id].id) + " at position " + std::to_string(id) +
                  "; number classes by their position, 0 is background");
  for (std::size_t id = 0; id < table.instances.size(); ++id) {
    const Instance& instance = table.instances[id];
    if (instance.id != id)
      throw Error("class table: instance " + instance.name + " has id " +
                  std::to_string(instance.id) + " at position " + std::to_string(id) +
                  "; number instances by their position, 0 is background");
    if (instance.class_id >= table.classes.size())
      throw Error("class table: instance " + instance.name + " is of class " +
                  std::to_string(instance.class_id) + ", beyond the last, " +
                  std::to_string(table.classes.size() - 1) + "; add the class to the table");
  }
}

std::string size_of(int width_px, int height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px);
}

}  // namespace

void check(const Detection& detection, int width_px, int height_px) {
  const PixelBox& box = detection.box;
  const cv::Mat1b& mask = detection.mask;
  if (box.u_min < 0 || box.v_min < 0 || box.u_max >= width_px || box.v_max >= height_px)
    throw Error("detection: its box reaches beyond the colour camera's " +
                size_of(width_px, height_px) +
                " pixels; detect in images of the colour camera's size");
  if (mask.cols != box.width() || mask.rows != box.height())
    throw Error("detection: its mask has " + size_of(mask.cols, mask.rows) +
                " pixels, its box has " + size_of(box.width(), box.height()) +
                "; cut the mask to the box");
  const cv::Size image = detection.image_px;
  if (image != cv::Size{} && image != cv::Size(width_px, height_px))
    throw Error("detection: its label image has " + size_of(image.width, image.height) +
                " pixels, the colour camera " + size_of(width_px, height_px) +
                "; give the intrinsics it was taken with");
}

std::vector<Detection> detections_of(const cv::Mat1w& label, const ClassTable& table) {
  check(table);
  std::vector<Detection> detections;
  const std::vector<PixelBox> boxes = boxes_of(label, table.instances.size());
  for (const Instance& instance : table.instances) {
    const PixelBox& box = boxes[instance.id];
    if (!table.detected(instance.class_id) || box.u_max < box.u_min) continue;
    const cv::Mat1b mask = label(box.rect()) == instance.id;
    detections.push_back({instance.class_id, instance.id, 1.0, box, mask, label.size()});
  }
  return detections;
}

cv::Mat1b pixels_wanted(const std::vector<Detection>& detections, int width_px, int height_px) {
  cv::Mat1b wanted(height_px, width_px, std::uint8_t{0});
  for (const Detection& detection : detections) {
    check(detection, width_px, height_px);
    const PixelBox& box = detection.box;
    cv::Mat1b region = wanted(box.rect());
    region |= detection.mask;
    wanted((box.v_min + box.v_max) / 2, (box.u_min + box.u_max) / 2) = 255;
  }
  return wanted;
}

}  // namespace mapscore
