// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/output_check.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <set>

namespace mapscore::eval {

void check_outputs(const std::vector<OutputFile>& outputs) {
  namespace fs = std::filesystem;
  std::set<fs::path> named;
  for (const auto& [flag, file, ending] : outputs) {
    if (file.empty()) continue;
    const auto refuse = [&, name = flag, path = file](const std::string& why) {
      throw Error(fmt::format("{}: {}: {}", name, path.string(), why));
    };
    if (!ending.empty() && file.extension() != ending)
      refuse(fmt::format("is written as {}; give the file this ending", ending));
    const fs::path whole = fs::absolute(file).lexically_normal();
    std::error_code none;
    if (fs::is_directory(whole, none)) refuse("is a folder; give the name of a file");
    if (!fs::is_directory(whole.parent_path(), none))
      refuse("its folder is not there; make it, or give another");
    if (!named.insert(whole).second) refuse("two flags name this file; give each its own");
  }
}

OutputLocks::OutputLocks(const std::vector<std::filesystem::path>& files) {
  namespace fs = std::filesystem;
  std::set<fs::path> folders;
  for (const fs::path& file : files) {
    if (file.empty()) continue;
    std::error_code missing;
    const fs::path folder = fs::canonical(fs::absolute(file).parent_path(), missing);
    if (!missing) folders.insert(folder);
  }
  for (const fs::path& folder : folders) locks_.emplace_back(folder);
}

}  // namespace mapscore::eval
