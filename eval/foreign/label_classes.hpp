// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

#include <opencv2/core.hpp>

#include <filesystem>
#include <vector>

namespace mapscore::eval {

/// How an image of class ids is cut into detections.
enum class ClassMasks {
  components,  ///< one for each connected component (8 neighbours) of a class
  classes,     ///< one for each class
};

/// What the pixels of a network's label images mean.
struct LabelClasses {
  ClassTable table;                     ///< classes, and instances where pixels are instance ids
  bool has_instances = false;           ///< pixels are instance ids of the table; else class labels
  std::vector<ClassId> class_of_pixel;  ///< of class labels, by pixel value; beyond: background
};

/// Reads the file of docs/foreign_recordings.md. Throws Error with file, line and key path.
[[nodiscard]] LabelClasses read_label_classes(const std::filesystem::path& file);

/// An image of instance ids with the table that says their classes.
struct LabelledImage {
  cv::Mat1w instances;
  ClassTable table;
};

/// Turns an image of class labels into one of instances, numbered from 1: by class, then by the
/// first pixel in row-major order. Only detected classes become instances. Throws Error where they
/// are more than 65535. Images of instance ids stay as they are.
[[nodiscard]] LabelledImage instances_of(const cv::Mat1w& label, const LabelClasses& classes,
                                         ClassMasks masks);

}  // namespace mapscore::eval
