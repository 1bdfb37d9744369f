// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// The results of a shard that one host computed.
struct ShardFolder {
  int shard = 1, shards = 1;
  std::string host;
  std::filesystem::path folder;
};

/// RESULTS/shards/I-of-N@HOST of this host. Each host has its own, since a cluster may run a task
/// on two at once, and the locks of a network file system may not reach from one to the other.
[[nodiscard]] std::filesystem::path shard_folder(const std::filesystem::path& results, int shard,
                                                 int shards);

/// The folder of results to which a folder belongs: that of a shard's, else itself.
[[nodiscard]] std::filesystem::path whole_folder(const std::filesystem::path& results);

/// All that are there, in the order of N, I and HOST; other names are passed over.
[[nodiscard]] std::vector<ShardFolder> shard_folders(const std::filesystem::path& results);

}  // namespace mapscore::eval
