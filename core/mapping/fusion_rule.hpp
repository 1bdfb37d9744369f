// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/mapping/class_beliefs.hpp"
#include "core/mapping/voxel_hit.hpp"

#include <span>
#include <variant>
#include <vector>

namespace mapscore {

// How the hits of one frame change what a voxel believes. Every rule in equations: docs/fusion.md.

/// Cells whose old value decays under the blend: those that a draw hit [M], or also all in view.
enum class Decay { hit, view };

/// M_t = K M_{t-1} + (1 - K) / N * (sum of the scores over the draws that the class won)
/// [M, section 3.2]. Keeps one probability a class; they add up to at most 1.
struct BlendRule {
  /// Weight of what the map held before, in [0, 1]; 1 never maps anything, and studies refuse it.
  double K = 0.5;
  Decay decay = Decay::hit;
};

/// Keeps the class of the most confident observation and that confidence, (sum of scores) / N.
struct MaxConfidenceRule {};

/// Counts the draws that each class won; probability is a class's count over all counts.
struct VoteRule {};

/// p(c | z_1..t) proportional to p(c | z_t) / p(c) * p(c | z_1..t-1) [X, eq. 5; R, eq. 3 to 5].
/// Keeps the classes that were ever seen in the voxel, and the others as one, exactly.
struct BayesRule {
  std::vector<double> priors;  ///< p(c) by class id, each above 0, adding up to 1; at least two
  double doubt = 0.05;         ///< scores count as at least this and at most 1 - this
};

/// The three most probable classes and the rest as one; classes that one side lacks are split off
/// its rest by lambda [R, algorithm 1].
struct Top3Rule {
  int classes = 2;      ///< in the class table, background included; at least two
  double lambda = 0.9;  ///< share of the rest that a class split off gets, in (0, 1)
  double doubt = 0.05;  ///< as BayesRule's
};

using FusionRule = std::variant<BlendRule, MaxConfidenceRule, VoteRule, BayesRule, Top3Rule>;

/// The same prior for each of so many classes.
[[nodiscard]] std::vector<double> uniform_priors(int classes);

/// Throws Error naming the parameter that is out of range.
void check(const FusionRule& rule);

/// Changes the beliefs of one voxel by its hits in one frame: ascending by class, at least one,
/// each with 1 to `draws` draws and at most `draws` in all; `draws` is N. Class ids must lie within
/// the rule's classes. Neither rule nor hits are checked here (SemanticMap::fuse does).
void fuse(const BlendRule& rule, std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs);
void fuse(const MaxConfidenceRule& rule, std::span<const VoxelHit> hits, int draws,
          ClassBeliefs& beliefs);
void fuse(const VoteRule& rule, std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs);
void fuse(const BayesRule& rule, std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs);
void fuse(const Top3Rule& rule, std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs);
void fuse(const FusionRule& rule, std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs);

/// Lets what a voxel held before decay: the blend's part of the formula where no draw hit.
void decay(const BlendRule& rule, ClassBeliefs& beliefs);

/// What a voxel of two maps believes, maps of two halves of the frames. Equals the map of all of
/// them under max confidence and vote, under Bayes up to rounding, under top-3 nearly. Throws
/// Error under the blend, which forgets how many frames hit a voxel.
[[nodiscard]] ClassBeliefs merged(const FusionRule& rule, const ClassBeliefs& a,
                                  const ClassBeliefs& b);

/// What an inner node believes: under the blend the mean of its children, else them merged in
/// their order. Children are those that exist; null pointers and empty beliefs say nothing.
[[nodiscard]] ClassBeliefs combined(const FusionRule& rule,
                                    std::span<const ClassBeliefs* const> children);

/// Probability of a class after one frame in which it won every draw with score 1, in a voxel that
/// was never seen. The default threshold of a prediction is half of it.
[[nodiscard]] double first_full_hit(const FusionRule& rule);

}  // namespace mapscore
