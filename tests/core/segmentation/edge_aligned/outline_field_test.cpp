// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/outline_field.hpp"

#include "core/random_stream.hpp"
#include "core/segmentation/edge_aligned/outline_distance.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace mapscore {
namespace {

/// Rectangles that overlap, with holes, in an image of at most 40 x 30.
cv::Mat1w random_owners(RandomStream& stream) {
  const int columns = 1 + static_cast<int>(stream.bits() % 40);
  const int rows = 1 + static_cast<int>(stream.bits() % 30);
  cv::Mat1w owner(rows, columns, std::uint16_t{0});
  for (std::uint64_t n = 0; n < 1 + stream.bits() % 5; ++n) {
    const int u = static_cast<int>(stream.bits() % columns);
    const int v = static_cast<int>(stream.bits() % rows);
    const cv::Rect box(u, v, 1 + static_cast<int>(stream.bits() % (columns - u)),
                       1 + static_cast<int>(stream.bits() % (rows - v)));
    owner(box).setTo(static_cast<double>(stream.bits() % 4));
  }
  return owner;
}

bool on_rim(const cv::Mat1w& owner, int v, int u) {
  const std::uint16_t own = owner(v, u);
  const int last_v = owner.rows - 1, last_u = owner.cols - 1;
  return own != 0 &&
         (owner(std::max(v - 1, 0), u) != own || owner(std::min(v + 1, last_v), u) != own ||
          owner(v, std::max(u - 1, 0)) != own || owner(v, std::min(u + 1, last_u)) != own);
}

/// The nearest of all pixels that count, by the closed form of the way to each.
float plain_distance(const cv::Mat1w& owner, int v, int u) {
  const bool inside = owner(v, u) != 0;
  int nearest = 1 << 29;
  for (int r = 0; r < owner.rows; ++r)
    for (int c = 0; c < owner.cols; ++c) {
      if (inside ? owner(r, c) != 0 && !on_rim(owner, r, c) : owner(r, c) == 0) continue;
      const int dv = std::abs(r - v), du = std::abs(c - u);
      nearest = std::min(nearest,
                         89740 * std::min(dv, du) + 62588 * (std::max(dv, du) - std::min(dv, du)));
    }
  const float way = static_cast<float>(nearest) / 65536.0F;
  return inside ? -0.5F - way : way - 0.5F;
}

/// The distance itself, which is a multiple of 1/16384 pixel: of up to 256 no bit is lost.
float without_border(float distance) {
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(distance) & ~kBorderBits);
}

TEST(OutlineDistance, IsTheWayToTheNearestPixelOnTheOtherSide) {
  RandomStream stream(21, "owners");
  for (int round = 0; round < 60; ++round) {
    const cv::Mat1w owner = random_owners(stream);
    cv::Mat1f distance(owner.rows, owner.cols, 0.0F);
    measure_outline_distance(owner, distance);
    for (int v = 0; v < owner.rows; ++v)
      for (int u = 0; u < owner.cols; ++u)
        ASSERT_EQ(without_border(distance(v, u)), plain_distance(owner, v, u))
            << "round " << round << ", pixel " << u << ' ' << v;
  }
}

/// Of the nearest rim pixels of its mask: whether any touches a mask of a higher number, and if
/// none does, one of a lower number.
Border plain_border(const cv::Mat1w& owner, int v, int u) {
  if (owner(v, u) == 0) return kNoBorder;
  const float distance = plain_distance(owner, v, u);
  bool at_none = false, at_higher = false;
  for (int r = 0; r < owner.rows; ++r)
    for (int c = 0; c < owner.cols; ++c) {
      if (owner(r, c) == 0 || !on_rim(owner, r, c)) continue;
      const int dv = std::abs(r - v), du = std::abs(c - u);
      const int way = 89740 * std::min(dv, du) + 62588 * (std::max(dv, du) - std::min(dv, du));
      if (-0.5F - static_cast<float>(way) / 65536.0F != distance) continue;
      std::uint16_t lowest = 65535, highest = 0;
      for (const auto& [y, x] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
        const std::uint16_t other =
            owner(std::clamp(r + y, 0, owner.rows - 1), std::clamp(c + x, 0, owner.cols - 1));
        if (other == 0) continue;
        lowest = std::min(lowest, other), highest = std::max(highest, other);
      }
      if (highest > owner(r, c))
        at_higher = true;
      else if (lowest >= owner(r, c))
        at_none = true;
    }
  // Of ways of one length that at no border counts first, then that at a mask of a higher number.
  return at_none ? kNoBorder : at_higher ? kBesideHigher : kBesideLower;
}

