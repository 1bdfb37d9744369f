// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace mapscore::eval {

/// A shift of a cloud, and how much of its weight then lies near the surfaces.
struct Shift {
  Eigen::Vector3d by = Eigen::Vector3d::Zero();
  double score = 0.0;
};

/// Finds the shifts that bring a cloud onto surfaces: correlates its occupied
/// cells with a field that falls off with the distance from the surfaces, for
/// all shifts at once, by Fourier transforms. Immutable, safe to share between
/// threads.
class ShiftSearch {
 public:
  /// Cells of 10 cm, larger where the surfaces would take too many. The volume repeats beyond the
  /// surfaces' bounds, so that a part of a cloud that a shift brings out of them on one side counts
  /// as come in on the other.
  explicit ShiftSearch(std::span<const Eigen::Vector3d> surface);

  [[nodiscard]] double cell_m() const { return cell_m_; }
  /// The highest peaks of two clouds, best first, at most `most` each; weights
  /// are one a point.
  [[nodiscard]] std::array<std::vector<Shift>, 2> peaks(
      const std::array<std::vector<Eigen::Vector3d>, 2>& clouds, std::span<const double> weights,
      std::size_t most) const;

 private:
  using Volume = cv::Mat_<cv::Vec2f>;  ///< complex; a row for each z and y, or
                                       ///< for each y and x

  [[nodiscard]] Volume empty() const { return Volume::zeros(size_[2] * size_[1], size_[0]); }
  [[nodiscard]] std::array<int, 3> cell_of(const Eigen::Vector3d& p) const;
  [[nodiscard]] Volume forward(Volume volume) const;
  [[nodiscard]] Volume backward(Volume spectrum) const;
  [[nodiscard]] std::vector<Shift> peaks_of(const Volume& scores, int part,
                                            const Eigen::Vector3d& centre, std::size_t most) const;

  double cell_m_ = 0.1;
  Eigen::Vector3d low_, centre_;  ///< of the surfaces' bounds
  std::array<int, 3> size_{};     ///< cells along x, y, z, after which the volume repeats
  Volume field_;                  ///< its spectrum
};

}  // namespace mapscore::eval
