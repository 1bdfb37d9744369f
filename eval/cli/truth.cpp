// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/truth_source.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/truth/truth_file.hpp"

#include <fmt/format.h>

#include <iostream>

namespace mapscore::eval {
namespace {

struct TruthFlags {
  std::string source, file;
  LatticeFlags lattice;
  WorkFlags work;
};

void write_truth_of(const TruthFlags& flags) {
  TruthSource source(flags.source, flags.lattice, flags.work);
  LatticeTruth truth;
  if (source.recording())
    truth = source.truth(source.table(), false);
  else
    truth.surface = source.surface();
  const VisibleTruth* visible = source.recording() ? &truth.view.visible : nullptr;
  write_truth(flags.file, truth.surface, visible, source.table());
  std::cout << fmt::format("{:<16} {:>10} {:>10}\n", "class", "surface", "visible");
  for (const SemanticClass& c : source.table().classes)
    std::cout << fmt::format("{:<16} {:>10} {:>10}\n", c.name, truth.surface.count(c.id),
                             visible ? std::to_string(visible->count(c.id)) : "-");
}

}  // namespace

void add_truth(CLI::App& program) {
  const auto [verb, flags] = add_verb<TruthFlags>(
      program, "truth", "Write the voxels that the surfaces really touch", write_truth_of);
  verb->add_option("SOURCE", flags->source,
                   "Scene (MJCF: surfaces alone) or recording (and what it saw)")
      ->required();
  verb->add_option("-o,--output", flags->file, ".csv (i,j,k,class,touch_only,samples) or .ply")
      ->required();
  flags->lattice.add_to(*verb);
  flags->work.add_to(*verb);
  verb->footer(
      "Prints voxels by class: on the surface, and visible to the recording.\n"
      "Examples:\n"
      "  mapscore truth scenes/apartment.xml --voxel_m 0.05 -o truth.ply\n"
      "  mapscore truth results/demo/recordings/apartment-* --voxel_m 0.02 -o truth.csv\n"
      "  mapscore truth /data/apartment --frames 0:50:2 -o half.csv");
}

}  // namespace mapscore::eval
