// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/command.hpp"

#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

#include <csignal>

namespace mapscore {
namespace {

TEST(Command, GivesBothOutputsAndTheExitCode) {
  const testing::TemporaryFolder folder;
  const CommandOutcome outcome =
      run_command({"sh", "-c", "pwd; cat; echo wrong >&2; exit 3"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.out, std::filesystem::canonical(folder.path()).string() + "\n");
  EXPECT_EQ(outcome.err, "wrong\n");
}

TEST(Command, NoShellReadsItsWords) {
  const std::string word = "$(echo ran) 'a\" `echo ran`;\n*";
  EXPECT_EQ(run_command({"printf", "%s", word}, "/").out, word);
}

TEST(Command, MuchOutputIsWhole) {
  EXPECT_EQ(run_command({"head", "-c", "1000000", "/dev/zero"}, "/").out, std::string(1000000, 0));
}

TEST(Command, EndedByASignal) {
  EXPECT_EQ(run_command({"sh", "-c", "kill -9 $$"}, "/").exit_code, 128 + 9);
}

TEST(Command, HowItEndedIsNotKnownWhereTheSystemForgetsChildren) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  testing::expect_error("sh: how it ended is not known", [] {
    (void)run_command({"sh", "-c", "exit 3"}, "/");
  });
  std::signal(SIGCHLD, before);
}

TEST(Command, WhatIsNotThere) {
  EXPECT_FALSE(program_on_path("no_such_program"));
  EXPECT_TRUE(program_on_path("sh"));
  testing::expect_error("no_such_program: cannot be started",
                        [] { (void)run_command({"no_such_program"}, "/"); });
}

}  // namespace
}  // namespace mapscore
