// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/compiled_scene.hpp"

#include "core/error.hpp"
#include "sim/world/scene_builder.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <fstream>
#include <iterator>

namespace mapscore::sim {
namespace {

class Hash {
 public:
  Hash() : state_(XXH3_createState(), XXH3_freeState) { XXH3_128bits_reset(state_.get()); }

  /// Adds `count` values; the count goes in as well, so that neighbours cannot trade values.
  template <typename T>
  void add(const T* values, std::size_t count) {
    const std::uint64_t bytes = count * sizeof(T);
    XXH3_128bits_update(state_.get(), &bytes, sizeof bytes);
    if (bytes > 0) XXH3_128bits_update(state_.get(), values, bytes);
  }

  void add_file(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw Error(fmt::format("{}: cannot be read; check the path", file.string()));
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    add(bytes.data(), bytes.size());
  }

  std::string hex() const {
    const XXH128_hash_t digest = XXH3_128bits_digest(state_.get());
    return fmt::format("{:016x}{:016x}", digest.high64, digest.low64);
  }

 private:
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

void add_model(Hash& hash, const mjModel& m) {
  hash.add(m.names, m.nnames);
  hash.add(m.body_parentid, m.nbody);
  hash.add(m.body_pos, 3 * m.nbody);
  hash.add(m.body_quat, 4 * m.nbody);
  hash.add(m.qpos0, m.nq);
  hash.add(m.geom_type, m.ngeom);
  hash.add(m.geom_bodyid, m.ngeom);
  hash.add(m.geom_dataid, m.ngeom);
  hash.add(m.geom_matid, m.ngeom);
  hash.add(m.geom_group, m.ngeom);
  hash.add(m.geom_size, 3 * m.ngeom);
  hash.add(m.geom_pos, 3 * m.ngeom);
  hash.add(m.geom_quat, 4 * m.ngeom);
  hash.add(m.geom_rgba, 4 * m.ngeom);
  if (m.njnt > 0) {  // scenes without joints keep the hashes that they had before joints counted
    hash.add(m.jnt_type, m.njnt);
    hash.add(m.jnt_bodyid, m.njnt);
    hash.add(m.jnt_pos, 3 * m.njnt);
    hash.add(m.jnt_axis, 3 * m.njnt);
  }
  hash.add(m.mesh_vert, 3 * m.nmeshvert);
  hash.add(m.mesh_face, 3 * m.nmeshface);
  hash.add(m.mesh_texcoord, 2 * m.nmeshtexcoord);
  hash.add(m.hfield_size, 4 * m.nhfield);
  hash.add(m.hfield_data, m.nhfielddata);
  hash.add(m.mat_rgba, 4 * m.nmat);
  hash.add(m.mat_texrepeat, 2 * m.nmat);
  hash.add(m.tex_data, m.ntexdata);
  hash.add(m.cam_pos, 3 * m.ncam);
  hash.add(m.cam_quat, 4 * m.ncam);
  hash.add(m.cam_fovy, m.ncam);
  hash.add(m.light_pos, 3 * m.nlight);
  hash.add(m.light_dir, 3 * m.nlight);
  hash.add(m.light_diffuse, 3 * m.nlight);
}

}  // namespace

void place(const mjModel& model, mjData& data) {
  mj_kinematics(&model, &data);
  mj_comPos(&model, &data);
  mj_camlight(&model, &data);
}

void place_at(const Motion& motion, double stamp_s, const mjModel& model, mjData& data) {
  const std::vector<double> values = motion.at(stamp_s);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int joint = mj_name2id(&model, mjOBJ_JOINT, motion.joints[i].c_str());
    data.qpos[model.jnt_qposadr[joint]] = values[i];
  }
  place(model, data);
}

DrawnScene solid_scene(const mjModel& model, mjData& data, const Ownership& ownership,
                       const std::vector<bool>& robot_body) {
  DrawnScene drawn = visible_scene(model, data);
  std::erase_if(drawn.geoms, [&](mjvGeom& geom) {
    const int body = model.geom_bodyid[geom.objid];
    if (ownership.opaque(body)) geom.rgba[3] = 1.0f;
    return robot_body[body] || geom.rgba[3] < 1.0f;
  });
  return drawn;
}

DrawnScene faceted_scene(const CompiledScene& scene, mjData& data, const std::vector<Shape>& shapes,
                         const std::vector<Pose>& T_world_shape) {
  DrawnScene drawn = solid_scene(*scene.model, data, scene.ownership, scene.robot_body);
  for (mjvGeom& geom : drawn.geoms) geom.segid = scene.assignment.geom_instances[geom.objid];
  draw_by_facets(*scene.model, shapes, T_world_shape, drawn);
  return drawn;
}

std::string content_hash(const mjModel& model, const std::filesystem::path& scene,
                         const std::optional<std::filesystem::path>& classes,
                         const std::filesystem::path& robot) {
  Hash hash;
  hash.add_file(scene);
  if (classes) hash.add_file(*classes);
  if (!robot.empty()) hash.add_file(robot);
  add_model(hash, model);
  return hash.hex();
}

}  // namespace mapscore::sim
