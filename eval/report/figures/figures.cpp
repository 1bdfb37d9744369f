// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/figures.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/report/figures/accuracy.hpp"
#include "eval/report/figures/causes.hpp"
#include "eval/report/figures/classes.hpp"
#include "eval/report/figures/layout.hpp"
#include "eval/report/figures/script.hpp"
#include "eval/report/figures/threshold.hpp"
#include "eval/report/table.hpp"
#include "eval/report/tidy_csv.hpp"

#include <sstream>
#include <string>
#include <system_error>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem)
    throw Error(folder.string() + ": cannot be made (" + problem.message() +
                "); choose another folder");
}

fs::path written(const fs::path& file, const std::string& text) {
  write_whole_file(file, text);
  return file;
}

}  // namespace

std::vector<fs::path> draw_figures(const StudySummary& summary, const fs::path& folder) {
  make_folder(folder);
  const StudyLayout layout(summary);
  std::vector<FigureSheet> sheets{accuracy_figure(summary, layout), causes_figure(summary, layout)};
  if (auto by_class = class_bars_figure(summary)) sheets.push_back(std::move(*by_class));
  if (auto by_class = class_figure(summary, layout)) sheets.push_back(std::move(*by_class));
  sheets.push_back(precision_recall_figure(summary, layout));
  sheets.push_back(reliability_figure(summary, layout));
  std::vector<fs::path> pictures;
  for (const FigureSheet& sheet : sheets)
    for (fs::path& file : draw(sheet, folder)) pictures.push_back(std::move(file));
  return pictures;
}

std::vector<fs::path> write_tables(const StudySummary& summary, const fs::path& folder) {
  make_folder(folder);
  std::ostringstream tidy;
  write_tidy_csv(summary, tidy);
  const std::string table = to_text(score_table(summary, std::string(kPooled))) + '\n' +
                            to_text(score_table(summary, std::string(kMacro)));
  return {written(folder / "trials.csv", tidy.str()), written(folder / "table.txt", table)};
}

}  // namespace mapscore::eval
