// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/shards.hpp"

#include "eval/results/sweep_status.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <system_error>
#include <tuple>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// The name of this host as part of a file's.
std::string host_name() {
  std::string who = this_process();
  who.erase(0, who.find('@') + 1);
  for (char& letter : who)
    if (!is_word({&letter, 1}, "-._")) letter = '_';
  return who;
}

}  // namespace

fs::path shard_folder(const fs::path& results, int shard, int shards) {
  return results / "shards" / fmt::format("{}-of-{}@{}", shard, shards, host_name());
}

fs::path whole_folder(const fs::path& results) {
  const fs::path folder = fs::absolute(results / "").lexically_normal().parent_path();
  return folder.parent_path().filename() == "shards" ? folder.parent_path().parent_path() : results;
}

std::vector<ShardFolder> shard_folders(const fs::path& results) {
  std::vector<ShardFolder> found;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(results / "shards", none)) {
    ShardFolder shard;
    int read = 0;
    const std::string name = entry.path().filename();
    if (std::sscanf(name.c_str(), "%9d-of-%9d@%n", &shard.shard, &shard.shards, &read) != 2 ||
        read == 0 || shard.shard < 1 || shard.shard > shard.shards)
      continue;
    shard.host = name.substr(static_cast<std::size_t>(read));
    shard.folder = entry.path();
    found.push_back(std::move(shard));
  }
  std::ranges::sort(found, {},
                    [](const ShardFolder& of) { return std::tie(of.shards, of.shard, of.host); });
  return found;
}

}  // namespace mapscore::eval
