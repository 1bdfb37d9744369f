// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#ifdef MAPSCORE_SIMULATOR

#include "eval/explore/exploration_run.hpp"

#include "core/error.hpp"
#include "core/mapping/mapper.hpp"
#include "core/random_stream.hpp"
#include "eval/explore/live_belief.hpp"
#include "eval/explore/live_floor.hpp"
#include "eval/explore/object_memory.hpp"
#include "eval/explore/standing_floor.hpp"
#include "eval/lab/map_frame.hpp"
#include "eval/lab/sights.hpp"
#include "eval/render/study_drive.hpp"
#include "sim/render/renderer.hpp"
#include "sim/robot/drive_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>

namespace mapscore::eval {
namespace {

constexpr double kBackOffM = 0.2;  ///< at most, before what blocks a way

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

ExploringRobot robot_of(const sim::DriveModel& drive, const Study& config,
                        const Calibration& believed) {
  const RobotExtent extent = extent_of(drive);
  return {extent.radius_m + drive_settings(config).clearance_m, extent.height_m, believed};
}

/// Intermediate waypoints look along the way, so that the robot turns no more than it must.
std::vector<sim::Drive::Waypoint> along_the_way(std::vector<PlanarPose> way) {
  constexpr double kApartM = 0.02;
  for (std::size_t n = 1; n + 1 < way.size(); ++n) {
    const double dx = way[n + 1].x_m - way[n].x_m, dy = way[n + 1].y_m - way[n].y_m;
    if (std::hypot(dx, dy) > kApartM) way[n].yaw_rad = std::atan2(dy, dx);
  }
  return way;
}

/// One exploration: drive, sensors, map and planner in step.
class ExplorationRun {
 public:
  ExplorationRun(const ExplorationStage& stage, const Task& task, const PlanarPose& start,
                 const MakeExplorer& make_explorer, const ExplorationSinks& sinks)
      : stage_(stage),
        task_(task),
        settings_(task.config.exploration),
        sinks_(sinks),
        T_map_world_(map_frame(task.config, task.seed_index).T_map_world()),
        mapping_(mapping_of(task.config, stage.table)),
        threshold_(
            task.config.score.threshold.value.value_or(default_threshold(mapping_.fusion.rule))),
        sights_(task, stage.world.calibration(), stage.world.shapes(), stage.table),
        belief_(task, T_map_world_),
        floor_(task, stage.world),
        renderer_(stage.world, task.config.cameras.shadows),
        mapper_(mapping_, stage.table.classes.size()),
        seen_(stage.surface, stage.world.calibration(), T_map_world_),
        drive_(stage.drive, start, drive_settings(task.config)),
        explorer_(
            make_explorer(robot_of(stage.drive, task.config, sights_.believed()), T_map_world_)) {
    drive_.mind_edges();
    if (settings_.look_again_voxels > 0.0)
      objects_.emplace(stage.table.classes.size(), settings_.look_again_voxels);
  }

  ExplorationResult run() {
    catch_up();
    while (!out_of_budget()) {
      const ExplorationStep step = choose();
      if (!step.view) {
        end(step);
        break;
      }
      go_to(*step.view);
    }
    if (result_.end == ExplorationEnd::budget)
      static_cast<void>(choose());  // of which the moment alone counts
    score_last_point();
    if (sinks_.map) sinks_.map(mapper_.map());
    write_logs();
    result_.driven_m = drive_.log().distance_m;
    result_.duration_s = drive_.time_s();
    result_.bump_contacts = drive_.health().bump_contacts;
    if (objects_)
      result_.objects = {objects_->objects(), objects_->missed(), objects_->found_again()};
    return std::move(result_);
  }

 private:
  // --- what the planner sees and says ------------------------------------------------------------

  ExplorationStep choose() {
    floor_.look();
    const double stamp_s = drive_.log().samples.back().stamp_s;
    const Pose T_map_base = belief_.mean_at(drive_.log(), stamp_s);
    const OccupancyGrid floor = floor_.grid();
    const double before_s = thread_seconds();
    ExplorationStep step =
        explorer_->next({mapper_.map(), floor, planar(T_map_base), T_map_base.translation().z(),
                         objects_ ? objects_->again() : std::vector<LookAgain>{}});
    const double plan_s = thread_seconds() - before_s;
    result_.plans_s += plan_s;
    result_.slowest_plan_s = std::max(result_.slowest_plan_s, plan_s);
    FloorMoment moment{stamp_s, drive_.log().distance_m, floor, {}};
    for (const Frontier& frontier : step.frontiers)
      for (const GridCell& cell : frontier.cells) moment.frontier.push_back(floor.centre_of(cell));
    result_.moments.push_back(std::move(moment));
    return step;
  }

