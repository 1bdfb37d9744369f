// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/study_tree.hpp"

#include <array>

namespace mapscore::eval {
namespace {

/// The unit that a key's name ends with; longer endings first.
std::string_view unit_of(std::string_view key) {
  using Unit = std::pair<std::string_view, std::string_view>;
  constexpr auto kUnits = std::to_array<Unit>({{"_m_deg", "m, m, deg"},
                                               {"_m_rad", "m and rad, squared"},
                                               {"_per_s", "1/s"},
                                               {"_per_m", "1/m"},
                                               {"_mps2", "m/s^2"},
                                               {"_dps2", "deg/s^2"},
                                               {"_mps", "m/s"},
                                               {"_dps", "deg/s"},
                                               {"_ms", "ms"},
                                               {"_percent", "%"},
                                               {"_deg", "deg"},
                                               {"_px", "px"},
                                               {"_m", "m"},
                                               {"_s", "s"}});
  for (const auto& [ending, unit] : kUnits)
    if (key.ends_with(ending)) return unit;
  return "";
}

class Reference {
 public:
  void section(const std::string& path, const Section auto& value) {
    for_each_child(value, [&](const auto& member, const Field& field) {
      node(join_path(path, field.key), field, member);
    });
  }

  [[nodiscard]] std::string take() && { return std::move(text_); }

 private:
  template <class T>
  void node(const std::string& path, const Field& field, const T& value) {
    if constexpr (std::same_as<T, Methods>) {
      row(path, "map", "", "required", "", field.meaning);
      section(path + ".NAME", MethodSettings{});
      section(path + ".NAME", CommandMethod{});
    } else if constexpr (std::same_as<T, Sweep>) {
      row(path + ".PATH", "list of values of the leaf", "", "-", "", field.meaning);
    } else if constexpr (std::same_as<T, Scenes>) {
      row(path, "map", "", "-", "", field.meaning);
    } else if constexpr (Choice<T>) {
      choice(path, field, value);
    } else if constexpr (Section<const T>) {
      row(path, "section", "", "", "", field.meaning);
      section(path, value);
    } else {
      leaf(path, field, value);
    }
  }

  template <Choice T>
  void choice(const std::string& path, const Field& field, const T& value) {
    row(path, fmt::format("one of {}", fmt::join(kinds_of(value), ", ")), "",
        field.required ? "required" : kind_of(value), "", field.meaning);
    for (const auto& kind : each_kind<T>())
      for_each_child(kind, [&](const auto& section, const Field& of_kind) {
        node(join_path(path, of_kind.key), of_kind, section);
      });
  }

  template <class T>
  void leaf(const std::string& path, const Field& field, const T& value) {
    const std::string range = field.range.text();
    const std::string text = Leaf<T>::text(value);
    const bool by_the_file = text == "\"\"";
    const bool wide = std::same_as<T, std::uint64_t> && range == "any";
    row(path, Leaf<T>::type() + (wide ? ", 64 bits" : ""), unit_of(field.key),
        by_the_file ? "-" : text, range == "any" ? "" : range, field.meaning);
  }

  /// The default beneath: what holds where neither the file nor a preset gives the key.
  template <class T, class Keys>
  void leaf(const std::string& path, const Field& field, const Given<T, Keys>& value) {
    leaf(path, field, value.value);
  }

  void row(std::string_view key, std::string_view type, std::string_view unit,
           std::string_view preset, std::string_view range, std::string_view meaning) {
    text_ +=
        fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key, type, unit, preset, range, meaning);
  }

  std::string text_ =
      "# Keys of a study file\n\n"
      "Made by the program from the lists of fields of the parameters (core/parameters.hpp). A key "
      "whose default is - may be left\nout. The dotted path of a key is what sweeps and flags name "
      "it by; in a flag its end is enough where one key alone ends so.\nNAME is a method's name, "
      "PATH "
      "the path of a leaf. Defaults are those of the default preset and scan_model; another "
      "brings\n"
      "its own.\n\n"
      "| key | type | unit | default | range | meaning |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
};

}  // namespace

std::string config_reference() {
  Reference reference;
  reference.section("", Study{});
  return std::move(reference).take();
}

}  // namespace mapscore::eval
