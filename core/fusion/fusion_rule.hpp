// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/fusion/class_beliefs.hpp"
#include "core/fusion/plugged_rule.hpp"
#include "core/parameters.hpp"
#include "core/placement/placement.hpp"
#include "core/placement/pose_belief.hpp"

#include <array>
#include <concepts>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace mapscore {

// How the hits of one frame change what a voxel believes. Every rule in equations: docs/fusion.md.
//
// The list of fields of a rule has a third argument: `draws()` visits the fields of Draws, which
// every rule has in a study (Drawn), at their place in the file.

/// Cells whose old value decays under the blend: those that a draw hit [M], or also all in view.
enum class Decay { hit, view };
constexpr auto names_of(Decay) {
  return std::to_array<std::string_view>({"hit", "view"});
}

/// M_t = K M_{t-1} + (1 - K) / N * (sum of the scores over the draws that the class won)
/// [M, section 3.2]. Keeps one probability a class; they add up to at most 1.
struct BlendRule {
  static constexpr std::string_view kKind = "blend";
  static constexpr std::string_view kMeaning =
      "weighted mean of the map and the draws of an observation";
  double K = 0.5;
  Decay decay = Decay::hit;

  static void fields(auto& s, auto&& visit, auto&& draws) {
    visit(s.K, Field{"K",
                     "weight of what the map held before",
                     {.low = 0, .high = 1, .open_high = true},
                     "K"});
    draws();
    visit(s.decay,
          Field{.key = "decay",
                .meaning = "voxels whose old value decays: those that a draw hit, or all in view",
                .later = true});
  }
  bool operator==(const BlendRule&) const = default;
};

/// Keeps the class of the most confident observation and that confidence, (sum of scores) / N.
struct MaxConfidenceRule {
  static constexpr std::string_view kKind = "max_confidence";
  static constexpr std::string_view kMeaning = "the class of the most confident observation";

  static void fields(auto&, auto&&, auto&& draws) { draws(); }
  bool operator==(const MaxConfidenceRule&) const = default;
};

/// Counts the draws that each class won; probability is a class's count over all counts.
struct VoteRule {
  static constexpr std::string_view kKind = "vote";
  static constexpr std::string_view kMeaning = "the class that won most draws of all observations";

  static void fields(auto&, auto&&, auto&& draws) { draws(); }
  bool operator==(const VoteRule&) const = default;
};

/// Scores of 0 and 1 would never be forgotten.
inline constexpr Field kDoubt{"doubt",
                              "scores count as at least this and at most 1 - this",
                              {.low = 0, .high = 0.5, .open_low = true, .open_high = true}};

/// p(c | z_1..t) proportional to p(c | z_t) / p(c) * p(c | z_1..t-1) [X, eq. 5; R, eq. 3 to 5].
/// Keeps the classes that were ever seen in the voxel, and the others as one, exactly.
struct BayesRule {
  static constexpr std::string_view kKind = "bayes";
  static constexpr std::string_view kMeaning = "recursive label update with class priors";
  /// p(c) by class id, each above 0, adding up to 1; at least two. In a study: of the detected
  /// classes alone, and none where all are equal (of_classes).
  std::vector<double> priors;
  double doubt = 0.05;

  static void fields(auto& s, auto&& visit, auto&& draws) {
    draws();
    visit(s.doubt, kDoubt);
    UnlessEmpty priors{s.priors};
    visit(priors,
          Field{"priors",
                "of each detected class in the order of ids, adding up to less than 1; the other "
                "classes share what is left; default: all classes equal",
                {.low = 0, .high = 1, .open_low = true, .open_high = true}});
  }
  bool operator==(const BayesRule&) const = default;
};

/// The three most probable classes and the rest as one; classes that one side lacks are split off
/// its rest by lambda [R, algorithm 1].
struct Top3Rule {
  static constexpr std::string_view kKind = "top3";
  static constexpr std::string_view kMeaning = "the three most probable classes, the rest as one";
  int classes = 2;  ///< in the class table, background included; at least two
  double lambda = 0.9;
  double doubt = 0.05;

  static void fields(auto& s, auto&& visit, auto&& draws) {
    draws();
    visit(s.doubt, kDoubt);
    visit(s.lambda, Field{"lambda",
                          "share of the rest that a class split off it gets",
                          {.low = 0, .high = 1, .open_low = true, .open_high = true}});
  }
  bool operator==(const Top3Rule&) const = default;
};

using FusionRule =
    std::variant<BlendRule, MaxConfidenceRule, VoteRule, BayesRule, Top3Rule, PluggedRule>;

/// A rule with the draws that it fuses, as a study has it.
template <class Rule>
struct Drawn {
  // References, since those of a rule that a program adds are set before `main`.
  static constexpr const std::string_view &kKind = Rule::kKind, &kMeaning = Rule::kMeaning;
  Rule rule;
  Draws draws;

