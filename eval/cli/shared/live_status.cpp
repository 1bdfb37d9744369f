// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/live_status.hpp"

#include "files/text.hpp"

#include <fmt/format.h>

#include <ctime>
#include <iostream>
#include <utility>

namespace mapscore::eval {

LiveStatus::LiveStatus(SweepStatus first, std::filesystem::path results, int frames)
    : status_(std::move(first)), results_(std::move(results)), frames_(frames) {
  if (const auto before = read_status(results_)) {
    status_.seconds_per_trial = before->seconds_per_trial;
    status_.rate_jobs = before->rate_jobs;
  }
  status_.who = this_process();
  status_.started_s = std::time(nullptr);
  write();
}

void LiveStatus::progress(std::int64_t done, std::int64_t total) {
  const std::scoped_lock lock(mutex_);
  if (done < status_.evaluations) return;  // another thread was faster to tell
  status_.evaluations = done;
  status_.evaluations_total = total;
  if (Clock::now() - written_ >= std::chrono::seconds(1)) write();
}

void LiveStatus::ended(std::size_t computed, std::size_t failed) {
  const std::scoped_lock lock(mutex_);
  status_.computed = static_cast<std::int64_t>(computed);
  status_.failed = static_cast<std::int64_t>(failed);
}

void LiveStatus::end(const char* state) {
  const std::scoped_lock lock(mutex_);
  status_.state = state;
  write();
}

void LiveStatus::write() {
  written_ = Clock::now();
  status_.updated_s = std::time(nullptr);
  status_.seconds = std::chrono::duration<double>(written_ - started_).count();
  if (status_.evaluations > 0) {
    status_.seconds_per_trial =
        status_.seconds * frames_ / static_cast<double>(status_.evaluations);
    status_.rate_jobs = status_.jobs;
  }
  write_status(status_, results_);
}

void enter_results(const char* verb, const std::filesystem::path& results, bool quiet,
                   std::optional<FolderLock>& lock) {
  lock.emplace(results, WhenTaken::go_on);
  if (!lock->taken()) return;
  const auto other = read_status(results);
  if (!quiet)
    std::cerr << fmt::format("{}: {} is in use{}; waiting until that sweep ends\n", verb,
                             shown(results), other ? " by " + shown(other->who) : "");
  lock.emplace(results);
}

}  // namespace mapscore::eval
