// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/edge_aligned/outline_shifts.hpp"
#include "core/wide_vectors.hpp"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace mapscore {

/// Where the pixels of a depth image lie in a colour image. Neighbours mostly lie beside each other
/// there too, so that a row reads the colour image in long runs, as fast as it can be copied.
class ColorPlaces {
 public:
  /// Depth pixels of a row, from column `begin`, that lie in colour pixels beside each other, from
  /// `cell` on.
  struct Run {
    int begin, count, cell;
  };

  /// `find_row(v, cells)`: writes the places of row v, as in `cells` below.
  ColorPlaces(const cv::Size& depth_image, auto&& find_row) : cells_(depth_image) {
    Marks jumps(static_cast<std::size_t>(cells_.cols));
    for (int v = 0; v < cells_.rows; ++v) {
      find_row(v, cells_[v]);
      add_runs(v, jumps);
    }
    first_run_.push_back(runs_.size());
  }

  /// By depth pixel the place in the colour image, row-major; -1 beyond it.
  [[nodiscard]] const cv::Mat1i& cells() const { return cells_; }

  [[nodiscard]] std::span<const Run> runs_of(int v) const {
    const auto row = static_cast<std::size_t>(v);
    return std::span(runs_).subspan(first_run_[row], first_run_[row + 1] - first_run_[row]);
  }

  /// Reads an image of the colour camera's, row-major, at the pixels of row v; what lies beyond it
  /// keeps its value.
  template <typename Value>
  void look_up(const Value* image, int v, Value* values) const {
    for (const auto& [begin, count, cell] : runs_of(v))
      std::copy_n(image + cell, count, values + begin);
  }

 private:
  void add_runs(int v, Marks& jumps);

  cv::Mat1i cells_;
  std::vector<Run> runs_;
  std::vector<std::size_t> first_run_;  ///< of each row, and the end
};

/// The places of depth pixels in the colour image of a mended calibration and its shifts.
/// `inverse_depth`: 1/m; a pixel without depth is placed as at infinity. Thread-safe.
[[nodiscard]] ColorPlaces color_places(const cv::Mat1f& inverse_depth, const Calibration& mended,
                                       const OutlineShifts& shifts);

}  // namespace mapscore
