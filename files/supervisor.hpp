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
  int out, err;              ///< descriptors that it prints to
  int reports;               ///< descriptor that a SupervisorReport is written to
};

/// How it ended, or the errno of why it could not begin.
struct SupervisorReport {
  int problem = 0;
  int status = 0;  ///< of wait
  rusage usage{};  ///< of it and of all that it started
};

/// Forks a process that runs the program and, when that ends, or this thread ends, or it gets
/// SIGTERM, kills everything the program has started: it adopts what loses its parent
/// (PR_SET_CHILD_SUBREAPER). Then it reports and ends. Gives its id, -1 where it cannot be forked.
[[nodiscard]] pid_t fork_supervisor(const SupervisedProgram& program);

}  // namespace mapscore
