// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/fusion/fusion_rule.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>
#include <type_traits>

namespace mapscore {
namespace {

/// Below this a decayed class is forgotten; no threshold in use comes near it.
constexpr double kForgotten = 1e-6;

void check_classes(const auto&) {}
void check_classes(const BayesRule& rule) {
  if (rule.priors.size() < 2 || rule.priors.size() >= kOtherClasses)
    throw Error("priors: need one for each class of the table, at least two");
  for (const double prior : rule.priors)
    if (!(prior > 0.0 && prior < 1.0))
      throw Error(
          "priors: each must lie above 0 and below 1; a class of prior 0 is never believed");
  const double sum = std::accumulate(rule.priors.begin(), rule.priors.end(), 0.0);
  if (std::abs(sum - 1.0) > 1e-9) throw Error("priors: must add up to 1; divide them by their sum");
}
void check_classes(const Top3Rule& rule) {
  if (rule.classes < 2 || rule.classes >= kOtherClasses)
    throw Error("classes: need at least two in the class table");
}

/// Whether a is the class to keep of two: the more confident, ties to the lower id.
bool surer(const ClassProbability& a, const ClassProbability& b) {
  return a.probability != b.probability ? a.probability > b.probability : a.class_id < b.class_id;
}

void keep_surer(const ClassProbability& candidate, ClassBeliefs& beliefs) {
  if (beliefs.empty() || surer(candidate, beliefs.entries().front()))
    beliefs = ClassBeliefs({candidate});
}

ClassBeliefs mean_of(std::span<const ClassBeliefs* const> children) {
  ClassBeliefs mean;
  int count = 0;
  for (const ClassBeliefs* child : children) {
    if (child == nullptr || child->empty()) continue;
    ++count;
    for (const ClassProbability& entry : child->entries())
      mean.weight_of(entry.class_id) += entry.probability;
  }
  for (ClassProbability& entry : mean.entries()) entry.probability /= count;
  return mean;
}

/// By class id: the given ones for detected classes, the rest in equal shares for the others.
std::vector<double> priors_of(const std::vector<double>& given, const ClassTable& table) {
  const auto detected = static_cast<std::size_t>(
      std::ranges::count_if(table.classes, [](const SemanticClass& c) { return c.detect; }));
  if (given.size() != detected)
    throw Error("fusion.bayes.priors: has " + std::to_string(given.size()) + " numbers, but " +
                std::to_string(detected) + " classes are detected; write one for each");
  const double rest = 1.0 - std::accumulate(given.begin(), given.end(), 0.0);
  if (!(rest > 0.0))
    throw Error(
        "fusion.bayes.priors: add up to 1 or more; leave a share for the classes that are not "
        "detected");
  std::vector<double> priors;
  auto next = given.begin();
  const auto others = static_cast<double>(table.classes.size() - detected);
  for (const SemanticClass& c : table.classes) priors.push_back(c.detect ? *next++ : rest / others);
  return priors;
}

/// Sums of scores of 1 or a little less are rounded up by no more.
constexpr double kRounding = 1e-9;

std::size_t classes_of(const FusionRule& rule, std::size_t class_count) {
  if (const auto* bayes = std::get_if<BayesRule>(&rule))
    return std::min(class_count, bayes->priors.size());
  if (const auto* top3 = std::get_if<Top3Rule>(&rule))
    return std::min(class_count, static_cast<std::size_t>(top3->classes));
  return class_count;
}

void check_hit(const VoxelHit& hit, std::size_t classes) {
  if (hit.class_id >= classes)
    throw Error("hits: class " + std::to_string(hit.class_id) + " is beyond the table of " +
                std::to_string(classes) + " classes; map with the table of the detections");
  if (hit.draws < 1) throw Error("hits: a class is listed that won no draw; leave it out");
  if (!(hit.score_sum >= 0.0 && hit.score_sum <= hit.draws * (1.0 + kRounding)))
    throw Error("hits: the scores of a class do not lie in (0, 1]; give detections such scores");
}

}  // namespace

std::vector<double> uniform_priors(int classes) {
  if (classes < 2) throw Error("classes: need at least two in the class table");
  return std::vector<double>(static_cast<std::size_t>(classes), 1.0 / classes);
}

Fusion for_classes(const DrawnFusion& fusion, const ClassTable& table) {
  Fusion fitted = std::visit(
      [](const auto& kind) {
        return Fusion{kind.rule, kind.draws};
      },
      fusion);
  const auto classes = static_cast<int>(table.classes.size());
  if (auto* top3 = std::get_if<Top3Rule>(&fitted.rule)) top3->classes = classes;
  if (auto* bayes = std::get_if<BayesRule>(&fitted.rule))
    bayes->priors =
        bayes->priors.empty() ? uniform_priors(classes) : priors_of(bayes->priors, table);
  return fitted;
}

void check(const FusionRule& rule) {
  std::visit(
      [](const auto& kind) {
        check_ranges(Drawn<std::remove_cvref_t<decltype(kind)>>{kind, {}});
        check_classes(kind);
      },
      rule);
}

void check_fusion(std::span<const VoxelHit> hits, int draws, const FusionRule& rule,
                  std::size_t class_count) {
  check(rule);
  if (draws < 1) throw Error("N: the number of draws must be at least 1");
  const std::size_t classes = classes_of(rule, class_count);
  int in_voxel = 0;
  for (std::size_t n = 0; n < hits.size(); ++n) {
    check_hit(hits[n], classes);
    const bool same = n > 0 && hits[n].key == hits[n - 1].key;
    in_voxel = (same ? in_voxel : 0) + hits[n].draws;
    if (in_voxel > draws)
      throw Error("N: a voxel was hit by more than N draws; give the N that it was placed with");
    if (n > 0 &&
        std::tie(hits[n - 1].key, hits[n - 1].class_id) >= std::tie(hits[n].key, hits[n].class_id))
      throw Error("hits: must ascend by voxel, then class; give them as placed");
  }
}

void decay(const BlendRule& rule, ClassBeliefs& beliefs) {
  for (ClassProbability& entry : beliefs.entries()) entry.probability *= rule.K;
  beliefs.forget_below(kForgotten);
}

void fuse(const BlendRule& rule, std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs) {
  for (ClassProbability& entry : beliefs.entries()) entry.probability *= rule.K;
  for (const VoxelHit& hit : hits)
    beliefs.weight_of(hit.class_id) += (1.0 - rule.K) * hit.score_sum / draws;
  beliefs.forget_below(kForgotten);
}

void fuse(const MaxConfidenceRule&, std::span<const VoxelHit> hits, int draws,
          ClassBeliefs& beliefs) {
  for (const VoxelHit& hit : hits) keep_surer({hit.class_id, hit.score_sum / draws}, beliefs);
}

void fuse(const VoteRule&, std::span<const VoxelHit> hits, int, ClassBeliefs& beliefs) {
  for (const VoxelHit& hit : hits) beliefs.weight_of(hit.class_id) += hit.draws;
}

void fuse(const PluggedRule& rule, std::span<const VoxelHit> hits, int draws,
          ClassBeliefs& beliefs) {
  (*rule).fuse(hits, draws, beliefs);
  if (!beliefs.well_formed())
    throw Error(std::string(PluggedRule::kKind) +
                ": gave a voxel weights that are negative or not finite, or classes out of order; "
                "change them by weight_of");
}

ClassBeliefs merged(const BlendRule&, const ClassBeliefs&, const ClassBeliefs&) {
  throw Error(
      "blend: maps made by it cannot be merged, since each frame outweighs those before it; map "
      "all frames in one run, or use another fusion rule");
}

ClassBeliefs merged(const MaxConfidenceRule&, const ClassBeliefs& a, const ClassBeliefs& b) {
  ClassBeliefs sum = a;
  for (const ClassProbability& entry : b.entries()) keep_surer(entry, sum);
  return sum;
}

ClassBeliefs merged(const VoteRule&, const ClassBeliefs& a, const ClassBeliefs& b) {
  ClassBeliefs sum = a;
  for (const ClassProbability& entry : b.entries())
    sum.weight_of(entry.class_id) += entry.probability;
  return sum;
}

ClassBeliefs combined(const FusionRule& rule, std::span<const ClassBeliefs* const> children) {
  if (std::holds_alternative<BlendRule>(rule)) return mean_of(children);
  ClassBeliefs whole;
  for (const ClassBeliefs* child : children)
    if (child != nullptr && !child->empty()) whole = merged(rule, whole, *child);
  return whole;
}

double first_full_hit(const FusionRule& rule) {
  if (const auto* blend = std::get_if<BlendRule>(&rule)) return 1.0 - blend->K;
  ClassBeliefs beliefs;
  fuse(rule, std::vector<VoxelHit>{{{}, kBackground, 1, 1.0}}, 1, beliefs);
  return beliefs.weight(kBackground);
}

}  // namespace mapscore
