// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore {

/// The dotted path that `name` stands for: itself, or the only one that ends in ".NAME".
[[nodiscard]] std::optional<std::string> path_named(std::string_view name,
                                                    const std::vector<std::string>& paths);

/// "did you mean 'NEAREST'?", or the choices when none is near; those that end in ".WORD" alone
/// where several do.
[[nodiscard]] std::string suggestion(std::string_view word,
                                     const std::vector<std::string>& choices);

/// Throws Error with `problem` and a suggestion unless `word` is one of `choices`.
void require_one_of(const std::vector<std::string>& choices, std::string_view word,
                    std::string_view problem);

/// "did you mean 'PATH'?" with what is there under nearly the name of the first part of `missing`
/// that is not; `otherwise` where nothing is near. Never throws.
[[nodiscard]] std::string path_suggestion(const std::filesystem::path& missing,
                                          std::string_view otherwise);

}  // namespace mapscore
