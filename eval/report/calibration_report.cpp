// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/calibration_report.hpp"

#include "eval/recording/pose_text.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

namespace mapscore::eval {
namespace {

constexpr double kInDegrees = 180.0 / std::numbers::pi;

/// A number of a correction, for people and for files.
struct CorrectionNumber {
  std::string_view name, unit;
  double in_unit;
  std::string_view key;
};

constexpr std::array<CorrectionNumber, CalibrationCorrection::kAxes> kCorrectionNumbers{{
    {"turn about x (right)", "deg", kInDegrees, "turn_x_rad"},
    {"turn about y (down)", "deg", kInDegrees, "turn_y_rad"},
    {"turn about z (view)", "deg", kInDegrees, "turn_z_rad"},
    {"shift along x", "mm", 1e3, "shift_x_m"},
    {"shift along y", "mm", 1e3, "shift_y_m"},
    {"shift along z", "mm", 1e3, "shift_z_m"},
    {"focal length", "%", 1e2, "log_focal"},
    {"principal point u", "px", 1.0, "centre_u_px"},
    {"principal point v", "px", 1.0, "centre_v_px"},
    {"time offset", "ms", 1e3, "time_offset_s"},
}};

constexpr std::string_view kMayBeWorse =
    "\nnote: it is likely better than the start, but lies so near to it, or explains so little "
    "more, that it may be worse; more frames tell";

/// Those that were looked for.
std::vector<int> looked_for(const CalibrationEstimate& estimate) {
  std::vector<int> axes;
  for (int n = 0; n < CalibrationCorrection::kAxes; ++n)
    if (estimate.covariance(n, n) > 0) axes.push_back(n);
  return axes;
}

/// Standard deviation of the length of three numbers.
double sigma_of(const CalibrationEstimate& estimate, int first) {
  return std::sqrt(estimate.covariance.block<3, 3>(first, first).trace());
}

}  // namespace

std::string calibration_summary(const CalibrationEstimate& estimate) {
  if (estimate.weakest.empty())  // no frame told anything
    return fmt::format("{}: {}\n", word_of(estimate.verdict), estimate.reason);
  const Pose& rigid = estimate.correction.rigid;
  const std::string found = fmt::format(
      "{:.1f} mm and {:.3f} degrees from the start (standard deviations {:.2f} mm and {:.3f} "
      "degrees)",
      1e3 * rigid.translation().norm(), kInDegrees * Eigen::AngleAxisd(rigid.linear()).angle(),
      1e3 * sigma_of(estimate, CalibrationCorrection::shift_x),
      kInDegrees * sigma_of(estimate, CalibrationCorrection::turn_x));
  const std::string shares = fmt::format(
      "steps of depth lie on {:.1f} % of the outlines with it, on {:.1f} % with the "
      "start",
      100 * estimate.explained, 100 * estimate.explained_start);
  const std::string word(word_of(estimate.verdict));
  const std::string verdict =
      estimate.verdict == CalibrationVerdict::calibrated
          ? fmt::format("{}: {}{}", word, found, estimate.may_be_worse ? kMayBeWorse : "")
      : estimate.verdict == CalibrationVerdict::confirmed
          ? fmt::format("{}: {}; it is kept\nfound: {}", word, estimate.reason, found)
          : fmt::format("{}: {}\nfound, and not used: {}", word, estimate.reason, found);
  return fmt::format(
      "{}\n{}\nknown least: {}, to {:.2f} px (refused from {} on); condition number {:.0f} "
      "(refused "
      "from {} on)\nobjects end {:.2f} px {} their masks; what the next table does not list is "
      "taken as exact, be it a focal length, a lens or the scale of depth\n",
      verdict, shares, estimate.weakest, estimate.weakest_px, CalibrationEstimate::kMostWeak_px,
      estimate.condition, CalibrationEstimate::kMostCondition,
      std::abs(estimate.correction.offset_px),
      estimate.correction.offset_px < 0 ? "within" : "beyond");
}

std::string calibration_numbers(const CalibrationEstimate& estimate) {
  const CalibrationCorrection::Vector change = estimate.correction.vector();
  std::string text = fmt::format("{:<22} {:>10} {:>10}\n", "number", "change", "sigma");
  for (const int n : looked_for(estimate)) {
    const CorrectionNumber& number = kCorrectionNumbers[static_cast<std::size_t>(n)];
    text += fmt::format("{:<22} {:>10.3f} {:>10.3f} {}\n", number.name, number.in_unit * change[n],
                        number.in_unit * std::sqrt(estimate.covariance(n, n)), number.unit);
  }
  return text;
}

std::string calibration_frames(const CalibrationEstimate& estimate, const std::vector<int>& names) {
  std::string text =
      fmt::format("{:>6} {:>11} {:>8} {:>11} {:>13} {:>11} {:>16}\n", "frame", "outlines px",
                  "steps", "explained %", "information %", "residual px", "without frame px");
  for (std::size_t n = 0; n < estimate.frames.size(); ++n) {
    const FrameContribution& frame = estimate.frames[n];
    text += fmt::format("{:>6} {:>11.0f} {:>8} {:>11.1f} {:>13.1f} {:>11.3f} {:>16}\n", names.at(n),
                        frame.length_px, frame.edges, 100 * frame.explained,
                        100 * frame.information, frame.residual_px,
                        frame.left_out_px > 0 ? fmt::format("{:.3f}", frame.left_out_px) : "-");
  }
  return text;
}

std::string estimate_yaml(const CalibrationEstimate& estimate, const Calibration& start) {
  const std::vector<int> axes = looked_for(estimate);
  const CalibrationCorrection::Vector all = estimate.correction.vector();
  std::string keys, change, covariance;
  for (const int a : axes) {
    keys += fmt::format("{}{}", keys.empty() ? "" : ", ",
                        kCorrectionNumbers[static_cast<std::size_t>(a)].key);
    change += fmt::format("{}{}", change.empty() ? "" : ", ", all[a]);
    std::string row;
    for (const int b : axes)
      row += fmt::format("{}{}", row.empty() ? "" : ", ", estimate.covariance(a, b));
    covariance += fmt::format("    - [{}]\n", row);
  }
  return fmt::format(
      "estimate:\n"
      "  verdict: {}\n{}"
      "  start: {{fx_px: {}, fy_px: {}, cx_px: {}, cy_px: {}, T_color_depth: [{}]}}\n"
      "  frames: {}\n"
      "  objects: {:.1f}\n"
      "  outlines_on_steps: {{start: {:.4f}, estimate: {:.4f}}}\n"
      "  condition: {:.1f}\n"
      "  weakest: {{direction: {}, sigma_px: {:.4f}}}\n"
      "  numbers: [{}]\n"
      "  change: [{}]\n"
      "  covariance:\n{}",
      word_of(estimate.verdict), estimate.may_be_worse ? "  may_be_worse: true\n" : "",
      start.color.fx_px, start.color.fy_px, start.color.cx_px, start.color.cy_px,
      join_numbers(numbers_of(start.T_color_depth), ", "), estimate.frames.size(), estimate.objects,
      estimate.explained_start, estimate.explained, estimate.condition,
      yaml_quoted(estimate.weakest), estimate.weakest_px, keys, change, covariance);
}

}  // namespace mapscore::eval
