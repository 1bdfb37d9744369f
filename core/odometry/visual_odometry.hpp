// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/localization/odometry_motion.hpp"
#include "core/odometry/depth_scan.hpp"
#include "core/odometry/key_frames.hpp"
#include "core/odometry/key_view.hpp"
#include "core/odometry/local_map.hpp"
#include "core/odometry/loop_closure.hpp"
#include "core/odometry/pose_graph.hpp"
#include "core/parameters.hpp"

#include <opencv2/core.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mapscore {

/// Visual odometry of a depth camera, on a wheeled robot or free.
struct VisualOdometryParams {
  DepthSampling sampling;
  PlaneMapParams map;
  KeyFrameRule key;
  OdometryNoise wheel_noise;         ///< of the wheels' increments, where they are given
  std::optional<LoopClosure> loops;  ///< with them it is visual SLAM
  /// False: the camera is in a hand, or nobody knows, and may move in all six axes alike.
  bool wheeled = true;
};

/// One depth image, in the order of stamps.
struct OdometryFrame {
  double stamp_s = 0.0;
  cv::Mat1w depth;                  ///< planar z in units of 1 / kDepthUnitsPerMetre; 0: none
  std::optional<Pose> T_odom_base;  ///< of the wheels' encoders; without them the robot is expected
                                    ///< to go on as it went
};

/// How a frame's pose came about.
enum class Tracking {
  started,    ///< the first frame with depth, at the pose that was given
  tracked,    ///< by the scan and the motion prior together
  slipped,    ///< the scan contradicts the prior, or fits better elsewhere, or the wheels jump: the
              ///< prior then counts for little
  unsure,     ///< the scan contradicts the prior and fits no better elsewhere: by the prior alone
  beside,     ///< most of what the frame shows is new, as expected: scan and prior
  blind,      ///< hardly any depth: by the prior alone, whose uncertainty adds up
  lost,       ///< what should be seen is not there: by the prior alone, with a jump in uncertainty
  restarted,  ///< lost for some frames, or what it sees contradicts earlier key frames: a new map
              ///< begins, at the uncertain pose
  relocated   ///< the same, and a key frame is found that looks alike: there
};
constexpr auto names_of(Tracking) {
  return std::to_array<std::string_view>({"started", "tracked", "slipped", "unsure", "beside",
                                          "blind", "lost", "restarted", "relocated"});
}

/// What odometry says of a frame.
struct OdometryStep {
  double stamp_s = 0.0;
  Pose T_map_base = Pose::Identity();
  /// Of the error xi, T_true = T_map_base Exp(xi): x y z roll pitch yaw in the axes of
  /// base_footprint.
  Covariance6 covariance = Covariance6::Zero();
  Tracking tracking = Tracking::started;
  double known_share = 0.0, inlier_share = 0.0;  ///< see ScanMatch
  double upright_known_share = 0.0;              ///< see UprightMatch; known_share where it is none
  bool key_frame = false;
  bool closed_loop = false;
};

/// Where a frame lies in the final estimate, after all loops.
struct CorrectedPose {
  double stamp_s = 0.0;
  Pose T_map_base = Pose::Identity();
};

/// Visual odometry and, with loop closure, visual SLAM: each depth image is matched with the planes
/// of the last key frames, the motion prior (the wheels, or a constant velocity) in the sum of
/// information; key frames alone enter the map, since many clouds of a standing robot would break
/// it. Loops are proposed by pose and likeness, verified by matching, and spread over the key
/// frames by a pose graph (docs/odometry.md). Used by one thread at a time; same input, same bytes.
class VisualOdometry {
 public:
  /// `T_map_base_start`: pose at the first frame. Throws Error when a parameter is out of range.
  VisualOdometry(const VisualOdometryParams& params, const Calibration& believed,
                 const Pose& T_map_base_start);

  /// Throws Error when the image is not of the camera's size, or the stamp is not later than the
  /// last one.
  OdometryStep add(const OdometryFrame& frame);

