// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/unseen_occluders.hpp"

#include "core/segmentation/edge_aligned/near_holes.hpp"
#include "core/wide_vectors.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore {
namespace {

/// Depths at which a near object is tried, in least ranges.
constexpr std::array kNearDepths{1.0, 0.85, 0.7, 0.6, 0.5};
constexpr double kHeld = 0.8;                 // of a run of a hole that is a whole object
constexpr double kRunsOnFrom = 1.3;           // in least ranges: a farther surface does not run on,
constexpr double kRunsOnUntil = 1.05;         // and one that does ends nearer than this
constexpr std::array kBesideRim_px{1, 4, 7};  // where masks are compared; two of three must agree
constexpr int kHoleRim_px = 11;               // near holes leave out 4 or 5 at their rims
constexpr int kRimCells = 7;                  // about a hole's cell, that reach over its rim
/// Of a hole's cells every second in both ways is tried, by its first pixel. What it covers of the
/// colour image is marked as wide as to reach the marks of the next, and the hole's own rim.
constexpr int kTried = 2;
constexpr int kMark_px = 2 * kTried * kHoleCell_px + 1;

/// Rays of depth pixels beside each other in a row or a column, 1 m before their camera: the
/// coordinate along that line, and the one across it, which is the same for all.
struct RunOfRays {
  const double* along;
  double across;
  bool in_row;
  int count;
};

/// Finds the pixels of the colour image, row-major, that hold what lies at a depth z_m on each ray;
/// -1 beyond the image. Rounds as CameraModel::project, so that what lies on the border of two
/// pixels falls into the same.
MAPSCORE_WIDE_VECTORS
void find_cells_at(const RunOfRays& rays, double z_m, const Calibration& calibration,
                   int* __restrict cells) {
  const Eigen::Matrix3d R = calibration.T_color_depth.linear();
  const Eigen::Vector3d t = calibration.T_color_depth.translation();
  const Eigen::Vector3d first = R.col(rays.in_row ? 0 : 1);
  const Eigen::Vector3d other = R.col(rays.in_row ? 1 : 0) * rays.across, ahead = R.col(2);
  const double ax = first.x(), ay = first.y(), az = first.z(), bx = other.x(), by = other.y(),
               bz = other.z(), cx = ahead.x(), cy = ahead.y(), cz = ahead.z(), tx = t.x(),
               ty = t.y(), tz = t.z();
  const CameraModel& color = calibration.color;
  const double fx = color.fx_px, fy = color.fy_px, middle_u = color.cx_px, middle_v = color.cy_px;
  const double right = color.width_px, bottom = color.height_px;
  const int columns = color.width_px, count = rays.count;
  const double* const along = rays.along;
  for (int n = 0; n < count; ++n) {
    const double X = z_m * (ax * along[n] + bx + cx) + tx;
    const double Y = z_m * (ay * along[n] + by + cy) + ty;
    const double Z = z_m * (az * along[n] + bz + cz) + tz;
    const double u = fx * X / Z + middle_u + 0.5, v = fy * Y / Z + middle_v + 0.5;
    const bool within = (u >= 0) & (v >= 0) & (u < right) & (v < bottom);
    const int column = static_cast<int>(within ? u : 0.0);
    const int row = static_cast<int>(within ? v : 0.0);
    cells[n] = within ? row * columns + column : -1;
  }
}

/// Keeps the pixels of a run that something near covers: those whose owner is also that of what
/// lies far behind, or is `whole`. The others become `none`.
MAPSCORE_WIDE_VECTORS
void keep_covered(const int* owners, const int* far_owners, int whole, int none, int count,
                  int* __restrict cells) {
  for (int n = 0; n < count; ++n) {
    const int owner = owners[n];
    const bool is_covered = (owner != 0) & ((owner == far_owners[n]) | (owner == whole));
    cells[n] = is_covered ? cells[n] : none;
  }
}

/// Marks pixels of a row that lie in `covered` ones of the colour image and do not run on.
MAPSCORE_WIDE_VECTORS
void hide_covered(const std::uint8_t* covered, const int* cells, const std::uint8_t* running_on,
                  int count, std::uint8_t* __restrict hidden) {
  for (int n = 0; n < count; ++n) {
    const bool is_hidden = (covered[n] != 0) & (cells[n] >= 0) & (running_on[n] == 0);
    hidden[n] = is_hidden ? std::uint8_t{255} : hidden[n];
  }
}

class Occluders {
 public:
  Occluders(const DepthEdges& edges, const cv::Mat1i& cells, const MaskField& masks,
            const OutlineAlignment& alignment, const Calibration& mended)
      : edges_(edges),
        cells_(cells),
        masks_(masks),
        offset_px_(alignment.offset_px),
        mended_(mended) {
    const Eigen::Vector3d& t = mended_.T_color_depth.translation();
    in_rows_ = std::abs(t.x()) >= std::abs(t.y());
    const int length = in_rows_ ? cells.cols : cells.rows;
    for (int n = 0; n < length; n += kTried * kHoleCell_px) {
      const Eigen::Vector3d ray = ray_of(place(0, n));
      along_.push_back(in_rows_ ? ray.x() : ray.y());
    }
  }

