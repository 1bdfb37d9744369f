// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "sim/world/costly_scene.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <exception>
#include <fstream>
#include <new>
#include <string>

namespace mapscore::sim {
namespace {

/// Lowers what this process may take; a lower limit that is there stays.
void lower(decltype(RLIMIT_AS) resource, rlim_t value) {
  rlimit now{};
  getrlimit(resource, &now);
  now.rlim_cur = std::min(now.rlim_cur, value);
  setrlimit(resource, &now);
}

rlim_t address_space() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/// MuJoCo's runtime writes a line of its own when it dies.
void be_silent() {
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
}

/// What the child does: writes the reason of a refusal to `report`.
[[noreturn]] void work_within(const TrialLimits& limits, const std::function<void()>& work,
                              int report) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  be_silent();
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGXCPU, SIGALRM})
    std::signal(signal, SIG_DFL);
  lower(RLIMIT_CORE, 0);
  lower(RLIMIT_CPU, limits.processor_s);
  alarm(2 * limits.processor_s);
  lower(RLIMIT_AS, address_space() + (rlim_t{limits.memory_gb} << 30));
  try {
    work();
  } catch (const std::bad_alloc&) {
    _exit(1);
  } catch (const std::exception& error) {
    const std::string reason = error.what();
    _exit(write(report, reason.data(), reason.size()) < 0 ? 1 : 0);
  }
  _exit(0);
}

/// All that is written to a pipe until its other end is closed.
std::string read_all(int pipe) {
  std::string text;
  std::array<char, 4096> part{};
  while (true) {
    const ssize_t size = read(pipe, part.data(), part.size());
    if (size > 0)
      text.append(part.data(), static_cast<std::size_t>(size));
    else if (size == 0 || errno != EINTR)
      return text;
  }
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

void try_apart(const std::filesystem::path& scene, const std::function<void()>& work,
               const TrialLimits& limits) {
  std::array<int, 2> report{};
  if (pipe2(report.data(), O_CLOEXEC) != 0)
    throw Error(fmt::format("{}: no pipe for trying it; close some files", scene.string()));
  const pid_t child = fork();
  if (child == 0) work_within(limits, work, report[1]);
  close(report[1]);
  const std::string reason = child < 0 ? "" : read_all(report[0]);
  close(report[0]);
  if (child < 0)
    throw Error(fmt::format("{}: no process for trying it; end some others", scene.string()));
  const int status = wait_for(child);
  if (!reason.empty()) throw Error(reason);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  const bool late = signal == SIGXCPU || signal == SIGALRM;
  throw Error(fmt::format(
      "{}: MuJoCo {}; take smaller counts, height fields, textures and meshes", scene.string(),
      late ? fmt::format("is not done with it in {} s of processor time or {} s by the clock",
                         limits.processor_s, 2 * limits.processor_s)
           : fmt::format("dies of it, or needs more than {} GB", limits.memory_gb)));
}

}  // namespace mapscore::sim
