// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT
//
// Prints, for each study file named, the resolved configuration of every cell and the text behind
// the key of every task. Compiles against this version and against older ones (compare.py).

#if __has_include("eval/study/study.hpp")
#include "eval/results/plan.hpp"
#include "eval/study/grid.hpp"
#include "eval/study/study.hpp"
#else
#include "eval/experiment/grid.hpp"
#include "eval/experiment/plan.hpp"
#include "eval/experiment/study.hpp"
#endif

#include <cstdio>
#include <exception>

int main(int count, char** files) try {
  using namespace mapscore::eval;
  for (int n = 1; n < count; ++n) {
    const Study study = load_study(files[n]);
    std::printf("=== %s\n%s", files[n], to_yaml(study).c_str());
    for (const Cell& cell : cells(study))
      std::printf("--- %s\n%s", text_of(cell).c_str(), to_yaml(resolve(study, cell)).c_str());
    const Plan plan = plan_of(study, "any recording");
    for (std::size_t i = 0; i < plan.tasks.size(); ++i)
      std::printf("--- task\n%s", plan.tasks[i].description.c_str());
  }
  std::printf("=== reference\n%s", config_reference().c_str());
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
