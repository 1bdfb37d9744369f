// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/shard_stores.hpp"

#include "core/error.hpp"
#include "eval/report/summary.hpp"
#include "eval/results/shards.hpp"
#include "eval/results/sweep_status.hpp"
#include "files/text.hpp"

#include <algorithm>
#include <iostream>
#include <iterator>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

void note_left_out(const Error& error) {
  std::cerr << "sweep: note: left out: " << error.what() << '\n';
}

}  // namespace

OtherStores shard_stores(const fs::path& results) {
  OtherStores stores;
  for (const ShardFolder& shard : shard_folders(results)) try {
      stores.emplace_back(shown(shard.folder),
                          ResultStore::open_existing(store_file(shard.folder)));
    } catch (const Error& error) {
      note_left_out(error);
    }
  return stores;
}

OtherStores stores_of(const std::vector<std::string>& folders) {
  OtherStores stores;
  for (const fs::path folder : folders) {
    OtherStores shards = shard_stores(folder);
    if (shards.empty() || fs::exists(store_file(folder)))
      stores.emplace_back(shown(folder), ResultStore::open_existing(store_file(folder)));
    std::ranges::move(shards, std::back_inserter(stores));
  }
  return stores;
}

int take_over(ResultStore& store, const ResultStore& other) {
  const int taken = store.merge(other);
  const auto costs = store.costs();
  for (const auto& [key, cost] : other.costs())
    if (!costs.contains(key)) store.add_cost(key, cost);
  const auto failures = other.failures();
  if (failures.empty()) return taken;
  const auto held = store.keys();
  for (const auto& [key, reason] : failures)
    if (!held.contains(key)) store.add_failure(key, reason);
  return taken;
}

int take_over_shards(ResultStore& store, const fs::path& results) {
  int taken = 0;
  for (const auto& [name, other] : shard_stores(results)) try {
      taken += take_over(store, other);
    } catch (const Error& error) {
      note_left_out(error);
    }
  return taken;
}

double measured_seconds_per_trial(const fs::path& results) {
  const auto seconds_of = [](const fs::path& folder) {
    const auto status = read_status(folder);
    return status ? status->seconds_per_trial * status->rate_jobs : 0.0;
  };
  if (const double seconds = seconds_of(results); seconds > 0) return seconds;
  double sum = 0;
  int measured = 0;
  for (const ShardFolder& shard : shard_folders(results))
    if (const double seconds = seconds_of(shard.folder); seconds > 0) {
      sum += seconds;
      ++measured;
    }
  return measured > 0 ? sum / measured : 0.0;
}

}  // namespace mapscore::eval
