// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// A file that a flag names, to be written when the work is done.
struct OutputFile {
  std::string flag;
  std::filesystem::path file;  ///< empty: not asked for
  std::string ending;          ///< that it must have, as ".ot"; empty: any
};

/// Refuses before the work what could not be written after it: throws Error unless each file has
/// its ending, lies in a folder that is there and is no folder itself, and no two are the same.
void check_outputs(const std::vector<OutputFile>& outputs);

}  // namespace mapscore::eval
