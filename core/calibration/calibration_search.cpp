// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/calibration/calibration_search.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace mapscore {
namespace {

constexpr double kTurnStep_px = 6.0, kShiftStep_m = 0.02, kRollStep_rad = 0.04;
constexpr double kMostTurnSteps = 20;       // to either side, however long the lens
constexpr std::size_t kCoarseEdges = 2000;  // of all frames
constexpr std::size_t kKept = 4096;         // of the tried corrections, the best
constexpr double kApart_px = 8.0;           // between candidates, at kApartAt_m
constexpr double kApartAt_m = 2.0;

std::size_t stride_for(const std::deque<OutlineEvidence>& frames, std::size_t most) {
  std::size_t edges = 0;
  for (const OutlineEvidence& frame : frames) edges += frame.edges();
  return 1 + edges / most;
}

struct TriedCorrection {
  CalibrationCorrection correction;
  double match = 0;
};

/// The best of them, the best first.
void keep_best(std::vector<TriedCorrection>& tried) {
  std::ranges::stable_sort(tried, std::ranges::greater(), &TriedCorrection::match);
  if (tried.size() > kKept) tried.resize(kKept);
}

/// Values from -most to most at about `step`, with 0.
std::vector<double> lattice(double most, double step) {
  std::vector<double> values;
  const int count = static_cast<int>(std::ceil(most / step - 1e-9));
  for (int n = -count; n <= count; ++n) values.push_back(count == 0 ? 0.0 : most * n / count);
  return values;
}

}  // namespace

CalibrationCorrection::Vector start_information(float sigma_px) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  CalibrationCorrection::Vector far;  // that a start may well be off
  far << 5 * kDegree, 5 * kDegree, 5 * kDegree, 0.1, 0.1, 0.1, 0.05, 20, 20, 0.2, 4;
  return static_cast<double>(sigma_px * sigma_px) * kEdgesOfAnError *
         far.cwiseAbs2().cwiseInverse();
}

CalibrationCorrection refined(const std::deque<OutlineEvidence>& frames, CalibrationCorrection from,
                              float sigma_px, int steps, std::size_t edges,
                              const FreeNumbers& free) {
  const std::size_t stride = stride_for(frames, edges);
  for (int step = 0; step < steps; ++step) {
    CalibrationCorrection::Matrix lower = CalibrationCorrection::Matrix::Zero();
    CalibrationCorrection::Vector gradient = CalibrationCorrection::Vector::Zero();
    for (const OutlineEvidence& frame : frames)
      frame.linearise(from, sigma_px, stride, [&](const OutlineEquation& e) {
        lower.selfadjointView<Eigen::Lower>().rankUpdate(e.slope, e.weight);
        gradient += e.weight * e.residual * e.slope;
      });
    CalibrationCorrection::Matrix H = lower.selfadjointView<Eigen::Lower>();
    const CalibrationCorrection::Vector pull =
        start_information(sigma_px) / static_cast<double>(stride);
    H.diagonal() += pull;
    CalibrationCorrection::Vector b = -gradient - pull.cwiseProduct(from.vector());
    b = b.cwiseProduct(free).eval();
    H = H.cwiseProduct(free * free.transpose()).eval();
    H.diagonal() += CalibrationCorrection::Vector::Ones() - free;
    const CalibrationCorrection::Vector change = H.ldlt().solve(b);
    if (!change.allFinite()) return from;
    from = from.changed(change);
    from.offset_px = std::clamp(from.offset_px, -8.0, 8.0);
  }
  return from;
}

std::vector<CalibrationCorrection> searched(const std::deque<OutlineEvidence>& frames,
                                            double turn_rad, double shift_m, double focal_px,
                                            const std::vector<double>& times_s, std::size_t most) {
  const std::size_t stride = stride_for(frames, kCoarseEdges);
  const std::vector<double> turns = lattice(turn_rad, std::max(kTurnStep_px / focal_px,
                                                               turn_rad / kMostTurnSteps)),
                            rolls = lattice(turn_rad / 2, kRollStep_rad),
                            shifts = lattice(shift_m, kShiftStep_m);
  std::vector<TriedCorrection> tried;
  const auto within = [](double a, double b, double limit) {
    return std::hypot(a, b) <= limit * (1 + 1e-9);
  };
  const auto try_shifts = [&](const Eigen::Vector3d& turn, double time_s) {
    const Eigen::Matrix3d R = exp_rotation(turn);
    for (const double ty : shifts)
      for (const double tx : shifts) {
        if (!within(tx, ty, shift_m)) continue;
        TriedCorrection& one = tried.emplace_back();
        one.correction.rigid.linear() = R;
        one.correction.rigid.translation() = Eigen::Vector3d(tx, ty, 0);
        one.correction.time_s = time_s;
        for (const OutlineEvidence& frame : frames)
          one.match += frame.coarse_match(one.correction, stride);
      }
    if (tried.size() > 4 * kKept) keep_best(tried);
  };
  for (const double time_s : times_s)
    for (const double roll : rolls)
      for (const double ry : turns)
        for (const double rx : turns)
          if (within(rx, ry, turn_rad)) try_shifts({rx, ry, roll}, time_s);
  keep_best(tried);
  std::vector<CalibrationCorrection> best;
  const auto places = [&](const CalibrationCorrection& c) {
    Eigen::Matrix<double, 4, 1> at;
    const Eigen::Vector3d near = c.rigid * Eigen::Vector3d(0, 0, kApartAt_m / 2),
                          far = c.rigid * Eigen::Vector3d(0, 0, 2 * kApartAt_m);
    at << near.head<2>() / near.z(), far.head<2>() / far.z();
    return Eigen::Matrix<double, 4, 1>(focal_px * at);
  };
  for (const TriedCorrection& one : tried) {
    if (best.size() == most) break;
    if (std::ranges::none_of(best, [&](const CalibrationCorrection& other) {
          return one.correction.time_s == other.time_s &&
                 (places(one.correction) - places(other)).norm() < kApart_px;
        }))
      best.push_back(one.correction);
  }
  return best;
}

double spread_px(const OutlineEvidence& frame, const CalibrationCorrection& correction,
                 float sigma_px) {
  double sum = 0, weights = 0;
  frame.linearise(correction, sigma_px, 1, [&](const OutlineEquation& e) {
    sum += e.weight * e.residual * e.residual;
    weights += e.weight;
  });
  return weights > 0 ? std::sqrt(sum / weights) : 0.0;
}

double explained_share(const std::deque<OutlineEvidence>& frames,
                       const CalibrationCorrection& correction, float sigma_px) {
  double length = 0, explained = 0;
  for (const OutlineEvidence& frame : frames) {
    length += frame.length_px();
    explained += frame.explained(correction, sigma_px);
  }
  return length > 0 ? explained / length : 0.0;
}

}  // namespace mapscore
