// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/camera.hpp"
#include "core/placement/pose_belief.hpp"

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

// The texts of a trial folder (docs/formats.md): trial.yaml, frames.csv, beliefs.csv, poses.txt and
// detections.csv. What they hold comes back to the bit.

/// One colour image and what belongs to it; paths are relative to the folder.
struct TrialFrame {
  int index = 0;         ///< of the colour image in the recording
  double stamp_s = 0.0;  ///< of the colour image
  std::string color, depth, label;
  PoseBelief belief;  ///< T_map_base in the frame of the trial's map
};

/// What an id of a label image means.
struct TrialDetection {
  std::optional<int> frame;  ///< TrialFrame::index; empty: every frame
  int layer = 0;             ///< which of the frame's label images
  InstanceId id = 0;
  ClassId class_id = kBackground;
  double score = 1.0;
  bool operator==(const TrialDetection&) const = default;
};

/// Everything of a trial but its images and its method.
struct TrialSheet {
  std::string study, method;
  int seed_index = 0;
  std::uint64_t draw_seed = 0;  ///< of all random streams of the method
  Calibration believed;
  double color_rate_hz = 0, depth_rate_hz = 0;
  double voxel_m = 0;                                      ///< edge of the lattice that is scored
  Eigen::Vector3d map_origin_m = Eigen::Vector3d::Zero();  ///< of the map frame in the world
  double map_yaw_deg = 0;
  std::vector<SemanticClass> classes;
  std::vector<TrialFrame> frames;          ///< stamps ascend
  std::vector<TrialDetection> detections;  ///< of a frame in the order of its detections
};

/// Path of a layer of a frame's label images, given that of layer 0.
[[nodiscard]] std::string layer_path(const std::string& label, int layer);

/// Writes the files into a folder. Throws Error as write_file.
void write_sheet(const TrialSheet& sheet, const std::filesystem::path& folder);

/// Throws Error with file, line and mend when one is missing, damaged or of another format version,
/// an image lies outside of the folder, or poses.txt says other poses than beliefs.csv.
[[nodiscard]] TrialSheet read_sheet(const std::filesystem::path& folder);

/// Whether a folder is that of a trial.
[[nodiscard]] bool is_trial_folder(const std::filesystem::path& folder);

}  // namespace mapscore::eval
