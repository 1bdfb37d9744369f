// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/frame.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/shape.hpp"
#include "eval/recording/scan_file.hpp"
#include "eval/recording/shape_poses.hpp"
#include "eval/recording/stamp_list.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace mapscore::eval {

/// Version of the folder layout; a reader refuses any other.
inline constexpr int kRecordingFormat = 1;

/// Faults of depth and labels that the images of a recording hold, drawn as trials of seed index 0
/// draw them: `key: value, ...` of the study's keys, empty where nothing was baked.
struct BakedFaults {
  std::uint64_t seed = 0;  ///< of the study
  std::string depth, labels;

  bool operator==(const BakedFaults&) const = default;
};

/// Where odometry and scans stand below a recording's folder.
inline constexpr const char* kOdometryFile = "odometry.txt";
inline constexpr const char* kScanFile = "scan/scans.bin";

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
  std::optional<BakedFaults> baked;  ///< none: the images are exact
  int frame_count = 0;
  bool has_truth = true;   ///< truth/ and depth_label/ exist; maps can be scored only with them
  int odometry_count = 0;  ///< lines of odometry.txt; 0 where there is none
  int scan_count = 0;      ///< turns of scan/scans.bin; 0 where there is none
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
  /// stamps and that every listed image is there, below the folder. Images are read and held
  /// against hashes.txt only by `read`.
  [[nodiscard]] static Recording open(const std::filesystem::path& folder);

  [[nodiscard]] const RecordingInfo& info() const { return info_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// The folder of results of who opened it, where what is made of its images is kept; empty where
  /// nobody said.
  [[nodiscard]] const std::filesystem::path& results() const { return results_; }
  void keep_in(const std::filesystem::path& results) { results_ = results; }
  /// Colour images, each a frame of every trial.
  [[nodiscard]] int frame_count() const { return info_.frame_count; }
  [[nodiscard]] int depth_count() const { return static_cast<int>(depth_.size()); }
  /// Hash over recording.yaml, lists, poses, surfaces, odometry, scans and every image file's
  /// bytes.
  [[nodiscard]] const std::string& content_hash() const { return content_hash_; }

  /// The depth image that a frame is read with: the nearest to the stamp of its colour image plus
  /// `offset_s`, the earlier of two equally near.
  [[nodiscard]] int depth_of(int index, double offset_s = 0.0) const;

  /// True pose of base_footprint at the stamp of a frame's depth image.
  [[nodiscard]] const Pose& T_world_base(int index) const {
    return T_world_base_of_depth(depth_of(index));
  }
  [[nodiscard]] double depth_stamp_s(int depth_index) const {
    return depth_.at(static_cast<std::size_t>(depth_index)).stamp_s;
  }
  [[nodiscard]] const Pose& T_world_base_of_depth(int depth_index) const {
    return depth_.at(static_cast<std::size_t>(depth_index)).T_world_base;
  }
  /// True pose at the stamp of a colour image, between two lines of groundtruth.txt interpolated.
  /// Throws Error where the trajectory does not reach it.
  [[nodiscard]] Pose T_world_base_of_color(int index) const;
  /// True pose at any stamp, likewise interpolated; nothing before the first and after the last
  /// line.
  [[nodiscard]] std::optional<Pose> T_world_base_at(double stamp_s) const {
    return interpolated(trajectory_, stamp_s);
  }
  [[nodiscard]] double color_stamp_s(int index) const {
    return color_.at(static_cast<std::size_t>(index)).stamp_s;
  }

  /// Paths of images below the folder, of a colour image and a depth image by their index.
  [[nodiscard]] const std::string& color_path(int index) const {
    return color_.at(static_cast<std::size_t>(index)).path;
  }
  [[nodiscard]] std::string label_path(int index) const;
  [[nodiscard]] const std::string& depth_path(int depth_index) const {
    return depth_.at(static_cast<std::size_t>(depth_index)).path;
  }

  /// Bytes of the image at such a path. Throws Error where they are not those that were hashed.
  [[nodiscard]] std::string read_image(const std::string& path) const;

  /// A frame with the depth image that belongs to it.
  [[nodiscard]] Frame read(int index, Channels channels = {}) const {
    return read(index, depth_of(index), channels);
  }
  /// A frame with any depth image.
  [[nodiscard]] Frame read(int index, int depth_index, Channels channels = {}) const;
  /// One side of a frame alone: color and label, or depth, depth_label, stamp and pose.
  void read_color(int index, Channels channels, Frame& frame) const;
  void read_depth(int depth_index, Channels channels, Frame& frame) const;
  /// Exact drawn surfaces in the world frame, background included (instance 0); moving ones at
  /// their place before the motion, see read_poses.
  [[nodiscard]] std::vector<Shape> read_shapes() const;
  /// Where the moving ones of read_shapes were at each depth image; empty where nothing moves.
  [[nodiscard]] ShapePoses read_poses() const;

  [[nodiscard]] bool has_odometry() const { return info_.odometry_count > 0; }
  [[nodiscard]] bool has_scans() const { return info_.scan_count > 0; }
  /// Odometry from the wheels' encoders. Throws Error when the recording has none, or another
  /// number of lines than recording.yaml announces.
  [[nodiscard]] std::vector<OdometryPose> read_odometry() const;
  /// The lidar's turns, without noise. Throws Error likewise.
  [[nodiscard]] ScanLog read_scans() const;

 private:
  struct DepthImage : StampedImage {
    Pose T_world_base;
  };
  void check_frame(int index) const;
  [[nodiscard]] cv::Mat1w read_grey16(const std::string& path, const CameraModel& camera) const;

  std::filesystem::path folder_, results_;
  RecordingInfo info_;
  std::string content_hash_;
  std::unordered_map<std::string, std::string> image_hashes_;  ///< by path
  std::vector<StampedImage> color_;
  std::vector<DepthImage> depth_;
  std::vector<TrajectoryPose> trajectory_;
};

}  // namespace mapscore::eval
