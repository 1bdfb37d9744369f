// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/frame.hpp"
#include "eval/foreign/label_classes.hpp"
#include "eval/recording/stamp_list.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// How a folder in the layout of the TUM RGB-D benchmark is to be read.
struct LabelledFolderOptions {
  std::string cameras;  ///< as read_cameras; empty: recording.yaml's
  std::string classes;  ///< file of read_label_classes; empty: recording.yaml's
  ClassMasks masks = ClassMasks::components;
  double depth_units_per_m = kDepthUnitsPerMetre;
  std::optional<std::pair<double, double>> range_m;  ///< least and most depth; none: the cameras'
  double max_offset_s = 0.02;    ///< stamps farther apart do not belong together
  bool follow = false;           ///< images may lie outside of the folder: links, `..`
  double max_pose_gap_s = 0.25;  ///< poses are interpolated between lines at most this far apart
  bool poses = true;             ///< read groundtruth.txt; else `place` gives the poses
};

/// Frames that a folder holds, and why the others are left out.
struct LabelledFolderCounts {
  int labels = 0;  ///< label images listed
  int no_depth = 0, no_pose = 0;
};

/// A folder of label images, depth images and poses from any source, read for mapping
/// (docs/foreign_recordings.md). Needs neither truth nor recording.yaml. Safe to share between
/// threads.
class LabelledFolder {
 public:
  /// Reads cameras, classes, lists and trajectory and associates them. Throws Error with file and
  /// mend, also where no frame is left.
  LabelledFolder(const std::filesystem::path& folder, const LabelledFolderOptions& options);

  [[nodiscard]] int frame_count() const { return static_cast<int>(frames_.size()); }
  /// Label and depth images, wherever they lie.
  [[nodiscard]] std::vector<std::filesystem::path> image_files() const;
  [[nodiscard]] const LabelledFolderCounts& counts() const { return counts_; }
  [[nodiscard]] const Calibration& calibration() const { return calibration_; }
  /// Classes; the instances of a frame come with it.
  [[nodiscard]] const ClassTable& table() const { return classes_.table; }
  /// Replaces the table's classes, to change which are detected; nothing else of them may differ.
  void detect_as(const std::vector<SemanticClass>& classes) { classes_.table.classes = classes; }
  [[nodiscard]] double stamp_s(int index) const { return at(index).depth.stamp_s; }
  [[nodiscard]] const Pose& T_world_base(int index) const { return at(index).T_world_base; }
  /// What is added to the stamps of label images before they are paired (BelievedCameras).
  [[nodiscard]] double time_offset_s() const { return time_offset_s_; }
  /// How long after its depth image a frame's labels were seen, by the stamps so corrected.
  [[nodiscard]] double lag_s(int index) const { return at(index).lag_s; }
  /// Velocity of the depth camera in its own optical frame at the frame's depth stamp, order x y z
  /// roll pitch yaw (m/s, rad/s), of the poses of groundtruth.txt around it; nothing where there
  /// are none, or they are too far apart.
  [[nodiscard]] std::optional<Vector6> motion(int index) const;

  /// Gives the frames of a folder that is read without poses theirs; those that the trajectory does
  /// not reach are left out. Throws Error where none is left.
  void place(const std::vector<TrajectoryPose>& trajectory);

  /// All depth images of the folder by their stamps, which ascend, also those without labels.
  [[nodiscard]] const std::vector<StampedImage>& depth_images() const { return depth_; }
  /// One of them, in 1/5000 m. Throws Error where it is missing, damaged or of another size.
  [[nodiscard]] cv::Mat1w read_depth(const StampedImage& image) const;

  /// A frame with label and depth (in 1/5000 m); instances of the frame go to `table`. Throws Error
  /// where an image is damaged or of another size.
  [[nodiscard]] Frame read(int index, ClassTable& table) const;

 private:
  struct LabelledDepth {
    std::string label;
    StampedImage depth;
    double lag_s = 0;
    Pose T_world_base;
  };
  [[nodiscard]] const LabelledDepth& at(int index) const {
    return frames_.at(static_cast<std::size_t>(index));
  }
  void read_meaning();
  [[nodiscard]] std::vector<StampedImage> label_images() const;
  [[nodiscard]] std::optional<Pose> pose_near(const std::vector<TrajectoryPose>& trajectory,
                                              double stamp_s) const;
  void pair_frames();
  void check_images() const;
  void size_cameras();
  void check_cameras() const;

  std::filesystem::path folder_;
  LabelledFolderOptions options_;
  Calibration calibration_;
  double time_offset_s_ = 0;
  std::vector<TrajectoryPose> trajectory_;
  LabelClasses classes_;
  std::vector<StampedImage> depth_;
  std::vector<LabelledDepth> frames_;
  LabelledFolderCounts counts_;
};

}  // namespace mapscore::eval
