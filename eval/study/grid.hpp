// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/study/study.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// One point of a sweep.
struct Cell {
  int index = 0;
  /// Path and canonical value, in file order.
  std::vector<std::pair<std::string, std::string>> doses;

  bool operator==(const Cell&) const = default;
};

/// One trial of a study: a method at a cell with a seed. It determines one row of the results.
struct TrialSpec {
  int index = 0;
  std::string method;
  Cell cell;
  int seed_index = 0;

  bool operator==(const TrialSpec&) const = default;
};

/// A list whose elements are made each time they are asked for, so that a million of them take no
/// memory. Copies share what `make` holds.
template <class Element>
class LazyList {
 public:
  LazyList() = default;
  /// `make(position)` for 0 <= position < size.
  LazyList(std::size_t size, std::function<Element(std::size_t)> make)
      : size_(size), make_(std::move(make)) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Element operator[](std::size_t position) const { return make_(position); }

  class Iterator {
   public:
    Iterator(const LazyList& list, std::size_t position) : list_(&list), position_(position) {}
    [[nodiscard]] Element operator*() const { return (*list_)[position_]; }
    Iterator& operator++() {
      ++position_;
      return *this;
    }
    [[nodiscard]] bool operator==(const Iterator&) const = default;

   private:
    const LazyList* list_;
    std::size_t position_;
  };
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size_}; }

 private:
  std::size_t size_ = 0;
  std::function<Element(std::size_t)> make_;
};

/// The product of the swept values, paths in the order of the file, the last path fastest; or the
/// points of another `sampling`. A study without a sweep has one cell without doses.
[[nodiscard]] std::vector<Cell> cells(const Study& study);

/// The swept values as numbers; nothing where one of them is none.
[[nodiscard]] std::optional<std::vector<double>> numbers_of(const SweepAxis& axis);

/// Every method at every cell with every seed. Cells vary slowest, methods fastest, so that
/// neighbouring trials have the same faults and share the corrupted frames (Sights).
[[nodiscard]] LazyList<TrialSpec> trials(const Study& study);

/// The seed of everything that one repetition of a study draws; shared by all methods and doses.
[[nodiscard]] std::uint64_t trial_seed(std::uint64_t study_seed, int seed_index);

/// The study at one cell: its doses set, its sweep empty. Throws Error naming the path when a dose
/// does not fit; never for a cell of a loaded study.
[[nodiscard]] Study resolve(const Study& study, const Cell& cell);

/// The name of a cell's scene; empty in a study without scenes.
[[nodiscard]] std::string scene_of(const Study& study, const Cell& cell);

/// The doses without that of the scene.
[[nodiscard]] decltype(Cell::doses) doses_of_scene(const Study& study, decltype(Cell::doses) doses);

/// "path = value, path = value", for people; empty without doses.
[[nodiscard]] std::string text_of(const Cell& cell);

}  // namespace mapscore::eval
