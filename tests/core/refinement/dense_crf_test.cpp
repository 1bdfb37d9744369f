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

/// Voxels of 5 cm in a row along x, of one colour; label 0 with the given probabilities.
CrfVoxels row(const std::vector<double>& of_first) {
  CrfVoxels voxels;
  voxels.voxel_m = 0.05;
  voxels.probability.resize(2, static_cast<Eigen::Index>(of_first.size()));
  for (std::size_t i = 0; i < of_first.size(); ++i) {
    voxels.keys.push_back({static_cast<int>(i), 0, 0});
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
  const CrfResult result = refine(row({0.9, 0.4}), params);
  // k = exp(-1/2); log-odds of label 0: log(0.9 / 0.1) + 2 k (0.4 - 0.6), the other with 0.9 - 0.1.
  const double k = std::exp(-0.5);
  const double odds_0 = std::log(9.0) - 0.4 * k, odds_1 = std::log(0.4 / 0.6) + 1.6 * k;
  EXPECT_NEAR(result.probability(0, 0), 1 / (1 + std::exp(-odds_0)), 2e-6);
  EXPECT_NEAR(result.probability(0, 1), 1 / (1 + std::exp(-odds_1)), 2e-6);
  EXPECT_EQ(result.iterations, 1);
  // Normalised, k becomes k / (1 + k).
  params.normalised = true;
  const double normalised_odds = std::log(9.0) - 0.4 * k / (1 + k);
  EXPECT_NEAR(refine(row({0.9, 0.4}), params).probability(0, 0),
              1 / (1 + std::exp(-normalised_odds)), 2e-6);
}

TEST(DenseCrf, ColourCutsTheSecondKernel) {
  Crf params;
  params.smoothness_weight = 0;
  params.iterations = 1;
  CrfVoxels pair = row({0.9, 0.4});
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
  const CrfResult result = refine(row(of_first), Crf{});
  for (Eigen::Index i = 0; i < 9; ++i) EXPECT_GT(result.probability(0, i), 0.9) << i;
  const CrfResult alone = refine(row({0.2}), Crf{});
  EXPECT_NEAR(alone.probability(0, 0), 0.2, 1e-6);
}

TEST(DenseCrf, BorderBetweenTwoClassesStays) {
  const CrfResult result = refine(row({.9, .9, .9, .9, .9, .1, .1, .1, .1, .1}), Crf{});
  for (Eigen::Index i = 0; i < 10; ++i) EXPECT_EQ(result.probability(0, i) > 0.5f, i < 5) << i;
}

TEST(DenseCrf, FloorIsTakenWhereThereIsANeighbour) {
  Crf params = smoothness_only(1e-9, 0.05);
  params.probability_floor = 0.1;
  const CrfResult result = refine(row({1.0, 0.3}), params);
  EXPECT_NEAR(result.probability(0, 0), 1.0 / 1.1, 1e-6);
  EXPECT_NEAR(result.probability(0, 1), 0.3, 1e-6);
  EXPECT_EQ(result.iterations, 1);
}

TEST(DenseCrf, WeightsOfZeroChangeNothing) {
  for (const CrfFilter filter : {CrfFilter::neighbours, CrfFilter::lattice}) {
    Crf params = smoothness_only(0.0, 0.05);
    params.filter = filter;
    const CrfVoxels voxels = row({1.0, 0.3});
    const CrfResult result = refine(voxels, params);
    EXPECT_TRUE(result.probability == voxels.probability);
    EXPECT_EQ(result.alone, std::vector<bool>(2, true));
    EXPECT_EQ(result.iterations, 0);
  }
}

/// Two voxels, `apart` from one another.
CrfVoxels pair_of(const VoxelKey& apart, double voxel_m) {
  CrfVoxels voxels = row({0.9, 0.4});
  voxels.keys[1] = apart;
  voxels.voxel_m = voxel_m;
  return voxels;
}

/// Neither in tenths nor in hundredths does a binary number say whether they are equal.
TEST(DenseCrf, PairAtExactlyTheCutOffCounts) {
  struct Tie {
    double sigma_m, voxel_m;
    VoxelKey at, beyond;
  };
  for (const Tie& tie :
       {Tie{0.1, 0.05, {6, 0, 0}, {6, 1, 0}}, Tie{0.1, 0.05, {2, 4, 4}, {3, 4, 4}},
        Tie{0.05, 0.05, {0, 3, 0}, {0, 3, 1}}, Tie{0.15, 0.05, {9, 0, 0}, {9, 0, 1}},
        Tie{0.15, 0.05, {-4, -4, 7}, {-4, -5, 7}}, Tie{0.1, 0.1, {0, 0, -3}, {1, 0, -3}},
        Tie{0.1, 0.02, {0, 15, 0}, {0, -15, 1}}, Tie{0.07, 0.03, {7, 0, 0}, {7, 1, 0}},
        Tie{0.3, 0.1, {9, 0, 0}, {9, 1, 0}}, Tie{0.06, 0.02, {9, 0, 0}, {9, 1, 0}}}) {
    Crf params = smoothness_only(100.0, tie.sigma_m);
    params.iterations = 1;
    params.normalised = false;
    const CrfResult at = refine(pair_of(tie.at, tie.voxel_m), params);
    const double odds = std::log(0.4 / 0.6) + 100 * std::exp(-4.5) * 0.8;
    EXPECT_NEAR(at.probability(0, 1), 1 / (1 + std::exp(-odds)), 2e-6) << tie.sigma_m;
    EXPECT_EQ(at.alone, std::vector<bool>(2, false));
    EXPECT_EQ(refine(pair_of(tie.beyond, tie.voxel_m), params).alone, std::vector<bool>(2, true))
        << tie.sigma_m;
  }
}

TEST(DenseCrf, CutOffIsOfTheWholeSumWithColour) {
  Crf params;
  params.smoothness_weight = 0;
  params.appearance_sigma_m = 0.15;
  CrfVoxels pair = pair_of({6, 3, 0}, 0.05);  // 5 of 9
  pair.colours[1] = {140, 100, 100};          // and 4
  EXPECT_EQ(refine(pair, params).alone, std::vector<bool>(2, false));
  pair.colours[1] = {140, 99, 100};
  EXPECT_EQ(refine(pair, params).alone, std::vector<bool>(2, true));
}

TEST(DenseCrf, VoxelAloneKeepsItsBitsAndChangesNothing) {
  Crf params;
  const CrfVoxels voxels = noisy_corner(10, 9, 0.3);
  const CrfResult without = refine(voxels, params);
  const Eigen::Index count = voxels.probability.cols();
  for (const VoxelKey& place : {VoxelKey{-8, 0, 0}, VoxelKey{20, -400, 3}, VoxelKey{0, 17, 9}}) {
    CrfVoxels more = voxels;
    more.keys.insert(more.keys.begin(), place);
    more.colours.insert(more.colours.begin(), Colour{150, 170, 150});
    more.probability.resize(9, count + 1);
    more.probability << Eigen::VectorXf::Unit(9, 4), voxels.probability;
    const CrfResult with = refine(more, params);
    EXPECT_TRUE(with.alone[0]);
    EXPECT_TRUE(with.probability.col(0) == more.probability.col(0));
    EXPECT_TRUE(with.probability.rightCols(count) == without.probability);
    EXPECT_EQ(with.iterations, without.iterations);
    EXPECT_EQ(with.last_change, without.last_change);
  }
  const CrfResult single = refine(row({1.0}), params);
  EXPECT_EQ(single.probability(0, 0), 1.0f);
  EXPECT_EQ(single.iterations, 0);
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
  std::reverse(turned.keys.begin(), turned.keys.end());
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
      for (VoxelKey& key : voxels.keys) key = {key.i - 18000, key.j + 620, key.k + 8};
      EXPECT_LT(largest_difference(refine(voxels, params), plain_refine(voxels, params, cutoff)),
                1e-4);
    }
  }
}

