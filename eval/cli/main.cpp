// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/shared/terminal_guard.hpp"
#include "eval/cli/verbs.hpp"
#include "files/text.hpp"

#include <csignal>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <string_view>

namespace {

constexpr int kWrongInput = 2;

int complain(const std::string& message) {
  std::cerr << "mapscore: " << mapscore::shown(message) << '\n';
  return kWrongInput;
}

/// CLI11 would only say that a verb is missing.
void refuse_unknown_verb(const CLI::App& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::string verbs;
  for (const CLI::App* verb : program.get_subcommands({})) {
    if (verb->get_name() == argv[1]) return;
    verbs += (verbs.empty() ? "" : ", ") + verb->get_name();
  }
  throw mapscore::Error(std::string("no verb '") + argv[1] + "'; there are: " + verbs);
}

/// An unset variable of a shell would otherwise pass for a flag that was not given.
void refuse_empty_values(int argc, char** argv) {
  for (int n = 1; n < argc; ++n) {
    const std::string_view word = argv[n];
    if (word.empty())
      throw mapscore::Error(std::string("an empty value after '") + argv[n - 1] +
                            "'; give one, or leave the flag out");
    if (word.starts_with("--") && word.find('=') == word.size() - 1)
      throw mapscore::Error(std::string(word) + ": has no value; give one, or leave the flag out");
  }
}

int run(CLI::App& program, int argc, char** argv) {
  int exit_code = 0;
  mapscore::eval::add_verbs(program, exit_code);
  refuse_unknown_verb(program, argc, argv);
  refuse_empty_values(argc, argv);
  program.parse(argc, argv);
  std::cout.flush();
  return std::cout ? exit_code : complain("standard output cannot be written; is the disk full?");
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file at its limit is then an error of writing, with a line
  const mapscore::eval::TerminalGuard guarded_output(std::cout), guarded_errors(std::cerr);
  CLI::App program(
      "How good is a semantic 3D map, and how much calibration and localisation error can it "
      "take?");
  program.require_subcommand(1);
  program.set_version_flag("--version", std::string("mapscore ") + MAPSCORE_VERSION);
  program.footer(
      "Examples:\n"
      "  mapscore sweep configs/demo.yaml -o results/demo     all trials of a study\n"
      "  mapscore table results/demo                          their scores\n"
      "  mapscore figures results/demo                        their figures and pictures\n"
      "`mapscore VERB --help` tells more. Exit codes: 0 done, 1 the answer is no, 2 wrong input.");
  try {
    return run(program, argc, argv);
  } catch (const CLI::Success& request) {
    return program.exit(request);
  } catch (const CLI::ParseError& error) {
    return complain(std::string(error.what()) + "; see `mapscore --help`");
  } catch (const mapscore::Error& error) {
    return complain(error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return complain(error.path1().string() + ": " + error.code().message() +
                    "; give another place, or mend its permissions");
  } catch (const std::bad_alloc&) {
    return complain(
        "out of memory: what was read takes more than there is; give a smaller file, scene or "
        "study, or larger voxels");
  } catch (const std::exception& error) {
    return complain(error.what());
  }
}