  /// 255 on what near objects cover in the colour image.
  [[nodiscard]] cv::Mat1b covered() {
    const cv::Mat1b& hole = edges_.near_holes;
    // Behind the image a row for what covers nothing.
    cv::Mat1b with_none(masks_.owner.rows + 1, masks_.owner.cols, std::uint8_t{0});
    cv::Mat1b hit = with_none.rowRange(0, masks_.owner.rows);
    const int lines = in_rows_ ? hole.rows : hole.cols, length = in_rows_ ? hole.cols : hole.rows;
    for (int line = 0; line < lines; line += kTried) {
      const auto is_hole = [&](int n) { return hole(place(line, n)) != 0; };
      for (int begin = 0, end = 0; begin < length; begin = end) {
        end = begin + 1;
        if (!is_hole(begin)) continue;
        while (end < length && is_hole(end)) ++end;
        if (!is_shadow(kHoleCell_px * line, kHoleCell_px * begin, kHoleCell_px * end))
          cover(line, begin, end, hit[0]);
      }
    }
    cv::Mat1b marked;
    cv::dilate(hit, marked, cv::Mat(kMark_px, kMark_px, CV_8U, cv::Scalar(1)), {-1, -1}, 1,
               cv::BORDER_CONSTANT | cv::BORDER_ISOLATED);
    return marked;
  }

  /// 255 on surfaces that run on into a near hole.
  [[nodiscard]] cv::Mat1b running_on() const {
    const cv::Mat1f& w = edges_.inverse_depth;
    cv::Mat1b beside;
    cv::dilate(edges_.near_holes, beside, cv::Mat(kRimCells, kRimCells, CV_8U, cv::Scalar(1)));
    cv::Mat1b marked(w.size(), std::uint8_t{0});
    const auto least = static_cast<float>(1.0 / (kRunsOnUntil * mended_.range_min_m));
    const Eigen::Vector3d& t = mended_.T_color_depth.translation();
    const double nearness = (1 / kNearDepths.back() - 1 / kRunsOnFrom) / mended_.range_min_m;
    const int reach_px = static_cast<int>(std::ceil(mended_.depth.fx_px * t.norm() * nearness));
    const cv::Mat1f& on = in_rows_ ? edges_.right : edges_.down;
    const cv::Point next = place(0, 1);
    const auto mark_from = [&](const cv::Point& end) {
      if (!(w(end) > least)) return;
      marked(end) = 255;
      cv::Point at = end;
      for (int n = 0; n < reach_px && on(at) >= 1.0F; ++n) marked(at += next) = 255;
      at = end;
      for (int n = 0; n < reach_px && (in_rows_ ? at.x : at.y) > 0 && on(at - next) >= 1.0F; ++n)
        marked(at -= next) = 255;
    };
    std::vector<cv::Point> cells;
    cv::findNonZero(beside & (edges_.near_holes == 0), cells);
    const cv::Rect image({0, 0}, w.size());
    for (const cv::Point& cell : cells)
      for (const cv::Point& pixel :
           {cv::Point(0, 0), cv::Point(1, 0), cv::Point(0, 1), cv::Point(1, 1)})
        if (const cv::Point end = kHoleCell_px * cell + pixel; image.contains(end)) mark_from(end);
    return marked;
  }

