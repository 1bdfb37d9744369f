// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/sensors/lidar.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "sim/sensors/ray_cast.hpp"
#include "sim/world/compiled_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace mapscore::sim {
namespace {

constexpr int kHiddenGroup = 5;

void check(const LidarSettings& s) {
  if (s.beams < 1) throw Error(fmt::format("lidar: beams {} must be at least 1", s.beams));
  if (!std::isfinite(s.first_angle_rad)) throw Error("lidar: first_angle must be a finite number");
  if (!(s.range_min_m >= 0) || !(s.range_max_m > s.range_min_m) || !std::isfinite(s.range_max_m))
    throw Error(
        fmt::format("lidar: range {} to {} m: give 0 <= min < max", s.range_min_m, s.range_max_m));
}

ModelPtr copy_for_rays(const World& world) {
  ModelPtr model(mj_copyModel(nullptr, &world.model()));
  for (int geom = 0; geom < model->ngeom; ++geom) model->geom_group[geom] = kHiddenGroup;
  for (const mjvGeom& geom : world.drawn().geoms) model->geom_group[geom.objid] = 0;
  return model;
}

/// The robot stands where the model has it: its base at the world's origin.
Pose site_pose(const mjModel& model) {
  const int site = mj_name2id(&model, mjOBJ_SITE, "robot/lidar");
  const int base = mj_name2id(&model, mjOBJ_BODY, "robot/base_footprint");
  if (site < 0 || base < 0)
    throw Error("lidar: the robot has no site `lidar` under base_footprint; add one to its MJCF");
  const DataPtr data(mj_makeData(&model));
  mj_kinematics(&model, data.get());
  const Pose T_world_base = pose_of(data->xpos + 3 * base, data->xmat + 9 * base);
  return T_world_base.inverse() * pose_of(data->site_xpos + 3 * site, data->site_xmat + 9 * site);
}

}  // namespace

/// Casts one turn after another on one thread.
class Lidar::Caster {
 public:
  explicit Caster(const Lidar& lidar)
      : lidar_(lidar),
        data_(mj_makeData(lidar.model_.get())),
        along_(lidar.directions_.size()),
        hits_(lidar.settings_.beams),
        ranges_m_(lidar.settings_.beams) {
    place(*lidar_.model_, *data_);
  }

  LidarRanges scan(const StampedPose& pose) {
    if (const Motion* motion = lidar_.world_.motion())
      place_at(*motion, pose.stamp_s, *lidar_.model_, *data_);
    const Pose T_world_lidar = pose.T_world_base * lidar_.T_base_lidar_;
    for (std::size_t i = 0; i < along_.size(); i += 3)
      Eigen::Map<Eigen::Vector3d>(along_.data() + i) =
          T_world_lidar.linear() * Eigen::Map<const Eigen::Vector3d>(lidar_.directions_.data() + i);
    const Eigen::Vector3d from = T_world_lidar.translation();
    cast_rays(*lidar_.model_, *data_, from.data(), along_.data(), hits_.data(), ranges_m_.data(),
              lidar_.settings_.beams, lidar_.settings_.range_max_m);
    LidarRanges ranges(ranges_m_.size());
    for (std::size_t i = 0; i < ranges.size(); ++i) ranges[i] = measured(ranges_m_[i]);
    return ranges;
  }

 private:
  float measured(double range_m) const {
    if (range_m < 0.0 || range_m > lidar_.settings_.range_max_m)
      return std::numeric_limits<float>::infinity();
    return range_m < lidar_.settings_.range_min_m ? 0.0f : static_cast<float>(range_m);
  }

  const Lidar& lidar_;
  DataPtr data_;
  std::vector<mjtNum> along_;
  std::vector<int> hits_;
  std::vector<mjtNum> ranges_m_;
};

Lidar::Lidar(const World& world, const LidarSettings& settings)
    : world_(world), settings_(settings) {
  check(settings);
  quiet_mujoco();
  model_ = copy_for_rays(world);
  T_base_lidar_ = site_pose(*model_);
  for (int beam = 0; beam < settings.beams; ++beam) {
    const double angle_rad = settings.first_angle_rad + beam * angle_step_rad();
    directions_.insert(directions_.end(), {std::cos(angle_rad), std::sin(angle_rad), 0.0});
  }
}

std::vector<LidarRanges> Lidar::scans(const std::vector<StampedPose>& poses, int jobs) const {
  if (jobs < 1) throw Error("lidar: jobs must be at least 1");
  std::vector<LidarRanges> scans(poses.size());
  constexpr std::size_t kRun = 16;
  Runs runs(scans.size(), kRun);
  run_jobs(jobs, [&](int) {
    Caster caster(*this);
    for (Runs::Run run{}; runs.next(run);)
      for (std::size_t i = run.first; i < run.last; ++i) scans[i] = caster.scan(poses[i]);
  });
  return scans;
}

}  // namespace mapscore::sim
