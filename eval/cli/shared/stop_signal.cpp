// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/stop_signal.hpp"

#include <atomic>
#include <csignal>

namespace mapscore::eval {
namespace {

std::atomic<int> taken_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

}  // namespace

StopSignal::StopSignal() {
  taken_signal = 0;
  struct sigaction action {};
  action.sa_handler = [](int signal) { taken_signal = signal; };
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

StopSignal::~StopSignal() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
}

int StopSignal::taken() const {
  return taken_signal;
}

}  // namespace mapscore::eval