  /// Marks what objects beside the view may hide: `from_border` pixels from where they may stand.
  void mark_beside_view(cv::Mat1b& hidden) const {
    const cv::Mat1f &w = edges_.inverse_depth, &on = in_rows_ ? edges_.right : edges_.down;
    const Eigen::Vector3d color = mended_.T_color_depth.inverse().translation();
    const double parallax_px =  // of a point at 1 m; what is nearer lies farther this way
        in_rows_ ? mended_.depth.fx_px * color.x() : mended_.depth.fy_px * color.y();
    const double nearest = 1 / mended_.range_min_m;
    const int lines = in_rows_ ? w.rows : w.cols, length = in_rows_ ? w.cols : w.rows;
    const int widest = std::min(length - 1, static_cast<int>(std::abs(parallax_px) * nearest) + 1);
    for (int line = 0; line < lines; ++line) {
      bool has_before = false;  // on the surface, a pixel that nothing beside the view may hide:
      cv::Point before;         // the last of these
      for (int from_border = widest; from_border >= 0; --from_border) {
        const int n = parallax_px > 0 ? length - 1 - from_border : from_border;
        const cv::Point at = place(line, n);
        const cv::Point link = parallax_px > 0 ? place(line, n - 1) : at;  // to the pixel before
        has_before = has_before && on(link) >= 1.0F;
        if (!(w(at) > 0)) continue;
        if (std::abs(parallax_px) * (nearest - static_cast<double>(w(at))) <= from_border)
          before = at, has_before = true;
        else if (has_before && owner_at(cells_(before)) == 0 && owner_at(cells_(at)) != 0)
          hidden(at) = 255;
      }
    }
  }

 private:
  /// The n-th pixel of a line along the baseline.
  [[nodiscard]] cv::Point place(int line, int n) const {
    return in_rows_ ? cv::Point(n, line) : cv::Point(line, n);
  }

  /// The ray of a depth pixel, 1 m before its camera.
  [[nodiscard]] Eigen::Vector3d ray_of(const cv::Point& pixel) const {
    return mended_.depth.back_project(pixel.x, pixel.y, 1.0);
  }

  /// Whether the run [begin, end) of a hole may be a projector's shadow. Something near would
  /// cover, in the colour image, the surface on the side that the colour camera sees past it, but
  /// no more of it than a reach: the mask there is the same as beyond.
  [[nodiscard]] bool is_shadow(int line, int begin, int end) const {
    if (!is_noisy(edges_)) return false;
    const cv::Mat1f& w = edges_.inverse_depth;
    const int length = in_rows_ ? w.cols : w.rows;
    const Eigen::Vector3d& t = mended_.T_color_depth.translation();
    const double shift_px = in_rows_ ? mended_.depth.fx_px * t.x() : mended_.depth.fy_px * t.y();
    const int way = shift_px < 0 ? -1 : 1;
    const auto is_inside = [&](int n) { return n >= 0 && n < length; };
    int rim = shift_px < 0 ? begin - 1 : end;
    const int last = rim + way * kHoleRim_px;
    while (is_inside(rim) && rim != last && !(w(place(line, rim)) > 0)) rim += way;
    if (!is_inside(rim) || !(w(place(line, rim)) > 0)) return false;
    const double nearest = 1 / (kNearDepths.back() * mended_.range_min_m);
    const double reach_px =
        std::abs(shift_px) * (nearest - static_cast<double>(w(place(line, rim))));
    const int reach = static_cast<int>(std::ceil(reach_px)) + 2;
    if (!is_inside(rim + way * (kBesideRim_px.back() + reach))) return false;
    return std::ranges::count_if(kBesideRim_px, [&](int n) {
             const cv::Point near = place(line, rim + way * n),
                             beyond = place(line, rim + way * (n + reach));
             return w(near) > 0 && w(beyond) > 0 &&
                    owner_at(cells_(near)) == owner_at(cells_(beyond));
           }) > 1;
  }

