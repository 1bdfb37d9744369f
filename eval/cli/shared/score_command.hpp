// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/recording/recording.hpp"
#include "eval/results/task_list.hpp"

#include <filesystem>
#include <string>

namespace mapscore::eval {

/// The command that scores a map of a task as its trial does, as a comment and a line.
[[nodiscard]] std::string score_command(const std::filesystem::path& map, const Study& study,
                                        const Recording& recording, const ClassTable& table,
                                        const Task& task, double threshold);

}  // namespace mapscore::eval
