// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/command.hpp"

#include "core/error.hpp"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace mapscore {
namespace {

/// What a program prints, in memory: unlike a pipe it never makes the program wait.
class Catcher {
 public:
  Catcher() : descriptor_(memfd_create("output", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw Error(std::string("no file in memory: ") + std::strerror(errno));
  }
  ~Catcher() { close(descriptor_); }
  Catcher(const Catcher&) = delete;
  Catcher& operator=(const Catcher&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] std::string text() const {
    std::string text;
    std::array<char, 4096> part{};
    for (ssize_t read = 0; (read = pread(descriptor_, part.data(), part.size(),
                                         static_cast<off_t>(text.size()))) > 0;)
      text.append(part.data(), static_cast<std::size_t>(read));
    return text;
  }

 private:
  int descriptor_;
};

}  // namespace

std::optional<std::filesystem::path> program_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::filesystem::path program = std::filesystem::path(folder) / name;
    std::error_code none;
    if (std::filesystem::is_regular_file(program, none) && access(program.c_str(), X_OK) == 0)
      return program;
  }
  return std::nullopt;
}

CommandOutcome run_command(const std::vector<std::string>& words,
                           const std::filesystem::path& folder) {
  const Catcher out, err;
  std::vector<std::string> texts = words;
  std::vector<char*> arguments;
  for (std::string& text : texts) arguments.push_back(text.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;  // what the child does before it becomes the program
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", 0, 0);
  posix_spawn_file_actions_adddup2(&actions, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.descriptor(), STDERR_FILENO);
  pid_t child = 0;
  const int problem =
      posix_spawnp(&child, arguments.front(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (problem != 0)
    throw Error(words.front() + ": cannot be started in " + folder.string() + ": " +
                std::strerror(problem));
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR)
      throw Error(words.front() + ": how it ended is not known: " + std::strerror(errno));
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), out.text(), err.text()};
}

}  // namespace mapscore
