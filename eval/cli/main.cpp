// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/fusion/plugged_rule.hpp"
#include "core/segmentation/plugged_segmentation.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/results/build_identity.hpp"
#include "files/suggestion.hpp"
#include "files/text.hpp"

#include <malloc.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <streambuf>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

constexpr int kWrongInput = 2;

/// Lets the process keep up to 128 MB that it has freed. The images of a frame are freed with it,
/// and the system would take seconds a thousand frames to give the same memory for the next one.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 128 << 20);
}

/// While it exists, escapes all that a stream prints by shown_lines(), so that names from
/// strangers' files cannot control the terminal. One thread at a time.
class TerminalGuard : public std::streambuf {
 public:
  explicit TerminalGuard(std::ostream& stream) : stream_(stream), inner_(stream.rdbuf(this)) {}
  ~TerminalGuard() override {
    hand_on(pending_.size());
    stream_.rdbuf(inner_);
  }
  TerminalGuard(const TerminalGuard&) = delete;
  TerminalGuard& operator=(const TerminalGuard&) = delete;

 protected:
  int_type overflow(int_type letter) override {
    if (traits_type::eq_int_type(letter, traits_type::eof())) return traits_type::not_eof(letter);
    const char byte = traits_type::to_char_type(letter);
    return xsputn(&byte, 1) == 1 ? letter : traits_type::eof();
  }
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    pending_.append(bytes, static_cast<std::size_t>(count));
    return hand_on(pending_.size() - mapscore::unfinished_tail(pending_)) ? count : 0;
  }
  int sync() override { return inner_->pubsync(); }

 private:
  /// Passes on the first `bytes` of the pending text, escaped; false when the stream fails.
  bool hand_on(std::size_t bytes) {
    const std::string text = mapscore::shown_lines(std::string_view(pending_).substr(0, bytes));
    pending_.erase(0, bytes);
    const auto size = static_cast<std::streamsize>(text.size());
    return inner_->sputn(text.data(), size) == size;
  }

  std::ostream& stream_;
  std::streambuf* inner_;
  std::string pending_;
};

int complain(const std::string& message) {
  std::cerr << "mapscore: " << mapscore::shown(message) << '\n';
  return kWrongInput;
}

/// CLI11 would only say that a verb is missing.
void refuse_unknown_verb(const CLI::App& program, const std::vector<std::string>& words) {
  if (words.empty() || words.front().starts_with('-')) return;
  std::vector<std::string> verbs;
  for (const CLI::App* verb : program.get_subcommands({})) verbs.push_back(verb->get_name());
  if (std::ranges::find(verbs, words.front()) != verbs.end()) return;
  throw mapscore::Error("no verb '" + words.front() + "'; " +
                        mapscore::suggestion(words.front(), verbs));
}

/// An unset variable of a shell would otherwise pass for a flag that was not given.
void refuse_empty_values(const std::vector<std::string>& words) {
  for (std::size_t n = 0; n < words.size(); ++n) {
    const std::string& word = words[n];
    if (word.empty())
      throw mapscore::Error("an empty value after '" + (n > 0 ? words[n - 1] : "mapscore") +
                            "'; give one, or leave the flag out");
    if (word.starts_with("--") && word.find('=') == word.size() - 1)
      throw mapscore::Error(word + ": has no value; give one, or leave the flag out");
  }
}

/// The words after the program's name; `help VERB` as `VERB --help`, and the hyphens within a
/// flag's name as the underscores that ours have. What follows a bare `--` is for another program.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  for (std::string& word : words) {
    if (word == "--") break;
    if (!word.starts_with("--")) continue;
    const auto end =
        word.begin() + static_cast<std::ptrdiff_t>(std::min(word.find('='), word.size()));
    std::replace(word.begin() + 2, end, '-', '_');
  }
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    words.insert(words.begin() + (words.empty() ? 0 : 1), "--help");
  }
  return words;
}

std::string version() {
  std::string text = std::string("mapscore ") + MAPSCORE_VERSION + ", build " +
                     std::string(mapscore::eval::build_identity());
  for (const std::string_view kind :
       {mapscore::PluggedSegmentation::kKind, mapscore::PluggedRule::kKind})
    if (!kind.empty()) text += ", with " + std::string(kind);
  return text;
}

int run(CLI::App& program, int argc, char** argv) {
  mapscore::PluggedSegmentation::check("segmentation");
  mapscore::PluggedRule::check("fusion");
  int exit_code = 0;
  mapscore::eval::add_verbs(program, exit_code);
  std::vector<std::string> words = words_of(argc, argv);
  refuse_unknown_verb(program, words);
  refuse_empty_values(words);
  std::ranges::reverse(words);  // as CLI11 takes them
  program.name(argc > 0 ? argv[0] : "mapscore");
  program.parse(std::move(words));
  std::cout.flush();
  return std::cout ? exit_code : complain("standard output cannot be written; is the disk full?");
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  std::signal(SIGXFSZ, SIG_IGN);  // a file at its limit is then an error of writing, with a line
  const TerminalGuard guarded_output(std::cout), guarded_errors(std::cerr);
  CLI::App program(
      "How good is a semantic 3D map, and how much calibration and localisation error can it "
      "take?");
  program.require_subcommand(1);
  program.set_version_flag("--version", version());
  program.footer(
      "Examples:\n"
      "  mapscore sweep configs/demo.yaml -o results/demo     all trials of a study\n"
      "  mapscore table results/demo                          their scores\n"
      "  mapscore figures results/demo                        their figures and pictures\n"
      "`mapscore help VERB` tells more. Exit codes: 0 done, 1 the answer is no or trials failed,\n"
      "2 wrong input, 3 nothing could be compared.");
  try {
    return run(program, argc, argv);
  } catch (const CLI::Success& request) {
    return program.exit(request);
  } catch (const CLI::ParseError& error) {
    return complain(std::string(error.what()) + "; see `mapscore --help`");
  } catch (const mapscore::Error& error) {
    return complain(error.what());
  } catch (const mapscore::eval::StoppedRecording& stopped) {
    complain(stopped.what());
    return 128 + stopped.signal;
  } catch (const std::filesystem::filesystem_error& error) {
    return complain(error.path1().string() + ": " + error.code().message() +
                    "; give another place, or mend its permissions");
  } catch (const std::bad_alloc&) {
    return complain(
        "out of memory: what was read takes more than there is; give a smaller file, scene or "
        "study, or larger voxels");
  } catch (const std::exception& error) {
    return complain(error.what());
  }
}
