// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/matched_edges.hpp"

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
  float *__restrict px = moved.x, *__restrict py = moved.y, *__restrict pz = moved.z,
                   *__restrict us = moved.u, *__restrict vs = moved.v;
  const float fx = project.fx, fy = project.fy, cx = project.cx, cy = project.cy;
  const float xx = R(0, 0), xy = R(0, 1), xz = R(0, 2), yx = R(1, 0), yy = R(1, 1), yz = R(1, 2),
              zx = R(2, 0), zy = R(2, 1), zz = R(2, 2), tx = t.x(), ty = t.y(), tz = t.z();
  for (int n = 0; n < count; ++n) {
    const float x = xs[n], y = ys[n], z = zs[n];
    const float X = xx * x + (xy * y + xz * z) + tx;
    const float Y = yx * x + (yy * y + yz * z) + ty;
    const float Z = zx * x + (zy * y + zz * z) + tz;
    px[n] = X / Z, py[n] = Y / Z, pz[n] = Z;
    us[n] = fx * X / Z + cx, vs[n] = fy * Y / Z + cy;
  }
}

/// Places in an image, of points z metres before the camera.
struct Places {
  const float *u, *v, *z;
  int count;
};

/// As BetweenPixels.
struct Between {
  float *value, *slope_u, *slope_v;
};

/// Reads an image of at least 2 x 2 pixels between them. Marks the places within it where it is at
/// most `most` from 0.
MAPSCORE_WIDE_VECTORS
void read_between(const float* image, const cv::Size& size, const Places& places, float most,
                  const Between& between, std::uint8_t* __restrict marks) {
  const int count = places.count, columns = size.width;
  const float *us = places.u, *vs = places.v, *zs = places.z;
  const float right = static_cast<float>(size.width - 1),
              bottom = static_cast<float>(size.height - 1);
  float *__restrict value = between.value, *__restrict slope_u = between.slope_u,
                   *__restrict slope_v = between.slope_v;
  for (int n = 0; n < count; ++n) {
    const bool inside = (zs[n] > MatchedEdges::kNearest_m) & (us[n] >= 0) & (vs[n] >= 0) &
                        (us[n] < right) & (vs[n] < bottom);
    const float at_u = inside ? us[n] : 0.0F, at_v = inside ? vs[n] : 0.0F;
    const int u = static_cast<int>(at_u), v = static_cast<int>(at_v);
    const float a = at_u - static_cast<float>(u), b = at_v - static_cast<float>(v);
    const int cell = v * columns + u;
    const float top_left = image[cell], top_right = image[cell + 1],
                low_left = image[cell + columns], low_right = image[cell + columns + 1];
    const float d =
        (1 - b) * ((1 - a) * top_left + a * top_right) + b * ((1 - a) * low_left + a * low_right);
    value[n] = d;
    slope_u[n] = (1 - b) * (top_right - top_left) + b * (low_right - low_left);
    slope_v[n] = (1 - a) * (low_left - top_left) + a * (low_right - top_right);
    marks[n] = static_cast<std::uint8_t>(inside & !(std::abs(d) > most));
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

void MatchedEdges::move(const EdgeColumns& edges, const OutlineAlignment& a,
                        const Projection& project) {
  for (std::vector<float>* column : {&x_, &y_, &z_, &u_, &v_}) column->resize(edges.x.size());
  project_points({edges.x.data(), edges.y.data(), edges.z.data(), static_cast<int>(edges.x.size())},
                 a.rotation, a.translation, project,
                 {x_.data(), y_.data(), z_.data(), u_.data(), v_.data()});
}

void MatchedEdges::find_distances(float within_px) {
  for (std::vector<float>* column : {&value_, &slope_u_, &slope_v_}) column->resize(u_.size());
  is_near_.assign(u_.size(), 0);
  const cv::Mat1f& distance = field_.distance;
  if (distance.rows < 2 || distance.cols < 2) return;
  read_between(distance[0], distance.size(),
               {u_.data(), v_.data(), z_.data(), static_cast<int>(u_.size())}, within_px,
               {value_.data(), slope_u_.data(), slope_v_.data()}, is_near_.data());
}

}  // namespace mapscore
