// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

namespace mapscore::eval {
namespace {

struct KnownLeaf {
  std::string_view path, name, unit;
  double scale = 1.0;  ///< from the unit of the study file to `unit`
};

constexpr double kMillimetres = 1000.0;
constexpr std::array kKnownLeaves{
    KnownLeaf{"faults.misregistration.magnitude_m", "misregistration", "mm", kMillimetres},
    KnownLeaf{"faults.misregistration.angle_deg", "misregistration angle", "deg"},
    KnownLeaf{"faults.misregistration.focal_error_percent", "focal length error", "%"},
    KnownLeaf{"faults.mount.magnitude_m", "mount error", "mm", kMillimetres},
    KnownLeaf{"faults.mount.angle_deg", "mount error angle", "deg"},
    KnownLeaf{"faults.pose.sigma_xy_m", "pose σ of x and y", "mm", kMillimetres},
    KnownLeaf{"faults.pose.sigma_yaw_deg", "pose σ of yaw", "deg"},
    KnownLeaf{"faults.pose.sigma_scale", "true pose σ", "× nominal"},
    KnownLeaf{"faults.pose.reported_scale", "reported / true covariance", ""},
    KnownLeaf{"faults.time_offset_ms", "time offset", "ms"},
    KnownLeaf{"faults.depth.preset", "depth camera", ""},
    KnownLeaf{"faults.labels.preset", "2D segmentation", ""},
    KnownLeaf{"faults.labels.scale", "label errors", "× the preset's"},
    KnownLeaf{"faults.labels.boundary_px", "label boundary off by", "px"},
    KnownLeaf{"localization.source", "pose source", ""},
    KnownLeaf{"fusion.blend.N", "N", ""},
    KnownLeaf{"fusion.blend.K", "K", ""},
    KnownLeaf{"voxel_m", "voxel", "mm", kMillimetres},
};

KnownLeaf leaf_of(const std::string& path) {
  const auto known = std::find_if(kKnownLeaves.begin(), kKnownLeaves.end(),
                                  [&](const KnownLeaf& leaf) { return leaf.path == path; });
  if (known != kKnownLeaves.end()) return *known;
  const std::size_t dot = path.rfind('.');
  const std::string_view last =
      std::string_view(path).substr(dot == std::string::npos ? 0 : dot + 1);
  return {path, last, ""};
}

std::optional<double> number_of(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole ? std::optional(number) : std::nullopt;
}

/// "particle_filter" as people write it.
std::string spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace

std::string FigureAxis::title() const {
  return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

std::string FigureAxis::text(std::size_t value) const {
  return fmt::format("{} = {}{}{}", name, values.at(value), unit.empty() ? "" : " ", unit);
}

FigureAxis figure_axis(const SweepAxis& axis) {
  const KnownLeaf leaf = leaf_of(axis.path);
  FigureAxis figure{std::string(leaf.name), std::string(leaf.unit), true, {}, {}, ""};
  figure.key = axis.path.substr(axis.path.rfind('.') + 1);
  for (const std::string& value : axis.values) {
    const std::optional<double> number = number_of(value);
    figure.numeric = figure.numeric && number;
    figure.at.push_back(number.value_or(0.0) * leaf.scale);
    figure.values.push_back(number ? fmt::format("{:.6g}", *number * leaf.scale) : spaced(value));
  }
  if (!figure.numeric)
    for (std::size_t i = 0; i < figure.at.size(); ++i) figure.at[i] = static_cast<double>(i);
  return figure;
}

}  // namespace mapscore::eval
