// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/sights.hpp"

#include "core/calibration/calibrator.hpp"
#include "core/error.hpp"
#include "core/objects/simulated_perception.hpp"
#include "core/segmentation/registered_cloud.hpp"
#include "eval/lab/recorded_surfaces.hpp"
#include "eval/objects/object_file.hpp"
#include "eval/objects/true_objects.hpp"
#include "eval/recording/frame_selection.hpp"
#include "eval/results/input_files.hpp"
#include "sim/faults/calibration_faults.hpp"
#include "sim/faults/depth_noise.hpp"
#include "sim/faults/label_noise.hpp"

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <variant>

namespace mapscore::eval {
namespace {

constexpr int kMostLooks = 64;  // at frames that may show nothing

/// The objects of a file, each an instance beyond those of the table; in the scene's world.
std::vector<PerceivedModel> models_of_file(const std::filesystem::path& path, ClassTable& table) {
  const ObjectFile file = read_objects(path, table);
  const Pose T_world_map = file.T_world_map();
  std::vector<PerceivedModel> models;
  for (const MapObject& object : file.objects) {
    const std::size_t id = table.instances.size();
    if (id > std::numeric_limits<InstanceId>::max())
      throw Error(fmt::format("{}: more objects than label images can tell apart; remove some",
                              path.string()));
    const auto instance = static_cast<InstanceId>(id);
    table.instances.push_back({instance, fmt::format("object_{}", object.id), object.class_id});
    if (table.detected(object.class_id))
      models.push_back({instance, {moved(T_world_map, object.box)}});
  }
  return models;
}

/// The truth of a recording, which simulated perception then knows.
RecordedShapes true_shapes(const Recording& recording) {
  if (recording.info().has_truth) return shapes_of(recording);
  throw Error(recording.folder().string() +
              ": has no truth to simulate perception of; name an object map as "
              "perception.simulated.objects");
}

/// The depth image of every frame under the time offset.
std::vector<int> paired_depth(const Recording& recording, const Study& config) {
  std::vector<int> depth;
  for (int frame = 0; frame < recording.frame_count(); ++frame)
    depth.push_back(recording.depth_of(frame, config.faults.time_offset_ms / 1000.0));
  return depth;
}

}  // namespace

/// The label images of simulated perception in place of a recording's: a sensor without faults,
/// which knows the true pose and calibration and votes with the noise-free depth image. Immutable,
/// safe to share between threads.
class Sights::SimulatedLabels {
 public:
  /// `shapes()`: the scene's surfaces, asked for where no file names the objects. Throws Error when
  /// the file of the objects is refused or holds too many.
  SimulatedLabels(const SimulatedPerception& settings, const Study& config,
                  const Calibration& calibration, const ClassTable& table,
                  const std::function<RecordedShapes()>& shapes)
      : settings_(settings), calibration_(calibration), table_(table) {
    if (settings.objects) {
      models_ = models_of_file(resolve_path(config, *settings.objects), table_);
      return;
    }
    shapes_ = shapes();
    if (!shapes_.poses.empty()) return;
    models_ = models_of(shapes_.shapes, Pose::Identity(), table_,
                        settings_.boxes == PerceivedBoxes::surfaces);
    shapes_ = {};
  }

  /// The recording's table; where a file is given, with its objects as further instances.
  [[nodiscard]] const ClassTable& table() const { return table_; }
  /// Instance ids per colour pixel. Reads the frame's `depth`, stamp and pose.
  [[nodiscard]] cv::Mat1w of(const Frame& frame) const {
    const PosedDepth view{calibration_.depth, frame.T_world_base * calibration_.T_base_depth,
                          calibration_.range_min_m, calibration_.range_max_m, frame.depth};
    const cv::Mat1w seen =
        perceive(models_at(frame.stamp_s), view, settings_.tolerance_m, settings_.min_pixels);
    return labels_in_color(seen, register_depth(frame.depth, calibration_));
  }

