// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/matched_edges.hpp"

#include "core/geometry/pose.hpp"
#include "core/wide_vectors.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace mapscore {

std::vector<ProjectedEdge> edges_near_outlines(const DepthEdges& edges, const OutlineField& field,
                                               const Calibration& believed, float reach_px) {
  const Eigen::Matrix3f R = believed.T_color_depth.linear().cast<float>();
  const Eigen::Vector3f t = believed.T_color_depth.translation().cast<float>();
  const Projection project(believed.color);
  const Eigen::Array2f last(static_cast<float>(field.distance.cols - 1),
                            static_cast<float>(field.distance.rows - 1));
  std::vector<ProjectedEdge> near;
  near.reserve(edges.steps.size());
  for (const DepthEdge& edge : edges.steps) {
    const Eigen::Vector3f p = R * edge.point + t;
    if (!(p.z() > MatchedEdges::kNearest_m)) continue;
    const Eigen::Array2f at = project(p), within = at.max(0.0F).min(last);
    const float distance =
        std::abs(field.distance(static_cast<int>(within.y()), static_cast<int>(within.x()))) +
        (within - at).abs().sum();
    if (distance <= reach_px)
      near.push_back(
          {p, direction_of(edge.outward), static_cast<std::uint8_t>(edge.outward), edge.strength});
  }
  return near;
}

EdgeColumns::EdgeColumns(const std::vector<ProjectedEdge>& edges, std::size_t most)
    : stride(1 + edges.size() / most) {
  const auto add = [this](const ProjectedEdge& edge, float edge_strength) {
    x.push_back(edge.p.x());
    y.push_back(edge.p.y());
    z.push_back(edge.p.z());
    outward_u.push_back(edge.outward.x());
    outward_v.push_back(edge.outward.y());
    strength.push_back(edge_strength);
    way.push_back(edge.way);
  };
  for (std::size_t n = 0; n < edges.size(); n += stride) add(edges[n], edges[n].strength);
  while (x.size() % kTogether != 0) add(edges.front(), 0.0F);
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

void MatchedEdges::match(const EdgeColumns& edges, const OutlineAlignment& a,
                         const Projection& project, float sigma_px) {
  for (std::vector<float>* column : {&x, &y, &nearness, &u, &v}) column->resize(edges.x.size());
  move(edges, a, project);
  match_placed(edges.outward_u, edges.outward_v, edges.strength, {a.offset_px, sigma_px});
}

void MatchedEdges::match_shifted(const PlacedEdges& edges, const Eigen::Vector2f& shift,
                                 float offset_px, float sigma_px) {
  const std::size_t count = edges.u.size();
  u.resize(count), v.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    u[n] = edges.u[n] + shift.x();
    v[n] = edges.v[n] + shift.y();
  }
  match_placed(edges.outward_u, edges.outward_v, edges.strength, {offset_px, sigma_px});
}

MAPSCORE_WIDE_VECTORS
void MatchedEdges::move(const EdgeColumns& edges, const OutlineAlignment& a,
                        const Projection& project) {
  const int count = static_cast<int>(edges.x.size());
  const float *xs = edges.x.data(), *ys = edges.y.data(), *zs = edges.z.data();
  float *px = x.data(), *py = y.data(), *nearnesses = nearness.data(), *us = u.data(),
        *vs = v.data();
  const Eigen::Matrix3f& R = a.rotation;
  const float fx = project.fx, fy = project.fy, cx = project.cx, cy = project.cy;
  const float xx = R(0, 0), xy = R(0, 1), xz = R(0, 2), yx = R(1, 0), yy = R(1, 1), yz = R(1, 2),
              zx = R(2, 0), zy = R(2, 1), zz = R(2, 2), tx = a.translation.x(),
              ty = a.translation.y(), tz = a.translation.z();
  MAPSCORE_NO_OVERLAPS
  for (int n = 0; n < count; ++n) {
    const float X = xx * xs[n] + (xy * ys[n] + xz * zs[n]) + tx;
    const float Y = yx * xs[n] + (yy * ys[n] + yz * zs[n]) + ty;
    const float Z = zx * xs[n] + (zy * ys[n] + zz * zs[n]) + tz;
    const bool is_ahead = Z > kNearest_m;
    const float ahead = is_ahead ? Z : kNearest_m;
    const float near = 1.0F / ahead;
    px[n] = X * near, py[n] = Y * near, nearnesses[n] = near;
    us[n] = is_ahead ? fx * (X * near) + cx : -1.0F;  // beyond the image
    vs[n] = fy * (Y * near) + cy;
  }
}

MAPSCORE_WIDE_VECTORS
void MatchedEdges::match_all(const float* outward_us, const float* outward_vs,
                             const float* strengths, const MatchRules& rules) {
  const int count = static_cast<int>(u.size()), columns = field_.distance.cols,
            rows = field_.distance.rows;
  const float *image = field_.distance[0], *us = u.data(), *vs = v.data();
  float *weights = weight.data(), *residuals = residual.data(), *distances = distance.data(),
        *facings = facing.data(), *slopes_u = slope_u.data(), *slopes_v = slope_v.data(),
        *slopes_offset = slope_offset.data();
  const MatchRules by = rules;
  MAPSCORE_NO_OVERLAPS
  for (int n = 0; n < count; ++n) {
    const EdgeMatch match = match_in(
        image, columns, rows, {us[n], vs[n], outward_us[n], outward_vs[n], strengths[n]}, by);
    weights[n] = match.weight, residuals[n] = match.residual, distances[n] = match.distance;
    facings[n] = match.facing, slopes_u[n] = match.slope_u, slopes_v[n] = match.slope_v;
    slopes_offset[n] = match.at_border ? 0.0F : -1.0F;
  }
}

