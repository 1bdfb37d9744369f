// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/command.hpp"

#include "core/error.hpp"
#include "files/supervisor.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

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
  const CommandOutcome killed = run_command({"sh", "-c", "kill -9 $$"}, "/");
  EXPECT_EQ(killed.exit_code, 128 + 9);
  EXPECT_EQ(killed.signal, 9);
  const CommandOutcome ended = run_command({"sh", "-c", "exit 137"}, "/");
  EXPECT_EQ(ended.exit_code, 137);
  EXPECT_EQ(ended.signal, 0);
}

TEST(Command, HowItEndedIsKnownWhereTheSystemForgetsChildren) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(run_command({"sh", "-c", "exit 3"}, "/").exit_code, 3);
  std::signal(SIGCHLD, before);
}

double seconds_of(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Whether a process is alive; a zombie, whom nobody waits for in a container, is not.
bool alive(const std::string& id) {
  std::ifstream file("/proc/" + id + "/stat");
  std::string number, name, state;
  return (file >> number >> name >> state) && state != "Z";
}

TEST(Command, EndsInTime) {
  CommandOutcome outcome;
  EXPECT_LT(seconds_of([&] {
              outcome = run_command({"sh", "-c", "echo begun; sleep 100"}, "/", {.timeout_s = 0.3});
            }),
            10.0);
  EXPECT_TRUE(outcome.timed_out);
  EXPECT_EQ(outcome.exit_code, 128 + 9);
  EXPECT_EQ(outcome.out, "begun\n");
}

TEST(Command, EndsWhenItIsStopped) {
  int asked = 0;
  const CommandOutcome outcome =
      run_command({"sleep", "100"}, "/", {.stop = [&] { return ++asked > 2; }});
  EXPECT_TRUE(outcome.stopped);
  EXPECT_FALSE(outcome.timed_out);
}

TEST(Command, WhatHasEndedIsNotStoppedAnyMore) {
  int asked = 0;
  const auto stop = [&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));  // it ends meanwhile
    return ++asked > 1;
  };
  const CommandOutcome outcome = run_command({"true"}, "/", {.timeout_s = 1, .stop = stop});
  EXPECT_EQ(asked, 1);
  EXPECT_FALSE(outcome.timed_out || outcome.stopped);
}

/// What `act` gives, 0 to 255, in a process of its own that `prepare` has changed; nothing where it
/// cannot be, -1 where it takes longer than 20 s.
std::optional<int> in_a_process(const auto& prepare, const auto& act) {
  constexpr int kCannot = 255;
  const pid_t id = fork();
  if (id == 0) {
    alarm(20);
    try {
      _exit(prepare() ? act() : kCannot);
    } catch (const std::exception&) {
      _exit(kCannot - 1);
    }
  }
  int status = 0;
  waitpid(id, &status, 0);
  if (!WIFEXITED(status)) return -1;
  return WEXITSTATUS(status) == kCannot ? std::nullopt : std::optional(WEXITSTATUS(status));
}

TEST(Command, EndsInTimeWhereTheKernelListsNoChildren) {
  const testing::TemporaryFolder folder;
  const auto hide_proc = [] {
    return (unshare(CLONE_NEWNS) == 0 || unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0) &&
           mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
           mount("none", "/proc", "tmpfs", 0, nullptr) == 0;
  };
  const auto timed_out = in_a_process(hide_proc, [&] {
    const std::string sleeps = "sleep 100 & echo $! > id; sleep 100";
    return run_command({"sh", "-c", sleeps}, folder.path(), {.timeout_s = 0.3}).timed_out ? 1 : 0;
  });
  if (!timed_out) GTEST_SKIP() << "/proc cannot be hidden";
  EXPECT_EQ(timed_out, 1);
  std::string id;
  std::ifstream(folder.path() / "id") >> id;
  EXPECT_FALSE(alive(id));
}

TEST(Command, AServerTellsWhereThereCanBeNoProcess) {
  const auto become_another = [] {  // with one process beside this one
    const rlimit two{2, 2};
    return setrlimit(RLIMIT_NPROC, &two) == 0 && setuid(61234) == 0;
  };
  const auto said = in_a_process(become_another, [] {
    const SupervisorServer server;
    try {
      (void)run_command({"true"}, "/", {.server = &server});
    } catch (const Error& error) {
      return std::string(error.what()).ends_with(std::strerror(EAGAIN)) ? 1 : 2;
    }
    return 0;
  });
  if (!said) GTEST_SKIP() << "needs root";
  EXPECT_EQ(said, 1);
}

TEST(Command, NothingThatItStartedStaysBehind) {
  for (const std::string leave :
       {"sleep 100 & echo $!", "setsid sleep 100 & sleep 0.2; echo $!",
        "(setsid sh -c 'trap \"\" TERM INT HUP; sleep 100 & echo $!; wait' &); sleep 0.2",
        "sh -c 'sleep 100 >/dev/null 2>&1 </dev/null & echo $!'"}) {
    const CommandOutcome outcome = run_command({"sh", "-c", leave}, "/", {.timeout_s = 20});
    EXPECT_EQ(outcome.exit_code, 0) << leave;
    EXPECT_FALSE(outcome.timed_out) << leave;
    const std::string id = outcome.out.substr(0, outcome.out.find('\n'));
    ASSERT_FALSE(id.empty()) << leave;
    EXPECT_FALSE(alive(id)) << leave;
  }
}

