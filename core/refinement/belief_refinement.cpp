// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/refinement/belief_refinement.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <string>

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
  const auto labels = static_cast<Eigen::Index>(task.classes.size());
  Eigen::VectorXd column = Eigen::VectorXd::Zero(labels + (rest == CrfRest::label ? 1 : 0));
  for (const ClassProbability& entry : beliefs.entries()) {
    if (!is_named(entry)) continue;
    const auto at = std::ranges::lower_bound(task.classes, entry.class_id);
    column[at - task.classes.begin()] = entry.probability / beliefs.divisor();
  }
  if (rest == CrfRest::label) column[labels] = 1.0 - share;
  return (column / column.sum()).cast<float>();
}

CrfTask task_of(std::span<const Eigen::Vector3d> centres_m, std::span<const Colour> colours,
                std::span<const ClassBeliefs> beliefs, CrfRest rest) {
  CrfTask task;
  task.classes = named_classes(beliefs);
  for (std::size_t i = 0; i < beliefs.size(); ++i) {
    const double share = named_share(beliefs[i]);
    if (task.classes.empty() || (rest == CrfRest::apart && share <= 0.0)) continue;
    task.voxel_of.push_back(i);
    task.share.push_back(rest == CrfRest::apart ? share : 1.0);
    task.voxels.centres_m.push_back(centres_m[i]);
    if (!colours.empty()) task.voxels.colours.push_back(colours[i]);
  }
  const auto labels =
      static_cast<Eigen::Index>(task.classes.size()) + (rest == CrfRest::label ? 1 : 0);
  task.voxels.probability.resize(labels, static_cast<Eigen::Index>(task.voxel_of.size()));
  for (std::size_t column = 0; column < task.voxel_of.size(); ++column) {
    const ClassBeliefs& voxel = beliefs[task.voxel_of[column]];
    task.voxels.probability.col(static_cast<Eigen::Index>(column)) =
        column_of(voxel, task, named_share(voxel), rest);
  }
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

void check_sizes(std::size_t centres, std::size_t colours, std::size_t beliefs) {
  if (centres != beliefs || (colours != 0 && colours != beliefs))
    throw Error("crf: " + std::to_string(centres) + " centres and " + std::to_string(colours) +
                " colours for " + std::to_string(beliefs) + " voxels; give one each a voxel");
}

}  // namespace

std::vector<ClassBeliefs> refine_beliefs(std::span<const Eigen::Vector3d> centres_m,
                                         std::span<const Colour> colours,
                                         std::span<const ClassBeliefs> beliefs, const Crf& crf,
                                         int jobs) {
  check_sizes(centres_m.size(), colours.size(), beliefs.size());
  const CrfTask task = task_of(centres_m, colours, beliefs, crf.rest);
  const CrfResult result = refine(task.voxels, crf, jobs);
  std::vector<ClassBeliefs> refined(beliefs.begin(), beliefs.end());
  for (std::size_t column = 0; column < task.voxel_of.size(); ++column) {
    ClassBeliefs& voxel = refined[task.voxel_of[column]];
    const auto entries = voxel.entries();
    const bool names_others = !entries.empty() && !is_named(entries.back());
    voxel = beliefs_of(task, result.probability.col(static_cast<Eigen::Index>(column)),
                       task.share[column], names_others);
  }
  return refined;
}

}  // namespace mapscore
