#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "core/scene/pointshell.h"

namespace godobject {

/// The front of a shell's sphere tree. Items are the nodes, then the points. Every point is in the front or marked, or
/// one node above it is in the front.
///
/// An item in the front is known to be free while it stays in its *ball*: the ball's centre is where the item was when
/// it was looked up, in the field's frame, and its radius is the clearance there less the item's own radius. `scan`
/// compares the items with their balls, in vectors of single precision. Items lie in blocks of sixteen slots. A block
/// is not compared before the odometer's reading at which the first of its items could leave its ball. A marked point
/// may keep its slot: then it needs no other one when it returns. Real-time safe except `start`.
class Front {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;
  static constexpr std::uint32_t kBlockSize = 16;
  static constexpr std::uint32_t kAtOnce = 4;  ///< blocks that are compared together

  /// Returns the size of the memory for `start` [32-bit words].
  static std::size_t memory(const Pointshell& shell) noexcept {
    if (shell.size == 0) return 0;
    return kAlignment - 1 + blocks_for(shell) * (sizeof(Block) + sizeof(double)) / sizeof(std::uint32_t) +
           kWords * (shell.nodes.size() + shell.size) + mark_words(shell.size) + mark_words(mark_words(shell.size));
  }

  /// Starts with the root in the front and due at once. `memory`: memory(shell) words that outlive the front, as does
  /// the shell. Cost: linear in the number of items.
  void start(std::span<std::uint32_t> memory, const Pointshell& shell) noexcept;

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

  /// Tells whether the item is in the front, and not marked.
  bool has(std::uint32_t item) const noexcept {
    return words_[kWords * item + kSlot] != kNone && !(item >= node_count_ && is_marked(item - node_count_));
  }
  /// Returns the node above the item; kNone for the root.
  std::uint32_t parent_of(std::uint32_t item) const noexcept { return words_[kWords * item + kParent]; }

  /// A sphere around all points of an item, in the shell's frame [m].
  struct Sphere {
    float x, y, z, radius;
  };
  /// Returns the item's sphere.
  Sphere sphere_of(std::uint32_t item) const noexcept {
    if (item >= node_count_) {
      const std::uint32_t i = item - node_count_;
      return {x_[i], y_[i], z_[i], 0.0f};
    }
    constexpr double kRoundedUp = 1.0 + 1e-6;  // derived: more than the rounding to single precision, 6e-8
    const format::Node& node = nodes_[item];
    return {node.center[0], node.center[1], node.center[2], static_cast<float>(kRoundedUp * radius_of(node))};
  }

  /// The pose of the shell in the field's frame, in single precision.
  struct Place {
    float m[3][4];   ///< rotation; the last column is the translation [m]
    float rounding;  ///< bound of the error of an item's position [m]
  };
  /// Returns the place of a pose (R, t) [m].
  Place place(const Matrix3& R, const Vector3& t) const noexcept;

  /// The free ball of an item. Its *pace*, at least 1, bounds its displacement over the odometer's difference.
  struct Ball {
    double radius;    ///< clearance less the item's radius, finite [m]
    double per_pace;  ///< 1 / pace, above 0
  };

  /// Puts an item into the front, or gives it another ball there, at `place`. It is free until the odometer reads
  /// `until` [m].
  void insert(std::uint32_t item, const Place& place, const Ball& ball, double until) noexcept {
    std::uint32_t slot = word(item, kSlot);
    if (slot == kNone) slot = append(item);
    set_ball(blocks_[slot / kBlockSize], slot % kBlockSize, place, ball);
    lower(slot / kBlockSize, until);
  }
  /// Puts an item into the front that the next scan finds, wherever the item is.
  void insert_due(std::uint32_t item) noexcept;
  /// Takes an item out of the front. The last item takes its slot.
  void remove(std::uint32_t item) noexcept;

  /// Returns the item in a slot.
  std::uint32_t item_in(std::uint32_t slot) const noexcept {
    return blocks_[slot / kBlockSize].item[slot % kBlockSize];
  }
  /// Returns the sphere of the item in a slot.
  Sphere sphere_in(std::uint32_t slot) const noexcept {
    const Block& block = blocks_[slot / kBlockSize];
    const std::uint32_t k = slot % kBlockSize;
    return {block.x[k], block.y[k], block.z[k], block.radius[k]};
  }

  /// Finds the items that may leave their ball before the odometer reads travelled + reach, and calls visit(slot) for
  /// each. Before the next scan the caller gives each of them another ball, marks it or removes it: their block is not
  /// due because of them. `visit` itself may do the first two. Before each group of at most kAtOnce blocks that are due
  /// it asks go_on(blocks): if false, the blocks that are left stay due, and `scan` returns false. `travelled`: the
  /// odometer's reading at `place` [m]. Cost: a comparison for each block, and one for each item of the blocks that are
  /// due.
  template <class Visit, class GoOn>
  bool scan(const Place& place, double travelled, double reach, Visit&& visit, GoOn&& go_on) noexcept {
    const double horizon = travelled + reach;
    const std::uint32_t blocks = block_count();
    std::uint32_t due[kAtOnce];
    std::uint32_t dues = 0;
    for (std::uint32_t b = 0; b < blocks; ++b) {
      if (!(until_[b] >= horizon)) due[dues++] = b;  // all, if the reading is no number
      if (dues == 0 || (dues < kAtOnce && b + 1 < blocks)) continue;
      if (!go_on(dues)) return false;
      Found found[kAtOnce];
      compare(due, dues, place, static_cast<float>(reach), found);
      for (std::uint32_t k = 0; k < dues; ++k) {
        until_[due[k]] = travelled + static_cast<double>(found[k].least);
        const std::uint32_t items = count_ - due[k] * kBlockSize;
        const std::uint32_t lanes = items < kBlockSize ? (1u << items) - 1 : (1u << kBlockSize) - 1;  // a NaN finds all
        for (std::uint32_t bits = found[k].bits & lanes; bits != 0; bits &= bits - 1) {
          visit(due[k] * kBlockSize + static_cast<std::uint32_t>(std::countr_zero(bits)));
        }
      }
      dues = 0;
    }
    return true;
  }

