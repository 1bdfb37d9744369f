// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <cstdint>

namespace mapscore {

/// A program to be run, made before the fork: after it nothing may be allocated.
struct SupervisedProgram {
  const char* file;          ///< a path
  char* const* arguments;    ///< its name first, nullptr last
  const char* folder;        ///< to work in
  std::uint64_t file_bytes;  ///< of each file that it writes; 0: any number
  int out = -1, err = -1;    ///< descriptors that it prints to
  int reports = -1;          ///< descriptor that a SupervisorReport is written to
};

/// First that the supervisor has begun; then how the program ended, or the errno of why it could
/// not begin.
struct SupervisorReport {
  pid_t begun = 0;  ///< of the first report alone: the supervisor's id
  int problem = 0;
  int status = 0;  ///< of wait
  rusage usage{};  ///< of it and of all that it started
};

/// Forks a process that runs the program and, when that ends, or this thread ends, or it gets
/// SIGTERM, kills everything the program has started: it adopts what loses its parent
/// (PR_SET_CHILD_SUBREAPER). Where the kernel lists no children (/proc/thread-self/children), it
/// kills the program's process group alone. Then it reports and ends. Gives its id, -1 where it
/// cannot be forked.
[[nodiscard]] pid_t fork_supervisor(const SupervisedProgram& program);

/// A process that forks supervisors, made early: what this process has taken in memory later is not
/// copied for each program, nor counted as the program's own. It ends with this. Safe to use from
/// several threads.
class SupervisorServer {
 public:
  /// Throws Error when there can be no such process.
  SupervisorServer();
  ~SupervisorServer();
  SupervisorServer(const SupervisorServer&) = delete;
  SupervisorServer& operator=(const SupervisorServer&) = delete;

  /// As fork_supervisor, in the other process. False where the words are too long to be sent, or
  /// the process is gone; errno says which.
  [[nodiscard]] bool start(const SupervisedProgram& program) const;

 private:
  int socket_ = -1;
  pid_t id_ = -1;
};

}  // namespace mapscore
