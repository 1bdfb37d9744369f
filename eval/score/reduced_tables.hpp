// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/score/prediction.hpp"

#include <vector>

namespace mapscore::eval {

// Other readings of a scene's class table: truth made with them (surface_truth, SampleCounter,
// make_lattice_truth) is that of instances, or of all surfaces as one.

/// Every instance, background among them, is a class of its own, under its own id, name and its
/// class's colour; detected where its class is.
[[nodiscard]] ClassTable instance_table(const ClassTable& table);

/// The one class of geometry_table beside background.
inline constexpr ClassId kSurfaceClass = 1;

/// Two classes: background, which nothing belongs to, and `surface`, detected, of every instance of
/// the table, background's included. Ids beyond the table remain background.
[[nodiscard]] ClassTable geometry_table(const ClassTable& table);

/// The map for geometry_table: every occupied voxel belongs to `surface`, those known to be free to
/// nothing; probabilities stay. Score it with threshold 0.
[[nodiscard]] MapSnapshot geometry_map(const MapSnapshot& map);

}  // namespace mapscore::eval
