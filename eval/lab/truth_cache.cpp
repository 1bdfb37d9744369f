// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/truth_cache.hpp"

#include "eval/lab/lattice_truth.hpp"
#include "eval/score/reduced_tables.hpp"

#include <algorithm>
#include <exception>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr int kOneJob = 1;  // the threads that ask are the parallelism

/// The entry of `list` that `fits`, or a new one at its front that `make` fills without the lock;
/// those that ask meanwhile wait for it. At most `capacity` entries stay.
template <class Entry, class Value>
Value found_or_made(std::mutex& mutex, std::list<Entry>& list, std::size_t capacity,
                    std::shared_future<Value> Entry::*member, Entry entry, const auto& fits,
                    const auto& make) {
  std::promise<Value> promise;
  entry.*member = promise.get_future().share();
  {
    std::unique_lock lock(mutex);
    const auto found = std::find_if(list.begin(), list.end(), fits);
    if (found != list.end()) {
      const std::shared_future<Value> value = (*found).*member;
      lock.unlock();
      return value.get();
    }
    list.push_front(entry);
    if (list.size() > capacity) list.pop_back();
  }
  try {
    promise.set_value(make());
  } catch (...) {
    promise.set_exception(std::current_exception());
  }
  return (entry.*member).get();
}

}  // namespace

TruthCache::TruthCache(const Recording& recording, const ClassTable& table, FrameCache& frames,
                       std::size_t capacity)
    : recording_(recording),
      instance_table_(instance_table(table)),
      frames_(frames),
      capacity_(capacity),
      classes_{table},
      instances_{instance_table_},
      boxes_(recording) {}

TruthCache::Truth TruthCache::get(const MapFrame& map_frame, const TruthOptions& options) {
  return get(classes_, classes_.maps, capacity_, map_frame, options);
}

TruthCache::Truth TruthCache::of_instances(const MapFrame& map_frame, TruthOptions options) {
  options.distances = false;
  return get(instances_, instances_.maps, capacity_, map_frame, options);
}

TruthCache::Truth TruthCache::of_frame(const MapFrame& map_frame, TruthOptions options,
                                       int depth_image) {
  return get(classes_, classes_.frames, capacity_ * kFramesOfLattice, map_frame,
             at_image(std::move(options), depth_image));
}

TruthCache::Truth TruthCache::of_frame_instances(const MapFrame& map_frame, TruthOptions options,
                                                 int depth_image) {
  options.distances = false;
  return get(instances_, instances_.frames, capacity_ * kFramesOfLattice, map_frame,
             at_image(std::move(options), depth_image));
}

TruthOptions TruthCache::at_image(TruthOptions options, int depth_image) const {
  options.at_s = recording_.depth_stamp_s(depth_image);
  options.depth_image = depth_image;
  return options;
}

TruthCache::Truth TruthCache::get(Shelf& shelf, std::list<Shelf::OfView>& truths,
                                  std::size_t capacity, const MapFrame& map_frame,
                                  const TruthOptions& options) {
  const auto fits = [&](const Shelf::OfView& entry) {
    return entry.map_frame == map_frame && entry.options == options;
  };
  return found_or_made(mutex_, truths, capacity, &Shelf::OfView::truth,
                       Shelf::OfView{map_frame, options, {}}, fits, [&]() -> Truth {
                         LatticeTruth truth;
                         SurfacesAt at =
                             surfaces(shelf, map_frame, options.epsilon_m)->at(options.at_s);
                         truth.surface = std::move(at.surface);
                         truth.distance_to_class = std::move(at.distance_to_class);
                         truth.distance_to_thin = std::move(at.distance_to_thin);
                         truth.view = make_view(recording_, shelf.table, frames_, map_frame,
                                                options, truth.surface, kOneJob);
                         return std::make_shared<const LatticeTruth>(std::move(truth));
                       });
}

TruthCache::Surfaces TruthCache::surfaces(Shelf& shelf, const MapFrame& map_frame,
                                          double epsilon_m) {
  const auto fits = [&](const Shelf::OfLattice& entry) {
    return entry.map_frame == map_frame && entry.epsilon_m == epsilon_m;
  };
  return found_or_made(mutex_, shelf.surfaces, std::max(capacity_, kLeastLattices),
                       &Shelf::OfLattice::surfaces, Shelf::OfLattice{map_frame, epsilon_m, {}},
                       fits, [&]() -> Surfaces {
                         return std::make_shared<const RecordedSurfaces>(
                             shapes(), shelf.table, map_frame, epsilon_m, kOneJob);
                       });
}

const RecordedShapes& TruthCache::shapes() {
  std::call_once(shapes_read_, [this] { shapes_ = shapes_of(recording_); });
  return shapes_;
}

}  // namespace mapscore::eval
