// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/content_hash.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <fstream>
#include <iterator>
#include <memory>

namespace mapscore::sim {
namespace {

std::string hexadecimal(const XXH128_hash_t& digest) {
  return fmt::format("{:016x}{:016x}", digest.high64, digest.low64);
}

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

  std::string hex() const { return hexadecimal(XXH3_128bits_digest(state_.get())); }

 private:
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

void add_geoms(Hash& hash, const mjModel& m) {
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
}

/// Scenes without joints keep the hashes that they had before joints counted.
void add_joints(Hash& hash, const mjModel& m) {
  if (m.njnt == 0) return;
  hash.add(m.jnt_type, m.njnt);
  hash.add(m.jnt_bodyid, m.njnt);
  hash.add(m.jnt_pos, 3 * m.njnt);
  hash.add(m.jnt_axis, 3 * m.njnt);
}

void add_assets(Hash& hash, const mjModel& m) {
  hash.add(m.mesh_vert, 3 * m.nmeshvert);
  hash.add(m.mesh_face, 3 * m.nmeshface);
  hash.add(m.mesh_texcoord, 2 * m.nmeshtexcoord);
  hash.add(m.hfield_size, 4 * m.nhfield);
  hash.add(m.hfield_data, m.nhfielddata);
  hash.add(m.mat_rgba, 4 * m.nmat);
  hash.add(m.mat_texrepeat, 2 * m.nmat);
  hash.add(m.tex_data, m.ntexdata);
}

void add_view(Hash& hash, const mjModel& m) {
  hash.add(m.cam_pos, 3 * m.ncam);
  hash.add(m.cam_quat, 4 * m.ncam);
  hash.add(m.cam_fovy, m.ncam);
  hash.add(m.light_pos, 3 * m.nlight);
  hash.add(m.light_dir, 3 * m.nlight);
  hash.add(m.light_diffuse, 3 * m.nlight);
}

}  // namespace

std::string hash_of_bytes(std::string_view bytes) {
  return hexadecimal(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string content_hash(const mjModel& model, const std::filesystem::path& scene,
                         const std::optional<std::filesystem::path>& classes,
                         const std::filesystem::path& robot) {
  Hash hash;
  hash.add_file(scene);
  if (classes) hash.add_file(*classes);
  if (!robot.empty()) hash.add_file(robot);
  add_geoms(hash, model);
  add_joints(hash, model);
  add_assets(hash, model);
  add_view(hash, model);
  return hash.hex();
}

}  // namespace mapscore::sim
