// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/frame.hpp"
#include "core/geometry/shape.hpp"
#include "eval/recording/recording.hpp"
#include "eval/recording/scan_file.hpp"
#include "eval/recording/shape_poses.hpp"

#include <filesystem>
#include <memory>
#include <vector>

namespace mapscore::eval {

/// Writes a recording aside (FOLDER.partial) and renames it in `finish`; without `finish` the
/// destructor removes what was written, so that nothing half-written is ever taken for whole.
class RecordingWriter {
 public:
  RecordingWriter(const std::filesystem::path& folder, RecordingInfo info);
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Encodes and writes a colour image and its labels, or a depth image and its labels, with the
  /// pose of base_footprint at its stamp. Images of a side are numbered from 0. Safe to call from
  /// several threads, in any order.
  void write_color(const Frame& frame);
  void write_depth(const Frame& frame);
  /// `poses`: where those of `shapes` that move were at each depth image; written, even if nothing
  /// moved, where the recording has a motion.
  void write_shapes(const std::vector<Shape>& shapes, const ShapePoses& poses = {});
  /// Writes odometry.txt, or the lidar's turns, and announces them in recording.yaml.
  void write_odometry(const std::vector<OdometryPose>& poses);
  void write_scans(const ScanLog& scans);
  /// True poses between those of the images: further lines of groundtruth.txt.
  void add_poses(const std::vector<TrajectoryPose>& poses);
  /// Writes lists, trajectory and recording.yaml; checks that every frame 0..n-1 was written;
  /// renames.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mapscore::eval
