// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/experiment/lattice_truth.hpp"
#include "eval/experiment/map_frame.hpp"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Flags that say on which lattice the truth is taken.
struct LatticeFlags {
  double voxel_m = 0.05;
  std::vector<double> origin_m{0, 0, 0};
  double yaw_deg = 0.0;
  double epsilon_m = 0.0005;
  int min_samples = 1;

  void add_to(CLI::App& verb, bool with_voxel);
  [[nodiscard]] MapFrame map_frame() const;
};

/// Truth of a scene (surfaces alone) or of a recording (and what its frames saw).
struct SourceTruth {
  ClassTable table;
  LatticeTruth truth;
  bool has_views = false;
};

/// `source`: an MJCF file or a recording's folder. `sampled`: classes whose depth samples are kept
/// for distances, beside the detected ones; without any, none are. Throws Error.
[[nodiscard]] SourceTruth truth_of(const std::string& source, const LatticeFlags& flags,
                                   const std::vector<ClassId>& sampled, int jobs,
                                   std::size_t memory_bytes);

}  // namespace mapscore::eval