void MatchedEdges::match_placed(const std::vector<float>& outward_u,
                                const std::vector<float>& outward_v,
                                const std::vector<float>& strength, const MatchRules& rules) {
  for (std::vector<float>* column :
       {&weight, &residual, &distance, &facing, &slope_u, &slope_v, &slope_offset})
    column->resize(u.size());
  if (field_.distance.cols < 2 || field_.distance.rows < 2)
    std::ranges::fill(weight, 0.0F);
  else
    match_all(outward_u.data(), outward_v.data(), strength.data(), rules);
}

MAPSCORE_WIDE_VECTORS
void MatchedEdges::find_feet(const std::vector<std::uint8_t>& ways, std::vector<int>& feet) const {
  feet.resize(weight.size());
  const int count = static_cast<int>(weight.size()), columns = field_.elements[0].cols,
            rows = field_.elements[0].rows;
  const float *us = u.data(), *vs = v.data(), *weights = weight.data(),
              *distances = distance.data(), *facings = facing.data(), *slopes_u = slope_u.data(),
              *slopes_v = slope_v.data();
  const std::uint8_t* const way_of = ways.data();
  int* __restrict const cell_of = feet.data();
  constexpr float kCells = 1.0F / OutlineField::kCell_px;
  const float right = static_cast<float>(columns), bottom = static_cast<float>(rows);
  for (int n = 0; n < count; ++n) {
    const float foot_u = (us[n] - distances[n] * slopes_u[n]) * kCells,
                foot_v = (vs[n] - distances[n] * slopes_v[n]) * kCells;
    const bool counts =
        (weights[n] > 0) & (foot_u >= 0) & (foot_v >= 0) & (foot_u < right) & (foot_v < bottom);
    const int way = facings[n] > 0 ? way_of[n] : way_of[n] ^ 1;
    const int column = static_cast<int>(counts ? foot_u : 0.0F),
              row = static_cast<int>(counts ? foot_v : 0.0F);
    cell_of[n] = counts ? (way * rows + row) * columns + column : -1;
  }
}

float ExplainedOutlines::px(const OutlineAlignment& a, float sigma_px) {
  const float* elements = field_.elements[0].ptr<float>();  // of all ways
  const float weight = static_cast<float>(edges_.stride);
  votes_.resize(field_.elements.size() * field_.elements[0].total(), 0.0F);
  voted_.clear();
  matched_.match(edges_, a, project_.scaled(a.focal), sigma_px);
  matched_.find_feet(edges_.way, feet_);
  for (std::size_t n = 0; n < feet_.size(); ++n) {
    if (feet_[n] < 0) continue;
    const auto at = static_cast<std::size_t>(feet_[n]);
    if (elements[at] <= 0) continue;
    if (votes_[at] <= 0) voted_.push_back(at);
    votes_[at] += weight * matched_.weight[n];
  }
  double sum = 0;
  for (const std::size_t at : voted_) {
    sum += static_cast<double>(std::min(votes_[at], elements[at]));
    votes_[at] = 0;
  }
  return static_cast<float>(sum);
}

MAPSCORE_WIDE_VECTORS
NormalEquations add_up(const MatchedEdges& edges, const Projection& project, float focal_px) {
  constexpr int kLanes = EdgeColumns::kTogether, kRows = kParameters + 2;
  const float *xs = edges.x.data(), *ys = edges.y.data(), *nearnesses = edges.nearness.data();
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
      rows[kTurnX][lane] = part * (-gu * x * y - gv * (1 + y * y));
      rows[kTurnY][lane] = part * (gu * (1 + x * x) + gv * x * y);
      rows[kRoll][lane] = part * (gv * x - gu * y);
      rows[kFocal][lane] = part * (gu * x + gv * y);
      rows[kShiftX][lane] = gu * nearnesses[n];
      rows[kShiftY][lane] = gv * nearnesses[n];
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

Parameters parameters_of(const OutlineAlignment& a, float focal_px) {
  const Eigen::Matrix3f& R = a.rotation;
  const Eigen::Vector3f turn =
      0.5F * Eigen::Vector3f(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  Parameters all;
  all << focal_px * turn, focal_px * std::log(a.focal), a.translation.head<2>(), a.offset_px;
  return all;
}

Parameters solved(Eigen::Matrix<float, kParameters, kParameters> H, Parameters b,
                  const Parameters& free) {
  H = free.asDiagonal() * H * free.asDiagonal();
  H.diagonal() += Parameters::Ones() - free;
  b = b.cwiseProduct(free);
  return H.ldlt().solve(b);
}

OutlineAlignment stepped(OutlineAlignment a, const Parameters& step, float focal_px) {
  const Eigen::Vector3f turn = Eigen::Vector3f(step[kTurnX], step[kTurnY], step[kRoll]) / focal_px;
  const Eigen::Matrix3f R = exp_rotation(turn.cast<double>()).cast<float>();
  a.rotation = R * a.rotation;
  a.translation = R * a.translation + Eigen::Vector3f(step[kShiftX], step[kShiftY], 0);
  a.focal = std::clamp(a.focal * std::exp(step[kFocal] / focal_px), 0.5F, 2.0F);
  a.offset_px = std::clamp(a.offset_px + step[kOffset], -6.0F, 6.0F);
  return a;
}

}  // namespace mapscore
