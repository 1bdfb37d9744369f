// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/core/refinement/plain_crf.hpp"

#include "core/random_stream.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore::testing {
namespace {

double squared_colour(const Colour& a, const Colour& b) {
  return std::pow(a.r - b.r, 2) + std::pow(a.g - b.g, 2) + std::pow(a.b - b.b, 2);
}

double squared_voxels(const VoxelKey& a, const VoxelKey& b) {
  return std::pow(a.i - b.i, 2) + std::pow(a.j - b.j, 2) + std::pow(a.k - b.k, 2);
}

/// All pairs of one kernel, norms and weight included; the diagonal is 0.
Eigen::MatrixXd weights(const Eigen::MatrixXd& mahalanobis2, double weight, bool normalised,
                        double cutoff) {
  Eigen::MatrixXd k = mahalanobis2.unaryExpr(
      [&](double x) { return x > cutoff * cutoff * (1 + 1e-9) ? 0.0 : std::exp(-0.5 * x); });
  if (normalised) {
    const Eigen::VectorXd scale = k.rowwise().sum().cwiseSqrt().cwiseInverse();
    k = (scale.asDiagonal() * k * scale.asDiagonal()).eval();
  }
  k.diagonal().setZero();
  return weight * k;
}

Eigen::MatrixXd pair_weights(const CrfVoxels& voxels, const Crf& params, double cutoff) {
  const auto count = static_cast<Eigen::Index>(voxels.keys.size());
  Eigen::MatrixXd near(count, count), alike = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      near(i, j) = squared_voxels(voxels.keys[i], voxels.keys[j]);
      if (!voxels.colours.empty())
        alike(i, j) = squared_colour(voxels.colours[i], voxels.colours[j]);
    }
  }
  return weights(near * std::pow(voxels.voxel_m / params.smoothness_sigma_m, 2),
                 params.smoothness_weight, params.normalised, cutoff) +
         weights(near * std::pow(voxels.voxel_m / params.appearance_sigma_m, 2) +
                     alike / std::pow(params.appearance_sigma_colour, 2),
                 params.appearance_weight, params.normalised, cutoff);
}

Eigen::MatrixXd softmax(Eigen::MatrixXd log_q) {
  for (Eigen::Index i = 0; i < log_q.cols(); ++i) {
    log_q.col(i) = (log_q.col(i).array() - log_q.col(i).maxCoeff()).exp();
    log_q.col(i) /= log_q.col(i).sum();
  }
  return log_q;
}

}  // namespace

Eigen::MatrixXd plain_refine(const CrfVoxels& voxels, const Crf& params, double cutoff_sigmas) {
  const Eigen::MatrixXd pairs = pair_weights(voxels, params, cutoff_sigmas);
  const Eigen::MatrixXd log_p =
      voxels.probability.cast<double>().cwiseMax(params.probability_floor).array().log();
  const auto without_the_alone = [&](Eigen::MatrixXd next) {
    for (Eigen::Index i = 0; i < next.cols(); ++i)
      if (!(pairs.col(i).array() > 0.0).any())
        next.col(i) = voxels.probability.col(i).cast<double>();
    return next;
  };
  Eigen::MatrixXd q = without_the_alone(softmax(log_p));
  for (int step = 0; step < params.iterations; ++step) {
    const Eigen::MatrixXd next = without_the_alone(softmax(log_p + q * pairs));
    const double change = (next - q).cwiseAbs().maxCoeff();
    q = next;
    if (change <= params.tolerance) break;
  }
  return q;
}

CrfVoxels noisy_corner(int side, int labels, double wrong) {
  RandomStream stream(7, "noisy_corner");
  const auto level = [&](double mean) {
    return static_cast<std::uint8_t>(std::clamp(mean + 8.0 * stream.normal(), 0.0, 255.0));
  };
  CrfVoxels voxels;
  voxels.voxel_m = 0.05;
  voxels.probability.resize(labels, 2 * side * side);
  for (int wall = 0; wall < 2; ++wall) {
    for (int a = 0; a < side; ++a) {
      for (int b = 0; b < side; ++b) {
        const auto column = static_cast<Eigen::Index>(voxels.keys.size());
        voxels.keys.push_back({wall ? 0 : a, wall ? a : 0, b});
        const double grey = wall ? 70 : 150;
        voxels.colours.push_back({level(grey), level(grey + 20), level(grey)});
        const int truth = (wall + (b > side / 2 ? 2 : 0)) % labels;
        const int seen =
            stream.uniform() < wrong ? static_cast<int>(stream.uniform() * labels) % labels : truth;
        const double sure = 0.5 + 0.45 * stream.uniform();
        voxels.probability.col(column).setConstant(
            static_cast<float>((1.0 - sure) / std::max(1, labels - 1)));
        voxels.probability(seen, column) = labels > 1 ? static_cast<float>(sure) : 1.0f;
      }
    }
  }
  return voxels;
}

}  // namespace mapscore::testing
