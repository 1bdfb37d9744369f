// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/pose_text.hpp"

#include "files/yaml_value.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

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

PoseRows rows_of(const Pose& pose) {
  PoseRows rows{};
  std::ranges::copy(pose.affine().reshaped<Eigen::RowMajor>(), rows.begin());
  return rows;
}

std::optional<Pose> pose_of_rows(const PoseRows& rows) {
  Pose pose = Pose::Identity();
  std::ranges::copy(rows, pose.affine().reshaped<Eigen::RowMajor>().begin());
  const Eigen::Matrix3d R = pose.linear();
  const bool rigid = pose.matrix().allFinite() && R.determinant() > 0.0 &&
                     (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() <= kUnitTolerance;
  return rigid ? std::optional(pose) : std::nullopt;
}

Pose pose_of(const YamlValue& list) {
  const std::vector<YamlValue> items = list.elements();
  if (PoseRows rows{}; items.size() == rows.size()) {
    std::ranges::transform(items, rows.begin(), &YamlValue::number);
    if (const auto pose = pose_of_rows(rows)) return *pose;
    list.fail("is no rigid transform; write the upper three rows of its matrix");
  }
  PoseNumbers numbers{};
  if (items.size() != numbers.size()) list.fail("expected [tx, ty, tz, qx, qy, qz, qw]");
  std::ranges::transform(items, numbers.begin(), &YamlValue::number);
  const auto pose = pose_of(numbers);
  if (!pose) list.fail("quaternion qx, qy, qz, qw is not of length 1; normalise it");
  return *pose;
}

}  // namespace mapscore::eval
