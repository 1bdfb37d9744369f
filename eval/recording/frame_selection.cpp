// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/frame_selection.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <iterator>

namespace mapscore::eval {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t at = text.find(separator); at != std::string_view::npos;
       at = text.find(separator)) {
    parts.push_back(text.substr(0, at));
    text.remove_prefix(at + 1);
  }
  parts.push_back(text);
  return parts;
}

[[noreturn]] void refuse_slice(std::string_view text) {
  throw Error(fmt::format(
      "frames: '{}' is neither a frame nor a slice first:end:step of whole numbers from "
      "0, the step from 1; write e.g. 3,7,9 or 0:50:2",
      text));
}

/// The whole number, 0 or more, that is all of `part`; `slice` is what it stands in.
int number_of(std::string_view part, std::string_view slice) {
  int number = -1;
  const char* end = part.data() + part.size();
  const auto [stop, failure] = std::from_chars(part.data(), end, number);
  if (failure != std::errc() || stop != end || number < 0) refuse_slice(slice);
  return number;
}

}  // namespace

FrameSelection::FrameSelection(std::string_view text) {
  for (const std::string_view part : split(text, ',')) slices_.push_back(slice_of(part));
}

FrameSelection::Slice FrameSelection::slice_of(std::string_view text) {
  const std::vector<std::string_view> parts = split(text, ':');
  Slice slice;
  slice.text = text;
  if (parts.size() > 3) refuse_slice(text);
  if (parts.size() == 1 || !parts[0].empty()) slice.first = number_of(parts[0], text);
  if (parts.size() == 1) {
    slice.end = slice.first + 1;
    return slice;
  }
  if (!parts[1].empty()) slice.end = number_of(parts[1], text);
  if (parts.size() == 3 && !parts[2].empty()) slice.step = number_of(parts[2], text);
  if (slice.step < 1) refuse_slice(text);
  return slice;
}

std::vector<int> FrameSelection::of(int frame_count) const {
  std::vector<bool> selected(static_cast<std::size_t>(frame_count), all());
  for (const Slice& slice : slices_) {
    const std::int64_t end = slice.end.value_or(frame_count);
    if (slice.first >= frame_count || end > frame_count) {
      throw Error(
          fmt::format("frames: '{}' goes beyond the recording, which has {} frames, 0 to {}",
                      slice.text, frame_count, frame_count - 1));
    }
    for (std::int64_t frame = slice.first; frame < end; frame += slice.step) {
      selected[static_cast<std::size_t>(frame)] = true;
    }
  }
  std::vector<int> frames;
  for (int frame = 0; frame < frame_count; ++frame) {
    if (selected[static_cast<std::size_t>(frame)]) frames.push_back(frame);
  }
  if (frames.empty()) {
    throw Error(
        fmt::format("frames: none is selected of the {} of the recording; 'end' is not in "
                    "a slice, write e.g. 3:4",
                    frame_count));
  }
  return frames;
}

std::vector<int> spread_over(const std::vector<int>& frames, int most,
                             const std::function<bool(int)>& is_fit) {
  const std::size_t places = std::bit_ceil(frames.size());
  std::vector<int> chosen;
  std::size_t at = 0;
  for (std::size_t n = 0; n < places && std::ssize(chosen) < most; ++n) {
    if (at < frames.size() && is_fit(frames[at])) chosen.push_back(frames[at]);
    std::size_t bit = places / 2;  // the next number, its bits from the left
    for (; bit > 0 && (at & bit) != 0; bit /= 2) at ^= bit;
    at |= bit;
  }
  std::ranges::sort(chosen);
  return chosen;
}

}  // namespace mapscore::eval
