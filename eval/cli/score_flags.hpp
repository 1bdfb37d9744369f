// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/cli/shared/map_score.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/truth_source.hpp"
#include "eval/report/tables/table.hpp"

#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Flags of `score`.
struct ScoreFlags {
  std::vector<std::string> maps;
  MapFlags map;  ///< of the one in work
  std::string truth, format = "text";
  std::vector<std::string> detect;
  std::optional<double> threshold;
  bool align = false, details = false, tidy = false;
  std::string picture, errors_ply;
  ViewFlag view;
  LatticeFlags lattice;
  WorkFlags work;
};

/// The tables of a folder of label images, against those of the truth's recording. Throws Error for
/// flags of voxels, which would do nothing, a truth without images, and images that do not fit.
[[nodiscard]] std::vector<Table> score_label_images(const ScoreFlags& flags, TruthSource& source);

}  // namespace mapscore::eval