  void end(const ExplorationStep& step) {
    result_.end = step.end;
    result_.reason = !step.reason.empty() ? step.reason
                     : step.end == ExplorationEnd::explored
                         ? "no view is left that shows enough that is new"
                         : "what is left can be seen from no place that the robot can get to";
  }

  bool out_of_budget() {
    const auto used_up = [&](const std::string& what) {
      result_.end = ExplorationEnd::budget;
      result_.reason = what + " used up";
      return true;
    };
    if (drive_.log().distance_m >= settings_.budget_m)
      return used_up(fmt::format("budget_m {}", settings_.budget_m));
    if (drive_.time_s() >= settings_.budget_s)
      return used_up(fmt::format("budget_s {}", settings_.budget_s));
    if (static_cast<int>(result_.views.size()) >= settings_.budget_views)
      return used_up(fmt::format("budget_views {}", settings_.budget_views));
    return false;
  }

  // --- driving -----------------------------------------------------------------------------------

  /// Drives to a view along the planner's way, which is as far off as the robot believes to be.
  void go_to(const NextView& view) {
    if (view.way.empty()) throw Error("exploration: a view without a way; give at least its place");
    const double stamp_s = drive_.log().samples.back().stamp_s;
    const PlanarPose T_world_map =
        drive_.place() * inverse(planar(belief_.mean_at(drive_.log(), stamp_s)));
    std::vector<PlanarPose> way{drive_.place()};
    for (const PlanarPose& T_map_base : view.way) way.push_back(T_world_map * T_map_base);
    result_.views.push_back({stamp_s, drive_.log().distance_m, way.back(), view.way_m,
                             view.unknown_voxels, view.unsure_voxels, WayEnd::arrived, ""});
    drive_.follow(along_the_way(std::move(way)));
    sim::WayState state = sim::WayState::driving;
    while (state == sim::WayState::driving && !out_of_metres_or_time()) {
      state = drive_.step();
      catch_up();
    }
    finish_way(state);
    if (frame_stamp(next_frame_) <= settings_.budget_s)
      drive_.rest_until(frame_stamp(next_frame_));  // looks once from where it stands
    else
      drive_.rest_until(settings_.budget_s);
    catch_up();
  }

  bool out_of_metres_or_time() const {
    return drive_.log().distance_m >= settings_.budget_m || drive_.time_s() >= settings_.budget_s;
  }

  void finish_way(sim::WayState state) {
    ChosenView& view = result_.views.back();
    if (state == sim::WayState::arrived) return;
    if (state == sim::WayState::driving) {
      view.end = WayEnd::budget;
      return;
    }
    view.end = state == sim::WayState::blocked ? WayEnd::blocked : WayEnd::stuck;
    const auto obstacle = state == sim::WayState::blocked ? drive_.obstacle() : drive_.touched();
    if (obstacle) view.obstacle = obstacle->body;
    const double stamp_s = drive_.log().samples.back().stamp_s;
    const Pose T_map_base = belief_.mean_at(drive_.log(), stamp_s);
    const double radius_m = extent_of(stage_.drive).radius_m;
    Eigen::Vector3d p_base(radius_m, 0.0, 0.0);  // where it was heading
    if (obstacle)
      p_base = drive_.log().samples.back().T_world_base.inverse() *
               Eigen::Vector3d(obstacle->x_m, obstacle->y_m, obstacle->z_m);
    floor_.block((T_map_base * p_base).head<2>());
    drive_.back_off(kBackOffM);
    catch_up();
  }

  // --- seeing ------------------------------------------------------------------------------------

  double frame_stamp(int frame) const {
    return static_cast<double>(frame) / task_.config.trajectory.frames_per_s;
  }

