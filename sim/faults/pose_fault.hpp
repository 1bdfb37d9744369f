// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/parameters.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace mapscore::sim {

/// How pose noise is tied together over the frames of a drive.
enum class PoseNoiseKind {
  white,    ///< a draw of its own for every frame
  walk,     ///< steps add up: frame n carries the product of n + 1 draws
  constant  ///< one draw for the whole drive
};

/// The image at whose stamp the pose of a frame is looked up.
enum class PoseStamp { depth, color };
constexpr auto names_of(PoseNoiseKind) {
  return std::to_array<std::string_view>({"white", "walk", "constant"});
}
constexpr auto names_of(PoseStamp) {
  return std::to_array<std::string_view>({"depth", "color"});
}

/// Wrong localisation: T_believed = T_true * Exp(xi), xi ~ N(0, E) in the axes of base_footprint,
/// order x y z roll pitch yaw.
struct PoseNoise {
  double sigma_xy_m = 0, sigma_z_m = 0;
  Degrees sigma_roll_pitch_deg, sigma_yaw_deg;
  std::optional<std::array<std::array<double, 6>, 6>> covariance_m_rad;  ///< in place of the sigmas
  double sigma_scale = 1;
  PoseNoiseKind kind = PoseNoiseKind::white;
  double reported_scale = 1;
  PoseStamp stamp = PoseStamp::depth;

  static void fields(auto& s, auto&& visit) {
    visit(s.sigma_xy_m, Field{"sigma_xy_m",
                              "standard deviation of x and of y of base_footprint",
                              {0, 100},
                              "pose σ of x and y (mm)"});
    visit(s.sigma_z_m, Field{"sigma_z_m", "standard deviation of z", {0, 100}});
    visit(s.sigma_roll_pitch_deg,
          Field{"sigma_roll_pitch_deg", "standard deviation of roll and of pitch", {0, 180}});
    visit(s.sigma_yaw_deg,
          Field{"sigma_yaw_deg", "standard deviation of yaw", {0, 180}, "pose σ of yaw (deg)"});
    visit(s.covariance_m_rad,
          Field{"covariance_m_rad",
                "6x6 covariance of x y z roll pitch yaw in place of the standard deviations"});
    visit(s.sigma_scale,
          Field{"sigma_scale",
                "multiplies the standard deviations (the covariance by its square): the dose in "
                "one number",
                {0, 1000},
                "true pose σ (× nominal)"});
    visit(s.kind,
          Field{"kind", "drawn anew for each frame, summed up as a random walk, or drawn once"});
    visit(s.reported_scale, Field{"reported_scale",
                                  "covariance reported to the mapper over the true one",
                                  {0, 1000},
                                  "reported / true covariance"});
    visit(s.stamp, Field{.key = "stamp",
                         .meaning = "the image at whose stamp the pose of a frame is looked up",
                         .later = true});
  }
  bool operator==(const PoseNoise&) const = default;
};

/// E of the poses' error.
[[nodiscard]] Covariance6 covariance_of(const PoseNoise& noise);
/// Covariance that is reported to the mapper: reported_scale times the true one.
[[nodiscard]] Covariance6 reported_covariance(const PoseNoise& noise);

/// The error of a drive's believed poses, frame after frame: T_believed = T_true * Exp(xi). Frame n
/// draws from the stream (seed, "pose", n), and draws scale with the root of the covariance, so
/// that a fault's direction does not depend on its dose.
class PoseErrors {
 public:
  /// Throws Error when the covariance is not positive semi-definite.
  PoseErrors(const Covariance6& covariance, PoseNoiseKind kind, std::uint64_t seed);

  /// Exp(xi) of the next frame; exactly the identity where the covariance is zero.
  [[nodiscard]] Pose next();

 private:
  Covariance6 root_;
  PoseNoiseKind kind_;
  std::uint64_t seed_;
  std::size_t frame_ = 0;
  Pose error_ = Pose::Identity();
};

/// Believed poses T_world_base of a drive, by PoseErrors. A zero covariance returns the true poses
/// bit for bit. Throws likewise.
[[nodiscard]] std::vector<Pose> believe_poses(const std::vector<Pose>& T_world_base,
                                              const Covariance6& covariance, PoseNoiseKind kind,
                                              std::uint64_t seed);

}  // namespace mapscore::sim
