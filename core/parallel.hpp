// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <vector>

namespace mapscore {

/// Calls `work(job)` for job 0 .. jobs - 1 at the same time, job 0 on the calling thread, and waits
/// for all. An exception of a job is passed on, of several that of the lowest. `jobs` below 1
/// counts as 1.
template <class Work>
void run_jobs(int jobs, const Work& work) {
  std::vector<std::future<void>> helpers;
  for (int job = 1; job < jobs; ++job) {
    helpers.push_back(std::async(std::launch::async, [&work, job] { work(job); }));
  }
  work(0);
  for (std::future<void>& helper : helpers) helper.get();
}

/// 0 .. count - 1 in runs of `size`, each handed out once; for jobs that take the next run when
/// they are done with one. Thread-safe.
class Runs {
 public:
  struct Run {
    std::size_t first, last;  ///< without `last`
  };

  Runs(std::size_t count, std::size_t size) : count_(count), size_(size) {}

  /// False when none is left.
  [[nodiscard]] bool next(Run& run) {
    const std::size_t first = next_.fetch_add(size_);
    run = {std::min(first, count_), std::min(first + size_, count_)};
    return first < count_;
  }

  /// Leaves nothing to hand out.
  void stop() { next_ = count_; }

 private:
  std::size_t count_, size_;
  std::atomic<std::size_t> next_{0};
};

/// Calls `work(i)` for i in 0 .. count - 1 from up to `jobs` threads, each taking the next that is
/// left. An exception lets the others end with what they have taken, and is passed on.
template <class Work>
void for_each_in_parallel(std::size_t count, int jobs, const Work& work) {
  Runs items(count, 1);
  run_jobs(static_cast<int>(std::min(count, static_cast<std::size_t>(std::max(1, jobs)))),
           [&](int) {
             try {
               for (Runs::Run item; items.next(item);) work(item.first);
             } catch (...) {
               items.stop();
               throw;
             }
           });
}

}  // namespace mapscore
