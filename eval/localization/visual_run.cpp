// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/localization/visual_run.hpp"

#include "core/error.hpp"
#include "core/frame.hpp"
#include "sim/faults/depth_noise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace mapscore::eval {
namespace {

/// The entry of a frame: the wheels' odom under the pose, or the pose itself.
void append(BelievedTrajectory& believed, double stamp_s, const Pose& T_map_base,
            const Covariance6& covariance, const std::vector<OdometryPose>& odometry) {
  if (odometry.empty()) {
    believed.file = "depth.txt";
    believed.odometry.push_back({stamp_s, T_map_base});
    believed.entries.push_back({stamp_s, {Pose::Identity(), T_map_base, covariance}});
    return;
  }
  const Pose T_odom_base = odometry_at(odometry, stamp_s);
  believed.entries.push_back(
      {stamp_s, {T_map_base * T_odom_base.inverse(), T_odom_base, covariance}});
}

}  // namespace

std::array<int, names_of(Tracking{}).size()> VisualTrajectory::frames_by_tracking() const {
  std::array<int, names_of(Tracking{}).size()> frames{};
  for (const OdometryStep& step : steps) ++frames[static_cast<std::size_t>(step.tracking)];
  return frames;
}

void refuse_all_blind(std::span<const OdometryStep> steps, const std::string& file,
                      const std::string& mend) {
  const auto is_blind = [](const OdometryStep& step) { return step.tracking == Tracking::blind; };
  if (std::ranges::all_of(steps, is_blind))
    throw Error(
        fmt::format("{}: no depth image has enough depth to find poses by; {}", file, mend));
}

VisualTrajectory run_visual(const Recording& recording, const VisualRun& run,
                            const Pose& T_map_base_start,
                            const std::function<void(int, int)>& progress) {
  VisualTrajectory result;
  if (run.visual.wheels) result.believed.odometry = recording.read_odometry();
  const std::vector<OdometryPose> odometry = result.believed.odometry;
  VisualOdometry visual(run.params, run.believed, T_map_base_start);
  Frame image;
  for (int n = 0; n < recording.depth_count(); ++n) {
    recording.read_depth(n, {.label = false}, image);
    OdometryFrame frame{
        recording.depth_stamp_s(n),
        sim::corrupt_depth(image.depth, recording.info().calibration.depth, run.depth, run.seed, n),
        {}};
    if (!odometry.empty()) frame.T_odom_base = odometry_at(odometry, frame.stamp_s);
    result.steps.push_back(visual.add(frame));
    if (progress) progress(n + 1, recording.depth_count());
  }
  refuse_all_blind(result.steps, (recording.folder() / "depth.txt").string(),
                   "check faults.depth and the camera's range, or take another "
                   "localization.source");
  const std::vector<CorrectedPose> corrected = visual.corrected();
  for (std::size_t n = 0; n < result.steps.size(); ++n) {
    const OdometryStep& step = result.steps[n];
    append(result.believed, step.stamp_s,
           run.visual.corrected ? corrected[n].T_map_base : step.T_map_base, step.covariance,
           odometry);
  }
  result.loops = visual.loops();
  return result;
}

}  // namespace mapscore::eval
