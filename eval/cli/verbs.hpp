// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <CLI/CLI.hpp>

#include <memory>
#include <utility>

namespace mapscore::eval {

/// Adds a verb that calls `work` with its flags; gives both, to add the options.
template <class Flags>
[[nodiscard]] std::pair<CLI::App*, std::shared_ptr<Flags>> add_verb(CLI::App& program,
                                                                    const char* name,
                                                                    const char* help,
                                                                    void (*work)(const Flags&)) {
  CLI::App* verb = program.add_subcommand(name, help);
  const auto flags = std::make_shared<Flags>();
  verb->callback([work, flags] { work(*flags); });
  return {verb, flags};
}

/// Each function adds one verb to the program. A verb's callback does the work and throws Error
/// when the input is wrong; `exit_code` is set to 1 when the answer is no: scores fell, trials
/// failed, counts of a repeated trial differ, frames do not tell a calibration.
void add_record(CLI::App& program);
void add_explore(CLI::App& program);
void add_run(CLI::App& program, int& exit_code);
void add_trial(CLI::App& program);
void add_frames(CLI::App& program);
void add_sweep(CLI::App& program, int& exit_code);
void add_tolerance(CLI::App& program, int& exit_code);
void add_calibrate(CLI::App& program, int& exit_code);
void add_map(CLI::App& program);
void add_localize(CLI::App& program);
void add_segment(CLI::App& program);
void add_objects(CLI::App& program);
void add_truth(CLI::App& program);
void add_score(CLI::App& program);
void add_resolutions(CLI::App& program);
void add_status(CLI::App& program);
void add_trials(CLI::App& program);
void add_table(CLI::App& program);
void add_compare(CLI::App& program);
void add_figures(CLI::App& program);
void add_check(CLI::App& program, int& exit_code);
void add_info(CLI::App& program);

/// All of them, in the order of the help.
inline void add_verbs(CLI::App& program, int& exit_code) {
  add_record(program);
  add_explore(program);
  add_run(program, exit_code);
  add_trial(program);
  add_frames(program);
  add_sweep(program, exit_code);
  add_tolerance(program, exit_code);
  add_calibrate(program, exit_code);
  for (const auto add :
       {add_map, add_localize, add_segment, add_objects, add_truth, add_score, add_resolutions,
        add_status, add_trials, add_table, add_compare, add_figures})
    add(program);
  add_check(program, exit_code);
  add_info(program);
}

}  // namespace mapscore::eval
