// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/sweep_status.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "files/file_bytes.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <array>

namespace mapscore::eval {
namespace {

std::filesystem::path status_file(const std::filesystem::path& results) {
  return results / "status.json";
}

/// visit(key, member) for each member of a status.
void fields_of(auto& s, auto&& visit) {
  visit("study", s.study);
  visit("who", s.who);
  visit("started_s", s.started_s);
  visit("updated_s", s.updated_s);
  visit("state", s.state);
  visit("shard", s.shard);
  visit("jobs", s.jobs);
  visit("missing", s.missing);
  visit("computed", s.computed);
  visit("failed", s.failed);
  visit("evaluations", s.evaluations);
  visit("evaluations_total", s.evaluations_total);
  visit("seconds", s.seconds);
  visit("seconds_per_trial", s.seconds_per_trial);
  visit("rate_jobs", s.rate_jobs);
}

}  // namespace

std::optional<double> SweepStatus::seconds_left() const {
  if (evaluations <= 0 || evaluations_total < evaluations) return std::nullopt;
  return seconds * static_cast<double>(evaluations_total - evaluations) /
         static_cast<double>(evaluations);
}

std::string this_process() {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) return std::to_string(getpid());
  return fmt::format("{}@{}", getpid(), host.data());
}

void write_status(const SweepStatus& status, const std::filesystem::path& results) {
  nlohmann::ordered_json object;
  fields_of(status, [&](const char* key, const auto& member) { object[key] = member; });
  write_whole_file(status_file(results),
                   object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

std::optional<SweepStatus> read_status(const std::filesystem::path& results) {
  const std::filesystem::path file = status_file(results);
  std::error_code none;
  if (!std::filesystem::exists(file, none)) return std::nullopt;
  SweepStatus status;
  try {
    const auto object = nlohmann::json::parse(read_file(file));
    fields_of(status, [&](const char* key, auto& member) { object.at(key).get_to(member); });
  } catch (const nlohmann::json::exception& error) {
    throw Error(
        fmt::format("{}: no status of a sweep ({}); remove it", file.string(), error.what()));
  }
  return status;
}

}  // namespace mapscore::eval
