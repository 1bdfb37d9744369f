// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/outline_equations.hpp"

#include "core/wide_vectors.hpp"

#include <numeric>

namespace mapscore {

MAPSCORE_WIDE_VECTORS
NormalEquations add_up(const MatchedEdges& edges, const Projection& project, float focal_px) {
  constexpr int kLanes = EdgeColumns::kTogether, kRows = kParameters + 2;
  const float *xs = edges.x.data(), *ys = edges.y.data(), *zs = edges.z.data();
  const float *weights = edges.weight.data(), *residuals = edges.residual.data(),
              *slopes_u = edges.slope_u.data(), *slopes_v = edges.slope_v.data(),
              *slopes_offset = edges.slope_offset.data();
  const float fx = project.fx, fy = project.fy, part = 1.0F / focal_px;
  alignas(64) float sums[kRows * (kRows + 1) / 2][kLanes] = {};
  alignas(64) float rows[kRows][kLanes];  // the slopes, the residual and 1
  const int count = static_cast<int>(edges.weight.size());
  for (int first = 0; first < count; first += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const int n = first + lane;
      const float x = xs[n], y = ys[n], gu = slopes_u[n] * fx, gv = slopes_v[n] * fy;
      const float nearness = 1.0F / zs[n];
      rows[kTurnX][lane] = part * (-gu * x * y - gv * (1 + y * y));
      rows[kTurnY][lane] = part * (gu * (1 + x * x) + gv * x * y);
      rows[kRoll][lane] = part * (gv * x - gu * y);
      rows[kFocal][lane] = part * (gu * x + gv * y);
      rows[kShiftX][lane] = gu * nearness;
      rows[kShiftY][lane] = gv * nearness;
      rows[kOffset][lane] = slopes_offset[n];
      rows[kParameters][lane] = residuals[n];
      rows[kParameters + 1][lane] = 1.0F;
    }
    float(*sum)[kLanes] = sums;
    for (int i = 0; i < kRows; ++i) {
      alignas(64) float weighted[kLanes];
      for (int lane = 0; lane < kLanes; ++lane)
        weighted[lane] = weights[first + lane] * rows[i][lane];
      for (int j = 0; j <= i; ++j, ++sum)
        for (int lane = 0; lane < kLanes; ++lane) (*sum)[lane] += weighted[lane] * rows[j][lane];
    }
  }
  Eigen::Matrix<float, kRows, kRows> all;
  const float(*sum)[kLanes] = sums;
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j <= i; ++j, ++sum)
      all(i, j) = all(j, i) = std::accumulate(*sum, *sum + kLanes, 0.0F);
  return {all.topLeftCorner<kParameters, kParameters>(), -all.col(kParameters).head<kParameters>(),
          all(kParameters + 1, kParameters + 1), all(kParameters, kParameters)};
}

}  // namespace mapscore
