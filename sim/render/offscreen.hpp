// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <mujoco/mujoco.h>
#include <opencv2/core.hpp>

#include <memory>

namespace mapscore::sim {

/// Planar depth from what the depth buffer holds: z = numerator / (d + offset), of the projection's
/// own single-precision coefficients (zero-far mapping: d = 1 at the near plane, 0 at the far one).
struct DepthScale {
  double numerator = 0, offset = 0;

  /// Metres; 0 where nothing was drawn.
  [[nodiscard]] float metres(float d) const {
    return d > 0 ? static_cast<float>(numerator / (static_cast<double>(d) + offset)) : 0.0f;
  }
};

/// One OSMesa context with MuJoCo's rendering resources. Used by the thread that made it; contexts
/// of other threads may live beside it.
class Offscreen {
 public:
  /// `coarse`: one quadrilateral a side of a box. Throws Error when OSMesa gives no context or
  /// MuJoCo cannot use it.
  explicit Offscreen(const mjModel& model, bool coarse = false);
  ~Offscreen();
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

  /// Draws `scene` into a buffer of width x height pixels.
  void draw(int width_px, int height_px, mjvScene& scene);

  /// What was drawn last, row 0 at the BOTTOM. `depth` may be left out.
  void read(cv::Mat3b& bgr, cv::Mat1f* depth = nullptr) const;
  /// Depth scale of what was drawn last.
  [[nodiscard]] const DepthScale& depth_scale() const { return depth_scale_; }

 private:
  struct Context;
  std::unique_ptr<Context> context_;
  int width_px_ = 0, height_px_ = 0;
  DepthScale depth_scale_;
};

}  // namespace mapscore::sim
