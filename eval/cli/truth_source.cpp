// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/truth_source.hpp"

#include "core/error.hpp"
#include "eval/cli/options.hpp"
#include "eval/experiment/study_recording.hpp"

#include <numbers>

namespace mapscore::eval {

void LatticeFlags::add_to(CLI::App& verb, bool with_voxel) {
  if (with_voxel)
    verb.add_option("--voxel_m", voxel_m, "Voxel edge in metres [0.05]")
        ->check(finite_within(1e-4, 100.0));
  verb.add_option("--origin_m", origin_m, "Origin of the map frame in the world: x y z [0 0 0]")
      ->expected(3)
      ->check(finite_within(-1e6, 1e6));
  verb.add_option("--yaw_deg", yaw_deg, "Heading of the map frame in the world [0]")
      ->check(finite_within(-360, 360));
  verb.add_option("--epsilon_m", epsilon_m, "How far a cube is widened on each side [0.0005]")
      ->check(finite_within(0.0, 1.0));
  verb.add_option("--min_samples", min_samples, "Depth samples that make a voxel visible [1]")
      ->check(CLI::Range(1, 1000000));
}

MapFrame LatticeFlags::map_frame() const {
  return {voxel_m,
          {origin_m.at(0), origin_m.at(1), origin_m.at(2)},
          yaw_deg * std::numbers::pi / 180.0};
}

SourceTruth truth_of(const std::string& source, const LatticeFlags& flags,
                     const std::vector<ClassId>& sampled, int jobs, std::size_t memory_bytes) {
  const TruthOptions options{flags.epsilon_m, flags.min_samples, false, !sampled.empty()};
  if (std::filesystem::path(source).extension() == ".xml") {
    SceneSurfaces scene = surfaces_of_scene(source);
    LatticeTruth truth =
        make_surface_truth(scene.shapes, scene.table, flags.map_frame(), options, jobs);
    return {std::move(scene.table), std::move(truth), false};
  }
  const Recording recording = Recording::open(source);
  if (!recording.info().has_truth)
    throw Error(source +
                ": the recording has no truth/; only maps of rendered recordings can be scored");
  FrameCache frames(recording, {.color = false, .label = false, .depth = true, .depth_label = true},
                    memory_bytes);
  ClassTable table = recording.info().table;  // samples are kept of its detected classes
  for (const ClassId id : sampled) table.classes.at(id).detect = true;
  LatticeTruth truth =
      make_lattice_truth(recording, table, frames, flags.map_frame(), options, jobs);
  return {recording.info().table, std::move(truth), true};
}

}  // namespace mapscore::eval
