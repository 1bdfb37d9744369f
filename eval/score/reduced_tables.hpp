// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/score/map_snapshot.hpp"

#include <vector>

namespace mapscore::eval {

// Class tables derived from a scene's. Truth made with them (surface_truth, SampleCounter,
// make_lattice_truth) treats each instance, or all surfaces together, as one class.

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