  /// Returns the number of blocks.
  std::uint32_t block_count() const noexcept { return (count_ + kBlockSize - 1) / kBlockSize; }
  /// Returns a reading of the odometer before which no item is due; 0 while a point is marked. Cost: a comparison for
  /// each block.
  double certain() const noexcept;

  /// Pushes an item to the chain `first`, which is kNone if empty. No change if the item is in a chain.
  void push(std::uint32_t& first, std::uint32_t item) noexcept {
    if (word(item, kNext) != kNotChained) return;
    word(item, kNext) = first;
    first = item;
  }
  /// Pops an item from a chain that is not empty.
  std::uint32_t pop(std::uint32_t& first) noexcept {
    const std::uint32_t item = first;
    first = word(item, kNext);
    word(item, kNext) = kNotChained;
    return item;
  }

  /// Marks a point: it is due in every cycle until it is unmarked. If it has a slot, no scan finds it there.
  void mark(std::uint32_t point) noexcept {
    const std::uint32_t bit = 1u << point % 32;
    if ((marks_[point / 32] & bit) != 0) return;
    const std::uint32_t slot = word(node_count_ + point, kSlot);
    if (slot != kNone) blocks_[slot / kBlockSize].ball[slot % kBlockSize] = kNeverLeft;
    marks_[point / 32] |= bit;
    marked_words_[point / 1024] |= 1u << point / 32 % 32;
    ++marked_;
  }
  /// Unmarks a marked point. The caller then inserts it, or marks it again.
  void unmark(std::uint32_t point) noexcept {
    marks_[point / 32] &= ~(1u << point % 32);
    if (marks_[point / 32] == 0) marked_words_[point / 1024] &= ~(1u << point / 32 % 32);
    --marked_;
  }
  /// Tells whether a point is marked.
  bool is_marked(std::uint32_t point) const noexcept { return (marks_[point / 32] >> point % 32 & 1) != 0; }
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
  static constexpr std::size_t kAlignment = 16;  ///< [words]: a block begins with a cache line
  static constexpr std::uint32_t kNotChained = 0xfffffffe;
  static constexpr float kNeverLeft = std::numeric_limits<float>::max();  ///< a ball
  /// The words of an item. kSlot: kNone outside of the front. kNext: the next one of its chain, or kNotChained.
  enum Word : std::size_t { kSlot, kNext, kParent, kWords };

  /// Sixteen items, by component. Slots without an item, and those of marked points, have a ball that is never left.
  struct Block {
    alignas(64) float x[kBlockSize], y[kBlockSize], z[kBlockSize];  ///< centre of the item in the shell's frame [m]
    float at_x[kBlockSize], at_y[kBlockSize], at_z[kBlockSize];     ///< centre of its ball in the field's frame [m]
    float ball[kBlockSize];                                         ///< radius of its ball, rounded down [m]
    float per_pace[kBlockSize];                                     ///< Ball::per_pace, rounded down
    float radius[kBlockSize];                                       ///< of the item [m]
    std::uint32_t item[kBlockSize];
  };

  struct Found {
    std::uint32_t bits;  ///< a bit for each item that may leave its ball
    float least;         ///< the others stay in their balls until the odometer reads at least this much more [m]
  };
  void compare(const std::uint32_t* due, std::uint32_t count, const Place& place, float reach,
               Found* found) const noexcept;

  static constexpr std::size_t mark_words(std::size_t bits) noexcept { return (bits + 31) / 32; }
  /// The front and the marked points, which may have slots, are at most as many items as the shell has points.
  static std::size_t blocks_for(const Pointshell& shell) noexcept { return (shell.size + kBlockSize - 1) / kBlockSize; }

  std::uint32_t& word(std::uint32_t item, Word word) noexcept { return words_[kWords * item + word]; }
  void lower(std::uint32_t block, double until) noexcept {
    if (!(until >= until_[block])) until_[block] = until;
  }
  static void set_ball(Block& block, std::uint32_t k, const Place& place, const Ball& ball) noexcept;
  std::uint32_t append(std::uint32_t item) noexcept;

  Block* blocks_ = nullptr;
  double* until_ = nullptr;  ///< by block: the odometer's reading until which all its items stay in their balls [m]
  std::span<std::uint32_t> words_;
  std::span<std::uint32_t> marks_;         ///< a bit a point
  std::span<std::uint32_t> marked_words_;  ///< a bit a word of `marks_`
  std::span<const format::Node> nodes_;
  const float* x_ = nullptr;  ///< of the shell's points
  const float* y_ = nullptr;
  const float* z_ = nullptr;
  std::uint32_t node_count_ = 0;
  std::uint32_t count_ = 0;  ///< slots in use, the first ones
  std::uint32_t marked_ = 0;
  double extent_ = 0.0;  ///< largest sum of |coordinate| of an item's centre [m]
};

}  // namespace godobject
