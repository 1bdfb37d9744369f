// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/study.hpp"
#include "eval/recording/recording.hpp"
#include "sim/render/renderer.hpp"

#include <memory>
#include <span>

namespace mapscore::eval {

/// Paints the scene of a study, without its ceiling. Used by the thread that made it.
class ScenePainter {
 public:
  /// Throws Error when the program was built without the simulator, the study has no scene, or the
  /// scene is not there, is refused, or is not the one of the recording any more.
  ScenePainter(const Study& study, const Recording& recording);
  ~ScenePainter();
  ScenePainter(const ScenePainter&) = delete;
  ScenePainter& operator=(const ScenePainter&) = delete;

  /// The scene, pale, with the cubes in it.
  [[nodiscard]] cv::Mat3b paint(sim::View view, std::span<const sim::Cube> cubes);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mapscore::eval
