// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/shape.hpp"
#include "eval/recording/recording.hpp"
#include "eval/study/study.hpp"
#include "sim/render/renderer.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mapscore::eval {

/// Paints a scene without its ceiling. Used by the thread that made it. Every constructor throws
/// Error when the program was built without the simulator.
class ScenePainter {
 public:
  /// The scene of a study, or, where it names none, or it is not there or not the one of the
  /// recording any more, the surfaces of the recording; at the time `at_s` where they move.
  ScenePainter(const Study& study, const Recording& recording,
               std::optional<double> at_s = std::nullopt);
  /// An MJCF file, with the class file beside it. Throws Error when it is refused.
  explicit ScenePainter(const std::filesystem::path& scene);
  /// Exact surfaces, in the muted colours of their classes.
  ScenePainter(std::vector<Shape> shapes, const ClassTable& table);
  ~ScenePainter();
  ScenePainter(const ScenePainter&) = delete;
  ScenePainter& operator=(const ScenePainter&) = delete;

  /// The scene, pale, with the cubes in it. Throws Error when the view cannot be drawn.
  [[nodiscard]] cv::Mat3b paint(sim::View view, std::span<const sim::Cube> cubes);

  /// As paint, but cubes that things cover are seen through them.
  [[nodiscard]] cv::Mat3b paint_through(sim::View view, std::span<const sim::Cube> cubes);

  /// The scene with everything in the colour of its class, what no class claims grey.
  [[nodiscard]] cv::Mat3b paint_classes(sim::View view);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mapscore::eval