TEST(Command, DiesWithTheProgramThatRunsIt) {
  const testing::TemporaryFolder folder;
  const pid_t program = fork();
  if (program == 0) {
    (void)run_command({"sh", "-c", "echo $$ > id; setsid sleep 100 & echo $! >> id; wait"},
                      folder.path());
    _exit(0);
  }
  std::string first, second;
  for (int n = 0; n < 500 && second.empty(); ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::ifstream(folder.path() / "id") >> first >> second;
  }
  ASSERT_FALSE(second.empty());
  EXPECT_TRUE(alive(first) && alive(second));
  kill(program, SIGKILL);
  waitpid(program, nullptr, 0);
  for (int n = 0; n < 500 && (alive(first) || alive(second)); ++n)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(alive(first) || alive(second));
}

TEST(Command, OfAFloodBeginningAndEndAreKept) {
  const CommandOutcome outcome =
      run_command({"sh", "-c", "echo first; head -c 20000000 /dev/zero; echo last >&2; exit 7"},
                  "/", {.kept_bytes = 1000, .one_log = true});
  EXPECT_EQ(outcome.exit_code, 7);
  EXPECT_LT(outcome.out.size(), 3000u);
  EXPECT_TRUE(outcome.out.starts_with("first\n"));
  EXPECT_TRUE(outcome.out.ends_with("last\n"));
  EXPECT_NE(outcome.out.find(" bytes left out]"), std::string::npos);
  EXPECT_EQ(outcome.err, "");
}

TEST(Command, AFileIsBounded) {
  const testing::TemporaryFolder folder;
  const CommandOutcome outcome = run_command({"sh", "-c", "exec head -c 1000000 /dev/zero > file"},
                                             folder.path(), {.file_bytes = 1000});
  EXPECT_EQ(outcome.exit_code, 128 + SIGXFSZ);
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "file"), 1000u);
}

TEST(Command, ClosedOutputIsNotTheEnd) {
  const CommandOutcome outcome = run_command({"sh", "-c", "exec >&- 2>&-; sleep 0.3; exit 5"}, "/");
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_GT(outcome.wall_s, 0.25);
}

TEST(Command, TellsWhatItTook) {
  const CommandOutcome idle = run_command({"sleep", "0.3"}, "/");
  EXPECT_GT(idle.wall_s, 0.25);
  EXPECT_LT(idle.processor_s, 0.2);
  const CommandOutcome busy =
      run_command({"sh", "-c",
                   "i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done; head -c 100000000 /dev/zero "
                   "| tail -c 80000000 | wc -c"},
                  "/");
  EXPECT_GT(busy.processor_s, idle.processor_s);
  EXPECT_GT(busy.peak_bytes, 70'000'000u);
}

TEST(Command, AServerStartsItAsWell) {
  const testing::TemporaryFolder folder;
  const SupervisorServer server;
  const std::vector<char> much(300'000'000, 1);  // is not the program's
  const CommandLimits limits{.timeout_s = 20, .server = &server};
  const CommandOutcome outcome =
      run_command({"sh", "-c", "pwd; echo \"$0\" >&2; setsid sleep 100 & exit 3", "a b\n'c'"},
                  folder.path(), limits);
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.out, std::filesystem::canonical(folder.path()).string() + "\n");
  EXPECT_EQ(outcome.err, "a b\n'c'\n");
  EXPECT_LT(outcome.peak_bytes, 200'000'000u);
  EXPECT_TRUE(run_command({"sleep", "100"}, "/", {.timeout_s = 0.2, .server = &server}).timed_out);
  testing::expect_error("cannot be started",
                        [&] { (void)run_command({"/proc/self/stat"}, "/", limits); });
  testing::expect_error("cannot be started", [&] {
    (void)run_command({"echo", std::string(200'000, 'x')}, "/", limits);
  });
  EXPECT_EQ(run_command({"echo", std::string(100'000, 'x')}, "/", limits).out.size(), 100'001u);
}

TEST(Command, SeveralAtATime) {
  const SupervisorServer server;
  std::vector<std::jthread> threads;
  std::atomic<int> right = 0;
  for (int n = 0; n < 8; ++n)
    threads.emplace_back([&right, &server, n] {
      for (int turn = 0; turn < 10; ++turn) {
        const std::string word = std::to_string(100 * n + turn);
        const CommandLimits limits{.server = turn % 2 == 0 ? &server : nullptr};
        right += run_command({"echo", word}, "/", limits).out == word + '\n' ? 1 : 0;
      }
    });
  threads.clear();
  EXPECT_EQ(right, 80);
}

TEST(Command, ARelativePlaceOnThePathIsThatOfThisProgram) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path program = folder.path() / "a_program_here";
  std::ofstream(program) << "#!/bin/sh\necho here\n";
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  for (const char* path : {".:/bin", ":/bin"}) {
    const auto outcome = in_a_process(
        [&] { return chdir(folder.path().c_str()) == 0 && setenv("PATH", path, 1) == 0; },
        [&] { return run_command({"a_program_here"}, "/").out == "here\n" ? 1 : 0; });
    EXPECT_EQ(outcome, 1) << path;
  }
}

TEST(Command, WhatIsNotThere) {
  EXPECT_FALSE(program_on_path("no_such_program"));
  EXPECT_TRUE(program_on_path("sh"));
  testing::expect_error("no_such_program: cannot be started",
                        [] { (void)run_command({"no_such_program"}, "/"); });
}

}  // namespace
}  // namespace mapscore
