// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/depth_noise.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"
#include "sim/faults/depth_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace mapscore::sim {
namespace {

/// Beyond it nothing was measured, and the published terms diverge.
constexpr double kSteepest_rad = 85.0 * std::numbers::pi / 180.0;

/// theta / (pi/2 - theta).
double steepness(double incidence_rad) {
  const double theta = std::min(incidence_rad, kSteepest_rad);
  return theta / (0.5 * std::numbers::pi - theta);
}

/// Image and angles of incidence of what each pixel reports.
struct Seen {
  cv::Mat1d z_m;
  cv::Mat1f incidence_rad;
};

// One draw, or pair of draws, for each pixel in row-major order, whatever the pixel holds.

/// Takes the return (z = 0) of each pixel with the chance min(1, grazing * grazing_loss(angle)).
void drop_grazing(Seen& seen, const DepthDose& dose, RandomStream stream) {
  for (int v = 0; v < seen.z_m.rows; ++v)
    for (int u = 0; u < seen.z_m.cols; ++u)
      if (stream.uniform() < dose.grazing * grazing_loss(dose, seen.incidence_rad(v, u)))
        seen.z_m(v, u) = 0.0;
}

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

/// A pixel with a return and a neighbour (of four) across a step of the noise-free image reports,
/// with the chance min(1, flying * flying_share), the mix z + m (z_neighbour - z), m uniform in [0,
/// 1); of several the neighbour across the largest step in 1/z, ties to the order left, right,
/// above, below.
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

/// Each pixel reports what the pixel sees that lies a whole-number draw of N(0, sigma) away.
Seen displaced(const Seen& seen, const DepthDose& dose, RandomStream stream) {
  const int right = seen.z_m.cols - 1, bottom = seen.z_m.rows - 1;
  Seen moved{cv::Mat1d(seen.z_m.size()), cv::Mat1f(seen.z_m.size())};
  for (int v = 0; v <= bottom; ++v) {
    for (int u = 0; u <= right; ++u) {
      const double sigma_px = dose.lateral * lateral_sigma_px(dose, seen.incidence_rad(v, u));
      const double du =
          std::clamp(std::nearbyint(u + sigma_px * stream.normal()), 0.0, 1.0 * right);
      const double dv =
          std::clamp(std::nearbyint(v + sigma_px * stream.normal()), 0.0, 1.0 * bottom);
      const int column = static_cast<int>(du), row = static_cast<int>(dv);
      moved.z_m(v, u) = seen.z_m(row, column);
      moved.incidence_rad(v, u) = seen.incidence_rad(row, column);
    }
  }
  return moved;
}

void add_axial_noise(Seen& seen, const DepthDose& dose, RandomStream stream) {
  for (int v = 0; v < seen.z_m.rows; ++v) {
    for (int u = 0; u < seen.z_m.cols; ++u) {
      const double normal = stream.normal();
      double& z = seen.z_m(v, u);
      if (z == 0.0) continue;
      z += dose.axial * axial_sigma_m(dose, z, seen.incidence_rad(v, u)) * normal;
      z = std::max(z, 0.0);
    }
  }
}

/// To whole steps of the disparity f b / z; none where it rounds to zero.
void quantise(cv::Mat1d& z_m, double disparity_m_px, double step_px) {
  for (double& z : z_m) {
    if (z == 0.0) continue;
    const double steps = std::nearbyint(disparity_m_px / (z * step_px));
    z = steps == 0.0 ? 0.0 : disparity_m_px / (steps * step_px);
  }
}

cv::Mat1w stored(const cv::Mat1d& z_m) {
  cv::Mat1w depth(z_m.size());
  for (int v = 0; v < z_m.rows; ++v) {
    for (int u = 0; u < z_m.cols; ++u) {
      const double units = std::nearbyint(z_m(v, u) * kDepthUnitsPerMetre);
      const bool holds = units <= std::numeric_limits<std::uint16_t>::max();
      depth(v, u) = static_cast<std::uint16_t>(holds ? units : 0.0);
    }
  }
  return depth;
}

void drop_out_of_range(cv::Mat1w& depth, const DepthDose& dose, RandomStream stream) {
  for (std::uint16_t& value : depth) {
    const double chance = stream.uniform(), z = value / kDepthUnitsPerMetre;
    if ((z < dose.range_min_m || z > dose.range_max_m) && chance < dose.range) value = 0;
  }
}

void check_size(const cv::Mat1w& depth, const CameraModel& camera) {
  if (depth.cols == camera.width_px && depth.rows == camera.height_px) return;
  throw Error("depth fault: the image has " + std::to_string(depth.cols) + " x " +
              std::to_string(depth.rows) + " pixels, its camera " +
              std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px) +
              "; give the camera that made the image");
}

}  // namespace

double axial_sigma_m(const DepthDose& dose, double z_m, double incidence_rad) {
  const double beyond = z_m - 0.4, steep = steepness(incidence_rad);
  return dose.axial_base_m + dose.axial_growth_per_m * beyond * beyond +
         0.0001 / std::sqrt(z_m) * steep * steep;
}

double lateral_sigma_px(const DepthDose& dose, double incidence_rad) {
  return dose.lateral_px + 0.035 * steepness(incidence_rad);
}

double grazing_loss(const DepthDose& dose, double incidence_rad) {
  const double from_rad = dose.grazing_from_deg.rad(), to_rad = dose.grazing_to_deg.rad();
  return std::clamp((incidence_rad - from_rad) / (to_rad - from_rad), 0.0, 1.0);
}

cv::Mat1w corrupt_depth(const cv::Mat1w& depth, const CameraModel& camera, const DepthDose& dose,
                        std::uint64_t seed, int frame) {
  check(dose);
  check_size(depth, camera);
  if (is_zero(dose)) return depth;
  const auto stream = [&](std::string_view purpose) {
    return RandomStream(seed, purpose, {static_cast<std::uint64_t>(frame)});
  };
  const cv::Mat1d noise_free_m = metres_of(depth);
  const bool needs_angles = dose.grazing > 0.0 || dose.lateral > 0.0 || dose.axial > 0.0;
  Seen seen{noise_free_m.clone(),
            needs_angles ? incidence_angles(noise_free_m, camera) : cv::Mat1f(depth.size(), 0.0F)};
  if (dose.shadow > 0.0)
    seen.z_m.setTo(0.0, projector_shadow(noise_free_m, camera, dose.shadow * dose.baseline_m));
  if (dose.grazing > 0.0) drop_grazing(seen, dose, stream("depth.grazing"));
  if (dose.flying > 0.0)
    add_flying_pixels(seen.z_m, noise_free_m, camera, dose, stream("depth.flying"));
  if (dose.lateral > 0.0) seen = displaced(seen, dose, stream("depth.lateral"));
  if (dose.axial > 0.0) add_axial_noise(seen, dose, stream("depth.axial"));
  if (dose.quantisation > 0.0)
    quantise(seen.z_m, camera.fx_px * dose.baseline_m, dose.quantisation * dose.subpixel_px);
  cv::Mat1w measured = stored(seen.z_m);
  if (dose.range > 0.0) drop_out_of_range(measured, dose, stream("depth.range"));
  return measured;
}

}  // namespace mapscore::sim