  static void fields(auto& s, auto&& visit) {
    Rule::fields(s.rule, visit, [&] { Draws::fields(s.draws, visit); });
  }
  bool operator==(const Drawn&) const = default;
};

template <class Rules>
struct DrawnOf;
template <class... Rules>
struct DrawnOf<std::variant<Rules...>> {
  using Type = std::variant<Drawn<Rules>...>;
  template <class First>
  using With = std::variant<First, Drawn<Rules>...>;
};
/// Any rule with its draws.
using DrawnFusion = DrawnOf<FusionRule>::Type;

/// The same prior for each of so many classes.
[[nodiscard]] std::vector<double> uniform_priors(int classes);

/// How the observations of a map are drawn and fused.
struct Fusion {
  FusionRule rule;
  Draws draws;
};

/// A study's fusion, for the classes of a table: priors of the detected classes become those of all
/// classes, of which the others share what is left in equal parts. Throws Error where the priors do
/// not fit the table.
[[nodiscard]] Fusion for_classes(const DrawnFusion& fusion, const ClassTable& table);

/// Throws Error naming the parameter that is out of range.
void check(const FusionRule& rule);

/// Throws Error when the rule is out of range, `draws` < 1, or hits are not ascending by voxel and
/// class, have no draws or more than `draws` in a voxel, a sum of scores outside [0, draws], or a
/// class beyond `class_count` or the rule's own classes.
void check_fusion(std::span<const VoxelHit> hits, int draws, const FusionRule& rule,
                  std::size_t class_count);

/// Changes the beliefs of one voxel by its hits in one frame: ascending by class, at least one,
/// each with 1 to `draws` draws and at most `draws` in all; `draws` is N. Class ids must lie within
/// the rule's classes. Neither rule nor hits are checked here (SemanticMap::fuse does).
void fuse(const BlendRule& rule, std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs);
void fuse(const MaxConfidenceRule& rule, std::span<const VoxelHit> hits, int draws,
          ClassBeliefs& beliefs);
void fuse(const VoteRule& rule, std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs);
void fuse(const BayesRule& rule, std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs);
void fuse(const Top3Rule& rule, std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs);
/// Throws Error when the rule's weights are not those of ClassBeliefs.
void fuse(const PluggedRule& rule, std::span<const VoxelHit> hits, int draws,
          ClassBeliefs& beliefs);
/// By its kind. Takes no kind by itself, so that one without a form of its own does not compile.
template <std::same_as<FusionRule> Rule>
void fuse(const Rule& rule, std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs) {
  std::visit([&](const auto& kind) { fuse(kind, hits, draws, beliefs); }, rule);
}

/// Lets what a voxel held before decay: the blend's part of the formula where no draw hit.
void decay(const BlendRule& rule, ClassBeliefs& beliefs);

/// What a voxel of two maps believes, maps of two halves of the frames. Equals the map of all of
/// them under max confidence and vote, under Bayes up to rounding, under top-3 nearly. Throws
/// Error under the blend, which forgets how many frames hit a voxel.
[[nodiscard]] ClassBeliefs merged(const BlendRule& rule, const ClassBeliefs& a,
                                  const ClassBeliefs& b);
[[nodiscard]] ClassBeliefs merged(const MaxConfidenceRule& rule, const ClassBeliefs& a,
                                  const ClassBeliefs& b);
[[nodiscard]] ClassBeliefs merged(const VoteRule& rule, const ClassBeliefs& a,
                                  const ClassBeliefs& b);
[[nodiscard]] ClassBeliefs merged(const BayesRule& rule, const ClassBeliefs& a,
                                  const ClassBeliefs& b);
[[nodiscard]] ClassBeliefs merged(const Top3Rule& rule, const ClassBeliefs& a,
                                  const ClassBeliefs& b);
[[nodiscard]] inline ClassBeliefs merged(const PluggedRule& rule, const ClassBeliefs& a,
                                         const ClassBeliefs& b) {
  return (*rule).merged(a, b);
}
template <std::same_as<FusionRule> Rule>
[[nodiscard]] ClassBeliefs merged(const Rule& rule, const ClassBeliefs& a, const ClassBeliefs& b) {
  return std::visit([&](const auto& kind) { return merged(kind, a, b); }, rule);
}

/// What an inner node believes: under the blend the mean of its children, else them merged in
/// their order. Children are those that exist; null pointers and empty beliefs say nothing.
[[nodiscard]] ClassBeliefs combined(const FusionRule& rule,
                                    std::span<const ClassBeliefs* const> children);

/// Probability of a class after one frame in which it won every draw with score 1, in a voxel that
/// was never seen.
[[nodiscard]] double first_full_hit(const FusionRule& rule);

/// Least probability of a predicted voxel where none is given: half of what a first full hit gives.
[[nodiscard]] inline double default_threshold(const FusionRule& rule) {
  return first_full_hit(rule) / 2.0;
}

}  // namespace mapscore
