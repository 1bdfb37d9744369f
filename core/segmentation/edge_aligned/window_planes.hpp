// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/edge_aligned/window_medians.hpp"

#include <opencv2/core.hpp>

#include <array>
#include <cstddef>

namespace mapscore {

/// Planes w = a + b du + c dv fitted to the inverse depth w of the pixels about one, its window: of
/// those that have its label and lie near the plane. As many at once as wide vectors hold.
/// Thread-safe.
struct WindowPlanes {
  static constexpr int kReach_px = 4, kEdge_px = 2 * kReach_px + 1;  ///< of a window
  static constexpr std::size_t kFitted = WindowValues::kWindows;     ///< planes at once
  using Row = WindowValues::Row;

  Row labelled;  ///< how many pixels of the window have the label of its middle
  Row near;      ///< how many of these lie near the plane
  Row rise;      ///< of w at the middle, from its own, 1/m
  Row variance;  ///< of w there, in variances of the noise of one pixel
};

/// Two images with a rim as wide as a window's reach, and as wide as kFitted windows on the right,
/// so that no window leaves them; labels as floats, which hold them exactly.
struct RimmedImages {
  RimmedImages(const cv::Mat1f& inverse_depth, const cv::Mat1w& pixel_labels);

  cv::Mat1f labels, inverse;
};

/// The windows about kFitted pixels beside each other in a row, from pixel (u, v) of the images on;
/// these must outlive it. (x, y) is a place of a window, from its middle: there the label and w of
/// the first window, and behind them those of the others.
class WindowsInRow {
 public:
  WindowsInRow(const RimmedImages& images, int u, int v)
      : label_(images.labels[v + WindowPlanes::kReach_px] + u + WindowPlanes::kReach_px),
        w_(images.inverse[v + WindowPlanes::kReach_px] + u + WindowPlanes::kReach_px),
        stride_(static_cast<std::ptrdiff_t>(images.labels.step1())) {}

  [[nodiscard]] const float* label(int x, int y) const { return label_ + y * stride_ + x; }
  [[nodiscard]] const float* w(int x, int y) const { return w_ + y * stride_ + x; }

 private:
  const float *label_, *w_;
  std::ptrdiff_t stride_;
};

/// The windows about kFitted pixels from anywhere, copied. label() and w() are those of
/// WindowsInRow, once each window is set.
class CopiedWindows {
 public:
  /// The window about pixel (u, v) of the images becomes the n-th.
  void set(std::size_t n, const RimmedImages& images, int u, int v);

  [[nodiscard]] const float* label(int x, int y) const { return labels_[place_of(x, y)].data(); }
  [[nodiscard]] const float* w(int x, int y) const { return inverse_[place_of(x, y)].data(); }

 private:
  static std::size_t place_of(int x, int y) {
    constexpr int kReach_px = WindowPlanes::kReach_px;
    return static_cast<std::size_t>((y + kReach_px) * WindowPlanes::kEdge_px + x + kReach_px);
  }

  using Places = std::array<WindowPlanes::Row, WindowPlanes::kEdge_px * WindowPlanes::kEdge_px>;
  Places labels_, inverse_;
};

/// Level planes: near is what lies within `within` of the middle's own w, 1/m.
[[nodiscard]] WindowPlanes fit_level_planes(const WindowsInRow& windows,
                                            const WindowPlanes::Row& within);

/// Planes that slope: near is what lies within `within` of a plane through the middle that rises
/// from pixel to pixel by the medians over pairs of neighbours of the label.
[[nodiscard]] WindowPlanes fit_sloped_planes(const CopiedWindows& windows,
                                             const WindowPlanes::Row& within);

}  // namespace mapscore
