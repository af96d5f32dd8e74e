#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "core/scene/pointshell.h"

namespace godobject {

/// A calendar of the nodes and points of a shell, by the tick of the odometer at which each one is due for a look-up.
///
/// Items are the nodes, then the points. The filed items are the *front*: every point is filed or marked, or a node
/// above it is filed. Each filed item is in the list of one tick, so filing and taking cost the same for any number of
/// items (a hashed timing wheel: Varghese and Lauck, SOSP 1987). Points may be marked instead of filed. Real-time safe
/// except `start`.
class DueCalendar {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  /// Returns the size of the memory for `start` [32-bit words].
  static std::size_t memory(const Pointshell& shell) noexcept {
    if (shell.size == 0) return 0;
    return kWords - 1 + kWords * (shell.nodes.size() + shell.size) + mark_words(shell.size) +
           mark_words(mark_words(shell.size));
  }

  /// Starts with the root filed and due at once. `memory`: memory(shell) words that outlive the calendar. Cost: linear
  /// in the number of items.
  void start(std::span<std::uint32_t> memory, const Pointshell& shell) noexcept {
    const auto nodes = static_cast<std::uint32_t>(shell.nodes.size());
    const std::size_t items = nodes + shell.size;
    // aligned so that no item lies in two cache lines
    const std::size_t before = -(reinterpret_cast<std::uintptr_t>(memory.data()) / sizeof(std::uint32_t)) % kWords;
    words_ = memory.subspan(before, kWords * items);
    marks_ = memory.subspan(before + kWords * items, mark_words(shell.size));
    marked_words_ = memory.subspan(before + kWords * items + marks_.size(), mark_words(marks_.size()));
    std::fill(marks_.begin(), marks_.end(), 0u);
    std::fill(marked_words_.begin(), marked_words_.end(), 0u);
    head_.fill(kNone);
    filled_.fill(0);
    hand_ = 0;
    marked_ = 0;
    for (std::uint32_t i = 0; i < items; ++i) prev(i) = kNone;
    if (nodes > 0) parent(0) = kNone;
    for (std::uint32_t n = 0; n < nodes; ++n) {
      for_each_child(shell, n, [&](std::uint32_t child) { parent(child) = n; });
      const format::Node& node = shell.nodes[n];
      constexpr double kRoundedUp = 1.0 + 1e-6;  // derived: more than the rounding to single precision, 6e-8
      set_sphere(n, {node.center[0], node.center[1], node.center[2], static_cast<float>(kRoundedUp * radius_of(node))});
    }
    for (std::uint32_t i = 0; i < shell.size; ++i) set_sphere(nodes + i, {shell.x[i], shell.y[i], shell.z[i], 0.0f});
    if (nodes > 0) file(0, 0);
  }

  /// Calls visit(item) for the children of a node: nodes, or points if it is a leaf.
  template <class Visit>
  static void for_each_child(const Pointshell& shell, std::uint32_t n, Visit&& visit) noexcept {
    const format::Node& node = shell.nodes[n];
    if (node.leaf != 0) {
      const auto first = static_cast<std::uint32_t>(shell.nodes.size()) + node.first_point;
      for (std::uint32_t i = first; i < first + node.point_count; ++i) visit(i);
    } else {
      for (std::uint32_t child = n + 1; child < node.skip; child = shell.nodes[child].skip) visit(child);
    }
  }

  /// Tells whether the item is filed.
  bool is_filed(std::uint32_t item) const noexcept { return words_[kWords * item + kPrev] < kChained; }
  /// Returns the node above the item; kNone for the root.
  std::uint32_t parent_of(std::uint32_t item) const noexcept { return words_[kWords * item + kParent]; }

  /// A sphere around all points of an item, in the shell's frame [m]. It is stored beside the item's other words.
  struct Sphere {
    float x, y, z, radius;
  };
  /// Returns the item's sphere.
  Sphere sphere_of(std::uint32_t item) const noexcept {
    const std::uint32_t* const words = words_.data() + kWords * item;
    return {std::bit_cast<float>(words[kX]), std::bit_cast<float>(words[kY]), std::bit_cast<float>(words[kZ]),
            std::bit_cast<float>(words[kRadius])};
  }

  /// Files an item that is not filed: it is due at the tick `due`.
  void file(std::uint32_t item, std::uint64_t due) noexcept {
    const std::uint64_t tick = std::clamp(due, hand_ - std::min(hand_, kMostAhead), hand_ + kMostAhead);
    words_of(item)[kTick] = static_cast<std::uint32_t>(tick);
    link(item, tick > hand_ ? std::min(tick, hand_ + kSlots - 1) % kSlots : kCurrent);
  }

