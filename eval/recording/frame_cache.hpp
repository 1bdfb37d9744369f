// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/frame.hpp"
#include "eval/recording/recording.hpp"

#include <cstddef>
#include <future>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace mapscore::eval {

/// Decoded frames in memory, bounded by bytes; the frame used least recently goes first. Shared by
/// all threads: every member may be called from any. A frame that callers still hold stays alive
/// when it has left the cache, and is not counted then.
class FrameCache {
 public:
  /// Keeps its own copy of the opened recording. `max_bytes` 0 keeps nothing but frames being
  /// decoded.
  FrameCache(const Recording& recording, Channels channels, std::size_t max_bytes);

  /// The frame, decoded by the first thread that asks while others that ask for it wait. When
  /// decoding throws Error, all of them get that Error, and the next call tries anew.
  [[nodiscard]] std::shared_ptr<const Frame> get(int index);

  /// Bytes of the pixels kept, at most `max_bytes`.
  [[nodiscard]] std::size_t bytes() const;
  /// How many times a frame was decoded so far.
  [[nodiscard]] int decoded() const;

 private:
  using FramePtr = std::shared_ptr<const Frame>;
  struct Slot {
    std::shared_future<FramePtr> frame;
    std::list<int>::iterator age;  ///< place in `by_age_`
    std::size_t bytes = 0;         ///< 0 while it is being decoded
  };

  [[nodiscard]] FramePtr decode(int index, std::promise<FramePtr>& promise);
  void keep(int index, std::size_t bytes);
  void forget(int index);

  const Recording recording_;
  const Channels channels_;
  const std::size_t max_bytes_;
  mutable std::mutex mutex_;  // guards all below
  std::unordered_map<int, Slot> slots_;
  std::list<int> by_age_;  ///< most recently used first
  std::size_t bytes_ = 0;
  int decoded_ = 0;
};

}  // namespace mapscore::eval
