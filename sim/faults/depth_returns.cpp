// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/depth_returns.hpp"

#include "sim/faults/depth_geometry.hpp"
#include "sim/faults/depth_noise.hpp"

#include <array>
#include <cmath>

namespace mapscore::sim {
namespace {

/// Depth across the largest step beside pixel (u, v), or 0.
double across_step(const cv::Mat1d& z_m, int u, int v, const StepRule& rule) {
  const cv::Rect image({0, 0}, z_m.size());
  const double here = z_m(v, u);
  double across = 0.0, largest = 0.0;
  for (const cv::Point& offset : std::array<cv::Point, 4>{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}}) {
    const cv::Point other = cv::Point(u, v) + offset;
    if (!image.contains(other)) continue;
    const double there = z_m(other);
    if (there == 0.0 || !rule.is_step(here, there)) continue;
    const double size = std::abs(1.0 / here - 1.0 / there);
    if (size <= largest) continue;
    largest = size;
    across = there;
  }
  return across;
}

}  // namespace

void drop_grazing(cv::Mat1d& z_m, const cv::Mat1f& incidence_rad, const DepthDose& dose,
                  RandomStream stream) {
  for (int v = 0; v < z_m.rows; ++v) {
    for (int u = 0; u < z_m.cols; ++u) {
      const double chance = stream.uniform();
      if (chance < dose.grazing * grazing_loss(dose, incidence_rad(v, u))) z_m(v, u) = 0.0;
    }
  }
}

void add_flying_pixels(cv::Mat1d& z_m, const cv::Mat1d& noise_free_m, const CameraModel& camera,
                       const DepthDose& dose, RandomStream stream) {
  const StepRule rule(camera);
  for (int v = 0; v < z_m.rows; ++v) {
    for (int u = 0; u < z_m.cols; ++u) {
      const double chance = stream.uniform(), mix = stream.uniform();
      double& z = z_m(v, u);
      if (z == 0.0 || chance >= dose.flying * dose.flying_share) continue;
      const double across = across_step(noise_free_m, u, v, rule);
      if (across > 0.0) z += mix * (across - z);
    }
  }
}

}  // namespace mapscore::sim
