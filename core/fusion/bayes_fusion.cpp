// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// Bayes and top-3, which are made of products of distributions. Every distribution adds up to 1,
// kOtherClasses included; an empty one says nothing.

#include "core/fusion/fusion_rule.hpp"

#include <algorithm>
#include <functional>

namespace mapscore {
namespace {

constexpr std::size_t kKeptClasses = 3;

/// No belief falls below it, so that what was once ruled out can come back; the product of two of
/// them is still above 0 in doubles.
constexpr double kLeastBelief = 1e-150;

/// Divides by the sum; kept off 0.
void normalise(ClassBeliefs& beliefs) {
  double sum = 0.0;
  for (const ClassProbability& entry : beliefs.entries()) sum += entry.probability;
  for (ClassProbability& entry : beliefs.entries())
    entry.probability = std::max(entry.probability / sum, kLeastBelief);
}

/// Prior of all classes that the beliefs do not name; exactly 0 when they name all.
double unnamed_prior(const BayesRule& rule, const ClassBeliefs& beliefs) {
  double sum = 0.0;
  auto entry = beliefs.entries().begin();
  for (std::size_t id = 0; id < rule.priors.size(); ++id) {
    if (entry != beliefs.entries().end() && entry->class_id == id)
      ++entry;
    else
      sum += rule.priors[id];
  }
  return sum;
}

/// Names in `beliefs` every class that `other` names, without changing what is believed.
void name_classes_of(const BayesRule& rule, const ClassBeliefs& other, ClassBeliefs& beliefs) {
  const double unnamed = unnamed_prior(rule, beliefs);
  const double others = beliefs.empty() ? 1.0 : beliefs.weight(kOtherClasses);
  bool grown = beliefs.empty();
  for (const ClassProbability& entry : other.entries()) {
    if (entry.class_id == kOtherClasses || beliefs.weight(entry.class_id) > 0.0) continue;
    beliefs.weight_of(entry.class_id) = others * rule.priors[entry.class_id] / unnamed;
    grown = true;
  }
  if (!grown) return;
  const double left = unnamed_prior(rule, beliefs);
  beliefs.weight_of(kOtherClasses) = others * left / unnamed;
  beliefs.forget_below(1e-320);  // nobody is left among the others
}

/// Multiplies entry by entry; both sides name the same classes.
void multiply(const ClassBeliefs& factor, ClassBeliefs& beliefs) {
  for (std::size_t n = 0; n < beliefs.entries().size(); ++n)
    beliefs.entries()[n].probability *= factor.entries()[n].probability;
}

/// Names by weight, greatest first, ties to the lower id; without the others.
std::vector<ClassProbability> by_weight(const ClassBeliefs& beliefs) {
  std::vector<ClassProbability> sorted(beliefs.entries().begin(), beliefs.entries().end());
  std::erase_if(sorted, [](const ClassProbability& e) { return e.class_id == kOtherClasses; });
  std::ranges::stable_sort(sorted, std::greater{}, &ClassProbability::probability);
  return sorted;
}

/// Lines 11 to 20 of the algorithm, for one side.
void split_off(double lambda, const ClassBeliefs& other, ClassBeliefs& beliefs) {
  double rest = beliefs.weight(kOtherClasses);
  for (const ClassProbability& entry : by_weight(other)) {
    if (beliefs.weight(entry.class_id) > 0.0) continue;
    beliefs.weight_of(entry.class_id) = std::max(lambda * rest, kLeastBelief);
    rest *= 1.0 - lambda;
  }
  beliefs.weight_of(kOtherClasses) = std::max(rest, kLeastBelief);
}

/// The rest takes over what is not among the best three.
void keep_best(ClassBeliefs& beliefs) {
  std::vector<ClassProbability> sorted = by_weight(beliefs);
  if (sorted.size() <= kKeptClasses) return;
  double rest = beliefs.weight(kOtherClasses);
  for (std::size_t n = kKeptClasses; n < sorted.size(); ++n) rest += sorted[n].probability;
  sorted.resize(kKeptClasses);
  std::ranges::sort(sorted, {}, &ClassProbability::class_id);
  sorted.push_back({kOtherClasses, rest});
  beliefs = ClassBeliefs(std::move(sorted));
}

/// p(c | z) of one frame: the mean over its draws. A draw that class c won with mean score s says
/// s for c, and 1 - s for the others in proportion to their priors; a draw that missed the voxel
/// says the prior. s is kept within [doubt, 1 - doubt].
ClassBeliefs observed(const BayesRule& rule, std::span<const VoxelHit> hits, int draws) {
  double missed = draws;   // draws that say the prior
  double elsewhere = 0.0;  // what the hits leave for other classes, over their priors
  for (const VoxelHit& hit : hits) {
    const double score = std::clamp(hit.score_sum / hit.draws, rule.doubt, 1.0 - rule.doubt);
    missed -= hit.draws;
    elsewhere += hit.draws * (1.0 - score) / (1.0 - rule.priors[hit.class_id]);
  }
  ClassBeliefs beliefs;
  for (const VoxelHit& hit : hits) {
    const double prior = rule.priors[hit.class_id];
    const double score = std::clamp(hit.score_sum / hit.draws, rule.doubt, 1.0 - rule.doubt);
    const double by_others = elsewhere - hit.draws * (1.0 - score) / (1.0 - prior);
    beliefs.weight_of(hit.class_id) = hit.draws * score + (by_others + missed) * prior;
  }
  const double unnamed = unnamed_prior(rule, beliefs);
  if (unnamed > 0.0) beliefs.weight_of(kOtherClasses) = (elsewhere + missed) * unnamed;
  normalise(beliefs);
  return beliefs;
}

/// The same with equal priors, and no more than its three most probable classes by name.
ClassBeliefs observed(const Top3Rule& rule, std::span<const VoxelHit> hits, int draws) {
  ClassBeliefs beliefs = observed(BayesRule{uniform_priors(rule.classes), rule.doubt}, hits, draws);
  keep_best(beliefs);
  return beliefs;
}

}  // namespace

/// Proportional to a(c) b(c) / p(c), over the classes that either names and the others as one. A
/// class that one side does not name has its share of that side's others by the priors.
ClassBeliefs merged(const BayesRule& rule, const ClassBeliefs& a, const ClassBeliefs& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  ClassBeliefs whole = a, factor = b;
  name_classes_of(rule, b, whole);
  name_classes_of(rule, whole, factor);
  multiply(factor, whole);
  for (ClassProbability& entry : whole.entries())
    entry.probability /=
        entry.class_id == kOtherClasses ? unnamed_prior(rule, whole) : rule.priors[entry.class_id];
  normalise(whole);
  return whole;
}

/// [R, algorithm 1]: classes that one side lacks are split off its rest by lambda, the most
/// probable first; then a(c) b(c), normalised, of which the best three stay.
ClassBeliefs merged(const Top3Rule& rule, const ClassBeliefs& a, const ClassBeliefs& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  ClassBeliefs whole = a, factor = b;
  split_off(rule.lambda, a, factor);
  split_off(rule.lambda, b, whole);
  multiply(factor, whole);
  normalise(whole);
  keep_best(whole);
  return whole;
}

void fuse(const BayesRule& rule, std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs) {
  beliefs = merged(rule, beliefs, observed(rule, hits, draws));
}

void fuse(const Top3Rule& rule, std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs) {
  beliefs = merged(rule, beliefs, observed(rule, hits, draws));
}

}  // namespace mapscore
