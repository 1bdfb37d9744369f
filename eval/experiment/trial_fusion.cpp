// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/trial_fusion.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <type_traits>

namespace mapscore::eval {
namespace {

int class_count(const ClassTable& table) {
  return static_cast<int>(table.classes.size());
}

/// By class id: the given ones for detected classes, the rest in equal shares for the others.
std::vector<double> priors_of(const std::vector<double>& given, const ClassTable& table) {
  const auto detected = static_cast<std::size_t>(
      std::ranges::count_if(table.classes, [](const SemanticClass& c) { return c.detect; }));
  if (given.size() != detected)
    throw Error(fmt::format(
        "fusion.bayes.priors: has {} numbers, but {} classes are detected; write one for each",
        given.size(), detected));
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

FusionRule rule_of(const BlendSettings& s, const ClassTable&) {
  return BlendRule{s.K, s.decay};
}
FusionRule rule_of(const MaxConfidenceSettings&, const ClassTable&) {
  return MaxConfidenceRule{};
}
FusionRule rule_of(const VoteSettings&, const ClassTable&) {
  return VoteRule{};
}
FusionRule rule_of(const BayesSettings& s, const ClassTable& table) {
  return BayesRule{s.priors ? priors_of(*s.priors, table) : uniform_priors(class_count(table)),
                   s.doubt};
}
FusionRule rule_of(const Top3Settings& s, const ClassTable& table) {
  return Top3Rule{class_count(table), s.lambda, s.doubt};
}

}  // namespace

TrialFusion trial_fusion(const FusionSettings& settings, const ClassTable& table) {
  return std::visit(
      [&](const auto& kind) {
        return TrialFusion{rule_of(kind, table), kind.N, kind.noise_at, kind.covariance};
      },
      settings);
}

FusionSettings fusion_of(const FusionSettings& of_study, const MethodFusionSettings& of_method) {
  return std::visit(
      [&](const auto& kind) -> FusionSettings {
        if constexpr (std::is_same_v<std::decay_t<decltype(kind)>, StudyFusionSettings>)
          return of_study;
        else
          return kind;
      },
      of_method);
}

double default_threshold(const FusionRule& rule) {
  return first_full_hit(rule) / 2.0;
}

}  // namespace mapscore::eval
