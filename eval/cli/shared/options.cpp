// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/options.hpp"

#include "core/error.hpp"
#include "eval/report/tables/table_formats.hpp"
#include "eval/study/picture_view.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace mapscore::eval {
namespace {

/// Letters in a line of the terminal that standard output is: COLUMNS, or else what the terminal
/// says; 0: it is none.
std::size_t terminal_width() {
  constexpr std::size_t kNarrowest = 20;
  if (isatty(STDOUT_FILENO) == 0) return 0;
  winsize size{};
  std::size_t width = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
  if (const char* columns = std::getenv("COLUMNS"))
    if (const auto told = parse_whole(columns); told && *told > 0)
      width = static_cast<std::size_t>(*told);
  return width == 0 ? 0 : std::max(width, kNarrowest);
}

}  // namespace

void StudyFlags::add_to(CLI::App& verb, const char* shown_as, const char* help) {
  verb.add_option("STUDY", file, help)->required()->option_text(shown_as);
  verb.add_option(
          "--set", overrides,
          "Override a key, by its path or the end of it where one alone ends so: --set "
          "faults.pose.sigma_xy_m=0.02; a relative path counts from the study's folder; may be "
          "repeated")
      ->allow_extra_args(false);
  verb.add_option("-o,--output", results, "Folder of the results [results/NAME]");
}

CLI::Validator finite_within(double low, double high) {
  return CLI::Validator(
      [low, high](const std::string& text) {
        double value = 0.0;
        const bool fits = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
        return fits ? std::string()
                    : fmt::format("{}: must be a number from {} to {}", text, low, high);
      },
      fmt::format("in [{} - {}]", low, high));
}

void add_memory_flag(CLI::App& verb, std::size_t& bytes) {
  const auto refuse_negative = [](const std::string& text) {
    return text.rfind('-', 0) == 0 ? text + ": must not be negative, e.g. 512MB" : std::string();
  };
  verb.add_option("--memory", bytes, "Decoded frames held at once, e.g. 512MB [1GiB]")
      ->transform(CLI::AsSizeValue(false))
      ->transform(CLI::Validator(refuse_negative, ""));  // the later one looks first
}

void WorkFlags::add_to(CLI::App& verb) {
  add_without_memory_to(verb);
  add_memory_flag(verb, memory_bytes);
}

void WorkFlags::add_without_memory_to(CLI::App& verb) {
  verb.add_option("-j,--jobs", jobs, "Worker threads [all cores]; never changes a result")
      ->check(CLI::Range(1, 1024));
  verb.add_flag("-q,--quiet", quiet, "No progress on standard error");
}

void ViewFlag::add_to(CLI::App& verb) {
  verb.add_option("--view", numbers,
                  "Draw pictures from an eye towards a target (world, metres), and with a vertical "
                  "field of view in degrees [an overview, and where most errors are]")
      ->expected(6, 7)
      ->type_name("EX EY EZ TX TY TZ [VFOV]");
}

std::optional<sim::View> ViewFlag::view() const {
  if (numbers.empty()) return std::nullopt;
  try {
    return view_of_numbers(numbers);
  } catch (const Error& error) {
    throw Error(std::string("--view: ") + error.what());
  }
}

void add_format_flag(CLI::App& verb, std::string& format, const std::vector<std::string>& formats) {
  verb.add_option("--format", format, fmt::format("{} [{}]", fmt::join(formats, ", "), format))
      ->check(CLI::IsMember(formats));
}

CLI::Option* add_list(CLI::App& verb, const char* flag, std::vector<std::string>& names,
                      const std::string& help) {
  const auto take = [&names](const std::vector<std::string>& pieces) {
    std::string name;
    for (const std::string& piece : pieces) {
      name += piece;
      if (name.ends_with('\\')) {
        name.back() = ',';
      } else {
        if (std::ranges::count(names, name) == 0) names.push_back(name);
        name.clear();
      }
    }
    if (!name.empty()) names.push_back(name);
  };
  return verb.add_option_function<std::vector<std::string>>(flag, take, help)
      ->delimiter(',')
      ->allow_extra_args(false);
}

void add_interim_flag(CLI::App& verb, bool& interim) {
  verb.add_flag("--interim", interim,
                "Take an unfinished sweep: of each line the seeds that are there, marked INTERIM");
}

Reader reader_of(const std::string& format) {
  if (format == "csv" || format == "json") return Reader::program;
  return format == "text" ? Reader::terminal : Reader::paper;
}

std::string formatted(const Table& table, const std::string& format) {
  if (format == "csv") return to_csv(table);
  if (format == "markdown") return to_markdown(table);
  if (format == "tex") return to_tex(table);
  return format == "json" ? to_json(table) : to_text(table, terminal_width());
}

void check_outputs(const std::vector<OutputFile>& outputs, const std::vector<InputFile>& inputs) {
  namespace fs = std::filesystem;
  std::set<fs::path> named;
  for (const auto& [flag, file, ending] : outputs) {
    if (file.empty()) continue;
    const auto refuse = [&, name = flag, path = file](const std::string& why) {
      throw Error(fmt::format("{}: {}: {}", name, path.string(), why));
    };
    if (!ending.empty() && file.extension() != ending)
      refuse(fmt::format("is written as {}; give the file this ending", ending));
    std::error_code none;
    fs::path whole = fs::absolute(file).lexically_normal();
    whole = fs::weakly_canonical(whole.parent_path(), none) / whole.filename();
    if (fs::is_directory(whole, none)) refuse("is a folder; give the name of a file");
    if (!fs::is_directory(whole.parent_path(), none))
      refuse("its folder is not there; make it, or give another");
    if (!named.insert(whole).second) refuse("two flags name this file; give each its own");
    for (const auto& [read_by, input] : inputs)
      if (fs::equivalent(file, input, none))
        refuse(fmt::format("{} reads this file; give another name", read_by));
  }
}

std::list<FolderLock> lock_outputs(const std::vector<std::filesystem::path>& files) {
  namespace fs = std::filesystem;
  std::set<fs::path> folders;
  for (const fs::path& file : files) {
    if (file.empty()) continue;
    std::error_code missing;
    const fs::path folder = fs::canonical(fs::absolute(file).parent_path(), missing);
    if (!missing) folders.insert(folder);
  }
  std::list<FolderLock> locks;
  for (const fs::path& folder : folders) locks.emplace_back(folder);
  return locks;
}

}  // namespace mapscore::eval
