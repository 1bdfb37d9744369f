// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/occupancy_grid.hpp"
#include "core/placement/pose_belief.hpp"
#include "eval/lab/shared_cache.hpp"
#include "eval/localization/believed_trajectory.hpp"
#include "eval/localization/visual_run.hpp"
#include "eval/recording/recording.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/tracking_counts.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// What a trial's source of poses says.
struct TrialPoses {
  std::vector<PoseBelief> beliefs;              ///< by frame
  std::optional<TrackingCounts> tracking = {};  ///< of a source that looks at depth images
};

/// Computes the pose beliefs of a recording's trials. Beliefs that several trials share, such as a
/// particle filter's, are computed once; the last kHeld are kept. Safe to use from several threads:
/// a thread that asks for beliefs that another one is computing waits for them.
class PoseSources {
 public:
  static constexpr std::size_t kHeld = 1024;

  explicit PoseSources(const Recording& recording) : recording_(recording) {}

  /// What the source of a task believes at every frame, in the map frame of its lattice;
  /// covariances are those that are reported. Of a Gaussian source, which has no odometry, odom is
  /// map. `depth_of`: the depth image of every frame. Throws Error when the recording has no
  /// odometry or scans for the source, or a file is refused or does not reach a frame.
  [[nodiscard]] TrialPoses poses(const Task& task, const std::vector<int>& depth_of);
  [[nodiscard]] std::vector<PoseBelief> beliefs(const Task& task,
                                                const std::vector<int>& depth_of) {
    return poses(task, depth_of).beliefs;
  }

  /// How many are kept at present.
  [[nodiscard]] std::size_t held() { return beliefs_.held(); }

 private:
  [[nodiscard]] TrialPoses believed_at(const Task& task, const std::vector<int>& depth_of);
  /// Made once for all tasks that share it; none where the source needs none.
  [[nodiscard]] std::shared_ptr<const OccupancyGrid> grid(const Task& task);

  const Recording& recording_;
  SharedCache<std::string, std::shared_ptr<const TrialPoses>> beliefs_{kHeld};
  SharedCache<std::string, std::shared_ptr<const OccupancyGrid>> grids_{kHeld};
};

/// Visual odometry of a task over a whole recording, in the scene's world, from the true pose at
/// its start. Throws Error as PoseSources.
[[nodiscard]] VisualTrajectory visual_trajectory(
    const Recording& recording, const Task& task,
    const std::function<void(int, int)>& progress = {});

/// The true poses T_world_base at the stamps of a task's beliefs, by frame.
[[nodiscard]] std::vector<Pose> true_poses(const Recording& recording, const Task& task,
                                           const std::vector<int>& depth_of);

/// What the robot believes along a whole recording, in the scene's world, as a task's source says:
/// odometry, particle filter, depth images or a file. `grid`: grid_of the task's configuration
/// where it is at hand, else the filter has it made. `progress(turns or images done, all)` of
/// filter and visual odometry. Throws Error as PoseSources.
[[nodiscard]] BelievedTrajectory believed_trajectory(
    const Recording& recording, const Task& task, const OccupancyGrid* grid = nullptr,
    const std::function<void(int, int)>& progress = {});

/// The grid that a configuration's filter localises in: its file, or cut from the recording's truth
/// at the lidar's height. Throws Error when the file is refused, the recording has no truth or no
/// logs, or the robot starts in an occupied cell.
[[nodiscard]] OccupancyGrid grid_of(const Recording& recording, const Study& config);

}  // namespace mapscore::eval
