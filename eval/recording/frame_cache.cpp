// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/frame_cache.hpp"

namespace mapscore::eval {
namespace {

std::size_t bytes_of(const cv::Mat& image) {
  return image.total() * image.elemSize();
}

std::size_t bytes_of(const Frame& frame) {
  return bytes_of(frame.color) + bytes_of(frame.label) + bytes_of(frame.depth) +
         bytes_of(frame.depth_label);
}

}  // namespace

FrameCache::FrameCache(const Recording& recording, Channels channels, std::size_t max_bytes)
    : recording_(recording), channels_(channels), max_bytes_(max_bytes) {}

std::shared_ptr<const Frame> FrameCache::get(int index) {
  std::promise<FramePtr> promise;
  std::shared_future<FramePtr> others;
  {
    const std::lock_guard lock(mutex_);
    const auto [slot, first] = slots_.try_emplace(index);
    if (first) {
      by_age_.push_front(index);
      slot->second.frame = promise.get_future().share();
      slot->second.age = by_age_.begin();
    } else {
      by_age_.splice(by_age_.begin(), by_age_, slot->second.age);
      others = slot->second.frame;
    }
  }
  return others.valid() ? others.get() : decode(index, promise);
}

FrameCache::FramePtr FrameCache::decode(int index, std::promise<FramePtr>& promise) {
  try {
    auto frame = std::make_shared<const Frame>(recording_.read(index, channels_));
    keep(index, bytes_of(*frame));
    promise.set_value(frame);
    return frame;
  } catch (...) {
    forget(index);
    promise.set_exception(std::current_exception());
    throw;
  }
}

void FrameCache::keep(int index, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  ++decoded_;
  slots_.at(index).bytes = bytes;
  bytes_ += bytes;
  for (auto oldest = by_age_.end(); bytes_ > max_bytes_ && oldest != by_age_.begin();) {
    --oldest;
    const auto slot = slots_.find(*oldest);
    if (slot->second.bytes == 0) continue;  // being decoded: others wait for it
    bytes_ -= slot->second.bytes;
    slots_.erase(slot);
    oldest = by_age_.erase(oldest);
  }
}

void FrameCache::forget(int index) {
  const std::lock_guard lock(mutex_);
  const auto slot = slots_.find(index);
  by_age_.erase(slot->second.age);
  slots_.erase(slot);
}

std::size_t FrameCache::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

int FrameCache::decoded() const {
  const std::lock_guard lock(mutex_);
  return decoded_;
}

}  // namespace mapscore::eval
