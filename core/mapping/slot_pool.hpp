// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <mutex>
#include <new>

namespace mapscore {

/// Memory for very many small objects of one size, without an allocator's overhead for each. Slots
/// given back are reused by the same thread, after its end by any thread; they never return to the
/// system. Safe from all threads.
template <std::size_t kBytes>
class SlotPool {
 public:
  static void* take() {
    List& list = mine();
    if (list.head == nullptr) list.head = shared().take_all();
    Slot* slot = list.head;
    list.head = slot->next;
    return slot;
  }
  static void give(void* memory) noexcept {
    List& list = mine();
    list.head = new (memory) Slot{list.head};
  }

 private:
  struct Slot {
    Slot* next;
  };
  static_assert(kBytes >= sizeof(Slot) && kBytes % alignof(Slot) == 0);
  static constexpr std::size_t kSlotsAtOnce = 4096;

  /// What ended threads gave back, and memory from the system.
  struct Shared {
    std::mutex mutex;
    Slot* head = nullptr;

    Slot* take_all() {
      const std::lock_guard lock(mutex);
      if (Slot* all = head) {
        head = nullptr;
        return all;
      }
      auto* bytes = static_cast<std::byte*>(::operator new(kSlotsAtOnce* kBytes));
      Slot* first = nullptr;
      for (std::size_t n = kSlotsAtOnce; n > 0; --n)
        first = new (bytes + (n - 1) * kBytes) Slot{first};
      return first;
    }
    void give_all(Slot* first) {
      Slot* last = first;
      while (last->next != nullptr) last = last->next;
      const std::lock_guard lock(mutex);
      last->next = head;
      head = first;
    }
  };
  /// Outlives every thread.
  static Shared& shared() {
    static Shared& shared = *new Shared;
    return shared;
  }

  struct List {
    Slot* head = nullptr;
    ~List() {
      if (head != nullptr) shared().give_all(head);
      head = nullptr;
    }
  };
  static List& mine() {
    thread_local List list;
    return list;
  }
};

}  // namespace mapscore
