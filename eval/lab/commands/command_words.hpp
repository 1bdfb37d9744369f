// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/study/study.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Whether the method of that name is a command, which sweeps and searches of tolerances alone
/// run: its maps are not kept.
[[nodiscard]] bool is_command(const Study& study, const std::string& method);

/// The words of the command that a study's first method is: its program as an absolute path, files
/// that lie beside the study likewise, placeholders as they are. Throws Error naming the key when
/// the program is neither on the PATH nor beside the study, or cannot be executed, or a script
/// whose interpreter is not there, or {map} has no ending of a map.
[[nodiscard]] std::vector<std::string> command_words(const Study& config);

/// The words with these in the place of {trial}, {map} and {threads}, wherever they stand in one.
[[nodiscard]] std::vector<std::string> filled_words(std::vector<std::string> words,
                                                    const std::filesystem::path& trial,
                                                    const std::filesystem::path& map, int threads);

}  // namespace mapscore::eval
