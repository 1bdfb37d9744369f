// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/mapping/mapped_frames.hpp"
#include "core/objects/object_map.hpp"
#include "core/placement/pose_belief.hpp"
#include "core/segmentation/segmentation.hpp"
#include "eval/lab/map_frame.hpp"
#include "eval/lab/pose_sources.hpp"
#include "eval/lab/sights.hpp"
#include "eval/objects/object_file.hpp"
#include "eval/objects/true_objects.hpp"

#include <vector>

namespace mapscore::eval {

struct ObjectRunOptions {
  ObjectMapParams map;
  int min_points = 20;    ///< of a detection's largest piece, that becomes a box
  double piece_m = 0.05;  ///< cells of the lattice that tells pieces apart (solid_piece.hpp)
};

/// What a frame's segments say of objects: of each, the box about its largest solid piece, along
/// the map's axes. T_map_depth: where the depth camera is believed to be.
[[nodiscard]] std::vector<ObjectDetection> object_detections(const std::vector<Segment>& segments,
                                                             const Pose& T_map_depth,
                                                             const ObjectRunOptions& options);

/// One object map under way over the frames of a recording: what TrialRun does for voxels, under
/// the same faults. Used by one thread at a time; `recording` and `table` must outlive it.
class ObjectRun {
 public:
  /// Throws Error as PoseSources and Sights.
  ObjectRun(const Task& task, const Recording& recording, const ClassTable& table,
            PoseSources& poses, const ObjectRunOptions& options);

  /// Objects known before the first frame, wherever their map frame lies. Throws Error as
  /// ObjectMap::add.
  void start_from(const ObjectFile& known);

  /// The depth image that a frame is paired with under the task's time offset.
  [[nodiscard]] int depth_of(int frame) const { return sights_.depth_of(frame); }

  /// Register, segment, put boxes about what was kept, and take them into the map. It is read with
  /// the depth image that `depth_of` names, and with depth_label where it is to be scored.
  ObjectChanges advance(const Frame& frame);

  [[nodiscard]] const Sights& sights() const { return sights_; }
  [[nodiscard]] const ObjectMap& map() const { return map_; }
  [[nodiscard]] ObjectFile file() const;
  /// True objects of the detected classes that were visible in the frames so far. Boxes bound all
  /// of their surface at the end of the recording or, with `seen`, the samples of these frames.
  /// Throws Error when the recording has no truth.
  [[nodiscard]] std::vector<TrueObject> truth(bool seen) const;

 private:
  const Recording& recording_;
  const ClassTable& table_;
  Sights sights_;
  std::vector<PoseBelief> beliefs_;  ///< by frame
  Segmentation segmentation_;
  FrameChoice choice_;
  CalibrationEvidence told_;
  MapFrame map_frame_;
  ObjectRunOptions options_;
  ObjectMap map_;
  SeenInstances seen_;
};

}  // namespace mapscore::eval
