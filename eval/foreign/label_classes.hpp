// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

#include <opencv2/core.hpp>

#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// How a label image is cut into detections.
enum class ClassMasks {
  components,  ///< one for each connected component (8 neighbours) of a class
  classes,     ///< one for each class
  instances,   ///< one for each pixel value, kInstancesOfLabel * label + instance
};
constexpr auto names_of(ClassMasks) {
  return std::to_array<std::string_view>({"components", "classes", "instances"});
}

/// Pixel values of one label where they hold the instance too, as in KITTI's label images.
inline constexpr int kInstancesOfLabel = 256;

/// What the pixels of a network's label images mean.
struct LabelClasses {
  ClassTable table;                     ///< classes, and instances where pixels are instance ids
  bool has_instances = false;           ///< pixels are instance ids of the table; else class labels
  std::vector<ClassId> class_of_pixel;  ///< of class labels, by label; beyond: background

  /// The class of each value that a pixel can have; background where the file says none.
  [[nodiscard]] std::vector<ClassId> class_of_value(ClassMasks masks) const;
};

/// Reads the file of docs/foreign_recordings.md, for images that are cut by `masks`. Throws Error
/// with file, line and key path.
[[nodiscard]] LabelClasses read_label_classes(const std::filesystem::path& file, ClassMasks masks);

/// An image of instance ids with the table that says their classes.
struct LabelledImage {
  cv::Mat1w instances;
  ClassTable table;
};

/// Turns a label image into one of instances, numbered from the end of the table on, to which they
/// are added: by class, then by the first pixel in row-major order, or by pixel value. Only
/// detected classes become instances. `class_of_value`: of all 65536. Throws Error where there are
/// more instances than ids.
[[nodiscard]] LabelledImage instances_of(const cv::Mat1w& label,
                                         const std::vector<ClassId>& class_of_value,
                                         const ClassTable& table, ClassMasks masks);
/// The same with the classes of a file. Images of instance ids stay as they are.
[[nodiscard]] LabelledImage instances_of(const cv::Mat1w& label, const LabelClasses& classes,
                                         ClassMasks masks);

}  // namespace mapscore::eval