  /// Takes a filed item out.
  void take(std::uint32_t item) noexcept { unlink(item); }

  /// Tells `take_due` to take all.
  struct NeverStops {
    bool operator()() const noexcept { return false; }
  };

  /// Takes out all items due at the tick `now` or before, and calls visit(item) for each. `now` may be before the `now`
  /// of the last call. Items that `visit` files stay. Before each item it asks stops(): if true, the items that are
  /// left stay due, and it returns false.
  template <class Visit, class Stops = NeverStops>
  bool take_due(std::uint64_t now, Visit&& visit, const Stops& stops = {}) noexcept {
    const std::uint64_t last = hand_;
    hand_ = now;
    // after more ticks 32 bits do not tell which items are due: all are taken
    const std::int32_t most = now > last + kMostAhead ? std::numeric_limits<std::int32_t>::max() : 0;
    if (!visit_list(kCurrent, now, most, visit, stops)) {
      hand_ = std::min(now, last);
      return false;
    }
    if (now <= last) return true;  // items due later moved from the current list to their own
    const std::uint64_t slots = std::min<std::uint64_t>(now - last, kSlots);
    for (std::uint64_t k = 1; k <= slots; ++k) {
      const std::uint64_t from = (last + k) % kSlots;
      const std::uint64_t rest = filled_[from / 64] >> from % 64;
      k += rest != 0 ? static_cast<std::uint64_t>(std::countr_zero(rest)) : 63 - from % 64;
      if (rest == 0 || k > slots) continue;
      if (!visit_list((last + k) % kSlots, now, most, visit, stops)) {
        hand_ = last + k - 1;  // the lists from this one on are due later
        return false;
      }
    }
    return true;
  }

  /// Returns a tick before which no item is due.
  std::uint64_t certain() const noexcept {
    if (marked_ > 0 || head_[kCurrent] != kNone) return 0;
    for (std::uint64_t ahead = 1; ahead < kSlots;) {
      const std::uint64_t slot = (hand_ + ahead) % kSlots;
      const std::uint64_t rest = filled_[slot / 64] >> slot % 64;
      if (rest != 0) return hand_ + ahead + static_cast<std::uint64_t>(std::countr_zero(rest));
      ahead += 64 - slot % 64;
    }
    return hand_ + kSlots - 1;
  }

  /// Pushes an item that is not filed to the chain `first`, which is kNone if empty. No change if the item is in a
  /// chain.
  void push(std::uint32_t& first, std::uint32_t item) noexcept {
    if (words_[kWords * item + kPrev] == kChained) return;
    words_[kWords * item + kPrev] = kChained;
    next(item) = first;
    first = item;
  }
  /// Pops an item from a chain that is not empty.
  std::uint32_t pop(std::uint32_t& first) noexcept {
    const std::uint32_t item = first;
    first = next(item);
    prev(item) = kNone;
    return item;
  }

  /// Marks a point: it is due in every cycle until it is unmarked.
  void mark(std::uint32_t point) noexcept {
    const std::uint32_t bit = 1u << point % 32;
    if ((marks_[point / 32] & bit) != 0) return;
    marks_[point / 32] |= bit;
    marked_words_[point / 1024] |= 1u << point / 32 % 32;
    ++marked_;
  }
  /// Unmarks a marked point.
  void unmark(std::uint32_t point) noexcept {
    marks_[point / 32] &= ~(1u << point % 32);
    if (marks_[point / 32] == 0) marked_words_[point / 1024] &= ~(1u << point / 32 % 32);
    --marked_;
  }
  /// Returns the number of marked points.
  std::uint32_t marked() const noexcept { return marked_; }

  /// Calls visit(point) for all marked points, ascending. `visit` may unmark its point, and mark points that it was
  /// called for. It may return false to end the calls; then so does this function.
  template <class Visit>
  bool for_each_marked(Visit&& visit) const noexcept {
    for (std::uint32_t w = 0; w < marked_words_.size(); ++w) {
      for (std::uint32_t words = marked_words_[w]; words != 0; words &= words - 1) {
        const std::uint32_t word = 32 * w + static_cast<std::uint32_t>(std::countr_zero(words));
        for (std::uint32_t bits = marks_[word]; bits != 0; bits &= bits - 1) {
          const std::uint32_t point = 32 * word + static_cast<std::uint32_t>(std::countr_zero(bits));
          if constexpr (std::is_same_v<decltype(visit(point)), bool>) {
            if (!visit(point)) return false;
          } else {
            visit(point);
          }
        }
      }
    }
    return true;
  }

