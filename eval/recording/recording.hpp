// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/frame.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/shape.hpp"
#include "eval/recording/shape_poses.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Version of the folder layout; a reader refuses any other.
inline constexpr int kRecordingFormat = 1;

/// What recording.yaml holds: everything about a recording but its frames and surfaces.
struct RecordingInfo {
  Calibration calibration;  ///< the true one, which rendered the images
  double color_rate_hz = 0, depth_rate_hz = 0;
  ClassTable table;
  std::string scene;           ///< file name of the scene
  std::string scene_hash;      ///< content hash of scene, class file and robot
  std::string mujoco_version;  ///< empty when made elsewhere
  std::string motion;          ///< file name of the scene's motion; empty where nothing moves
  std::string motion_hash;     ///< hash of its bytes
  std::uint64_t seed = 0;
  int frame_count = 0;
  bool has_truth =
      true;  ///< truth/ and depth_label/ are there; without, maps can be made but not scored
};

/// Which images `Recording::read` decodes.
struct Channels {
  bool color = false, label = true, depth = true, depth_label = false;
};

/// A recording on disk, opened for reading; the format is described in docs/formats.md. All members
/// are safe to call from several threads. Throws Error naming the file and the reason.
class Recording {
 public:
  /// Reads recording.yaml, the stamp lists and the trajectory; checks version, counts, order of
  /// stamps and that every listed image is there. Images are decoded only by `read`.
  [[nodiscard]] static Recording open(const std::filesystem::path& folder);

  [[nodiscard]] const RecordingInfo& info() const { return info_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] int frame_count() const { return info_.frame_count; }
  /// Hash over recording.yaml, lists, poses, surfaces and every image file's bytes.
  [[nodiscard]] const std::string& content_hash() const { return content_hash_; }

  /// True pose of base_footprint at the depth stamp of a frame.
  [[nodiscard]] const Pose& T_world_base(int index) const {
    return entries_.at(static_cast<std::size_t>(index)).T_world_base;
  }

  /// Stamp of the depth image of a frame.
  [[nodiscard]] double depth_stamp_s(int index) const {
    return entries_.at(static_cast<std::size_t>(index)).depth_stamp_s;
  }

  [[nodiscard]] Frame read(int index, Channels channels = {}) const;
  /// Exact drawn surfaces in the world frame, background included (instance 0).
  /// Those that move stand where they were before they did; see read_poses.
  [[nodiscard]] std::vector<Shape> read_shapes() const;
  /// Where the moving ones of read_shapes were at each depth image; empty where nothing moves.
  [[nodiscard]] ShapePoses read_poses() const;

 private:
  std::filesystem::path folder_;
  RecordingInfo info_;
  std::string content_hash_;
  struct Entry {
    double color_stamp_s, depth_stamp_s;
    std::string color, label, depth, depth_label;  ///< relative paths
    Pose T_world_base;
  };
  std::vector<Entry> entries_;
};

/// Writes a recording aside (FOLDER.partial) and renames it in `finish`; without `finish` the
/// destructor removes what was written, so that nothing half-written is ever taken for whole.
class RecordingWriter {
 public:
  RecordingWriter(const std::filesystem::path& folder, RecordingInfo info);
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Encodes and writes the images of one frame. Safe to call from several threads, in any order.
  void write(const Frame& frame);
  /// `poses`: where those of `shapes` that move were at each depth image; written, even if nothing
  /// moved, where the recording has a motion.
  void write_shapes(const std::vector<Shape>& shapes, const ShapePoses& poses = {});
  /// Writes lists, trajectory and recording.yaml; checks that every frame 0..n-1 was written;
  /// renames.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mapscore::eval