TEST(OutlineDistance, GoesOnBeyondABorderOfTwoMasks) {
  RandomStream stream(24, "owners");
  int at_border = 0;
  for (int round = 0; round < 60; ++round) {
    const cv::Mat1w owner = random_owners(stream);
    if (cv::countNonZero(owner) == 0) continue;
    cv::Mat1f distance(owner.rows, owner.cols);
    measure_outline_distance(owner, distance);
    for (int v = 0; v < owner.rows; ++v)
      for (int u = 0; u < owner.cols; ++u) {
        const bool has_rim = distance(v, u) > -8000;
        const Border border = has_rim ? plain_border(owner, v, u) : kNoBorder;
        ASSERT_EQ(border_of(distance(v, u)), border)
            << "round " << round << ", pixel " << u << ' ' << v;
        ASSERT_EQ(beyond_border(distance(v, u)),
                  (border == kBesideLower ? -1 : 1) * distance(v, u));
        at_border += border != kNoBorder ? 1 : 0;
      }
  }
  EXPECT_GT(at_border, 300);
}

TEST(OutlineDistance, IsWhatTwoDistanceTransformsGive) {
  RandomStream stream(22, "owners");
  for (int round = 0; round < 20; ++round) {
    cv::Mat1w owner;
    cv::resize(random_owners(stream), owner, {160, 120}, 0, 0, cv::INTER_NEAREST);
    if (cv::countNonZero(owner) == 0) continue;
    cv::Mat1b deep(owner.rows, owner.cols, std::uint8_t{255});
    for (int v = 0; v < owner.rows; ++v)
      for (int u = 0; u < owner.cols; ++u)
        if (owner(v, u) == 0 || on_rim(owner, v, u)) deep(v, u) = 0;
    cv::Mat1f within, beyond, distance(owner.rows, owner.cols);
    cv::distanceTransform(deep, within, cv::DIST_L2, cv::DIST_MASK_3);
    cv::distanceTransform(owner == 0, beyond, cv::DIST_L2, cv::DIST_MASK_3);
    measure_outline_distance(owner, distance);
    for (int v = 0; v < owner.rows; ++v)
      for (int u = 0; u < owner.cols; ++u) {
        const float expected = owner(v, u) != 0 ? -0.5F - within(v, u) : beyond(v, u) - 0.5F;
        ASSERT_NEAR(distance(v, u), expected, 5e-3F) << u << ' ' << v;
      }
  }
}

/// Step by step over the whole image.
cv::Mat1w plain_spread(const cv::Mat1w& masks, int reach_px) {
  cv::Mat1w owner = masks.clone();
  for (int step = 0; step < reach_px; ++step) {
    const cv::Mat1w before = owner.clone();
    for (int v = 0; v < owner.rows; ++v)
      for (int u = 0; u < owner.cols; ++u) {
        if (before(v, u) != 0) continue;
        for (const auto& [dv, du] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
          const std::uint16_t near =
              before(std::clamp(v + dv, 0, owner.rows - 1), std::clamp(u + du, 0, owner.cols - 1));
          if (near != 0 && (owner(v, u) == 0 || near < owner(v, u))) owner(v, u) = near;
        }
      }
  }
  return owner;
}

TEST(OutlineField, OwnersSpreadStepByStepTiesToTheLowerIndex) {
  RandomStream stream(23, "owners");
  for (int round = 0; round < 60; ++round) {
    const cv::Mat1w masks = random_owners(stream);
    const int reach_px = static_cast<int>(stream.bits() % 12);
    const cv::Mat1w spread = spread_owners(masks, reach_px), plain = plain_spread(masks, reach_px);
    ASSERT_EQ(cv::countNonZero(spread != plain), 0) << "round " << round;
  }
}

/// A detection for each of the owners 1 to 3.
std::vector<Detection> detections_of_owners(const cv::Mat1w& owner) {
  std::vector<Detection> detections(3);
  for (std::size_t n = 0; n < 3; ++n) {
    detections[n].box = {0, 0, owner.cols - 1, owner.rows - 1};
    detections[n].mask = owner == static_cast<double>(n + 1);
  }
  return detections;
}

/// A groove that a pixel lies in.
struct Groove {
  std::uint16_t owner = 0;  ///< the mask on whose half it lies; 0: there is no groove
  int to_end = 0;           ///< steps to its end
};

/// That between the pixel's nearest masks before and behind it in a row or column.
Groove plain_groove(const cv::Mat1w& masks, int v, int u, int dv, int du) {
  const auto walk = [&](int way) {
    int steps = 0, y = v, x = u;
    while (y >= 0 && x >= 0 && y < masks.rows && x < masks.cols && masks(y, x) == 0)
      ++steps, y += way * dv, x += way * du;
    const bool inside = y >= 0 && x >= 0 && y < masks.rows && x < masks.cols;
    return std::pair(steps, inside ? masks(y, x) : std::uint16_t{0});
  };
  const auto [before, first] = walk(-1);
  const auto [behind, second] = walk(1);
  if (first == 0 || second == 0 || first == second || before + behind - 1 > 5) return {};
  return {before <= behind ? first : second, behind};
}

/// Of the grooves of its row and its column the one that ends first, row by row.
std::uint16_t plainly_closed(const cv::Mat1w& masks, int v, int u) {
  if (masks(v, u) != 0) return masks(v, u);
  const Groove row = plain_groove(masks, v, u, 0, 1), column = plain_groove(masks, v, u, 1, 0);
  const bool column_ends_first = column.owner != 0 && column.to_end == 1 && row.to_end > 1;
  return row.owner == 0 || column_ends_first ? column.owner : row.owner;
}

