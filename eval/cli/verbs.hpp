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

}  // namespace mapscore::eval
