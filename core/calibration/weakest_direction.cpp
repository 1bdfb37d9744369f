// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/calibration/weakest_direction.hpp"

#include "core/calibration/outline_evidence.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace mapscore {
namespace {

constexpr int kMask = CalibrationCorrection::kMaskSize;
constexpr double kLeastNoise_px = 0.5;  // of edges that err together
constexpr double kNamed = 0.3;          // part of a direction that is worth its name

constexpr std::array<const char*, CalibrationCorrection::kAxes> kAxisNames{
    "turn about x",      "turn about y",  "roll",         "shift along x",
    "shift along y",     "shift along z", "focal length", "principal point u",
    "principal point v", "time offset"};

std::string words_of(const Eigen::VectorXd& direction, const std::vector<int>& looked_for) {
  std::vector<std::pair<double, int>> parts;
  for (Eigen::Index n = 0; n < direction.size(); ++n)
    parts.emplace_back(-std::abs(direction[n]), looked_for[static_cast<std::size_t>(n)]);
  std::ranges::sort(parts);
  std::string words = kAxisNames[static_cast<std::size_t>(parts.front().second)];
  if (parts.size() > 1 && -parts[1].first > kNamed)
    words += std::string(" with ") + kAxisNames[static_cast<std::size_t>(parts[1].second)];
  return words;
}

}  // namespace

WeakestDirection weakest_direction(const CalibrationCorrection::Matrix& normal,
                                   const CalibrationCorrection::Matrix& covariance,
                                   const CalibrationCorrection::Vector& free,
                                   const CalibrationCorrection::Vector& pixels, double spread_px) {
  std::vector<int> looked_for;
  for (int n = 0; n < CalibrationCorrection::kAxes; ++n)
    if (free[n] > 0) looked_for.push_back(n);
  const auto size = static_cast<Eigen::Index>(looked_for.size());
  const double mask = std::max(normal(kMask, kMask), 1e-9);
  Eigen::MatrixXd known(size, size), unsure(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j) {
      const int a = looked_for[static_cast<std::size_t>(i)],
                b = looked_for[static_cast<std::size_t>(j)];
      const double scale = pixels[a] * pixels[b];
      known(i, j) = (normal(a, b) - normal(a, kMask) * normal(kMask, b) / mask) / scale;
      unsure(i, j) = covariance(a, b) * scale;
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> geometry(known);
  const double least = geometry.eigenvalues()[0], greatest = geometry.eigenvalues()[size - 1];
  WeakestDirection weakest;
  weakest.condition = weakest.sigma_px = std::numeric_limits<double>::infinity();
  if (least > 0) {
    weakest.condition = greatest / least;
    weakest.sigma_px = std::max(spread_px, kLeastNoise_px) * std::sqrt(kEdgesOfAnError / least);
  }
  Eigen::VectorXd direction = geometry.eigenvectors().col(0);
  if (unsure.allFinite()) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> measured(unsure);
    const double sigma_px = std::sqrt(std::max(0.0, measured.eigenvalues()[size - 1]));
    if (sigma_px > weakest.sigma_px) {
      weakest.sigma_px = sigma_px;
      direction = measured.eigenvectors().col(size - 1);
    }
  } else {
    weakest.sigma_px = std::numeric_limits<double>::infinity();
  }
  weakest.words = words_of(direction, looked_for);
  for (Eigen::Index i = 0; i < size; ++i) {
    const int a = looked_for[static_cast<std::size_t>(i)];
    weakest.by[a] = direction[i] / pixels[a];
  }
  weakest.by[kMask] = -normal.col(kMask).head<CalibrationCorrection::kAxes>().dot(
                          weakest.by.head<CalibrationCorrection::kAxes>()) /
                      mask;
  return weakest;
}

}  // namespace mapscore
