// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/results/store.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// Stores to take trials over from, by the names of their folders.
using OtherStores = std::vector<std::pair<std::string, ResultStore>>;

/// The stores of the shards in a results folder. One that cannot be read, as a task leaves that is
/// killed in its first moment, is left out with a note on standard error.
[[nodiscard]] OtherStores shard_stores(const std::filesystem::path& results);

/// The stores of results folders and of the shards in them. Throws Error where a folder holds none.
[[nodiscard]] OtherStores stores_of(const std::vector<std::string>& folders);

/// Takes over trials, and why others failed. Returns how many trials.
int take_over(ResultStore& store, const ResultStore& other);

/// The same from the shards in the store's own folder, of which one that turns out unreadable is
/// left out with a note.
int take_over_shards(ResultStore& store, const std::filesystem::path& results);

/// Processor seconds of a trial, as the last sweep into a folder measured it, or the mean of its
/// shards; 0 where none did.
[[nodiscard]] double measured_seconds_per_trial(const std::filesystem::path& results);

}  // namespace mapscore::eval
