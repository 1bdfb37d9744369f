// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <CLI/CLI.hpp>

namespace mapscore::eval {

/// Each function adds one verb to the program. A verb's callback does the work and throws Error
/// when the input is wrong; `check` sets `exit_code` to 1 when the answer is no.
void add_record(CLI::App& program);
void add_run(CLI::App& program);
void add_frames(CLI::App& program);
void add_sweep(CLI::App& program);
void add_map(CLI::App& program);
void add_localize(CLI::App& program);
void add_segment(CLI::App& program);
void add_objects(CLI::App& program);
void add_truth(CLI::App& program);
void add_score(CLI::App& program);
void add_resolutions(CLI::App& program);
void add_table(CLI::App& program);
void add_compare(CLI::App& program);
void add_figures(CLI::App& program);
void add_check(CLI::App& program, int& exit_code);
void add_info(CLI::App& program);

/// All of them, in the order of the help.
inline void add_verbs(CLI::App& program, int& exit_code) {
  add_record(program);
  add_run(program);
  add_frames(program);
  add_sweep(program);
  add_map(program);
  add_localize(program);
  add_segment(program);
  add_objects(program);
  add_truth(program);
  add_score(program);
  add_resolutions(program);
  add_table(program);
  add_compare(program);
  add_figures(program);
  add_check(program, exit_code);
  add_info(program);
}

}  // namespace mapscore::eval
