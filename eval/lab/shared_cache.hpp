// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <future>
#include <list>
#include <mutex>
#include <utility>

namespace mapscore::eval {

/// Values by key. Each is made once, by the first thread that asks for it; those that ask meanwhile
/// wait for it. The latest `capacity` stay. Safe to use from several threads.
template <class Key, class Value>
class SharedCache {
 public:
  explicit SharedCache(std::size_t capacity) : capacity_(capacity) {}

  /// The value of a key, or what make() gives, called without the lock; what it throws is thrown to
  /// all that ask.
  [[nodiscard]] Value get(const Key& key, const auto& make) {
    std::promise<Value> promise;
    std::shared_future<Value> value;
    bool is_new = false;
    {
      const std::scoped_lock lock(mutex_);
      const auto found = std::ranges::find(entries_, key, &Entry::first);
      is_new = found == entries_.end();
      value = is_new ? promise.get_future().share() : found->second;
      if (is_new) entries_.emplace_front(key, value);
      if (entries_.size() > capacity_) entries_.pop_back();
    }
    if (is_new) try {
        promise.set_value(make());
      } catch (...) {
        promise.set_exception(std::current_exception());
      }
    return value.get();
  }

  /// How many are kept at present.
  [[nodiscard]] std::size_t held() {
    const std::scoped_lock lock(mutex_);
    return entries_.size();
  }

 private:
  using Entry = std::pair<Key, std::shared_future<Value>>;

  std::size_t capacity_;
  std::mutex mutex_;
  std::list<Entry> entries_;  ///< the most recently made first
};

}  // namespace mapscore::eval
