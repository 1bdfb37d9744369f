// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/foreign/label_classes.hpp"
#include "eval/foreign/score_rows.hpp"
#include "eval/recording/recording.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Where a network's label images of a recording lie, and how they are read
/// (docs/foreign_recordings.md).
struct NetworkImages {
  std::filesystem::path folder, classes;
  ClassMasks masks = ClassMasks::components;
  std::optional<std::filesystem::path> scores = {};  ///< none: every score is 1
  /// Folder of images of the same names: how sure the network was of each pixel, in thousandths.
  std::optional<std::filesystem::path> confidence = {};

  auto operator<=>(const NetworkImages&) const = default;
};

/// Names and hashes of all that a network's detections are read from: the images of the folder with
/// their list, if there is one, the classes, the scores and the confidence. Throws Error where one
/// is missing, or the folder holds no image.
[[nodiscard]] std::string content_of(const NetworkImages& images);

/// Classes of the recording's `table` by pixel value, as a file names them for images that are cut
/// by `masks`; what is not detected by the file is background. Throws Error where it names a class
/// that the table lacks.
[[nodiscard]] std::vector<ClassId> classes_of_values(const LabelClasses& classes,
                                                     const std::filesystem::path& file,
                                                     ClassMasks masks, const ClassTable& table);

/// What a network found in one colour image.
struct NetworkDetections {
  cv::Mat1w instances;         ///< ids of the table, colour camera
  ClassTable table;            ///< the recording's, with this image's detections as instances
  std::vector<double> scores;  ///< by instance id
};

/// What a network says of each pixel of an image.
struct PixelVerdicts {
  cv::Mat1w classes;      ///< of the recording, detected or not
  cv::Mat1w thousandths;  ///< how sure it is of them, 0 to 1000
};

/// Label images of a network in place of a recording's own. Immutable, safe to share between
/// threads; the recording must outlive it.
class NetworkLabels {
 public:
  /// `table`: the recording's with the study's detected set. Reads classes, scores and lists, not
  /// the images. Throws Error, with file and mend, where one is refused or a frame has no image.
  NetworkLabels(const NetworkImages& images, const Recording& recording, const ClassTable& table);

  /// Of a frame. Throws Error where the image is missing, damaged, in colour or of another size.
  [[nodiscard]] NetworkDetections of(int frame) const;

  /// How sure the network was of each pixel of a frame; none without `confidence`. Throws Error as
  /// `of`, and where a value is above 1000.
  [[nodiscard]] std::optional<PixelVerdicts> verdicts_of(int frame) const;

  /// Reads every image. Throws Error as `of`, where more than a hundredth of all pixels have values
  /// without a meaning, where none is of a detected class, and where there are scores, but none of
  /// a value in its image.
  void check() const;

 private:
  [[nodiscard]] cv::Mat1w read(int frame) const;
  [[nodiscard]] cv::Mat1w read_confidence(int frame) const;
  void take_meaning(const ClassTable& table);

  NetworkImages images_;
  ClassTable table_;
  cv::Size size_;
  std::vector<std::filesystem::path> files_;  ///< by frame
  std::vector<ClassId> class_of_value_;       ///< of the recording, by pixel value
  std::vector<bool> known_;                   ///< values that the classes' file names, and 0
  std::vector<FrameScores> scores_;           ///< by frame
};

}  // namespace mapscore::eval
