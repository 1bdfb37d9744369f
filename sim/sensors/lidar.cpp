// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/sensors/lidar.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "sim/sensors/ray_cast.hpp"
#include "sim/world/drawn_scene.hpp"
#include "sim/world/motion.hpp"
#include "sim/world/mujoco_pose.hpp"
#include "sim/world/mujoco_session.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace mapscore::sim {

/// The world's model with what the renderer draws in group 0 and all else in group 5.
struct Lidar::Target {
  ModelPtr model;
  std::optional<Motion> motion;
  std::vector<int> addresses;  ///< in qpos, of the motion's joints
};

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

std::vector<int> addresses_of(const Motion& motion, const mjModel& model) {
  std::vector<int> addresses;
  for (const std::string& joint : motion.joints)
    addresses.push_back(model.jnt_qposadr[mj_name2id(&model, mjOBJ_JOINT, joint.c_str())]);
  return addresses;
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
        data_(mj_makeData(lidar.target_->model.get())),
        along_(lidar.directions_.size()),
        hits_(lidar.settings_.beams),
        ranges_m_(lidar.settings_.beams) {
    place();
  }

  /// Moves the scene to an instant of its motion.
  void move_to(double stamp_s) {
    const Target& target = *lidar_.target_;
    if (!target.motion) return;
    const std::vector<double> values = target.motion->at(stamp_s);
    for (std::size_t joint = 0; joint < values.size(); ++joint)
      data_->qpos[target.addresses[joint]] = values[joint];
    place();
  }

  LidarRanges scan(const Pose& T_world_base) {
    const Pose T_world_lidar = T_world_base * lidar_.T_base_lidar_;
    for (std::size_t i = 0; i < along_.size(); i += 3)
      Eigen::Map<Eigen::Vector3d>(along_.data() + i) =
          T_world_lidar.linear() * Eigen::Map<const Eigen::Vector3d>(lidar_.directions_.data() + i);
    const Eigen::Vector3d from = T_world_lidar.translation();
    cast_rays(*lidar_.target_->model, *data_, from.data(), along_.data(), kFirstGroup, hits_.data(),
              ranges_m_.data(), lidar_.settings_.beams, lidar_.settings_.range_max_m);
    LidarRanges ranges(ranges_m_.size());
    for (std::size_t i = 0; i < ranges.size(); ++i) ranges[i] = measured(ranges_m_[i]);
    return ranges;
  }

 private:
  void place() {  // rays need the bodies' centres of mass, too
    mj_kinematics(lidar_.target_->model.get(), data_.get());
    mj_comPos(lidar_.target_->model.get(), data_.get());
  }

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

Lidar::Lidar(const World& world, const LidarSettings& settings) : settings_(settings) {
  check(settings);
  quiet_mujoco();
  auto target = std::make_shared<Target>();
  target->model = copy_for_rays(world);
  if (const Motion* motion = world.motion()) {
    target->motion = *motion;
    target->addresses = addresses_of(*motion, *target->model);
  }
  T_base_lidar_ = settings.T_base_lidar ? *settings.T_base_lidar : site_pose(*target->model);
  target_ = std::move(target);
  for (int beam = 0; beam < settings.beams; ++beam) {
    const double angle_rad = settings.first_angle_rad + beam * angle_step_rad();
    directions_.insert(directions_.end(), {std::cos(angle_rad), std::sin(angle_rad), 0.0});
  }
}

double Lidar::angle_step_rad() const {
  return 2.0 * M_PI / settings_.beams;
}

LidarRanges Lidar::scan(const Pose& T_world_base) const {
  return Caster(*this).scan(T_world_base);
}

template <class ScanOne>
std::vector<LidarRanges> Lidar::all(std::size_t count, int jobs, const ScanOne& scan_one) const {
  if (jobs < 1) throw Error("lidar: jobs must be at least 1");
  std::vector<LidarRanges> scans(count);
  constexpr std::size_t kRun = 16;
  Runs runs(scans.size(), kRun);
  run_jobs(jobs, [&](int) {
    Caster caster(*this);
    for (Runs::Run run{}; runs.next(run);)
      for (std::size_t i = run.first; i < run.last; ++i) scans[i] = scan_one(caster, i);
  });
  return scans;
}

std::vector<LidarRanges> Lidar::scans(const std::vector<Pose>& T_world_base, int jobs) const {
  return all(T_world_base.size(), jobs,
             [&](Caster& caster, std::size_t i) { return caster.scan(T_world_base[i]); });
}

std::vector<LidarRanges> Lidar::scans(const std::vector<StampedPose>& poses, int jobs) const {
  return all(poses.size(), jobs, [&](Caster& caster, std::size_t i) {
    caster.move_to(poses[i].stamp_s);
    return caster.scan(poses[i].T_world_base);
  });
}

}  // namespace mapscore::sim
