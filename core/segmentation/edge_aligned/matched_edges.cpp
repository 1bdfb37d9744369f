// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/matched_edges.hpp"

#include <algorithm>

namespace mapscore {
namespace {

struct Points {
  const float *x, *y, *z;
  int count;
};

/// As in MatchedEdges::Match.
struct Moved {
  float *x, *y, *z, *u, *v;
};

/// Moves points to R p + t and projects them.
MAPSCORE_WIDE_VECTORS
void project_points(const Points& points, const Eigen::Matrix3f& R, const Eigen::Vector3f& t,
                    const Projection& project, const Moved& moved) {
  const int count = points.count;
  const float *xs = points.x, *ys = points.y, *zs = points.z;
  float *px = moved.x, *py = moved.y, *pz = moved.z, *us = moved.u, *vs = moved.v;
  const float fx = project.fx, fy = project.fy, cx = project.cx, cy = project.cy;
  const float xx = R(0, 0), xy = R(0, 1), xz = R(0, 2), yx = R(1, 0), yy = R(1, 1), yz = R(1, 2),
              zx = R(2, 0), zy = R(2, 1), zz = R(2, 2), tx = t.x(), ty = t.y(), tz = t.z();
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

/// Edges at places of an image, z metres before the camera.
struct Placed {
  const float *u, *v, *z, *outward_u, *outward_v, *strength;
  int count;
};

/// As the columns of MatchedEdges.
struct Matches {
  float *distance, *slope_u, *slope_v, *facing, *full_weight, *exponent;
  std::uint8_t* is_near;
};

/// Matches edges as match_at does where no border of two masks is. `image`: the field's distance,
/// of at least 2 x 2 pixels.
MAPSCORE_WIDE_VECTORS
void match_places(const float* image, const cv::Size& size, const Placed& edges, float offset_px,
                  float sigma_px, const Matches& matches) {
  const int count = edges.count, columns = size.width, rows = size.height;
  const float *us = edges.u, *vs = edges.v, *zs = edges.z, *outward_u = edges.outward_u,
              *outward_v = edges.outward_v, *strength = edges.strength;
  float *distance = matches.distance, *slope_u = matches.slope_u, *slope_v = matches.slope_v,
        *facing = matches.facing, *full_weight = matches.full_weight, *exponent = matches.exponent;
  std::uint8_t* const is_near = matches.is_near;
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
    const float along = du * outward_u[n] + dv * outward_v[n], opposite = -against * along;
    const float faces = along > 0 ? along : opposite;
    const float residual = d - offset_px;
    distance[n] = d, slope_u[n] = du, slope_v[n] = dv, facing[n] = along;
    full_weight[n] = strength[n] * faces;
    exponent[n] = -0.5F * residual * residual / variance;
    const bool inside = (zs[n] > MatchedEdges::kNearest_m) & (us[n] >= 0) & (vs[n] >= 0) &
                        (us[n] < right) & (vs[n] < bottom);
    is_near[n] = static_cast<std::uint8_t>(inside & !(std::abs(d) > most));
  }
}

}  // namespace

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

void MatchedEdges::move(const EdgeColumns& edges, const OutlineAlignment& a,
                        const Projection& project) {
  for (std::vector<float>* column : {&x_, &y_, &z_, &u_, &v_}) column->resize(edges.x.size());
  project_points({edges.x.data(), edges.y.data(), edges.z.data(), static_cast<int>(edges.x.size())},
                 a.rotation, a.translation, project,
                 {x_.data(), y_.data(), z_.data(), u_.data(), v_.data()});
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

void MatchedEdges::match_at_once(const std::vector<float>& outward_u,
                                 const std::vector<float>& outward_v,
                                 const std::vector<float>& strength, float offset_px,
                                 float sigma_px) {
  for (std::vector<float>* column :
       {&distance_, &slope_u_, &slope_v_, &facing_, &full_weight_, &exponent_})
    column->resize(u_.size());
  is_near_.assign(u_.size(), 0);
  const cv::Mat1f& distance = field_.distance;
  if (distance.rows < 2 || distance.cols < 2) return;
  match_places(distance[0], distance.size(),
               {u_.data(), v_.data(), z_.data(), outward_u.data(), outward_v.data(),
                strength.data(), static_cast<int>(u_.size())},
               offset_px, sigma_px,
               {distance_.data(), slope_u_.data(), slope_v_.data(), facing_.data(),
                full_weight_.data(), exponent_.data(), is_near_.data()});
}

}  // namespace mapscore
