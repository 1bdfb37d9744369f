// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/outline_field.hpp"

#include "core/segmentation/edge_aligned/outline_distance.hpp"
#include "core/wide_vectors.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdint>

namespace mapscore {
namespace {

constexpr int kWithinVotes_px = 18;  // more than votes tell apart: the largest offset, 6 px, and 2
constexpr int kGrooveRows = 32;      // in which grooves are boxed

cv::Rect grown(const cv::Rect& box, int by_px, const cv::Size& image) {
  return cv::Rect(box.x - by_px, box.y - by_px, box.width + 2 * by_px, box.height + 2 * by_px) &
         cv::Rect({0, 0}, image);
}

cv::Mat1w painted(const std::vector<Detection>& detections, int width_px, int height_px) {
  cv::Mat1w owner(height_px, width_px, std::uint16_t{0});
  for (std::size_t n = 0; n < detections.size(); ++n) {
    if (detections[n].mask.empty()) continue;
    owner(detections[n].box.rect()).setTo(static_cast<double>(n + 1), detections[n].mask);
  }
  return owner;
}

/// A pixel whose right or lower neighbour has another owner; the image's border repeats its own.
struct Change {
  int u, v;
  std::uint16_t own, right, below;
};

/// Adds those of a row.
void add_changes(const cv::Mat1w& owner, int v, Marks& differ, std::vector<Change>& changes) {
  const int last = owner.cols - 1;
  differ.resize(static_cast<std::size_t>(owner.cols));
  std::uint8_t* const differs = differ.data();
  const std::uint16_t* row = owner[v];
  const std::uint16_t* below = v + 1 < owner.rows ? owner[v + 1] : row;
  for (int u = 0; u < last; ++u) differs[u] = (row[u] != row[u + 1]) | (row[u] != below[u]);
  differs[last] = row[last] != below[last];
  for_each_marked(differ, [&](int u) {
    changes.push_back({u, v, row[u], row[std::min(u + 1, last)], below[u]});
  });
}

/// All of them, row by row.
std::vector<Change> changes_of(const cv::Mat1w& owner) {
  std::vector<Change> changes;
  Marks differ;
  for (int v = 0; v < owner.rows && owner.cols > 0; ++v) add_changes(owner, v, differ, changes);
  return changes;
}

/// The same once some pixels have got an owner, from those `before`.
std::vector<Change> changes_after(const std::vector<Change>& before, const cv::Mat1w& owner,
                                  const std::vector<cv::Point>& got) {
  std::vector<bool> differs(static_cast<std::size_t>(owner.rows) + 1, false);  // from row -1 on
  for (const cv::Point& at : got)
    differs[static_cast<std::size_t>(at.y)] = differs[static_cast<std::size_t>(at.y) + 1] = true;
  std::vector<Change> changes;
  Marks differ;
  auto from = before.begin();
  for (int v = 0; v < owner.rows; ++v) {
    const auto end = std::find_if(from, before.end(), [v](const Change& c) { return c.v > v; });
    if (differs[static_cast<std::size_t>(v) + 1])
      add_changes(owner, v, differ, changes);
    else
      changes.insert(changes.end(), from, end);
    from = end;
  }
  return changes;
}

/// Closes grooves of masks, half by each, in the order in which they end, row by row; of two that
/// end beside one pixel that of the row first. Returns their pixels.
std::vector<cv::Point> close_grooves(const std::vector<Change>& changes, cv::Mat1w& owners) {
  /// The last pixel of a mask in a row or column.
  struct Rim {
    int at = -OutlineField::kGroove_px - 2;
    std::uint16_t owner = 0;
  };
  std::vector<cv::Point> closed;
  const auto close = [&](const Rim& rim, int end, std::uint16_t owner, auto&& pixel_at) {
    const int gap = end - rim.at - 1;
    if (gap > OutlineField::kGroove_px || rim.owner == owner) return;
    for (int n = 0; n < gap; ++n) {
      const cv::Point at = pixel_at(rim.at + 1 + n);
      if (owners(at) != 0) continue;
      owners(at) = 2 * n < gap ? rim.owner : owner;
      closed.push_back(at);
    }
  };
  std::vector<Rim> columns(static_cast<std::size_t>(owners.cols));
  Rim rim;
  int row = -1;
  for (const auto& [u, v, own, right, below] : changes) {
    if (row != v) rim = {};
    row = v;
    Rim& column = columns[static_cast<std::size_t>(u)];
    if (own != 0 && right == 0) rim = {u, own};
    if (own != 0 && below == 0) column = {v, own};
    if (own == 0 && right != 0)
      close(rim, u + 1, right, [y = v](int at) { return cv::Point(at, y); });
    if (own == 0 && below != 0)
      close(column, v + 1, below, [x = u](int at) { return cv::Point(x, at); });
  }
  return closed;
}

/// Counts the outline elements by the way they face, in cells.
void count_elements(const std::vector<Change>& changes, const cv::Size& image,
                    OutlineField& field) {
  const int rows = image.height / OutlineField::kCell_px + 1;
  const cv::Mat1f all(4 * rows, image.width / OutlineField::kCell_px + 1, 0.0F);
  for (int way = 0; way < 4; ++way)
    field.elements[static_cast<std::size_t>(way)] = all.rowRange(way * rows, (way + 1) * rows);
  const auto count = [&](Outward way, int v, int u) {
    ++field.length_px;
    field.elements[static_cast<std::size_t>(way)](v / OutlineField::kCell_px,
                                                  u / OutlineField::kCell_px) += 1.0F;
  };
  for (const auto& [u, v, own, right, below] : changes) {
    if (right != own) {
      if (own != 0) count(Outward::right, v, u);
      if (right != 0) count(Outward::left, v, u + 1);
    }
    if (below != own) {
      if (own != 0) count(Outward::down, v, u);
      if (below != 0) count(Outward::up, v + 1, u);
    }
  }
}

/// Fills distances beyond a window.
void fill_far(const cv::Mat1w& owner, const cv::Rect& window, cv::Mat1f& distance) {
  const auto fill = [&](int v, int begin, int end) {
    for (int u = begin; u < end; ++u)
      distance(v, u) = owner(v, u) != 0 ? -OutlineField::kFar : OutlineField::kFar;
  };
  for (int v = 0; v < owner.rows; ++v) {
    const bool is_within = v >= window.y && v < window.br().y;
    fill(v, 0, is_within ? window.x : owner.cols);
    if (is_within) fill(v, window.br().x, owner.cols);
  }
}

/// The boxes in which grooves change distances that votes tell apart: by band of kGrooveRows rows,
/// or one for bands that follow each other where that is less to measure.
std::vector<cv::Rect> near_grooves(const std::vector<cv::Point>& pixels, const cv::Size& image) {
  std::vector<cv::Rect> grooves(static_cast<std::size_t>(image.height / kGrooveRows + 1));
  for (const cv::Point& at : pixels)
    grooves[static_cast<std::size_t>(at.y / kGrooveRows)] |= cv::Rect(at, cv::Size(1, 1));
  const auto cost = [&](const cv::Rect& box) {
    return grown(box, 2 * kWithinVotes_px, image).area();
  };
  std::vector<cv::Rect> near;
  for (const cv::Rect& groove : grooves) {
    if (groove.empty()) continue;
    if (!near.empty() && cost(near.back() | groove) <= cost(near.back()) + cost(groove))
      near.back() |= groove;
    else
      near.push_back(groove);
  }
  for (cv::Rect& box : near) box = grown(box, kWithinVotes_px, image);
  return near;
}

std::array<cv::Mat1b, 4> coarse_maps(const std::array<cv::Mat1f, 4>& cells) {
  std::array<cv::Mat1b, 4> maps;
  std::array<cv::Mat1f, 4> blurred;
  for (std::size_t way = 0; way < 4; ++way) {
    cv::Mat1f limited = cv::min(cells[way] / static_cast<double>(OutlineField::kCell_px), 1.0F);
    cv::GaussianBlur(limited, blurred[way], {5, 5}, 1.0);
  }
  for (std::size_t way = 0; way < 4; ++way) {
    const cv::Mat1f both = blurred[way] + OutlineField::kOtherWay * blurred[way ^ 1U];
    both.convertTo(maps[way], CV_8U, 255.0 / 0.4);
  }
  return maps;
}

/// Pixels with an owner beside ones without.
std::vector<cv::Point> rim_of(const cv::Mat1w& owner) {
  std::vector<cv::Point> rim;
  if (owner.empty()) return rim;
  const int last = owner.cols - 1;
  Marks flags(static_cast<std::size_t>(owner.cols));
  std::uint8_t* const flag = flags.data();
  for (int v = 0; v < owner.rows; ++v) {
    const std::uint16_t* row = owner[v];
    const std::uint16_t* above = owner[std::max(v - 1, 0)];
    const std::uint16_t* below = owner[std::min(v + 1, owner.rows - 1)];
    const auto mark = [&](int u, std::uint16_t left, std::uint16_t right) {
      flag[u] = (row[u] != 0) & ((left == 0) | (right == 0) | (above[u] == 0) | (below[u] == 0));
    };
    for (int u = 1; u < last; ++u) mark(u, row[u - 1], row[u + 1]);
    mark(0, row[0], row[std::min(1, last)]);
    mark(last, row[std::max(last - 1, 0)], row[last]);
    for_each_marked(flags, [&](int u) { rim.emplace_back(u, v); });
  }
  return rim;
}

}  // namespace

cv::Mat1w spread_owners(const cv::Mat1w& masks, int reach_px) {
  cv::Mat1w owner = masks.clone();
  struct Claim {
    cv::Point pixel;
    std::uint16_t owner;
  };
  std::vector<cv::Point> rim = rim_of(masks);
  std::vector<Claim> claims;
  for (int step = 0; step < reach_px && !rim.empty(); ++step) {
    claims.clear();
    for (const cv::Point& at : rim)
      for (const cv::Point& way :
           {cv::Point(-1, 0), cv::Point(1, 0), cv::Point(0, -1), cv::Point(0, 1)}) {
        const cv::Point near = at + way;
        if (near.x < 0 || near.y < 0 || near.x >= owner.cols || near.y >= owner.rows) continue;
        if (owner(near) == 0) claims.push_back({near, owner(at)});
      }
    rim.clear();
    for (const Claim& claim : claims) {
      std::uint16_t& holder = owner(claim.pixel);
      if (holder == 0) rim.push_back(claim.pixel);
      if (holder == 0 || claim.owner < holder) holder = claim.owner;
    }
  }
  return owner;
}

OutlineField outline_field(const std::vector<Detection>& detections, int width_px, int height_px,
                           int reach_px) {
  OutlineField field;
  field.owner = painted(detections, width_px, height_px);
  std::vector<Change> changes = changes_of(field.owner);
  field.closed = close_grooves(changes, field.owner);
  if (!field.closed.empty()) changes = changes_after(changes, field.owner, field.closed);
  count_elements(changes, field.owner.size(), field);
  field.coarse = coarse_maps(field.elements);
  field.distance.create(height_px, width_px);
  cv::Rect window;
  for (const Detection& detection : detections)
    if (field.length_px > 0) window |= grown(detection.box.rect(), reach_px, field.owner.size());
  fill_far(field.owner, window, field.distance);
  if (!window.empty()) measure_outline_distance(field.owner(window), field.distance(window));
  return field;
}

MaskField open_grooves(OutlineField&& field) {
  const cv::Size image = field.owner.size();
  if (!field.closed.empty()) field.distance = field.distance.clone();  // a fit may keep it
  for (const cv::Point& at : field.closed) field.owner(at) = 0;
  for (const cv::Rect& near : near_grooves(field.closed, image)) {
    const cv::Rect about = grown(near, kWithinVotes_px, image);
    cv::Mat1f measured(about.size());
    measure_outline_distance(field.owner(about), measured);
    measured(near - about.tl()).copyTo(field.distance(near));
  }
  return {field.owner, field.distance};
}

}  // namespace mapscore
