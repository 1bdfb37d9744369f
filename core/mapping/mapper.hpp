// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/fusion/fusion_rule.hpp"
#include "core/mapping/mapped_frames.hpp"
#include "core/mapping/semantic_map.hpp"
#include "core/placement/placement.hpp"
#include "core/placement/pose_belief.hpp"
#include "core/random_stream.hpp"
#include "core/segmentation/segmentation.hpp"
#include "core/space/occupancy.hpp"

#include <opencv2/core.hpp>

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace mapscore {

/// How an observation reaches the map's lattice: its points moved by the pose, or its voxels'
/// centres.
enum class Place { points, voxels };
constexpr auto names_of(Place) {
  return std::to_array<std::string_view>({"points", "voxels"});
}

/// How a map is made of what a robot sees.
struct Mapping {
  double voxel_m = 0.05;
  Segmentation segmentation{};
  Place place = Place::points;
  Fusion fusion{};
  Carving occupancy{};
  MappedFrames frames{};
};

/// Processor time that a method spent on one frame, in seconds. Measured, so not the same twice.
struct FrameTimes {
  double segmentation_s = 0.0;  ///< registration, where a segmentation reads a point, and all
                                ///< detections
  double mapping_s = 0.0;       ///< drawing poses, placing, carving, fusing

  [[nodiscard]] double total_s() const { return segmentation_s + mapping_s; }
};

/// Makes a semantic map of frames. Used by one thread at a time.
class Mapper {
 public:
  /// `class_count`: size of the class table. `told`: what a first look at the frames told of the
  /// believed calibration; unless that is closed, frames learn from those before them. Throws Error
  /// when a parameter is out of range.
  Mapper(const Mapping& mapping, std::size_t class_count, CalibrationEvidence told = {});

  /// Whether a frame is one that this map is made of (FrameChoice). Ask once a frame, in their
  /// order; the others are not to be integrated. Throws Error as FrameChoice.
  [[nodiscard]] bool takes(const Sight& sight, const PoseBelief& belief);

  /// Takes one frame into the map: segments its detections, places the segments by draws from the
  /// belief, carves free space and lets voxels in view decay where the map does so, and fuses
  /// [M, section 3]. `stream`: of the draws. Gives the segments. Throws Error as the steps do.
  std::vector<Segment> integrate(const Sight& sight, const PoseBelief& belief,
                                 RandomStream& stream);

  /// integrate() from placing on, for an observation that was made elsewhere. `seen` gives the
  /// believed cameras and the depth image.
  void fuse(const Observation& observation, const Sight& seen, const PoseBelief& belief,
            RandomStream& stream);

  /// Adds the colours of the registered pixels (masks and centres of boxes, docs/refinement.md) to
  /// the map, for a refinement that reads them. `bgr`: image of the colour camera.
  void add_colours(const Sight& sight, const cv::Mat3b& bgr, const PoseBelief& belief);

  [[nodiscard]] const SemanticMap& map() const { return map_; }
  [[nodiscard]] SemanticMap& map() { return map_; }
  /// Processor time of the last frame.
  [[nodiscard]] const FrameTimes& times() const { return times_; }

 private:
  Mapping mapping_;
  std::size_t class_count_;
  SemanticMap map_;
  FrameChoice choice_;
  CalibrationEvidence told_;
  FrameTimes times_;
};

/// T_map_depth at the mean of the belief.
[[nodiscard]] Pose mean_sensor_pose(const PoseBelief& belief, const Calibration& believed);

}  // namespace mapscore
