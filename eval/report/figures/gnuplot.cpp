// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/gnuplot.hpp"

#include "core/error.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

namespace mapscore::eval {
namespace {

constexpr const char* kLog = "gnuplot.log";

/// The first line that says something but a warning.
std::string first_words(const std::filesystem::path& log) {
  std::ifstream stream(log);
  for (std::string line; std::getline(stream, line);)
    if (const std::size_t start = line.find_first_not_of(" \t^");
        start != std::string::npos && line.find("arning:") == std::string::npos)
      return line.substr(start);
  return "it said nothing";
}

}  // namespace

void run_gnuplot(const std::filesystem::path& folder, const std::string& script) {
  std::string program = "gnuplot", no_startup_files = "-d", argument = script;
  char* arguments[] = {program.data(), no_startup_files.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t actions;  // what the child does before it becomes gnuplot
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, kLog, O_WRONLY | O_CREAT | O_TRUNC,
                                   0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int problem = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (problem != 0) throw Error("gnuplot: not found; install gnuplot-nox");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error(
        script + ": gnuplot failed: " + first_words(folder / kLog) +
        "; check the free space, and that gnuplot is 5.2 or later with cairo (gnuplot-nox)");
}

}  // namespace mapscore::eval
