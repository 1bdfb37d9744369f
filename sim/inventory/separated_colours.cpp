// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/inventory/class_suggestion.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace mapscore::sim {
namespace {

/// CIE L*a*b* of an sRGB colour, white D65 (CIE 15, IEC 61966-2-1).
Eigen::Vector3d lab_of(const Colour& colour) {
  const auto linear = [](std::uint8_t byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  Eigen::Matrix3d to_xyz;
  to_xyz << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Eigen::Vector3d rgb(linear(colour.r), linear(colour.g), linear(colour.b));
  const Eigen::Vector3d xyz = (to_xyz * rgb).cwiseQuotient(Eigen::Vector3d(0.9505, 1.0, 1.089));
  const Eigen::Vector3d f = xyz.unaryExpr([](double t) {
    return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  });
  return {116.0 * f.y() - 16.0, 500.0 * (f.x() - f.y()), 200.0 * (f.y() - f.z())};
}

struct Candidate {
  Colour colour;
  Eigen::Vector3d lab;
  double distance;  ///< to the nearest colour that is taken
};

std::vector<Candidate> candidates() {
  constexpr int kStep = 17;
  std::vector<Candidate> found;
  for (int r = 0; r < 256; r += kStep)
    for (int g = 0; g < 256; g += kStep)
      for (int b = 0; b < 256; b += kStep) {
        const Colour colour{static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g),
                            static_cast<std::uint8_t>(b)};
        const Eigen::Vector3d lab = lab_of(colour);
        if (lab.x() > 25.0 && lab.x() < 90.0) found.push_back({colour, lab, 1e9});
      }
  return found;
}

void take(const Eigen::Vector3d& lab, std::vector<Candidate>& among) {
  for (Candidate& candidate : among)
    candidate.distance = std::min(candidate.distance, (candidate.lab - lab).norm());
}

}  // namespace

std::vector<Colour> separated_colours(std::size_t count) {
  std::vector<Candidate> left = candidates();
  for (const std::uint8_t grey : {0, 64, 128, 192, 255}) take(lab_of({grey, grey, grey}), left);
  std::vector<Colour> colours;
  while (colours.size() < count) {
    const auto farthest = std::ranges::max_element(left, {}, &Candidate::distance);
    colours.push_back(farthest->colour);
    take(Eigen::Vector3d(farthest->lab), left);
  }
  return colours;
}

}  // namespace mapscore::sim
