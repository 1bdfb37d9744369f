// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/localization/visual_run.hpp"

#include "core/error.hpp"
#include "core/frame.hpp"
#include "sim/faults/depth_noise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

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

/// How far most depth images lie apart; 0 of one.
double usual_spacing_s(const Recording& recording) {
  std::vector<double> spacings_s{0.0};
  for (int n = 1; n < recording.depth_count(); ++n)
    spacings_s.push_back(recording.depth_stamp_s(n) - recording.depth_stamp_s(n - 1));
  const auto middle = spacings_s.begin() + static_cast<std::ptrdiff_t>(spacings_s.size() / 2);
  std::ranges::nth_element(spacings_s, middle);
  return *middle;
}

/// Stamps between two depth images that lie farther apart than a second and five times as far as
/// most do: there the wheels alone carry, and how little is known must grow with the way.
std::vector<double> stamps_in_gap(double from_s, double to_s, double usual_s) {
  constexpr double kEvery_s = 0.2, kMost = 500.0, kLeastGap_s = 1.0, kTimesUsual = 5.0;
  std::vector<double> stamps_s;
  if (to_s - from_s <= std::max(kLeastGap_s, kTimesUsual * usual_s)) return stamps_s;
  const double every_s = std::max(kEvery_s, (to_s - from_s) / kMost);
  for (int n = 1; from_s + n * every_s < to_s; ++n) stamps_s.push_back(from_s + n * every_s);
  return stamps_s;
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
  const double usual_s = usual_spacing_s(recording);
  std::vector<OdometryStep> placed;  // of the images, and of the wheels alone in gaps
  const auto carry = [&](double from_s, double to_s) {
    const std::vector<double> stamps_s = stamps_in_gap(from_s, to_s, usual_s);
    if (!stamps_s.empty()) result.without_images_s += to_s - from_s;
    for (const double stamp_s : stamps_s)
      placed.push_back(visual.add(
          {stamp_s, cv::Mat1w::zeros(run.believed.depth.height_px, run.believed.depth.width_px),
           odometry_at(odometry, stamp_s)}));
  };
  for (int n = 0; n < recording.depth_count(); ++n) {
    recording.read_depth(n, {.label = false}, image);
    if (n > 0 && !odometry.empty())
      carry(recording.depth_stamp_s(n - 1), recording.depth_stamp_s(n));
    OdometryFrame frame{
        recording.depth_stamp_s(n),
        sim::corrupt_depth(image.depth, recording.info().calibration.depth, run.depth, run.seed, n),
        {}};
    if (!odometry.empty()) frame.T_odom_base = odometry_at(odometry, frame.stamp_s);
    result.steps.push_back(visual.add(frame));
    placed.push_back(result.steps.back());
    if (progress) progress(n + 1, recording.depth_count());
  }
  if (!odometry.empty()) carry(result.steps.back().stamp_s, odometry.back().stamp_s);
  refuse_all_blind(result.steps, (recording.folder() / "depth.txt").string(),
                   "check faults.depth and the camera's range, or take another "
                   "localization.source");
  const std::vector<CorrectedPose> corrected = visual.corrected();
  for (std::size_t n = 0; n < placed.size(); ++n) {
    const OdometryStep& step = placed[n];
    append(result.believed, step.stamp_s,
           run.visual.corrected ? corrected[n].T_map_base : step.T_map_base, step.covariance,
           odometry);
  }
  result.loops = visual.loops();
  return result;
}

}  // namespace mapscore::eval
