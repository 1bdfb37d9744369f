// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/mapping/fusion_rule.hpp"
#include "core/mapping/pose_belief.hpp"

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace mapscore::eval {

// Fusion rules as a study writes them (docs/fusion.md). Each has its draws from the pose belief: N,
// noise_at, covariance.

struct BlendSettings {
  static constexpr std::string_view kKind = "blend";
  static constexpr std::string_view kMeaning =
      "weighted mean of the map and the draws of an observation";
  double K = 0.5;
  int N = 1;
  NoiseAt noise_at = NoiseAt::base;
  CovarianceUse covariance = CovarianceUse::diagonal;
  Decay decay = Decay::hit;
  bool operator==(const BlendSettings&) const = default;
};

struct MaxConfidenceSettings {
  static constexpr std::string_view kKind = "max_confidence";
  static constexpr std::string_view kMeaning = "the class of the most confident observation";
  int N = 1;
  NoiseAt noise_at = NoiseAt::base;
  CovarianceUse covariance = CovarianceUse::diagonal;
  bool operator==(const MaxConfidenceSettings&) const = default;
};

struct VoteSettings {
  static constexpr std::string_view kKind = "vote";
  static constexpr std::string_view kMeaning = "the class that won most draws of all observations";
  int N = 1;
  NoiseAt noise_at = NoiseAt::base;
  CovarianceUse covariance = CovarianceUse::diagonal;
  bool operator==(const VoteSettings&) const = default;
};

struct BayesSettings {
  static constexpr std::string_view kKind = "bayes";
  static constexpr std::string_view kMeaning = "recursive label update with class priors";
  int N = 1;
  NoiseAt noise_at = NoiseAt::base;
  CovarianceUse covariance = CovarianceUse::diagonal;
  double doubt = 0.05;
  std::optional<std::vector<double>> priors;  ///< of the detected classes; empty: all classes equal
  bool operator==(const BayesSettings&) const = default;
};

struct Top3Settings {
  static constexpr std::string_view kKind = "top3";
  static constexpr std::string_view kMeaning = "the three most probable classes, the rest as one";
  int N = 1;
  NoiseAt noise_at = NoiseAt::base;
  CovarianceUse covariance = CovarianceUse::diagonal;
  double doubt = 0.05;
  double lambda = 0.9;
  bool operator==(const Top3Settings&) const = default;
};

using FusionSettings =
    std::variant<BlendSettings, MaxConfidenceSettings, VoteSettings, BayesSettings, Top3Settings>;

struct StudyFusionSettings {
  static constexpr std::string_view kKind = "study";
  static constexpr std::string_view kMeaning = "as the study's `fusion`";
  bool operator==(const StudyFusionSettings&) const = default;
};

/// Fusion of one method: the study's, or its own.
using MethodFusionSettings = std::variant<StudyFusionSettings, BlendSettings, MaxConfidenceSettings,
                                          VoteSettings, BayesSettings, Top3Settings>;

}  // namespace mapscore::eval