 private:
  static constexpr std::uint64_t kSlots = 2048;          ///< ticks ahead that have a list each; a power of two
  static constexpr std::uint64_t kCurrent = kSlots;      ///< the list of items due at the hand or before
  static constexpr std::uint64_t kMostAhead = 1u << 30;  ///< most ticks ahead; derived: 32 bits tell differences apart
  static constexpr std::uint32_t kHead = 1u << 31;       ///< in the back link: the head of a list
  static constexpr std::uint32_t kChained = 0xfffffffe;  ///< in the back link: in a chain, not filed
  /// The words of an item. kTick: the low 32 bits of its tick.
  enum Word : std::size_t { kTick, kNext, kPrev, kParent, kX, kY, kZ, kRadius, kWords };

  static constexpr std::size_t mark_words(std::size_t bits) noexcept { return (bits + 31) / 32; }

  std::uint32_t* words_of(std::uint32_t item) noexcept { return words_.data() + kWords * item; }
  std::uint32_t& next(std::uint32_t item) noexcept { return words_of(item)[kNext]; }
  std::uint32_t& prev(std::uint32_t item) noexcept { return words_of(item)[kPrev]; }
  std::uint32_t& parent(std::uint32_t item) noexcept { return words_of(item)[kParent]; }

  void set_sphere(std::uint32_t item, const Sphere& sphere) noexcept {
    std::uint32_t* const words = words_of(item);
    words[kX] = std::bit_cast<std::uint32_t>(sphere.x);
    words[kY] = std::bit_cast<std::uint32_t>(sphere.y);
    words[kZ] = std::bit_cast<std::uint32_t>(sphere.z);
    words[kRadius] = std::bit_cast<std::uint32_t>(sphere.radius);
  }

  void link(std::uint32_t item, std::uint64_t slot) noexcept {
    const std::uint32_t first = head_[slot];
    next(item) = first;
    prev(item) = kHead | static_cast<std::uint32_t>(slot);
    if (first != kNone) {
      prev(first) = item;
    } else {
      filled_[slot / 64] |= std::uint64_t{1} << slot % 64;
    }
    head_[slot] = item;
  }

  void unlink(std::uint32_t item) noexcept {
    const std::uint32_t before = prev(item);
    const std::uint32_t after = next(item);
    if (after != kNone) prev(after) = before;
    if ((before & kHead) == 0) {
      next(before) = after;
    } else {
      const std::uint32_t slot = before & ~kHead;
      head_[slot] = after;
      if (after == kNone) filled_[slot / 64] &= ~(std::uint64_t{1} << slot % 64);
    }
    prev(item) = kNone;
  }

  std::uint32_t detach(std::uint64_t slot) noexcept {
    const std::uint32_t first = head_[slot];
    head_[slot] = kNone;
    filled_[slot / 64] &= ~(std::uint64_t{1} << slot % 64);
    return first;
  }

  /// Puts the rest of a detached list back, behind what was filed there since.
  void attach(std::uint64_t slot, std::uint32_t chain) noexcept {
    std::uint32_t before = kHead | static_cast<std::uint32_t>(slot);
    if (head_[slot] == kNone) {
      head_[slot] = chain;
      filled_[slot / 64] |= std::uint64_t{1} << slot % 64;
    } else {
      before = head_[slot];
      while (next(before) != kNone) before = next(before);
      next(before) = chain;
    }
    prev(chain) = before;
  }

  /// Visits a list's items; files items more than `most` ticks ahead of `now` again. False: it was stopped.
  template <class Visit, class Stops>
  bool visit_list(std::uint64_t slot, std::uint64_t now, std::int32_t most, Visit& visit, const Stops& stops) noexcept {
    std::uint32_t chain = detach(slot);
    while (chain != kNone) {
      if (stops()) {
        attach(slot, chain);
        return false;
      }
      const std::uint32_t item = pop(chain);
      const auto ahead = static_cast<std::int32_t>(words_of(item)[kTick] - static_cast<std::uint32_t>(now));
      if (ahead <= most) {
        visit(item);
      } else {
        file(item, now + static_cast<std::uint64_t>(ahead));
      }
    }
    return true;
  }

  std::span<std::uint32_t> words_;
  std::span<std::uint32_t> marks_;         ///< a bit a point
  std::span<std::uint32_t> marked_words_;  ///< a bit a word of `marks_`
  std::uint32_t marked_{};
  std::array<std::uint32_t, kSlots + 1> head_{};
  std::array<std::uint64_t, kSlots / 64 + 1> filled_{};  ///< lists that are not empty
  std::uint64_t hand_{};                                 ///< the tick of the last `take_due`
};

}  // namespace godobject
