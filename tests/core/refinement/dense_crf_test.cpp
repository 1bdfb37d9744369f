// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/refinement/dense_crf.hpp"

#include "core/error.hpp"
#include "tests/core/refinement/plain_crf.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace mapscore {
namespace {

using testing::noisy_corner;
using testing::plain_refine;

/// Voxels in a row along x, `step_m` apart, of one colour; label 0 with the given probabilities.
CrfVoxels row(const std::vector<double>& of_first, double step_m) {
  CrfVoxels voxels;
  voxels.probability.resize(2, static_cast<Eigen::Index>(of_first.size()));
  for (std::size_t i = 0; i < of_first.size(); ++i) {
    voxels.centres_m.emplace_back(step_m * static_cast<double>(i), 0, 0);
    voxels.colours.push_back({100, 100, 100});
    voxels.probability.col(static_cast<Eigen::Index>(i)) << static_cast<float>(of_first[i]),
        static_cast<float>(1.0 - of_first[i]);
  }
  return voxels;
}

Crf smoothness_only(double weight, double sigma_m) {
  Crf params;
  params.smoothness_weight = weight;
  params.smoothness_sigma_m = sigma_m;
  params.appearance_weight = 0;
  return params;
}

double largest_difference(const CrfResult& result, const Eigen::MatrixXd& plain) {
  return (result.probability.cast<double>() - plain).cwiseAbs().maxCoeff();
}

TEST(DenseCrf, TwoVoxelsByHand) {
  Crf params = smoothness_only(2.0, 0.05);
  params.iterations = 1;
  params.normalised = false;
  const CrfResult result = refine(row({0.9, 0.4}, 0.05), params);
  // k = exp(-1/2); log-odds of label 0: log(0.9 / 0.1) + 2 k (0.4 - 0.6), the other with 0.9 - 0.1.
  const double k = std::exp(-0.5);
  const double odds_0 = std::log(9.0) - 0.4 * k, odds_1 = std::log(0.4 / 0.6) + 1.6 * k;
  EXPECT_NEAR(result.probability(0, 0), 1 / (1 + std::exp(-odds_0)), 2e-6);
  EXPECT_NEAR(result.probability(0, 1), 1 / (1 + std::exp(-odds_1)), 2e-6);
  EXPECT_EQ(result.iterations, 1);
  // Normalised, k becomes k / (1 + k).
  params.normalised = true;
  const double normalised_odds = std::log(9.0) - 0.4 * k / (1 + k);
  EXPECT_NEAR(refine(row({0.9, 0.4}, 0.05), params).probability(0, 0),
              1 / (1 + std::exp(-normalised_odds)), 2e-6);
}

TEST(DenseCrf, ColourCutsTheSecondKernel) {
  Crf params;
  params.smoothness_weight = 0;
  params.iterations = 1;
  CrfVoxels pair = row({0.9, 0.4}, 0.05);
  pair.colours[1] = {120, 100, 100};
  const double k = std::exp(-0.5 * std::pow(0.05 / 0.12, 2) - 0.5);
  const double odds = std::log(0.4 / 0.6) + 3.0 * k / (1 + k) * 0.8;
  EXPECT_NEAR(refine(pair, params).probability(0, 1), 1 / (1 + std::exp(-odds)), 2e-6);
  pair.colours[1] = {200, 200, 200};  // beyond three sigmas
  EXPECT_NEAR(refine(pair, params).probability(0, 1), 0.4, 1e-6);
}

TEST(DenseCrf, OneWrongVoxelIsSmoothedAway) {
  std::vector<double> of_first(9, 0.95);
  of_first[4] = 0.2;
  const CrfResult result = refine(row(of_first, 0.05), Crf{});
  for (Eigen::Index i = 0; i < 9; ++i) EXPECT_GT(result.probability(0, i), 0.9) << i;
  const CrfResult alone = refine(row({0.2}, 0.05), Crf{});
  EXPECT_NEAR(alone.probability(0, 0), 0.2, 1e-6);
}

TEST(DenseCrf, BorderBetweenTwoClassesStays) {
  const CrfResult result = refine(row({.9, .9, .9, .9, .9, .1, .1, .1, .1, .1}, 0.05), Crf{});
  for (Eigen::Index i = 0; i < 10; ++i) EXPECT_EQ(result.probability(0, i) > 0.5f, i < 5) << i;
}

TEST(DenseCrf, WeightsOfZeroGiveTheFlooredInput) {
  Crf params = smoothness_only(0.0, 0.05);
  params.probability_floor = 0.1;
  const CrfResult result = refine(row({1.0, 0.3}, 0.05), params);
  EXPECT_NEAR(result.probability(0, 0), 1.0 / 1.1, 1e-6);
  EXPECT_NEAR(result.probability(0, 1), 0.3, 1e-6);
  EXPECT_EQ(result.iterations, 1);
}

struct FilterVariant {
  CrfFilter filter;
  bool normalised;
};
void PrintTo(const FilterVariant& variant, std::ostream* out) {
  *out << (variant.filter == CrfFilter::lattice ? "lattice" : "neighbours")
       << (variant.normalised ? ", normalised" : ", unnormalised");
}

class CrfFilters : public ::testing::TestWithParam<FilterVariant> {
 protected:
  [[nodiscard]] static Crf params() {
    Crf made;
    made.filter = GetParam().filter;
    made.normalised = GetParam().normalised;
    if (!made.normalised) made.smoothness_weight = made.appearance_weight = 0.1;
    return made;
  }
};

TEST_P(CrfFilters, ProbabilitiesStayNormalised) {
  for (const int labels : {1, 2, 7}) {
    const CrfResult result = refine(noisy_corner(14, labels, 0.3), params());
    EXPECT_GE(result.probability.minCoeff(), 0.0f);
    EXPECT_LT((result.probability.colwise().sum().array() - 1.0f).abs().maxCoeff(), 1e-5f);
  }
}

TEST_P(CrfFilters, Converges) {
  Crf endless = params();
  endless.iterations = 200;
  const CrfVoxels voxels = noisy_corner(14, 4, 0.2);
  const CrfResult result = refine(voxels, endless);
  EXPECT_LT(result.iterations, 200);
  EXPECT_LE(result.last_change, endless.tolerance);
  endless.tolerance = 0;
  EXPECT_LT((refine(voxels, endless).probability - result.probability).cwiseAbs().maxCoeff(), 1e-2);
}

TEST_P(CrfFilters, SameBytesForAnyNumberOfThreads) {
  const CrfVoxels voxels = noisy_corner(40, 5, 0.2);
  const CrfResult one = refine(voxels, params(), 1), five = refine(voxels, params(), 5);
  EXPECT_TRUE(one.probability == five.probability);
  EXPECT_EQ(one.last_change, five.last_change);
}

TEST_P(CrfFilters, OrderOfVoxelsDoesNotMatter) {
  const CrfVoxels voxels = noisy_corner(12, 3, 0.2);
  CrfVoxels turned = voxels;
  std::reverse(turned.centres_m.begin(), turned.centres_m.end());
  std::reverse(turned.colours.begin(), turned.colours.end());
  turned.probability = voxels.probability.rowwise().reverse();
  const Eigen::MatrixXf back = refine(turned, params()).probability.rowwise().reverse();
  EXPECT_LT((refine(voxels, params()).probability - back).cwiseAbs().maxCoeff(), 1e-3f);
}

INSTANTIATE_TEST_SUITE_P(All, CrfFilters,
                         ::testing::Values(FilterVariant{CrfFilter::neighbours, true},
                                           FilterVariant{CrfFilter::neighbours, false},
                                           FilterVariant{CrfFilter::lattice, true},
                                           FilterVariant{CrfFilter::lattice, false}));

TEST(DenseCrf, NeighboursEqualThePlainTwin) {
  for (const bool normalised : {true, false}) {
    for (const double cutoff : {2.0, 3.0}) {
      Crf params;
      params.normalised = normalised;
      params.cutoff_sigmas = cutoff;
      params.tolerance = 0;
      params.iterations = 5;
      if (!normalised) params.smoothness_weight = params.appearance_weight = 0.1;
      CrfVoxels voxels = noisy_corner(15, 4, 0.3);
      for (Eigen::Vector3d& centre : voxels.centres_m) centre += Eigen::Vector3d(-900, 31, 0.4);
      EXPECT_LT(largest_difference(refine(voxels, params), plain_refine(voxels, params, cutoff)),
                1e-4);
    }
  }
}

TEST(DenseCrf, CutOffCostsLittleAgainstAllPairs) {
  const CrfVoxels voxels = noisy_corner(15, 4, 0.3);
  const Eigen::MatrixXd all_pairs = plain_refine(voxels, Crf{}, 1e9);
  EXPECT_LT(largest_difference(refine(voxels, Crf{}), all_pairs), 0.05);
}

TEST(DenseCrf, LatticeIsNearAllPairs) {
  Crf params;
  params.filter = CrfFilter::lattice;
  const CrfVoxels voxels = noisy_corner(15, 4, 0.3);
  const Eigen::MatrixXd plain = plain_refine(voxels, params, 1e9);
  const Eigen::MatrixXd result = refine(voxels, params).probability.cast<double>();
  EXPECT_LT((result - plain).cwiseAbs().mean(), 0.02);
}

TEST(DenseCrf, NoVoxelsGiveNone) {
  EXPECT_EQ(refine(CrfVoxels{}, Crf{}).probability.cols(), 0);
}

TEST(DenseCrf, BadInputIsNamed) {
  const auto message = [](const CrfVoxels& voxels, const Crf& params) -> std::string {
    try {
      (void)refine(voxels, params);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const CrfVoxels good = row({0.9, 0.4}, 0.05);
  const auto with = [&](const std::function<void(CrfVoxels&, Crf&)>& spoil) {
    CrfVoxels voxels = good;
    Crf params;
    spoil(voxels, params);
    return message(voxels, params);
  };
  using ::testing::HasSubstr;
  constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(with([](auto& v, auto&) { v.centres_m.pop_back(); }), HasSubstr("centres"));
  EXPECT_THAT(with([](auto& v, auto&) { v.colours.clear(); }), HasSubstr("colours"));
  EXPECT_THAT(with([](auto& v, auto&) { v.probability(0, 1) = 0.5f; }), HasSubstr("voxel 1"));
  EXPECT_THAT(with([](auto& v, auto&) { v.probability(0, 1) = kNotANumber; }),
              HasSubstr("voxel 1"));
  EXPECT_THAT(with([](auto& v, auto&) { v.probability.col(0) << -1.0f, 2.0f; }),
              HasSubstr("voxel 0"));
  EXPECT_THAT(with([](auto& v, auto&) { v.centres_m[0].x() = kNotANumber; }),
              HasSubstr("not finite"));
  EXPECT_THAT(with([](auto& v, auto&) { v.centres_m[0].x() = 1e9; }), HasSubstr("larger"));
  EXPECT_THAT(with([](auto& v, auto& p) {
                v.centres_m[0].x() = 1e9;
                p.filter = CrfFilter::lattice;
              }),
              HasSubstr("larger"));
  EXPECT_THAT(with([](auto&, auto& p) { p.smoothness_sigma_m = 0; }),
              HasSubstr("smoothness_sigma_m"));
  EXPECT_THAT(with([](auto&, auto& p) { p.appearance_weight = kNotANumber; }),
              HasSubstr("appearance_weight"));
  EXPECT_THAT(with([](auto&, auto& p) { p.iterations = -1; }), HasSubstr("iterations"));
  EXPECT_EQ(with([](auto&, auto&) {}), "");
}

}  // namespace
}  // namespace mapscore
