// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/gnuplot.hpp"

#include "core/error.hpp"
#include "files/command.hpp"

#include <sstream>

namespace mapscore::eval {
namespace {

/// The first line that says something but a warning.
std::string first_words(const std::string& log) {
  std::istringstream stream(log);
  for (std::string line; std::getline(stream, line);)
    if (const std::size_t start = line.find_first_not_of(" \t^");
        start != std::string::npos && line.find("arning:") == std::string::npos)
      return line.substr(start);
  return "it said nothing";
}

}  // namespace

void run_gnuplot(const std::filesystem::path& folder, const std::string& script) {
  if (!program_on_path("gnuplot")) throw Error("gnuplot: not found; install gnuplot-nox");
  const CommandOutcome outcome = run_command({"gnuplot", "-d", script}, folder);
  if (outcome.exit_code != 0)
    throw Error(
        script + ": gnuplot failed: " + first_words(outcome.err) +
        "; check the free space, and that gnuplot is 5.2 or later with cairo (gnuplot-nox)");
}

}  // namespace mapscore::eval