/// Many of these have pairs at exactly 3 sigma.
TEST(DenseCrf, NeighboursEqualThePlainTwinOnAnyLatticeAnywhere) {
  for (const double sigma_m : {0.05, 0.09, 0.1, 0.15}) {
    for (const double voxel_m : {0.02, 0.05, 0.1}) {
      Crf params;
      params.smoothness_sigma_m = params.appearance_sigma_m = sigma_m;
      params.smoothness_weight = params.appearance_weight = 0.1;
      params.normalised = false;
      params.tolerance = 0;
      params.iterations = 2;
      CrfVoxels voxels = noisy_corner(12, 4, 0.3);
      voxels.voxel_m = voxel_m;
      const CrfResult here = refine(voxels, params);
      EXPECT_LT(largest_difference(here, plain_refine(voxels, params, params.cutoff_sigmas)), 5e-6)
          << sigma_m << ' ' << voxel_m;
      for (VoxelKey& key : voxels.keys) key = {key.i + 1000, key.j - 1000, key.k + 1000};
      EXPECT_TRUE(refine(voxels, params).probability == here.probability);
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
  const CrfVoxels good = row({0.9, 0.4});
  const auto with = [&](const std::function<void(CrfVoxels&, Crf&)>& spoil) {
    CrfVoxels voxels = good;
    Crf params;
    spoil(voxels, params);
    return message(voxels, params);
  };
  using ::testing::HasSubstr;
  constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(with([](auto& v, auto&) { v.keys.pop_back(); }), HasSubstr("keys"));
  EXPECT_THAT(with([](auto& v, auto&) { v.colours.clear(); }), HasSubstr("colours"));
  EXPECT_THAT(with([](auto& v, auto&) { v.probability(0, 1) = 0.5f; }), HasSubstr("voxel 1"));
  EXPECT_THAT(with([](auto& v, auto&) { v.probability(0, 1) = kNotANumber; }),
              HasSubstr("voxel 1"));
  EXPECT_THAT(with([](auto& v, auto&) { v.probability.col(0) << -1.0f, 2.0f; }),
              HasSubstr("voxel 0"));
  EXPECT_THAT(with([](auto& v, auto&) { v.voxel_m = kNotANumber; }), HasSubstr("voxel_m"));
  EXPECT_THAT(with([](auto& v, auto&) { v.voxel_m = 0; }), HasSubstr("voxel_m"));
  EXPECT_THAT(with([](auto& v, auto&) { v.keys[0].k = -2000000000; }), HasSubstr("wide"));
  EXPECT_THAT(with([](auto& v, auto&) {
                v.keys[0].k = -2147483647;
                v.keys[1].k = 2147483647;
              }),
              HasSubstr("4294967295 voxels wide"));
  EXPECT_THAT(with([](auto& v, auto& p) {
                v.keys[0].i = 1000000;
                v.voxel_m = 1000;
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
