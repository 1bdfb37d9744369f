// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/pose_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace mapscore::eval {
namespace {

constexpr double kUnitTolerance = 1e-3;

}  // namespace

PoseNumbers numbers_of(const Pose& pose) {
  Eigen::Quaterniond q(pose.linear());
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const Eigen::Vector3d t = pose.translation();
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

std::optional<Pose> pose_of(const PoseNumbers& numbers) {
  for (const double number : numbers)
    if (!std::isfinite(number)) return std::nullopt;
  const Eigen::Quaterniond q(numbers[6], numbers[3], numbers[4], numbers[5]);
  if (std::abs(q.norm() - 1.0) > kUnitTolerance) return std::nullopt;
  Pose pose = Pose::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
  return pose;
}

std::string join_numbers(std::span<const double> numbers, std::string_view separator) {
  return fmt::format("{}", fmt::join(numbers, separator));
}

std::optional<double> parse_number(std::string_view text) {
  double number = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

}  // namespace mapscore::eval
