// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/fault_check.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include <cmath>

namespace mapscore::eval {
namespace {

/// By the very test of the fault, whose message begins with the key.
void check_rigid(const sim::RigidDose& dose, const std::string& path, const Blame& blame) try {
  sim::check(dose);
} catch (const Error& error) {
  const std::string text = error.what();
  const std::size_t colon = text.find(": ");
  blame(path + '.' + text.substr(0, colon), text.substr(colon + 2));
}

constexpr std::string_view kCovariancePath = "faults.pose.covariance_m_rad";

void check_symmetric(const Covariance6& E, const Blame& blame) {
  const double tolerance = 1e-10 * E.cwiseAbs().maxCoeff();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < i; ++j) {
      if (std::abs(E(i, j) - E(j, i)) <= tolerance) continue;
      blame(kCovariancePath,
            fmt::format("is not symmetric: row {} column {} is {}, row {} column {} is {}; make "
                        "them equal",
                        i + 1, j + 1, E(i, j), j + 1, i + 1, E(j, i)));
    }
  }
}

void check_covariance(const sim::PoseNoise& pose, const Blame& blame) {
  if (!pose.covariance_m_rad) return;
  if (pose.sigma_xy_m != 0 || pose.sigma_z_m != 0 || pose.sigma_roll_pitch_deg.deg != 0 ||
      pose.sigma_yaw_deg.deg != 0)
    blame(kCovariancePath, "stands beside a sigma; keep the covariance or the sigmas");
  Covariance6 E;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) E(i, j) = (*pose.covariance_m_rad)[i][j];
  }
  check_symmetric(E, blame);
  try {  // the very test of the mapper, so that what is accepted here is not refused there
    (void)covariance_root(E);
  } catch (const Error&) {
    cv::Mat eigenvalues;  // the last is the least; Eigen's own solver compiles for seconds
    cv::eigen(cv::Mat(6, 6, CV_64F, E.data()), eigenvalues);
    blame(kCovariancePath,
          fmt::format("is not positive semi-definite: its least eigenvalue is {:.3g}; write the "
                      "covariance of a distribution",
                      eigenvalues.at<double>(5)));
  }
}

/// By the very test of each fault that has one, whose message names the key.
void check_doses(const FaultSettings& faults, const Blame& blame) {
  FaultSettings::fields(faults, [&](const auto& fault, const Field& field) {
    if constexpr (requires { sim::check(fault.dose()); }) try {
        sim::check(fault.dose());
      } catch (const Error& error) {
        blame(fmt::format("faults.{}", field.key), error.what());
      }
  });
}

void check_confusion(const Overrides<sim::LabelDose>& labels, const Blame& blame) {
  if (!labels.given.contains("confusion_matrix") || labels.values.confusion == 0) return;
  blame("faults.labels.confusion_matrix", "stands beside a confusion; keep one of the two");
}

}  // namespace

void check_faults(const FaultSettings& faults, const Blame& blame) {
  check_rigid(faults.misregistration.rigid, "faults.misregistration", blame);
  check_rigid(faults.mount.rigid, "faults.mount", blame);
  check_covariance(faults.pose, blame);
  check_confusion(faults.labels.own, blame);
  check_doses(faults, blame);
}

}  // namespace mapscore::eval
