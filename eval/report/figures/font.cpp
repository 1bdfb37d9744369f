// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/font.hpp"

#include "files/text.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <sstream>

namespace mapscore::eval {
namespace {

/// Fontconfig compares families without capitals and blanks.
std::string compared(const std::string& family) {
  std::string text = lower_case(family);
  std::erase(text, ' ');
  return text;
}

/// What fc-match says of a pattern; empty where it fails or is not there. No shell is asked.
std::string matched_families(std::string pattern) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return "";
  std::string program = "fc-match", flag = "-f", format = "%{family}";
  char* arguments[] = {program.data(), flag.data(), format.data(), pattern.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int problem = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::string text;
  std::array<char, 256> part{};
  for (ssize_t got = 1; problem == 0 && got > 0;)
    if ((got = read(ends[0], part.data(), part.size())) > 0)
      text.append(part.data(), static_cast<std::size_t>(got));
    else if (got < 0 && errno == EINTR)
      got = 1;
  close(ends[0]);
  int status = 0;
  while (problem == 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return problem == 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0 ? text : "";
}

}  // namespace

std::optional<std::string> substitute_font(const std::string& family) {
  std::string pattern;  // in which a hyphen begins a size
  for (const char letter : family) pattern += letter == '-' ? "\\-" : std::string(1, letter);
  const std::string families = matched_families(pattern);
  std::istringstream names(families);
  for (std::string name; std::getline(names, name, ',');)
    if (compared(name) == compared(family)) return std::nullopt;
  return families.empty() ? std::nullopt : std::optional(families.substr(0, families.find(',')));
}

}  // namespace mapscore::eval
