// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/parameters.hpp"

#include <array>
#include <cstdint>
#include <string_view>

namespace mapscore::sim {

/// A rigid error: fixed parts, and a magnitude whose direction the seed draws.
struct RigidDose {
  double magnitude_m = 0;  ///< along a direction uniform on the circle in the image plane
  Degrees angle_deg{};     ///< about an axis uniform on the circle in the image plane
  std::array<double, 3> translation_m{};  ///< in the optical axes of the camera concerned
  std::array<Degrees, 3> rotation_deg{};  ///< rotation vector, in the same axes

  /// What differs between two rigid errors in the words for people.
  struct Words {
    std::string_view magnitude, angle, translation, rotation, magnitude_figure, angle_figure;
  };
  static void fields(auto& s, const Words& words, auto&& visit) {
    visit(s.magnitude_m, Field{"magnitude_m", words.magnitude, {0, 1}, words.magnitude_figure});
    visit(s.angle_deg, Field{"angle_deg", words.angle, {0, 180}, words.angle_figure});
    visit(s.translation_m, Field{"translation_m", words.translation, {-10, 10}});
    visit(s.rotation_deg, Field{"rotation_deg", words.rotation, {-180, 180}});
  }
  bool operator==(const RigidDose&) const = default;
};

/// Error of the believed depth-to-colour registration. Moves labels, never points.
struct Misregistration {
  RigidDose rigid;
  double focal_error_percent = 0;  ///< the believed colour focal length is f * (1 + error)
  std::array<double, 2> principal_point_px{};  ///< added to the colour camera's centre

  static void fields(auto& s, auto&& visit) {
    constexpr RigidDose::Words kWords{
        "shift of the believed depth camera, its direction drawn by the seed",
        "turn of the believed depth camera, its axis drawn by the seed",
        "shift in the colour camera's optical frame; excludes magnitude_m",
        "rotation vector in the colour camera's optical frame; excludes angle_deg",
        "misregistration (mm)",
        "misregistration angle (deg)"};
    RigidDose::fields(s.rigid, kWords, visit);
    visit(s.focal_error_percent, Field{"focal_error_percent",
                                       "error of the believed focal length of the colour camera",
                                       {.low = -100, .high = 100, .open_low = true},
                                       "focal length error (%)"});
    visit(s.principal_point_px, Field{"principal_point_px",
                                      "error of the believed principal point of the colour camera",
                                      {-1000, 1000}});
  }
  bool operator==(const Misregistration&) const = default;
};

/// Error of the believed camera-to-base calibration. Moves points, never labels.
struct MountError {
  RigidDose rigid;

  static void fields(auto& s, auto&& visit) {
    constexpr RigidDose::Words kWords{
        "shift of the believed mount, its direction drawn by the seed",
        "turn of the believed mount, its axis drawn by the seed",
        "shift in the depth camera's optical frame; excludes magnitude_m",
        "rotation vector in the depth camera's optical frame; excludes angle_deg",
        "mount error (mm)",
        "mount error angle (deg)"};
    RigidDose::fields(s.rigid, kWords, visit);
  }
  bool operator==(const MountError&) const = default;
};

/// Throws Error, beginning with a key, when a fixed part stands beside a magnitude of its kind.
void check(const RigidDose& dose);

/// The rigid error E of a dose; the identity, bit for bit, when every dose is zero. The direction
/// drawn from (seed, purpose) does not depend on the dose.
[[nodiscard]] Pose rigid_error(const RigidDose& dose, std::uint64_t seed, std::string_view purpose);

/// Believed calibration under misregistration: T_believed_color_depth = E * T_color_depth, and the
/// colour intrinsics. A zero dose returns the true calibration bit for bit.
[[nodiscard]] Calibration misregister(const Calibration& truth, const Misregistration& dose,
                                      std::uint64_t seed);

/// Believed calibration under a mount error: T_believed_base_depth = T_base_depth * M, with M in
/// depth optical axes.
[[nodiscard]] Calibration misplace_mount(const Calibration& truth, const MountError& dose,
                                         std::uint64_t seed);

}  // namespace mapscore::sim
