// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/objects/map_object.hpp"

namespace mapscore {

/// How a box takes in another of the same object, face by face along its own axes.
enum class BoxUpdate {
  hull,  ///< the farther face stands: right for exact views of parts
  mean   ///< mean of the faces, weighted by observations: wrong views wash out, parts shrink it
};

/// `kept` after taking in `other`: axes of `kept`; each face by the rule, `other` standing in with
/// its least cover along these axes. Weights above 0.
[[nodiscard]] ObjectBox merged_box(const ObjectBox& kept, double kept_weight,
                                   const ObjectBox& other, double other_weight, BoxUpdate rule);

/// `object` after one more detection, at `stamp_s`: box, observations, confidence, age 0. Its model
/// stays unless the detection names one.
[[nodiscard]] MapObject updated(const MapObject& object, const ObjectDetection& detection,
                                double stamp_s, BoxUpdate rule);

/// Two objects that turned out to be one: id of the lower, axes of the one with more observations
/// (ties: the lower id), counts added, the later stamp with its age (ties: the lesser age).
[[nodiscard]] MapObject merged(const MapObject& a, const MapObject& b, BoxUpdate rule);

/// `object` after a frame in which it should have been seen and was not.
[[nodiscard]] MapObject missed(const MapObject& object);

}  // namespace mapscore
