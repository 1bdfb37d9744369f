// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/alignment/shift_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

constexpr double kCell_m = 0.1, kMargin_m = 0.3, kMostCells = 2e6;
/// The field falls off as a Gaussian of this width, cells, as far as kSplat.
constexpr double kSigma_cells = 1.3;
constexpr int kSplat = 2;
/// Peaks below this share of the highest are none.
constexpr double kLowestPeak = 0.6;

int modulo(int a, int size) {
  const int rest = a % size;
  return rest < 0 ? rest + size : rest;
}

}  // namespace

ShiftSearch::ShiftSearch(std::span<const Vector3d> surface) {
  Eigen::AlignedBox3d bounds;
  for (const Vector3d& p : surface) bounds.extend(p);
  low_ = bounds.min();
  centre_ = bounds.center();
  const Vector3d span_m = bounds.sizes() + Vector3d::Constant(2 * kMargin_m);
  cell_m_ = std::max(kCell_m, std::cbrt(span_m.prod() / kMostCells));
  for (int axis = 0; axis < 3; ++axis)
    size_[axis] = cv::getOptimalDFTSize(static_cast<int>(std::ceil(span_m[axis] / cell_m_)));
  Volume field = empty();
  for (const Vector3d& p : surface) {
    const auto [x, y, z] = cell_of(p);
    for (int dz = -kSplat; dz <= kSplat; ++dz)
      for (int dy = -kSplat; dy <= kSplat; ++dy)
        for (int dx = -kSplat; dx <= kSplat; ++dx) {
          const double squared = dx * dx + dy * dy + dz * dz;
          const auto value =
              static_cast<float>(std::exp(-squared / (2 * kSigma_cells * kSigma_cells)));
          float& cell = field(modulo(z + dz, size_[2]) * size_[1] + modulo(y + dy, size_[1]),
                              modulo(x + dx, size_[0]))[0];
          cell = std::max(cell, value);
        }
  }
  field_ = forward(field);
}

std::array<int, 3> ShiftSearch::cell_of(const Vector3d& p) const {
  std::array<int, 3> cell{};
  for (int axis = 0; axis < 3; ++axis) {
    const double index = std::floor((p[axis] - low_[axis]) / cell_m_);
    cell[axis] = static_cast<int>(index - std::floor(index / size_[axis]) * size_[axis]);
    cell[axis] = std::clamp(cell[axis], 0, size_[axis] - 1);
  }
  return cell;
}

// OpenCV transforms planes and rows: x and y are transformed slice by slice,
// then z as rows of the transposed volume. Spectra stay transposed.

ShiftSearch::Volume ShiftSearch::forward(Volume volume) const {
  for (int z = 0; z < size_[2]; ++z) {
    Volume slice = volume.rowRange(z * size_[1], (z + 1) * size_[1]);
    cv::dft(slice, slice);
  }
  Volume spectrum;
  cv::transpose(volume.reshape(0, size_[2]), spectrum);
  cv::dft(spectrum, spectrum, cv::DFT_ROWS);
  return spectrum;
}

ShiftSearch::Volume ShiftSearch::backward(Volume spectrum) const {
  cv::dft(spectrum, spectrum, cv::DFT_ROWS | cv::DFT_INVERSE | cv::DFT_SCALE);
  Volume volume;
  cv::transpose(spectrum, volume);
  volume = volume.reshape(0, size_[2] * size_[1]);
  for (int z = 0; z < size_[2]; ++z) {
    Volume slice = volume.rowRange(z * size_[1], (z + 1) * size_[1]);
    cv::dft(slice, slice, cv::DFT_INVERSE | cv::DFT_SCALE);
  }
  return volume;
}

std::array<std::vector<Shift>, 2> ShiftSearch::peaks(
    const std::array<std::vector<Vector3d>, 2>& clouds, std::span<const double> weights,
    std::size_t most) const {
  // The field is real, so one transform correlates two real clouds, as real and
  // imaginary part.
  Volume both = empty();
  std::array<Vector3d, 2> centres{Vector3d::Zero(), Vector3d::Zero()};
  for (int part = 0; part < 2; ++part) {
    for (std::size_t n = 0; n < clouds[part].size(); ++n) {
      const auto [x, y, z] = cell_of(clouds[part][n]);
      both(z * size_[1] + y, x)[part] += static_cast<float>(weights[n]);
      centres[part] += clouds[part][n] / static_cast<double>(clouds[part].size());
    }
  }
  // sum_p w(p) f(p + s) has the spectrum conj(W) F of a real W. With both
  // clouds in W, the complex conjugate of the wanted one is that of W conj(F).
  Volume spectrum = forward(both);
  cv::mulSpectrums(spectrum, field_, spectrum, 0, true);
  const Volume scores = backward(spectrum);
  return {peaks_of(scores, 0, centres[0], most), peaks_of(scores, 1, centres[1], most)};
}

std::vector<Shift> ShiftSearch::peaks_of(const Volume& scores, int part, const Vector3d& centre,
                                         std::size_t most) const {
  // scores(t) = sum_p w(p) f(p - t): the shift is -t, of all that repeat the
  // one that brings the cloud's centre nearest to the surfaces'.
  const auto at = [&](int x, int y, int z) {
    return scores(modulo(z, size_[2]) * size_[1] + modulo(y, size_[1]), modulo(x, size_[0]))[part];
  };
  float highest = 0.0f;
  for (const cv::Vec2f& value : scores) highest = std::max(highest, value[part]);
  std::vector<Shift> found;
  for (int z = 0; z < size_[2]; ++z)
    for (int y = 0; y < size_[1]; ++y)
      for (int x = 0; x < size_[0]; ++x) {
        const float value = at(x, y, z);
        if (value < kLowestPeak * highest) continue;
        bool is_peak = true;
        for (int d = 0; d < 27 && is_peak; ++d)
          is_peak = d == 13 || at(x + d % 3 - 1, y + d / 3 % 3 - 1, z + d / 9 - 1) <= value;
        if (!is_peak) continue;
        Shift shift{{-x * cell_m_, -y * cell_m_, -z * cell_m_}, value};
        for (int axis = 0; axis < 3; ++axis) {
          const double period_m = size_[axis] * cell_m_;
          const double off = centre_[axis] - (centre[axis] + shift.by[axis]);
          shift.by[axis] += std::round(off / period_m) * period_m;
        }
        found.push_back(shift);
      }
  std::ranges::stable_sort(found, std::ranges::greater(), &Shift::score);
  if (found.size() > most) found.resize(most);
  return found;
}

}  // namespace mapscore::eval