  [[nodiscard]] const std::vector<KeyFrame>& key_frames() const { return keys_; }
  [[nodiscard]] std::size_t loops() const { return loops_; }
  /// All frames so far, moved with their key frames by the loops that were closed since.
  [[nodiscard]] std::vector<CorrectedPose> corrected() const;

 private:
  struct Placed {
    double stamp_s = 0.0;
    std::optional<std::size_t> key;  ///< none before the first key frame: then in the map's axes
    Pose T_key_base = Pose::Identity();
  };
  struct State {
    Pose T_map_base = Pose::Identity();
    Covariance6 relative = Covariance6::Zero();  ///< of the pose in the local map
    Covariance6 drift = Covariance6::Zero();     ///< of the local map itself, in the base's axes
  };
  struct Expected {
    PosePrior prior;
    Pose T_last_base;  ///< motion since the last frame that counted
    bool wheels_jumped = false;
  };

  [[nodiscard]] Expected expect(const OdometryFrame& frame) const;
  [[nodiscard]] bool hardly_moved(const OdometryFrame& frame) const;
  [[nodiscard]] Covariance6 jump_when_lost() const;
  OdometryStep place(const OdometryFrame& frame);
  /// Until an image has depth the wheels carry; with it the map begins where they say.
  void begin(DepthScan scan, const OdometryFrame& frame, OdometryStep& step);
  /// A way back by a key frame that looks alike; else a new map after `most_lost` lost images.
  void recover(const DepthScan& scan, const OdometryFrame& frame, OdometryStep& step,
               int most_lost);
  /// The last key frames of the map that the robot is in.
  [[nodiscard]] std::span<const KeyFrame> keys_of_map() const;
  OdometryStep placed(OdometryStep step, const State& state);
  /// Of matches from several turns, and the first one, that with most of its upright points on
  /// planes.
  [[nodiscard]] ScanMatch searched(const DepthScan& scan, const PosePrior& loose,
                                   const ScanMatch& first) const;
  [[nodiscard]] bool sees_through_key(const cv::Mat1w& depth, const KeyFrame& key,
                                      const Pose& T_map_base) const;
  /// Whether an image at this pose sees through several of these key frames.
  [[nodiscard]] bool contradicts(const cv::Mat1w& depth, const Pose& T_map_base,
                                 std::span<const KeyFrame> keys) const;
  [[nodiscard]] Tracking track(const DepthScan& scan, const OdometryFrame& frame,
                               const Expected& expected, OdometryStep& step);
  void keep(DepthScan scan, const OdometryFrame& frame, OdometryStep& step);
  bool close_loop(const cv::Mat1w& depth, bool anywhere);
  bool relocate(const DepthScan& scan, const OdometryFrame& frame);
  void spread();
  void rebuild();
  /// The planes of these key frames, in the map's axes; at most kHorizon of them.
  [[nodiscard]] LocalMap map_of(const std::vector<std::size_t>& keys) const;

  VisualOdometryParams params_;
  Calibration believed_;
  State state_;  ///< at the last frame that counted
  LocalMap local_map_;
  std::optional<OdometryFrame> last_;           ///< that frame, without its image
  std::optional<OdometryFrame> previous_;       ///< the last frame, likewise
  Pose T_before_last_base_ = Pose::Identity();  ///< motion of the last step
  double last_step_s_ = 0.0, last_stamp_s_ = -std::numeric_limits<double>::infinity();
  int lost_for_ = 0;
  double last_support_ = 0.0;  ///< of the last scan that placed a frame
  double way_m_ = 0.0, loop_closed_at_m_ = 0.0;
  std::vector<KeyFrame> keys_;
  std::size_t map_begins_ = 0;  ///< first key frame since the robot was lost
  KeyView key_view_;            ///< of the last key frame
  std::vector<PoseEdge> edges_;
  std::vector<Placed> placed_;
  std::size_t loops_ = 0;
};

}  // namespace mapscore