  /// Takes the images and the turns of the lidar that are due.
  void catch_up() {
    const double now_s = drive_.log().samples.back().stamp_s;
    while (frame_stamp(next_frame_) <= now_s + 1e-9 || floor_.next_stamp_s() <= now_s + 1e-9) {
      if (floor_.next_stamp_s() < frame_stamp(next_frame_))
        floor_.turn(drive_.log(), belief_);
      else
        take_frame();
    }
  }

  void take_frame() {
    const int index = next_frame_++;
    const double stamp_s = frame_stamp(index);
    const sim::StampedPose pose{stamp_s, sim::pose_at(drive_.log(), stamp_s)};
    Frame frame;
    frame.index = frame.depth_index = index;
    if (sinks_.recording || sinks_.frame || reads_colour(task_.config))
      renderer_.render_color(pose, frame);
    else
      renderer_.render_label(pose, frame);
    renderer_.render_depth(pose, frame);
    if (sinks_.recording) sinks_.recording->write_color(frame);
    if (sinks_.recording) sinks_.recording->write_depth(frame);
    result_.frames.push_back({stamp_s, pose.T_world_base});
    map_frame_into(frame);
    seen_.add(frame);
    note_point(stamp_s);
    if (sinks_.frame) sinks_.frame(frame, mapper_.map());
    if (sinks_.progress) sinks_.progress(result_.curve.back());
  }

  void map_frame_into(const Frame& frame) {
    const Sight sight = sights_.of(frame);
    const PoseBelief belief = belief_.at_next_frame(drive_.log(), frame.stamp_s);
    if (!mapper_.takes(sight, belief)) return;
    RandomStream draws(trial_seed(task_), "belief", {static_cast<std::uint64_t>(frame.index)});
    const std::vector<Segment> segments = mapper_.integrate(sight, belief, draws);
    if (objects_) objects_->add(segments, sight, belief, frame.stamp_s);
    if (reads_colour(task_.config)) mapper_.add_colours(sight, frame.color, belief);
  }

  // --- scores ------------------------------------------------------------------------------------

  void note_point(double stamp_s) {
    CoveragePoint point{
        stamp_s,          drive_.log().distance_m,   static_cast<int>(result_.views.size()),
        seen_.coverage(), seen_.coverage_detected(), std::nullopt};
    const bool at_view = result_.curve.empty() || point.views != result_.curve.back().views;
    if (at_view || point.driven_m >= next_score_m_) {
      point.map = stage_.surface.state_of(mapper_.map(), threshold_);
      next_score_m_ =
          settings_.score_every_m * (std::floor(point.driven_m / settings_.score_every_m) + 1.0);
    }
    result_.curve.push_back(point);
  }

  void score_last_point() {
    result_.curve.back().map = stage_.surface.state_of(mapper_.map(), threshold_);
  }

  void write_logs() {
    if (!sinks_.recording) return;
    const double end_s = result_.frames.back().stamp_s;
    const std::vector<OdometryPose> odometry = odometry_of(drive_.log(), end_s);
    const ScanLog scans = floor_.take_scans(end_s);
    sinks_.recording->write_odometry(odometry);
    sinks_.recording->write_scans(scans);
    sinks_.recording->add_poses(truth_of(drive_.log(), odometry, floor_.poses_until(end_s)));
    sinks_.recording->write_shapes(stage_.world.shapes());
  }

  const ExplorationStage& stage_;
  const Task& task_;
  const ExplorationSettings& settings_;
  const ExplorationSinks& sinks_;
  const Pose T_map_world_;
  const Mapping mapping_;
  const double threshold_;
  Sights sights_;
  LiveBelief belief_;
  LiveFloor floor_;
  sim::Renderer renderer_;
  Mapper mapper_;
  std::optional<ObjectMemory> objects_;  ///< none where none are looked for again
  SeenSurface seen_;
  sim::DriveSession drive_;
  std::unique_ptr<Explorer> explorer_;
  int next_frame_ = 0;
  double next_score_m_ = 0.0;
  ExplorationResult result_;
};

}  // namespace

ExplorationResult explore(const ExplorationStage& stage, const Task& task, const PlanarPose& start,
                          const MakeExplorer& make_explorer, const ExplorationSinks& sinks) {
  return ExplorationRun(stage, task, start, make_explorer, sinks).run();
}

}  // namespace mapscore::eval

#endif
