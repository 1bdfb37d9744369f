// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/refinement/map_refinement.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace mapscore {
namespace {

constexpr double kLeastKept = 1e-6;

bool is_named(const ClassProbability& entry) {
  return entry.class_id != kOtherClasses;
}

/// Probability of all classes that the voxel names, in [0, 1].
double named_share(const ClassBeliefs& beliefs) {
  double sum = 0.0;
  for (const ClassProbability& entry : beliefs.entries())
    if (is_named(entry)) sum += entry.probability;
  return std::clamp(sum / beliefs.divisor(), 0.0, 1.0);
}

/// Every class that some voxel names, ascending.
std::vector<ClassId> named_classes(std::span<const ClassBeliefs> beliefs) {
  std::vector<ClassId> classes;
  std::vector<bool> known(kOtherClasses);
  for (const ClassBeliefs& voxel : beliefs)
    for (const ClassProbability& entry : voxel.entries())
      if (is_named(entry)) known[entry.class_id] = true;
  for (std::size_t c = 0; c < known.size(); ++c)
    if (known[c]) classes.push_back(static_cast<ClassId>(c));
  return classes;
}

/// Which voxels take part, and what the CRF is given of them.
struct CrfTask {
  std::vector<ClassId> classes;
  std::vector<std::size_t> voxel_of;  ///< by column
  std::vector<double> share;          ///< by column: what the columns' labels add up to
  CrfVoxels voxels;
};

Eigen::VectorXf column_of(const ClassBeliefs& beliefs, const CrfTask& task, double share,
                          CrfRest rest) {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(task.voxels.probability.rows());
  for (const ClassProbability& entry : beliefs.entries()) {
    if (!is_named(entry)) continue;
    const auto at = std::ranges::lower_bound(task.classes, entry.class_id);
    column[at - task.classes.begin()] = entry.probability / beliefs.divisor();
  }
  if (rest == CrfRest::label) column[column.size() - 1] = 1.0 - share;
  return (column / column.sum()).cast<float>();
}

CrfTask task_of(std::span<const VoxelKey> keys, double voxel_m, std::span<const Colour> colours,
                std::span<const ClassBeliefs> beliefs, CrfRest rest) {
  CrfTask task;
  task.voxels.voxel_m = voxel_m;
  task.classes = named_classes(beliefs);
  const std::size_t labels = task.classes.size() + (rest == CrfRest::label ? 1 : 0);
  Eigen::MatrixXf& columns = task.voxels.probability;
  columns.resize(static_cast<Eigen::Index>(labels), static_cast<Eigen::Index>(beliefs.size()));
  for (std::size_t i = 0; i < beliefs.size(); ++i) {
    const double share = named_share(beliefs[i]);
    if (task.classes.empty() || (rest == CrfRest::apart && share <= 0.0)) continue;
    columns.col(static_cast<Eigen::Index>(task.voxel_of.size())) =
        column_of(beliefs[i], task, share, rest);
    task.voxel_of.push_back(i);
    task.share.push_back(rest == CrfRest::apart ? share : 1.0);
    task.voxels.keys.push_back(keys[i]);
    if (!colours.empty()) task.voxels.colours.push_back(colours[i]);
  }
  columns.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(task.voxel_of.size()));
  return task;
}

/// The voxel's beliefs by the labels' new probabilities, which add up to `share`.
ClassBeliefs beliefs_of(const CrfTask& task, const Eigen::VectorXf& q, double share,
                        bool names_others) {
  std::vector<ClassProbability> entries;
  double sum = 0.0;
  for (std::size_t c = 0; c < task.classes.size(); ++c) {
    const double p = share * static_cast<double>(q[static_cast<Eigen::Index>(c)]);
    if (p < kLeastKept) continue;
    entries.push_back({task.classes[c], p});
    sum += p;
  }
  for (ClassProbability& entry : entries) entry.probability /= std::max(1.0, sum);  // rounding
  if (names_others) entries.push_back({kOtherClasses, std::max(0.0, 1.0 - sum)});
  return ClassBeliefs(std::move(entries));
}

/// Mean of the colours that are there; black without any.
Colour mean_colour(const std::vector<BelievedVoxel>& voxels) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const BelievedVoxel& voxel : voxels) {
    if (!voxel.colour) continue;
    sum += Eigen::Vector3d(voxel.colour->r, voxel.colour->g, voxel.colour->b);
    count += 1.0;
  }
  if (count == 0.0) return {0, 0, 0};
  const auto channel = [&](int n) {
    return static_cast<std::uint8_t>(std::lround(sum[n] / count));
  };
  return {channel(0), channel(1), channel(2)};
}

}  // namespace

std::vector<ClassBeliefs> refine_beliefs(std::span<const VoxelKey> keys, double voxel_m,
                                         std::span<const Colour> colours,
                                         std::span<const ClassBeliefs> beliefs, const Crf& crf,
                                         int jobs) {
  if (keys.size() != beliefs.size() || (!colours.empty() && colours.size() != beliefs.size()))
    throw Error("crf: " + std::to_string(keys.size()) + " keys and " +
                std::to_string(colours.size()) + " colours for " + std::to_string(beliefs.size()) +
                " voxels; give one each a voxel");
  const CrfTask task = task_of(keys, voxel_m, colours, beliefs, crf.rest);
  const CrfResult result = refine(task.voxels, crf, jobs);
  std::vector<ClassBeliefs> refined(beliefs.begin(), beliefs.end());
  for (std::size_t column = 0; column < task.voxel_of.size(); ++column) {
    if (result.alone[column]) continue;
    ClassBeliefs& voxel = refined[task.voxel_of[column]];
    const auto entries = voxel.entries();
    const bool names_others = !entries.empty() && !is_named(entries.back());
    voxel = beliefs_of(task, result.probability.col(static_cast<Eigen::Index>(column)),
                       task.share[column], names_others);
  }
  return refined;
}

void refine(SemanticMap& map, const Crf& crf, int jobs) {
  std::vector<BelievedVoxel> voxels = map.believed_voxels();
  const Colour elsewhere = mean_colour(voxels);
  std::vector<VoxelKey> keys;
  std::vector<Colour> colours;
  std::vector<ClassBeliefs> beliefs;
  for (BelievedVoxel& voxel : voxels) {
    keys.push_back(voxel.key);
    colours.push_back(voxel.colour.value_or(elsewhere));
    beliefs.push_back(std::move(voxel.beliefs));
  }
  std::vector<ClassBeliefs> refined =
      refine_beliefs(keys, map.edge_m(), colours, beliefs, crf, jobs);
  for (std::size_t n = 0; n < voxels.size(); ++n)
    map.set_beliefs(voxels[n].key, std::move(refined[n]));
}

}  // namespace mapscore
