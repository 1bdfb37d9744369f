// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <utility>

namespace mapscore::eval {

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
  /// Throws std::out_of_range beyond the end.
  [[nodiscard]] Element at(std::size_t position) const {
    if (position >= size_) throw std::out_of_range("LazyList");
    return make_(position);
  }

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

}  // namespace mapscore::eval
