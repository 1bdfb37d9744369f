// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/command.hpp"

#include "core/error.hpp"
#include "files/supervisor.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <utility>

namespace mapscore {
namespace {

class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw Error(std::string("no pipe: ") + std::strerror(errno));
    fcntl(ends_[0], F_SETFL, O_NONBLOCK);
  }
  ~Pipe() {
    for (const int end : ends_)
      if (end >= 0) close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  [[nodiscard]] int out() const { return ends_[0]; }
  [[nodiscard]] int in() const { return ends_[1]; }
  void close_in() { close(std::exchange(ends_[1], -1)); }

 private:
  std::array<int, 2> ends_{-1, -1};
};

/// What a program prints: all, or the beginning and the end.
class Kept {
 public:
  explicit Kept(std::size_t most) : most_(most) {}

  /// Takes what is in a pipe, but not all that a fast writer adds meanwhile.
  void take(int descriptor) {
    constexpr int kMostReads = 32;  // 2 MiB; a pipe holds 64 KiB, and 1 MiB at most
    std::array<char, 1 << 16> part{};
    ssize_t size = 0;
    for (int n = 0; n < kMostReads && (size = read(descriptor, part.data(), part.size())) > 0; ++n)
      add({part.data(), static_cast<std::size_t>(size)});
  }
  [[nodiscard]] std::string text() const {
    const std::size_t dropped = end_.size() > most_ ? end_.size() - most_ : 0;
    const std::size_t left_out = dropped_ + dropped;
    return begin_ + (left_out == 0 ? "" : "\n[" + std::to_string(left_out) + " bytes left out]\n") +
           end_.substr(dropped);
  }

 private:
  void add(std::string_view text) {
    const std::size_t room = most_ == 0 ? text.size() : most_ - std::min(most_, begin_.size());
    begin_ += text.substr(0, room);
    if (text.size() > room) end_ += text.substr(room);
    if (end_.size() < 4 * most_) return;
    dropped_ += end_.size() - most_;
    end_.erase(0, end_.size() - most_);
  }

  std::size_t most_, dropped_ = 0;
  std::string begin_, end_;
};

[[noreturn]] void fail_to_start(const std::string& name, const std::filesystem::path& folder,
                                int problem) {
  throw Error(name + ": cannot be started in " + folder.string() + ": " + std::strerror(problem));
}

/// A program under way: what it prints, and how it ends.
class Watched {
 public:
  explicit Watched(const CommandLimits& limits)
      : limits_(limits), out_(limits.kept_bytes), err_(limits.kept_bytes) {}

  /// Starts it; false where it cannot be, errno says why.
  [[nodiscard]] bool start(SupervisedProgram program) {
    program.out = out_pipe_.in();
    program.err = limits_.one_log ? program.out : err_pipe_.in();
    program.reports = reports_.in();
    if (limits_.server == nullptr) child_ = fork_supervisor(program);
    const bool started = limits_.server != nullptr ? limits_.server->start(program) : child_ > 0;
    for (Pipe* pipe : {&out_pipe_, &err_pipe_, &reports_}) pipe->close_in();
    return started;
  }

  /// Takes what it prints, and ends it at its limits, until it has ended.
  SupervisorReport until_it_ends(CommandOutcome& outcome) {
    constexpr int kMilliseconds = 100;
    std::array<pollfd, 3> watched{
        {{reports_.out(), POLLIN, 0}, {out_pipe_.out(), POLLIN, 0}, {err_pipe_.out(), POLLIN, 0}}};
    SupervisorReport report;
    for (bool ended = false; !ended;) {
      poll(watched.data(), watched.size(), kMilliseconds);
      take_output();
      for (std::size_t n = 1; n < watched.size(); ++n)  // closed by all: not asked any more
        if ((watched[n].revents & POLLHUP) != 0) watched[n].fd = -1;
      if (watched[0].revents != 0) ended = take_report(report);
      if (!ended) mind_limits(outcome);
    }
    take_output();
    outcome.wall_s = seconds();
    outcome.out = out_.text();
    outcome.err = err_.text();
    while (child_ > 0 && waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
    return report;
  }

 private:
  void take_output() {
    out_.take(out_pipe_.out());
    err_.take(err_pipe_.out());
  }
  /// True after the last report; where the supervisor itself was killed there is none.
  [[nodiscard]] bool take_report(SupervisorReport& report) {
    report = {};
    report.status = SIGKILL;
    if (read(reports_.out(), &report, sizeof report) != sizeof report) return true;
    if (report.begun > 0) supervisor_ = report.begun;
    return report.begun == 0;
  }
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  void mind_limits(CommandOutcome& outcome) const {
    if (supervisor_ <= 0 || outcome.timed_out || outcome.stopped) return;
    outcome.timed_out = seconds() > limits_.timeout_s;
    outcome.stopped = limits_.stop && limits_.stop();
    if (outcome.timed_out || outcome.stopped) kill(supervisor_, SIGTERM);
  }

  const CommandLimits& limits_;
  Pipe out_pipe_, err_pipe_, reports_;
  Kept out_, err_;
  pid_t child_ = -1, supervisor_ = -1;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

std::optional<std::filesystem::path> program_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto program = std::filesystem::absolute(std::filesystem::path(folder) / name);
    std::error_code none;
    if (std::filesystem::is_regular_file(program, none) && access(program.c_str(), X_OK) == 0)
      return program;
  }
  return std::nullopt;
}

CommandOutcome run_command(const std::vector<std::string>& words,
                           const std::filesystem::path& folder, const CommandLimits& limits) {
  std::filesystem::path file = words.front();
  if (words.front().find('/') == std::string::npos) {
    const auto found = program_on_path(words.front());
    if (!found) fail_to_start(words.front(), folder, ENOENT);
    file = *found;
  }
  std::vector<std::string> texts = words;
  std::vector<char*> arguments;
  for (std::string& text : texts) arguments.push_back(text.data());
  arguments.push_back(nullptr);
  Watched program(limits);
  if (!program.start({file.c_str(), arguments.data(), folder.c_str(), limits.file_bytes}))
    fail_to_start(words.front(), folder, errno);
  CommandOutcome outcome;
  const SupervisorReport report = program.until_it_ends(outcome);
  if (report.problem != 0) fail_to_start(words.front(), folder, report.problem);
  outcome.signal = WIFEXITED(report.status) ? 0 : WTERMSIG(report.status);
  outcome.exit_code = outcome.signal == 0 ? WEXITSTATUS(report.status) : 128 + outcome.signal;
  outcome.processor_s = seconds_of(report.usage.ru_utime) + seconds_of(report.usage.ru_stime);
  outcome.peak_bytes = static_cast<std::uint64_t>(report.usage.ru_maxrss) * 1024;
  return outcome;
}

}  // namespace mapscore
