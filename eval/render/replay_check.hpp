// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/recording/recording.hpp"
#include "eval/study/study.hpp"

#include <string>

namespace mapscore::eval {

/// What can only be checked once the classes are known, before the first frame: a confusion matrix
/// has a row for each detected class, at every point of the grid. Throws Error naming the key.
void check_classes(const Study& study, const ClassTable& table);

/// check_classes, and that faults of depth or labels are not added to those baked into the images.
/// Throws Error.
void check_replay(const Study& study, const RecordingInfo& info);

/// That the study's scene is another than the replayed recording's; empty otherwise.
[[nodiscard]] std::string note_on_scene(const Study& study, const RecordingInfo& info);

/// What to know before believing the scores of a recording whose depth was baked; empty otherwise.
[[nodiscard]] std::string note_on_baked(const RecordingInfo& info);

}  // namespace mapscore::eval
