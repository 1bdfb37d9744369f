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

std::shared_ptr<const Frame> FrameCache::get(int index, int depth_index) {
  const SidePtr color = side({Side::color, index}), depth = side({Side::depth, depth_index});
  auto frame = std::make_shared<Frame>(*depth);
  frame->index = index;
  frame->color = color->color;
  frame->label = color->label;
  return frame;
}

FrameCache::SidePtr FrameCache::side(const Key& key) {
  std::promise<SidePtr> promise;
  std::shared_future<SidePtr> others;
  {
    const std::lock_guard lock(mutex_);
    const auto [slot, first] = slots_.try_emplace(key);
    if (first) {
      by_age_.push_front(key);
      slot->second.side = promise.get_future().share();
      slot->second.age = by_age_.begin();
    } else {
      by_age_.splice(by_age_.begin(), by_age_, slot->second.age);
      others = slot->second.side;
    }
  }
  return others.valid() ? others.get() : decode(key, promise);
}

FrameCache::SidePtr FrameCache::decode(const Key& key, std::promise<SidePtr>& promise) {
  try {
    Frame frame;
    if (key.first == Side::color)
      recording_.read_color(key.second, channels_, frame);
    else
      recording_.read_depth(key.second, channels_, frame);
    auto decoded = std::make_shared<const Frame>(std::move(frame));
    keep(key, bytes_of(*decoded));
    promise.set_value(decoded);
    return decoded;
  } catch (...) {
    forget(key);
    promise.set_exception(std::current_exception());
    throw;
  }
}

void FrameCache::keep(const Key& key, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  ++decoded_;
  Slot& kept = slots_.at(key);
  kept.is_decoded = true;
  kept.bytes = bytes;
  bytes_ += bytes;
  for (auto oldest = by_age_.end(); bytes_ > max_bytes_ && oldest != by_age_.begin();) {
    --oldest;
    const auto slot = slots_.find(*oldest);
    if (!slot->second.is_decoded) continue;  // others wait for it
    bytes_ -= slot->second.bytes;
    slots_.erase(slot);
    oldest = by_age_.erase(oldest);
  }
}

void FrameCache::forget(const Key& key) {
  const std::lock_guard lock(mutex_);
  const auto slot = slots_.find(key);
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