 private:
  [[nodiscard]] std::vector<PerceivedModel> models_at(double stamp_s) const {
    if (shapes_.poses.empty()) return models_;
    return models_of(shapes_.at(stamp_s), Pose::Identity(), table_,
                     settings_.boxes == PerceivedBoxes::surfaces);
  }

  SimulatedPerception settings_;
  Calibration calibration_;
  ClassTable table_;
  RecordedShapes shapes_;               ///< of the truth, where they move
  std::vector<PerceivedModel> models_;  ///< in the scene's world, where nothing moves
};

std::map<int, Sight> sights_of_objects(const std::vector<int>& frames, int most,
                                       const std::function<Sight(int)>& sight) {
  std::map<int, Sight> sights;
  static_cast<void>(spread_over(frames, most, [&](int frame) {
    Sight seen = sight(frame);
    return !seen.detections().empty() && sights.emplace(frame, std::move(seen)).second;
  }));
  return sights;
}

CalibrationEvidence first_look(const Segmentation& segmentation, const MappedFrames& mapped,
                               const Calibration& believed, const std::vector<int>& frames,
                               const std::function<Sight(int)>& sight) {
  CalibrationEvidence told;
  if (!mends_calibration(segmentation, believed) || std::holds_alternative<KeyFramesAlone>(mapped))
    return told;
  int looks = 0;
  static_cast<void>(spread_over(frames, CalibrationEvidence::kMostFrames, [&](int frame) {
    if (++looks > kMostLooks) return false;
    const Sight seen = sight(frame);
    const auto fit = seen.detections().empty() ? nullptr : fitted(seen, segmentation);
    told.add(fit);
    return fit != nullptr;
  }));
  told.close();
  return told;
}

Calibration believed_calibration(const Calibration& truth, const Task& task) {
  const std::uint64_t seed = trial_seed(task);
  const Calibration misregistered =
      sim::misregister(truth, task.config.faults.misregistration, seed);
  return sim::misplace_mount(misregistered, task.config.faults.mount, seed);
}

Sights::Sights(const Task& task, const Recording& recording, const ClassTable& table,
               Networks* networks)
    : table_(table),
      labels_(task.labels),
      seed_(trial_seed(task)),
      depth_camera_(recording.info().calibration.depth),
      believed_(believed_calibration(recording.info().calibration, task)),
      depth_of_(paired_depth(recording, task.config)),
      faults_(task.config.faults) {
  if (const auto* settings = std::get_if<SimulatedPerception>(&task.config.perception))
    simulated_ = std::make_shared<const SimulatedLabels>(*settings, task.config,
                                                         recording.info().calibration, table,
                                                         [&] { return true_shapes(recording); });
  if (const auto images = network_images(task.config, recording)) {
    const auto read = [&] {
      return std::make_shared<const NetworkLabels>(*images, recording, table);
    };
    network_ = networks ? networks->get(*images, read) : read();
  }
  const auto* estimated = std::get_if<CalibratorSettings>(&task.config.calibration);
  if (estimated != nullptr && labels_ == Labels::detected) calibrate(recording, *estimated);
}

void Sights::calibrate(const Recording& recording, const CalibratorSettings& settings) {
  const auto sight = [&](int index) { return read(recording, index); };
  Calibrator calibrator(believed_, settings);
  for (const auto& [index, seen] :
       sights_of_objects(FrameSelection().of(recording.frame_count()), settings.frames, sight))
    calibrator.add(seen);
  const CalibrationEstimate estimate = calibrator.estimate();
  believed_ = estimate.calibration;
  believed_.is_doubtful = !is_known(estimate.verdict);
  calibration_note_ =
      fmt::format("calibration, estimated: {}{}{}{}", word_of(estimate.verdict),
                  estimate.reason.empty() ? "" : ": ", estimate.reason,
                  is_known(estimate.verdict) ? "" : "; what was believed before is used");
  const Pose error = believed_.T_color_depth * recording.info().calibration.T_color_depth.inverse();
  const double turn_rad = Eigen::AngleAxisd(error.linear()).angle();
  calibrated_ =
      CalibrationCounts{.calibrations = 1,
                        .calibrations_refused = is_known(estimate.verdict) ? 0 : 1,
                        .calibration_error_um = std::llround(1e6 * error.translation().norm()),
                        .calibration_error_urad = std::llround(1e6 * turn_rad)};
}

Sights::Sights(const Task& task, const Calibration& truth, const std::vector<Shape>& shapes,
               const ClassTable& table)
    : table_(table),
      labels_(task.labels),
      seed_(trial_seed(task)),
      depth_camera_(truth.depth),
      believed_(believed_calibration(truth, task)),
      is_live_(true),
      faults_(task.config.faults) {
  if (task.config.faults.time_offset_ms != 0.0)
    throw Error(
        "faults.time_offset_ms: pairs images of a recording, and there is none yet; explore "
        "without it, and replay the recording with it");
  if (!std::holds_alternative<BelievedCalibration>(task.config.calibration))
    throw Error(
        "calibration: is estimated from a recording, and there is none yet; explore with "
        "believed, and replay the recording with estimated");
  const auto* settings = std::get_if<SimulatedPerception>(&task.config.perception);
  if (settings != nullptr)
    simulated_ = std::make_shared<const SimulatedLabels>(*settings, task.config, truth, table, [&] {
      return RecordedShapes{shapes, {}};
    });
  else if (!std::holds_alternative<LabelPerception>(task.config.perception))
    throw Error(
        "perception: networks and their images need a recording, and there is none yet; explore "
        "with labels or simulated, and replay the recording with the network");
}

std::string Sights::key(const Study& config, Labels labels) {
  Study seen;
  seen.seed = config.seed;
  seen.faults = with_canonical_doses(config.faults);
  seen.faults.pose = {};
  seen.faults.lidar = {};
  seen.perception = config.perception;
  seen.calibration = config.calibration;
  return (labels == Labels::truth ? "truth\n" : "detected\n") + to_yaml(seen);
}

CalibrationEvidence Sights::told(const Recording& recording, const Segmentation& segmentation,
                                 const MappedFrames& mapped) const {
  if (labels_ == Labels::truth || !mends_calibration(segmentation, believed_)) return {};
  return told_.get({segmentation, mapped}, [&] {
    return first_look(segmentation, mapped, believed_, FrameSelection().of(recording.frame_count()),
                      [&](int frame) { return read(recording, frame); });
  });
}

const ClassTable& Sights::table() const {
  return simulated_ ? simulated_->table() : table_;
}

std::vector<Detection> Sights::detections_of(const Frame& frame) const {
  const sim::LabelDose dose = faults_.labels.dose();
  if (!network_)
    return sim::corrupt_detections(simulated_ ? simulated_->of(frame) : frame.label, table(), dose,
                                   seed_, frame.index);
  const NetworkDetections found = network_->of(frame.index);
  std::vector<Detection> detections =
      sim::corrupt_detections(found.instances, found.table, dose, seed_, frame.index);
  if (dose.scores == 0.0)
    for (Detection& detection : detections) detection.score = found.scores[detection.instance];
  return detections;
}

bool Sights::keeps_depth() const {
  return sim::is_zero(faults_.depth.dose());
}

bool Sights::keeps_labels() const {
  return !simulated_ && !network_ && sim::keeps_masks(faults_.labels.dose());
}

bool Sights::keeps_verdicts() const {
  return sim::is_zero(faults_.labels.dose());
}

Sight Sights::read(const Recording& recording, int frame) const {
  return of(recording.read(frame, depth_of(frame),
                           {.color = false, .label = true, .depth = true, .depth_label = false}));
}

Sight Sights::of(const Frame& frame) const {
  if (labels_ == Labels::truth) return {believed_, frame.depth, {}};
  return {believed_,
          sim::corrupt_depth(frame.depth, depth_camera_, faults_.depth.dose(), seed_,
                             frame.depth_index),
          detections_of(frame)};
}

}  // namespace mapscore::eval
