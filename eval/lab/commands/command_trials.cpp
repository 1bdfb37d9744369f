// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/commands/command_trials.hpp"

#include "core/error.hpp"
#include "eval/lab/commands/command_map.hpp"
#include "eval/lab/commands/command_words.hpp"
#include "eval/lab/trial_writer.hpp"
#include "files/command.hpp"
#include "files/file_bytes.hpp"
#include "files/text.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScratchName = "mapscore-scratch-";

/// What a command may write into one file.
constexpr std::uint64_t kMostFileBytes = std::uint64_t{1} << 30;
/// What is kept of the beginning and of the end of what it prints.
constexpr std::size_t kKeptBytes = 64 << 10;

/// Removes what killed sweeps left.
void remove_leftovers(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (!entry.path().filename().string().starts_with(kScratchName) ||
        !entry.is_directory(ignored) || entry.is_symlink(ignored))
      continue;
    if (const FolderLock lock(entry.path(), WhenTaken::go_on); lock.held())
      remove_tree(entry.path());
  }
}

/// Where scratch folders are made.
fs::path temporary_folder() {
  std::error_code problem;
  const fs::path folder = fs::absolute(fs::temp_directory_path(problem));
  if (problem)
    throw Error(
        fmt::format("TMPDIR: {}; set it to a folder that can be written", problem.message()));
  return folder;
}

/// A folder of this sweep alone.
fs::path new_scratch() {
  std::string folder = temporary_folder() / fmt::format("{}XXXXXX", kScratchName);
  if (mkdtemp(folder.data()) == nullptr)
    throw Error(fmt::format("{}: cannot be made ({}); set TMPDIR to a folder that can be written",
                            folder, std::strerror(errno)));
  return folder;
}

/// "; its log ends: 'LINES'", of at most so many bytes and lines.
std::string end_of(const std::string& log) {
  constexpr std::size_t kMost = 1000, kMostLines = 12;
  std::string_view rest = log;
  while (!rest.empty() && (rest.back() == '\n' || rest.back() == '\r')) rest.remove_suffix(1);
  if (rest.empty()) return "; it printed nothing";
  std::size_t first = rest.size() > kMost ? rest.size() - kMost : 0, at = rest.size();
  for (std::size_t lines = 0; lines < kMostLines && at != rest.npos && at > 0; ++lines)
    at = rest.rfind('\n', at - 1);
  if (at != rest.npos && at > 0) first = std::max(first, at + 1);
  return fmt::format("; its log ends: '{}'", shown(rest.substr(first)));
}

/// The text without the name of the scratch folder, which means nothing later.
std::string without(const std::string& folder, std::string text) {
  for (std::size_t at = 0; (at = text.find(folder, at)) != text.npos;)
    text.erase(at, folder.size());
  return text;
}

std::string how_it_ended(const CommandOutcome& outcome, double timeout_s) {
  if (outcome.timed_out) return fmt::format("the command took longer than {} s", timeout_s);
  if (outcome.signal != 0)
    return fmt::format("the command was ended by signal {} ({})", outcome.signal,
                       strsignal(outcome.signal));
  return fmt::format("the command ended with exit code {}", outcome.exit_code);
}

}  // namespace

CommandTrials::CommandTrials(Bench& bench, std::function<bool()> stop)
    : bench_(bench), stop_(std::move(stop)) {
  remove_leftovers(temporary_folder());
  do {  // again where another sweep has just taken it for a leftover
    scratch_ = new_scratch();
    hold_.emplace(scratch_, WhenTaken::go_on);
  } while (hold_->taken());
}

CommandTrials::~CommandTrials() {
  remove_tree(scratch_);
}

std::unique_ptr<CommandTrials::Workplace> CommandTrials::take_workplace() {
  const std::lock_guard lock(mutex_);
  if (free_.empty())
    return std::make_unique<Workplace>(Workplace{scratch_ / std::to_string(++workplaces_)});
  std::unique_ptr<Workplace> workplace = std::move(free_.back());
  free_.pop_back();
  return workplace;
}

void CommandTrials::give_back(std::unique_ptr<Workplace> workplace) {
  const std::lock_guard lock(mutex_);
  free_.push_back(std::move(workplace));
}

std::optional<TrialResult> CommandTrials::run(const Task& task, std::optional<TrialCost>& cost) {
  std::unique_ptr<Workplace> workplace = take_workplace();
  std::optional<TrialResult> result;
  std::exception_ptr failure;
  try {
    result = run_in(*workplace, task, cost);
  } catch (...) {
    failure = std::current_exception();
  }
  remove_tree(workplace->folder / "work");
  give_back(std::move(workplace));
  if (failure) std::rethrow_exception(failure);
  return result;
}

void CommandTrials::count_labels(TrialRun& trial) {
  for (int index = 0; index < bench_.recording().frame_count(); ++index) {
    const auto frame = bench_.frame(index, trial.depth_of(index));
    trial.count_labels(*frame, trial.sights()->of(*frame));
  }
}

std::optional<TrialResult> CommandTrials::run_in(Workplace& workplace, const Task& task,
                                                 std::optional<TrialCost>& cost) {
  const CommandMethod& method = *task.config.methods.front().command;
  const std::vector<std::string> words = command_words(task.config);
  const std::unique_ptr<TrialRun> trial = bench_.start(task);
  const fs::path work = workplace.folder / "work", given = work / "trial", map = work / method.map;
  if (!workplace.images) {
    remove_tree(workplace.folder / "images");  // what a full disk left of it
    workplace.images.emplace(bench_.recording(), workplace.folder / "images");
  }
  remove_tree(work);
  make_folder(given);
  write_trial(
      {task, bench_.recording(), *trial->sights(), trial->beliefs(), workplace.images->folder(),
       [&](int index, int depth_index) { return bench_.frame(index, depth_index); }},
      given);
  const CommandOutcome outcome =
      run_command(filled_words(words, given, map, method.threads), work,
                  {method.timeout_s, kMostFileBytes, kKeptBytes, true, &server_, stop_});
  if (outcome.stopped) return std::nullopt;
  cost = TrialCost{outcome.exit_code, outcome.wall_s, outcome.processor_s, outcome.peak_bytes};
  try {
    if (const auto changed = workplace.images->changed()) {
      workplace.images.reset();
      throw Error(fmt::format("the command changed its input {}", *changed));
    }
    if (outcome.timed_out || outcome.exit_code != 0)
      throw Error(how_it_ended(outcome, method.timeout_s));
    if (task.config.score.asked.labels) count_labels(*trial);
    return trial->judge(
        read_command_map(map, bench_.table(), task.config.voxel_m, trial->truth().surface));
  } catch (const std::bad_alloc&) {
    throw Error("its map takes more memory than there is" + end_of(outcome.out));
  } catch (const Error& error) {
    throw Error(without(work.string() + '/', shown(error.what())) + end_of(outcome.out));
  }
}

}  // namespace mapscore::eval
