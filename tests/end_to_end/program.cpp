// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;

fs::path temporary_file() {
  std::string name = fs::temp_directory_path() / ("mapscore_output_" + std::string(6, 'X'));
  const int file = mkstemp(name.data());
  if (file < 0) throw std::runtime_error(name + ": cannot be created");
  close(file);
  return name;
}

void redirect(const fs::path& file, int descriptor) {
  const int opened = open(file.c_str(), O_WRONLY | O_TRUNC);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
}

/// A write beyond the limit then fails with EFBIG, because its signal is ignored, also after exec.
void limit_file_size(std::size_t bytes) {
  const rlimit limit{bytes, bytes};
  if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(126);
  std::signal(SIGXFSZ, SIG_IGN);
}

[[noreturn]] void become(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& argument : command)
    arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  execv(arguments.front(), arguments.data());
  _exit(127);
}

std::string taken_from(const fs::path& file) {
  std::string text = bytes_of(file);
  fs::remove(file);
  return text;
}

}  // namespace

Process::Process(const std::vector<std::string>& command, const Surroundings& surroundings)
    : out_(temporary_file()), err_(temporary_file()) {
  const fs::path out = surroundings.standard_output.empty() ? out_ : surroundings.standard_output;
  id_ = fork();
  if (id_ < 0) throw std::runtime_error("fork failed");
  if (id_ > 0) return;
  redirect(out, STDOUT_FILENO);
  redirect(err_, STDERR_FILENO);
  if (surroundings.file_size_limit) limit_file_size(*surroundings.file_size_limit);
  become(command);
}

Process::~Process() {
  if (!reaped_) kill();
  fs::remove(out_);
  fs::remove(err_);
}

bool Process::kill() {
  if (ended()) return false;
  ::kill(id_, SIGKILL);
  waitpid(id_, &status_, 0);
  reaped_ = true;
  return WIFSIGNALED(status_);
}

void Process::interrupt() {
  if (!ended()) ::kill(id_, SIGINT);
}

bool Process::ended() {
  if (!reaped_) reaped_ = waitpid(id_, &status_, WNOHANG) == id_;
  return reaped_;
}

Outcome Process::wait() {
  if (!reaped_) waitpid(id_, &status_, 0);
  reaped_ = true;
  return {WIFEXITED(status_) ? WEXITSTATUS(status_) : -1, taken_from(out_), taken_from(err_)};
}

Outcome mapscore(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
  return Process(mapscore_command(arguments), surroundings).wait();
}

std::vector<std::string> mapscore_command(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{MAPSCORE_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

void expect_done(const Outcome& outcome) {
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

void expect_refused(const Outcome& outcome, const std::vector<std::string>& parts) {
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  for (const std::string& part : parts) EXPECT_THAT(outcome.err, ::testing::HasSubstr(part));
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

std::vector<std::string> contents_of(const fs::path& folder) {
  std::vector<std::string> names;
  if (!fs::exists(folder)) return names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.push_back(entry.path().lexically_relative(folder).string());
  std::ranges::sort(names);
  return names;
}

}  // namespace mapscore::testing