  /// Marks what the cells [begin, end) of a line of a hole cover.
  void cover(int line, int begin, int end, std::uint8_t* hit) {
    const int none = static_cast<int>(masks_.owner.total());
    const int first = (begin + kTried - 1) / kTried, last = (end + kTried - 1) / kTried;
    if (first == last) return;
    const Eigen::Vector3d ray = ray_of(kHoleCell_px * place(line, begin));
    const RunOfRays run{along_.data() + first, in_rows_ ? ray.y() : ray.x(), in_rows_,
                        last - first};
    find_owners(run, mended_.range_max_m, run_far_owners_);
    for (const double depth : kNearDepths) {
      find_owners(run, depth * mended_.range_min_m, run_owners_);
      const int middle = run_owners_[run_owners_.size() / 2];
      const auto held = static_cast<double>(std::ranges::count(run_owners_, middle));
      const int whole = held >= kHeld * run.count ? middle : 0;
      keep_covered(run_owners_.data(), run_far_owners_.data(), whole, none, run.count,
                   run_cells_.data());
      for (const int cell : run_cells_) hit[cell] = 255;
    }
  }

  /// Finds whose mask holds each pixel of a run if it lies at a depth; its place is in run_cells_.
  void find_owners(const RunOfRays& run, double z_m, std::vector<int>& owners) {
    run_cells_.resize(static_cast<std::size_t>(run.count));
    find_cells_at(run, z_m, mended_, run_cells_.data());
    owners.resize(run_cells_.size());
    std::ranges::transform(run_cells_, owners.begin(), [&](int cell) { return owner_at(cell); });
  }

  /// Whose mask holds a cell, as large as its object is; 0 for none.
  [[nodiscard]] int owner_at(int cell) const {
    return cell < 0 || masks_.distance[0][cell] >= offset_px_ ? 0 : masks_.owner[0][cell];
  }

  const DepthEdges& edges_;
  const cv::Mat1i& cells_;
  const MaskField& masks_;
  float offset_px_;
  Calibration mended_;
  bool in_rows_ = true;  ///< the baseline
  std::vector<double>
      along_;  ///< of each tried cell, its ray's coordinate along the baseline, at 1 m
  // Of a run of a hole at a depth: pixels of the colour image, at last those that are covered, and
  // whose masks hold them.
  std::vector<int> run_cells_, run_owners_, run_far_owners_;
};

}  // namespace

cv::Mat1b unseen_occluders(const DepthEdges& edges, const ColorPlaces& places,
                           const MaskField& masks, const OutlineAlignment& alignment,
                           const Calibration& mended) {
  const cv::Mat1i& cells = places.cells();
  Occluders occluders(edges, cells, masks, alignment, mended);
  cv::Mat1b hidden(cells.size(), std::uint8_t{0});
  if (!(mended.range_min_m > 0)) return hidden;
  occluders.mark_beside_view(hidden);
  if (cv::countNonZero(edges.near_holes) == 0) return hidden;
  const cv::Mat1b covered = occluders.covered();
  if (cv::countNonZero(covered) == 0) return hidden;
  const cv::Mat1b running_on = occluders.running_on();
  Marks row(static_cast<std::size_t>(cells.cols));
  for (int v = 0; v < cells.rows; ++v) {
    places.look_up(covered[0], v, row.data());
    hide_covered(row.data(), cells[v], running_on[v], cells.cols, hidden[v]);
  }
  return hidden;
}

}  // namespace mapscore
