// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/frame.hpp"
#include "eval/recording/recording.hpp"

#include <cstddef>
#include <future>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace mapscore::eval {

/// Decoded images in memory, bounded by bytes; those used least recently go first. A frame's colour
/// side (color, label) and depth side (depth, depth_label) are kept apart, since time offsets pair
/// them anew. Shared by all threads: every member may be called from any. Images that callers still
/// hold stay alive when they have left the cache, and are not counted then.
class FrameCache {
 public:
  /// Keeps its own copy of the opened recording. `max_bytes` 0 keeps nothing but frames being
  /// decoded.
  FrameCache(const Recording& recording, Channels channels, std::size_t max_bytes);

  /// The frame with the depth image that belongs to it, or with another. Its images share their
  /// pixels with the cache. Each side is decoded by the first thread that asks while others that
  /// ask for it wait. When decoding throws Error, all of them get that Error, and the next call
  /// tries anew.
  [[nodiscard]] std::shared_ptr<const Frame> get(int index) {
    return get(index, recording_.depth_of(index));
  }
  [[nodiscard]] std::shared_ptr<const Frame> get(int index, int depth_index);

  /// The depth side alone: depth, depth_label, stamp and pose.
  [[nodiscard]] std::shared_ptr<const Frame> get_depth(int depth_index) {
    return side({Side::depth, depth_index});
  }

  /// Bytes of the pixels kept, at most `max_bytes`.
  [[nodiscard]] std::size_t bytes() const;
  /// How many times a side was decoded so far.
  [[nodiscard]] int decoded() const;

 private:
  enum class Side { color, depth };
  using Key = std::pair<Side, int>;  ///< and the index of its image
  /// A frame of which one side is there.
  using SidePtr = std::shared_ptr<const Frame>;
  struct Slot {
    std::shared_future<SidePtr> side;
    std::list<Key>::iterator age;  ///< place in `by_age_`
    bool is_decoded = false;
    std::size_t bytes = 0;
  };

  [[nodiscard]] SidePtr side(const Key& key);
  [[nodiscard]] SidePtr decode(const Key& key, std::promise<SidePtr>& promise);
  void keep(const Key& key, std::size_t bytes);
  void forget(const Key& key);

  const Recording recording_;
  const Channels channels_;
  const std::size_t max_bytes_;
  mutable std::mutex mutex_;  // guards all below
  std::map<Key, Slot> slots_;
  std::list<Key> by_age_;  ///< most recently used first
  std::size_t bytes_ = 0;
  int decoded_ = 0;
};

}  // namespace mapscore::eval
