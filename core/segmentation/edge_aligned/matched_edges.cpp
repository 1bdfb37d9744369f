// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/matched_edges.hpp"

#include <algorithm>

namespace mapscore {
EdgeColumns::EdgeColumns(const std::vector<ProjectedEdge>& edges, std::size_t most)
    : stride(1 + edges.size() / most) {
  for (std::size_t n = 0; n < edges.size(); n += stride) {
    const ProjectedEdge& edge = edges[n];
    x.push_back(edge.p.x());
    y.push_back(edge.p.y());
    z.push_back(edge.p.z());
    outward_u.push_back(edge.outward.x());
    outward_v.push_back(edge.outward.y());
    strength.push_back(edge.strength);
    way.push_back(edge.way);
  }
}

void PlacedEdges::clear() {
  for (std::vector<float>* column : {&u, &v, &outward_u, &outward_v, &strength}) column->clear();
}

void PlacedEdges::push_back(const Eigen::Vector2f& at, const Eigen::Vector2f& outward,
                            float edge_strength) {
  u.push_back(at.x());
  v.push_back(at.y());
  outward_u.push_back(outward.x());
  outward_v.push_back(outward.y());
  strength.push_back(edge_strength);
}

MAPSCORE_WIDE_VECTORS
void MatchedEdges::move(const EdgeColumns& edges, const OutlineAlignment& a,
                        const Projection& project) {
  const int count = static_cast<int>(edges.x.size());
  for (std::vector<float>* column : {&x_, &y_, &z_, &u_, &v_}) column->resize(edges.x.size());
  const float *xs = edges.x.data(), *ys = edges.y.data(), *zs = edges.z.data();
  float *px = x_.data(), *py = y_.data(), *pz = z_.data(), *us = u_.data(), *vs = v_.data();
  const Eigen::Matrix3f& R = a.rotation;
  const float fx = project.fx, fy = project.fy, cx = project.cx, cy = project.cy;
  const float xx = R(0, 0), xy = R(0, 1), xz = R(0, 2), yx = R(1, 0), yy = R(1, 1), yz = R(1, 2),
              zx = R(2, 0), zy = R(2, 1), zz = R(2, 2), tx = a.translation.x(),
              ty = a.translation.y(), tz = a.translation.z();
  MAPSCORE_NO_OVERLAPS
  for (int n = 0; n < count; ++n) {
    const float x = xs[n], y = ys[n], z = zs[n];
    const float X = xx * x + (xy * y + xz * z) + tx;
    const float Y = yx * x + (yy * y + yz * z) + ty;
    const float Z = zx * x + (zy * y + zz * z) + tz;
    px[n] = X / Z, py[n] = Y / Z, pz[n] = Z;
    us[n] = fx * X / Z + cx, vs[n] = fy * Y / Z + cy;
  }
}

void MatchedEdges::move(const PlacedEdges& edges, const Eigen::Vector2f& shift) {
  const std::size_t count = edges.u.size();
  z_.assign(count, 1.0F);
  u_.resize(count), v_.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    u_[n] = edges.u[n] + shift.x();
    v_[n] = edges.v[n] + shift.y();
  }
}

MAPSCORE_WIDE_VECTORS
void MatchedEdges::match_at_once(const std::vector<float>& outward_u,
                                 const std::vector<float>& outward_v,
                                 const std::vector<float>& strength, float offset_px,
                                 float sigma_px) {
  for (std::vector<float>* column :
       {&distance_, &slope_u_, &slope_v_, &facing_, &full_weight_, &exponent_})
    column->resize(u_.size());
  is_near_.assign(u_.size(), 0);
  const int count = static_cast<int>(u_.size()), columns = field_.distance.cols,
            rows = field_.distance.rows;
  if (columns < 2 || rows < 2) return;
  const float *image = field_.distance[0], *us = u_.data(), *vs = v_.data(), *zs = z_.data(),
              *outward_us = outward_u.data(), *outward_vs = outward_v.data(),
              *strengths = strength.data();
  float *distance = distance_.data(), *slope_u = slope_u_.data(), *slope_v = slope_v_.data(),
        *facing = facing_.data(), *full_weight = full_weight_.data(), *exponent = exponent_.data();
  std::uint8_t* const is_near = is_near_.data();
  const float right = static_cast<float>(columns - 1), bottom = static_cast<float>(rows - 1);
  const float most = 3 * sigma_px + std::abs(offset_px), variance = sigma_px * sigma_px;
  const float against = static_cast<float>(OutlineField::kOtherWay);
  MAPSCORE_NO_OVERLAPS
  for (int n = 0; n < count; ++n) {
    const float at_u = std::min(std::max(0.0F, us[n]), right);
    const float at_v = std::min(std::max(0.0F, vs[n]), bottom);
    const int u = std::min(static_cast<int>(at_u), columns - 2);
    const int v = std::min(static_cast<int>(at_v), rows - 2);
    const float a = at_u - static_cast<float>(u), b = at_v - static_cast<float>(v);
    const int cell = v * columns + u;
    const float top_left = image[cell], top_right = image[cell + 1],
                low_left = image[cell + columns], low_right = image[cell + columns + 1];
    const float d =
        (1 - b) * ((1 - a) * top_left + a * top_right) + b * ((1 - a) * low_left + a * low_right);
    const float du = (1 - b) * (top_right - top_left) + b * (low_right - low_left);
    const float dv = (1 - a) * (low_left - top_left) + a * (low_right - top_right);
    const float along = du * outward_us[n] + dv * outward_vs[n], opposite = -against * along;
    const float faces = along > 0 ? along : opposite;
    const float residual = d - offset_px;
    distance[n] = d, slope_u[n] = du, slope_v[n] = dv, facing[n] = along;
    full_weight[n] = strengths[n] * faces;
    exponent[n] = -0.5F * residual * residual / variance;
    const bool inside =
        (zs[n] > kNearest_m) & (us[n] >= 0) & (vs[n] >= 0) & (us[n] < right) & (vs[n] < bottom);
    is_near[n] = static_cast<std::uint8_t>(inside & !(std::abs(d) > most));
  }
}

}  // namespace mapscore