/// Single pixels, among which grooves of rows and columns cross.
cv::Mat1w speckled_owners(RandomStream& stream) {
  cv::Mat1w owner(1 + static_cast<int>(stream.bits() % 20),
                  1 + static_cast<int>(stream.bits() % 20), std::uint16_t{0});
  for (std::uint16_t& pixel : owner)
    if (stream.bits() % 4 == 0) pixel = static_cast<std::uint16_t>(1 + stream.bits() % 3);
  return owner;
}

TEST(OutlineField, GroovesAreClosedHalfByEachMask) {
  RandomStream stream(25, "owners");
  int closed = 0;
  for (int round = 0; round < 400; ++round) {
    const cv::Mat1w masks = round % 2 == 0 ? random_owners(stream) : speckled_owners(stream);
    OutlineField field = outline_field(detections_of_owners(masks), masks.cols, masks.rows, 5);
    for (int v = 0; v < masks.rows; ++v)
      for (int u = 0; u < masks.cols; ++u) {
        const std::uint16_t expected = plainly_closed(masks, v, u);
        ASSERT_EQ(field.owner(v, u), expected) << "round " << round << ' ' << u << ' ' << v;
        closed += expected != masks(v, u);
      }
    ASSERT_EQ(cv::countNonZero(open_grooves(std::move(field)).owner != masks), 0);
  }
  EXPECT_GT(closed, 100);
}

/// Only near grooves the masks as they are have distances of their own.
TEST(OutlineField, MeasuresMasksAsTheyAreNearThem) {
  RandomStream stream(26, "masks");
  const auto drawn = [&](int least, int most) {
    return least + static_cast<int>(stream.uniform() * (most - least + 1));
  };
  int near_grooves = 0;
  for (int round = 0; round < 60; ++round) {
    cv::Mat1w masks(160, 220, std::uint16_t{0});
    const int columns = drawn(1, 5);
    for (int n = 0; n < 2 * columns; ++n) {  // two rows of plates with gaps of 0 to 9 px
      const int width = 200 / columns, left = n / 2 * width + drawn(0, 4);
      const int top = n % 2 == 0 ? drawn(0, 20) : 80;
      masks(cv::Rect(left, top, width - drawn(0, 9), 80 - drawn(0, 9))) =
          static_cast<std::uint16_t>(n % 3 + 1);
    }
    OutlineField field = outline_field(detections_of_owners(masks), masks.cols, masks.rows, 60);
    const cv::Mat1f closed = field.distance.clone(),
                    opened = open_grooves(std::move(field)).distance;
    cv::Mat1f distance(masks.size());
    measure_outline_distance(masks, distance);
    for (int v = 0; v < masks.rows; ++v)
      for (int u = 0; u < masks.cols; ++u) {
        const float here = opened(v, u);
        if (std::abs(distance(v, u)) < 16)
          ASSERT_EQ(here, distance(v, u)) << "round " << round << ' ' << u << ' ' << v;
        else
          ASSERT_TRUE(here >= 16 || here <= -16) << "round " << round << ' ' << u << ' ' << v;
        near_grooves += here != closed(v, u);
      }
  }
  EXPECT_GT(near_grooves, 10000);
}

TEST(OutlineField, CountsTheElementsThatFaceEachWay) {
  RandomStream stream(24, "owners");
  for (int round = 0; round < 40; ++round) {
    const cv::Mat1w masks = random_owners(stream);
    const OutlineField field =
        outline_field(detections_of_owners(masks), masks.cols, masks.rows, 5);
    const cv::Mat1w& owner = field.owner;
    std::array<cv::Mat1f, 4> elements;
    for (cv::Mat1f& cells : elements)
      cells = cv::Mat1f(owner.rows / 4 + 1, owner.cols / 4 + 1, 0.0F);
    int length_px = 0;
    const auto face = [&](Outward way, int v, int u, int beyond_v, int beyond_u) {
      if (beyond_v < 0 || beyond_u < 0 || beyond_v >= owner.rows || beyond_u >= owner.cols) return;
      if (owner(v, u) == 0 || owner(v, u) == owner(beyond_v, beyond_u)) return;
      elements[static_cast<std::size_t>(way)](v / 4, u / 4) += 1.0F;
      ++length_px;
    };
    for (int v = 0; v < owner.rows; ++v)
      for (int u = 0; u < owner.cols; ++u) {
        face(Outward::left, v, u, v, u - 1);
        face(Outward::right, v, u, v, u + 1);
        face(Outward::up, v, u, v - 1, u);
        face(Outward::down, v, u, v + 1, u);
      }
    EXPECT_EQ(field.length_px, length_px);
    for (std::size_t way = 0; way < 4; ++way)
      ASSERT_EQ(cv::countNonZero(field.elements[way] != elements[way]), 0) << "round " << round;
  }
}

}  // namespace
}  // namespace mapscore
