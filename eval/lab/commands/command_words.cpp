// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/commands/command_words.hpp"

#include "core/error.hpp"
#include "eval/map_files/map_file.hpp"
#include "files/command.hpp"
#include "files/text.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <optional>
#include <sstream>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// Why the kernel would not start a script, which Linux says in words that name neither.
std::string script_trouble(const fs::path& program) {
  std::string line(256, '\0');
  std::ifstream file(program, std::ios::binary);
  file.read(line.data(), static_cast<std::streamsize>(line.size()));
  line.resize(static_cast<std::size_t>(file.gcount()));
  if (!line.starts_with("#!")) {
    const bool is_text = std::ranges::all_of(line, [](const char c) {
      const auto byte = static_cast<unsigned char>(c);
      return byte >= 0x20 || std::isspace(byte);
    });
    return is_text ? "begins with no line of #!" : std::string();
  }
  std::istringstream words(line.substr(2, line.find('\n') - 2));
  std::string interpreter;
  words >> interpreter;
  return fs::exists(interpreter)
             ? std::string()
             : fmt::format("names the interpreter '{}', which is not there", shown(interpreter));
}

fs::path program_of(const Study& config, const std::string& name, const std::string& key) {
  std::optional<fs::path> program = file_beside(config, name);
  if (!program && name.find('/') == name.npos) program = program_on_path(name);
  if (!program)
    throw Error(fmt::format(
        "{}: '{}' is neither a program on the PATH nor a file beside the study; install it, or "
        "mend the path",
        key, shown(name)));
  if (access(program->c_str(), X_OK) != 0)
    throw Error(
        fmt::format("{}: {} cannot be executed; `chmod +x` it, or write its interpreter "
                    "before it",
                    key, shown(*program)));
  if (const std::string trouble = script_trouble(*program); !trouble.empty())
    throw Error(fmt::format("{}: {} {}; mend its first line, or write its interpreter before it",
                            key, shown(*program), trouble));
  return *program;
}

void replace_all(std::string& word, std::string_view from, const std::string& to) {
  for (std::size_t at = 0; (at = word.find(from, at)) != word.npos; at += to.size())
    word.replace(at, from.size(), to);
}

}  // namespace

bool is_command(const Study& study, const std::string& method) {
  const auto found = std::ranges::find(study.methods, method, &MethodSettings::name);
  return found != study.methods.end() && found->command;
}

std::vector<std::string> command_words(const Study& config) {
  const MethodSettings& method = config.methods.front();
  const std::string key = fmt::format("methods.{}", method.name);
  if (!has_ending_of_a_map(method.command->map))
    throw Error(fmt::format("{}.map: '{}' has no ending of a map; write one of {}", key,
                            shown(method.command->map), map_endings()));
  std::vector<std::string> words = method.command->command;
  words.front() = program_of(config, words.front(), key + ".command");
  for (std::size_t n = 1; n < words.size(); ++n)
    if (const auto file = file_beside(config, words[n])) words[n] = *file;
  return words;
}

std::vector<std::string> filled_words(std::vector<std::string> words, const fs::path& trial,
                                      const fs::path& map, int threads) {
  for (std::string& word : words) {
    replace_all(word, "{threads}", std::to_string(threads));
    replace_all(word, "{trial}", trial);
    replace_all(word, "{map}", map);
  }
  return words;
}

}  // namespace mapscore::eval
