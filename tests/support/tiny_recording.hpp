// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/frame.hpp"
#include "core/geometry/shape.hpp"
#include "eval/recording/recording.hpp"
#include "eval/recording/recording_writer.hpp"

#include <filesystem>
#include <vector>

namespace mapscore::testing {

/// A recording small enough to reason about: a crate (box, class 1, detected, instance 1) 1.3 m
/// before a wall (finite plane, class 2, not detected, instance 2); past the wall's edges there is
/// nothing. Four frames of 64x48 at 2 Hz, depth camera 2.5 cm beside the colour camera, exact
/// ray-cast images.

[[nodiscard]] eval::RecordingInfo tiny_info();
[[nodiscard]] std::vector<Frame> tiny_frames();
/// Crate and wall in the world frame, in this order.
[[nodiscard]] std::vector<Shape> tiny_shapes();
/// Writes both sides of a frame, at one stamp, both numbered `frame.index`.
void write_frame(eval::RecordingWriter& writer, const Frame& frame);
/// Writes the recording to `folder`, which must not exist.
void write_tiny_recording(const std::filesystem::path& folder);

/// What a camera with pose T_world_camera sees of boxes and planes: nearest surface through each
/// pixel centre. `depth` is planar z in 1/5000 m, 0 outside [range_min_m, range_max_m]; `label` the
/// instance, 0 where no surface is hit, whatever the range.
struct RayCast {
  cv::Mat1w depth, label;
};
[[nodiscard]] RayCast ray_cast(const std::vector<Shape>& shapes, const CameraModel& camera,
                               const Pose& T_world_camera, double range_min_m, double range_max_m);

/// A folder of its own under the system's temporary folder, removed with all it holds by the
/// destructor.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace mapscore::testing
