// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/trial_writer.hpp"

#include "core/error.hpp"
#include "eval/foreign/id_layers.hpp"
#include "eval/foreign/trial_sheet.hpp"
#include "eval/lab/map_frame.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "sim/faults/lidar_noise.hpp"

#include <fmt/format.h>

#include <set>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

TrialSheet sheet_of(const GivenTrial& given) {
  const Study& config = given.task.config;
  const RecordingInfo& info = given.recording.info();
  const MapFrame lattice = map_frame(config, given.task.seed_index);
  TrialSheet sheet;
  sheet.study = config.name;
  sheet.method = config.methods.front().name;
  sheet.seed_index = given.task.seed_index;
  sheet.draw_seed = trial_seed(given.task);
  sheet.believed = given.sights.believed();
  sheet.color_rate_hz = info.color_rate_hz;
  sheet.depth_rate_hz = info.depth_rate_hz;
  sheet.voxel_m = lattice.edge_m;
  sheet.map_origin_m = lattice.origin_m;
  sheet.map_yaw_deg = config.map_yaw_deg;
  sheet.classes = given.sights.table().classes;
  for (int index = 0; index < given.recording.frame_count(); ++index)
    sheet.frames.push_back(
        {index, given.recording.color_stamp_s(index), given.recording.color_path(index),
         given.recording.depth_path(given.sights.depth_of(index)),
         given.recording.label_path(index), given.beliefs.at(static_cast<std::size_t>(index))});
  return sheet;
}

/// What the ids of the recording's own label images mean, in every frame.
std::vector<TrialDetection> meanings_of(const ClassTable& table) {
  std::vector<TrialDetection> meanings;
  for (const Instance& instance : table.instances)
    if (table.detected(instance.class_id))
      meanings.push_back({{}, 0, instance.id, instance.class_id, 1.0});
  return meanings;
}

/// Puts the images of a trial into its folder.
class Images {
 public:
  Images(const GivenTrial& given, const fs::path& folder) : given_(given), folder_(folder) {}

  void write(TrialSheet& sheet) {
    const Sights& sights = given_.sights;
    const bool keeps_meanings = sights.keeps_labels() && sights.keeps_verdicts();
    if (keeps_meanings) sheet.detections = meanings_of(sights.table());
    for (const TrialFrame& frame : sheet.frames) {
      link(frame.color);
      if (sights.keeps_depth()) link(frame.depth);
      if (sights.keeps_labels()) link(frame.label);
      if (sights.keeps_depth() && keeps_meanings) continue;
      const Sight sight = sights.of(*given_.frame(frame.index, sights.depth_of(frame.index)));
      if (!sights.keeps_depth()) write_image(frame.depth, sight.depth());
      if (!keeps_meanings) write_detections(frame, sight, sheet.detections);
    }
  }

 private:
  /// A place is taken once, and its folder made.
  [[nodiscard]] bool takes(const std::string& path) {
    if (!taken_.insert(path).second) return false;
    if (folders_.insert(fs::path(path).parent_path()).second)
      make_folder((folder_ / path).parent_path());
    return true;
  }
  void link(const std::string& path) {
    if (takes(path)) link_or_copy(given_.images / path, folder_ / path);
  }
  void write_image(const std::string& path, const cv::Mat1w& image) {
    if (takes(path)) write_file(folder_ / path, encode_png(image));
  }

  void write_detections(const TrialFrame& frame, const Sight& sight,
                        std::vector<TrialDetection>& rows) {
    const CameraModel& camera = sight.believed().color;
    const IdLayers layers = id_layers(sight.detections(), {camera.width_px, camera.height_px});
    if (!given_.sights.keeps_labels())
      for (std::size_t n = 0; n < layers.images.size(); ++n)
        write_image(layer_path(frame.label, static_cast<int>(n)), layers.images[n]);
    for (TrialDetection row : layers.meanings) {
      row.frame = frame.index;
      rows.push_back(row);
    }
  }

  const GivenTrial& given_;
  const fs::path& folder_;
  std::set<std::string> taken_;
  std::set<fs::path> folders_;
};

/// The lidar's turns as the trial's localisation has them.
ScanLog noisy_scans(const GivenTrial& given, ScanLog scans) {
  const sim::LidarNoise noise = given.task.config.faults.lidar.dose();
  for (std::size_t n = 0; n < scans.scans.size(); ++n)
    sim::add_lidar_noise(noise, trial_seed(given.task), n, scans.scans[n].ranges_m);
  return scans;
}

void write_logs(const GivenTrial& given, const fs::path& folder) {
  const Recording& recording = given.recording;
  if (recording.has_odometry()) link_or_copy(given.images / kOdometryFile, folder / kOdometryFile);
  if (!recording.has_scans()) return;
  make_folder((folder / kScanFile).parent_path());
  const ScanLog exact = recording.read_scans();
  const std::string bytes = scan_log_bytes(noisy_scans(given, exact));
  if (bytes == scan_log_bytes(exact))
    link_or_copy(given.images / kScanFile, folder / kScanFile);
  else
    write_file(folder / kScanFile, bytes);
}

}  // namespace

void write_trial(const GivenTrial& given, const fs::path& folder) {
  if (given.task.config.score.unit == ScoreUnit::frame)
    throw Error(
        "score.unit: frame scores each frame by itself, but a trial folder becomes one map; --set "
        "score.unit=map");
  TrialSheet sheet = sheet_of(given);
  Images(given, folder).write(sheet);
  write_logs(given, folder);
  write_sheet(sheet, folder);
  write_file(folder / "method.yaml", method_yaml(given.task.config));
}

}  // namespace mapscore::eval
