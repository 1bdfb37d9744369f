// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/objects/map_object.hpp"

#include <cstddef>

namespace mapscore {

/// How a box takes in another of the same object, face by face along its own axes.
enum class BoxUpdate {
  hull,     ///< the farther face stands: right for exact views of parts
  mean,     ///< mean of the faces, weighted by observations: wrong views wash out, parts shrink it
  quantile  ///< quantile of each face over the views, counted outwards: few wrong views and many
            ///< parts do nothing
};

/// The rule, and for `quantile` its share s in (0, 1]: of n views each face is the ceil(s n)-th,
/// counted outwards; 1: the hull of the views.
struct BoxMerge {
  BoxUpdate rule = BoxUpdate::quantile;
  double share = 0.75;
};

/// Latest views that an object keeps.
inline constexpr std::size_t kMaxViews = 200;

/// `kept` after taking in `other`: axes of `kept`; each face by the rule, `other` standing in with
/// its least cover along these axes. Weights above 0. Throws Error for `quantile`, which needs the
/// views.
[[nodiscard]] ObjectBox merged_box(const ObjectBox& kept, double kept_weight,
                                   const ObjectBox& other, double other_weight, BoxUpdate rule);

/// `object` after one more detection, at `stamp_s`: box, observations, confidence, age 0. Its model
/// stays unless the detection names one. An object without views (of a file) counts as
/// `observations` views of its box.
[[nodiscard]] MapObject updated(const MapObject& object, const ObjectDetection& detection,
                                double stamp_s, const BoxMerge& merge);

/// Two objects that turned out to be one: id of the lower, axes of the one with more observations
/// (ties: the lower id), counts added, the later stamp with its age (ties: the lesser age).
[[nodiscard]] MapObject merged(const MapObject& a, const MapObject& b, const BoxMerge& merge);

/// `object` after a frame in which it should have been seen and was not.
[[nodiscard]] MapObject missed(const MapObject& object);

}  // namespace mapscore
