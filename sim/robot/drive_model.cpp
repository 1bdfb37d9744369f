// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/drive_model.hpp"

#include "core/error.hpp"
#include "sim/robot/scene_colliders.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

namespace mapscore::sim {
namespace {

constexpr double kTimeStepS = 0.002;
constexpr double kRobotHeightM = 1.3;
constexpr std::array<const char*, 2> kWheels = {"wheel_left", "wheel_right"};

SpecPtr parse_robot(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw Error(fmt::format("{}: no such robot file; check the path, or name one: --set robot=FILE",
                            file.string()));
  std::array<char, 1024> reason{};
  SpecPtr spec(mj_parseXML(file.c_str(), nullptr, reason.data(), static_cast<int>(reason.size())));
  if (!spec)
    throw Error(fmt::format("{}: MuJoCo refuses it: {}; mend the MJCF there", file.string(),
                            one_line(reason.data())));
  return spec;
}

void pin_options(mjOption& option) {
  mj_defaultOption(&option);
  option.timestep = kTimeStepS;
  option.gravity[0] = option.gravity[1] = 0.0;
  option.gravity[2] = -9.81;
  option.integrator = mjINT_IMPLICITFAST;
  option.solver = mjSOL_NEWTON;
  option.cone = mjCONE_ELLIPTIC;
  option.impratio = 10.0;
  option.disableflags |= mjDSBL_AUTORESET;
}

void stand_on_floor(mjSpec* spec, const std::string& file) {
  mjsBody* base = mjs_findBody(spec, "base_footprint");
  if (!base)
    throw Error(fmt::format("{}: no body `base_footprint`; name the robot's root so", file));
  mjs_addFreeJoint(base);
}

void widen_bumps(const mjModel& model, const std::vector<GeomRole>& role, double clearance_m,
                 mjSpec* spec) {
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (role[geom] != GeomRole::bump) continue;
    mjsElement* element = mjs_findElement(spec, mjOBJ_GEOM, mj_id2name(&model, mjOBJ_GEOM, geom));
    double* size = mjs_asGeom(element)->size;
    size[0] += clearance_m;
    if (model.geom_type[geom] == mjGEOM_BOX || model.geom_type[geom] == mjGEOM_ELLIPSOID)
      size[1] += clearance_m;
  }
}

ModelPtr compile(mjSpec* spec, const std::string& file) {
  ModelPtr model(mj_compile(spec, nullptr));
  if (!model)
    throw Error(
        fmt::format("{}: MuJoCo refuses the robot among the scene's geoms: {}; mend the "
                    "MJCF",
                    file, one_line(mjs_getError(spec))));
  return model;
}

/// Looks up what the drive needs in the compiled robot; throws naming what is missing.
void find_parts(const std::string& file, DriveModel& drive) {
  const mjModel& model = *drive.model;
  const auto id_of = [&](mjtObj type, const char* kind, const char* name) {
    const int found = mj_name2id(&model, type, name);
    if (found < 0)
      throw Error(
          fmt::format("{}: no {} `{}`; a robot that drives needs it, or leave the drive "
                      "kinematic",
                      file, kind, name));
    return found;
  };
  drive.base_body = id_of(mjOBJ_BODY, "body", "base_footprint");
  drive.base_qpos = model.jnt_qposadr[model.body_jntadr[drive.base_body]];
  std::array<const mjtNum*, 2> position{};
  std::array<double, 2> radius_m{};
  for (int side = 0; side < 2; ++side) {
    const int joint = id_of(mjOBJ_JOINT, "hinge joint", kWheels[side]);
    drive.wheel_qpos[side] = model.jnt_qposadr[joint];
    drive.wheel_actuator[side] = id_of(mjOBJ_ACTUATOR, "velocity actuator", kWheels[side]);
    drive.wheel_geom[side] = id_of(mjOBJ_GEOM, "geom", kWheels[side]);
    position[side] = model.body_pos + 3 * model.jnt_bodyid[joint];
    radius_m[side] = model.geom_size[3 * drive.wheel_geom[side]];
  }
  if (radius_m[0] != radius_m[1] || position[0][2] != position[1][2])
    throw Error(fmt::format("{}: the wheels differ in size or height; make them alike", file));
  drive.wheels = {radius_m[0], std::abs(position[0][1] - position[1][1])};
}

/// Of a geom of the robot.
GeomRole role_of(const mjModel& model, int geom, const std::string& file) {
  const std::string name = element_name(model, mjOBJ_GEOM, geom);
  if (model.geom_contype[geom] == 0 && model.geom_conaffinity[geom] == 0) return GeomRole::none;
  if (name == kWheels[0] || name == kWheels[1]) return GeomRole::wheel;
  if (name.starts_with("caster")) return GeomRole::caster;
  if (name.empty()) throw Error(fmt::format("{}: a geom that collides has no name; name it", file));
  return GeomRole::bump;
}

void assign_roles(const std::vector<Collider>& colliders, const std::string& file,
                  DriveModel& drive) {
  const mjModel& model = *drive.model;
  drive.role.assign(model.ngeom, GeomRole::none);
  drive.scene_body.assign(model.ngeom, "");
  for (const Collider& collider : colliders) {
    const int geom = mj_name2id(&model, mjOBJ_GEOM, collider.geom_name.c_str());
    drive.role[geom] = GeomRole::scene;
    drive.scene_body[geom] = collider.body_name;
  }
  for (int geom = 0; geom < model.ngeom; ++geom)
    if (model.geom_bodyid[geom] != 0) drive.role[geom] = role_of(model, geom, file);
}

/// Rays look for group 0.
void hide_robot_from_rays(const std::vector<GeomRole>& role, mjModel& model) {
  for (int geom = 0; geom < model.ngeom; ++geom)
    model.geom_group[geom] = role[geom] == GeomRole::scene ? 0 : 1;
}

}  // namespace

DriveModel make_drive_model(const World& world, const std::filesystem::path& robot,
                            double clearance_m) {
  quiet_mujoco();
  const SpecPtr spec = parse_robot(robot);
  pin_options(spec->option);
  stand_on_floor(spec.get(), robot.string());
  const std::vector<Collider> colliders = add_scene_colliders(world, kRobotHeightM, spec.get());
  DriveModel drive;
  drive.model = compile(spec.get(), robot.string());
  find_parts(robot.string(), drive);
  assign_roles(colliders, robot.string(), drive);
  widen_bumps(*drive.model, drive.role, clearance_m, spec.get());
  drive.probe = compile(spec.get(), robot.string());
  hide_robot_from_rays(drive.role, *drive.model);
  hide_robot_from_rays(drive.role, *drive.probe);
  return drive;
}

void stand_upright(const DriveModel& drive, const PlanarPose& place, double z_m, mjData& data) {
  const double half = 0.5 * place.yaw_rad;
  const std::array<double, 7> pose = {place.x_m, place.y_m, z_m,           std::cos(half),
                                      0.0,       0.0,       std::sin(half)};
  std::ranges::copy(pose, data.qpos + drive.base_qpos);
}

}  // namespace mapscore::sim
