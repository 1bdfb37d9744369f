// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

namespace mapscore::eval {

// Class tables derived from a scene's. Truth made with them (surface_truth, SampleCounter,
// make_view) treats each instance, or all surfaces together, as one class.

/// Every instance, background among them, is a class of its own, under its own id, name and its
/// class's colour; detected where its class is.
[[nodiscard]] inline ClassTable instance_table(const ClassTable& table) {
  ClassTable reduced;
  reduced.classes.clear();
  reduced.instances.clear();
  for (const Instance& instance : table.instances) {
    const SemanticClass& semantic = table.classes.at(instance.class_id);
    reduced.classes.push_back({instance.id, instance.name, semantic.colour, semantic.detect});
    reduced.instances.push_back({instance.id, instance.name, instance.id});
  }
  return reduced;
}

/// The one class of geometry_table beside background.
inline constexpr ClassId kSurfaceClass = 1;

/// Two classes: background, which nothing belongs to, and `surface`, detected, of every instance of
/// the table, background's included. Ids beyond the table remain background.
[[nodiscard]] inline ClassTable geometry_table(const ClassTable& table) {
  ClassTable reduced;
  reduced.classes.push_back({kSurfaceClass, "surface", {200, 200, 200}, true});
  reduced.instances = table.instances;
  for (Instance& instance : reduced.instances) instance.class_id = kSurfaceClass;
  return reduced;
}

}  // namespace mapscore::eval
