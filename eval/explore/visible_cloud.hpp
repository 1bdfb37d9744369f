// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/frame.hpp"
#include "core/geometry/camera.hpp"

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

namespace mapscore::eval {

/// A point of a surface that a depth camera saw.
struct SurfacePoint {
  Eigen::Vector3f p_world = Eigen::Vector3f::Zero();  ///< metres
  InstanceId instance = 0;                            ///< 0: background
  bool operator==(const SurfacePoint&) const = default;
};

/// What a camera saw of a scene's surfaces: of all depth samples within its range the first in each
/// cube of an edge and of each instance. Used by one thread at a time.
class VisibleCloud {
 public:
  explicit VisibleCloud(double cell_m) : cell_m_(cell_m) {}

  /// Adds the samples of a frame's `depth` and `depth_label` at its true pose. Throws Error when an
  /// image has another size than the camera.
  void add(const Frame& frame, const Calibration& truth);

  [[nodiscard]] const std::vector<SurfacePoint>& points() const { return points_; }

 private:
  double cell_m_;
  std::vector<SurfacePoint> points_;
  std::unordered_set<std::uint64_t> taken_;  ///< hashes of cube and instance
};

/// Little-endian: a magic line, each point as three floats and an instance, the hash of all that.
[[nodiscard]] std::string cloud_bytes(const std::vector<SurfacePoint>& points);
/// Nothing unless the bytes are whole.
[[nodiscard]] std::optional<std::vector<SurfacePoint>> cloud_of_bytes(const std::string& bytes);

/// The points that a file holds, or else those that `make` gives, which are then kept there.
[[nodiscard]] std::vector<SurfacePoint> kept_cloud(
    const std::filesystem::path& file, const std::function<std::vector<SurfacePoint>()>& make);

}  // namespace mapscore::eval
