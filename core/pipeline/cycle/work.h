#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace godobject {

/// The kinds of work of a cycle of `contact`.
enum class Work : std::uint8_t {
  kCycle,     ///< the part that every cycle has
  kSubstep,   ///< the part that every sub-step with a near point has
  kAttempt,   ///< the part that every attempt at a motion has
  kBlock,     ///< sixteen nodes or points of the search that are compared with their free balls
  kItem,      ///< a node or point of the search for which a bound of the clearance is looked up
  kPoint,     ///< a point that is looked up exactly
  kBounded,   ///< a near point of which only a bound is looked up and listed
  kNear,      ///< a near point that is listed and becomes a row
  kScan,      ///< a listed point, pair or row that a pass over its list looks at
  kChord,     ///< a point whose end in a motion is looked up
  kBall,      ///< a look-up of one point alone
  kPair,      ///< the gap of a pair of edges
  kBranches,  ///< a pair of branches of the trees of edges
  kFace,      ///< a face whose even pressure is computed
  kSolve,     ///< the start of a solver
  kExchange,  ///< a half space that enters the active set
  kNewton,    ///< a step of Newton's method for friction
  kSmoothed,  ///< a step of the smoothing method, for each contact
  kKinds
};
inline constexpr std::size_t kWorkKinds = static_cast<std::size_t>(Work::kKinds);

/// The cost of one piece of each kind [units]. A unit is about a quarter of a nanosecond on an x86-64 processor of 3
/// GHz with AVX2. Fitted once to 28,600 cycles of the demo's paths, a nut on its bolt and two pegs, while another job
/// ran: least squares of the relative error. The time of 80 % of these cycles was 0.8 to 1.7 times that of their work.
/// `kBlock`, `kItem` and `kBounded` are estimates from their instructions, 130, 90 and 120, since the search has a
/// front.
inline constexpr std::array<std::uint32_t, kWorkKinds> kWorkCosts = {900, 1500, 1400, 40, 75,   75,   40,   50,   2,
                                                                     190, 1350, 200,  90, 2400, 4700, 1650, 2100, 2000};

/// Returns the cost of one piece [units].
constexpr std::uint64_t cost_of(Work kind) noexcept { return kWorkCosts[static_cast<std::size_t>(kind)]; }

/// Counts the work of one cycle and tells when its budget is spent. The work depends on scene, state, input and the
/// processor's vectors, not on the clock, so that a replay repeats it to the bit. Real-time safe.
class WorkMeter {
 public:
  static constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

  /// Starts a cycle that may take `budget` units.
  void start(std::uint64_t budget) noexcept {
    spent_ = on_trees_ = aside_ = 0;
    budget_ = budget;
  }

  /// Counts `pieces` pieces of work.
  void add(Work kind, std::uint32_t pieces = 1) noexcept {
    const std::uint64_t units = cost_of(kind) * pieces;
    spent_ += units;
    if (kind == Work::kBlock || kind == Work::kItem || kind == Work::kBranches) on_trees_ += units;
  }

  /// Tells whether the budget is spent, but for what is set aside.
  bool is_spent() const noexcept { return spent_ >= budget_ || budget_ - spent_ <= aside_; }
  /// Tells whether the budget has room for `units` more, besides what is set aside.
  bool has(std::uint64_t units) const noexcept { return !is_spent() && units <= budget_ - spent_ - aside_; }
  /// Sets `units` aside for later work of the cycle, in place of what was set aside before.
  void set_aside(std::uint64_t units) noexcept { aside_ = units; }

  std::uint64_t spent() const noexcept { return spent_; }  ///< [units]
  std::uint64_t on_trees() const noexcept {
    return on_trees_;
  }                                                          ///< the part that visits trees, which go on later [units]
  std::uint64_t budget() const noexcept { return budget_; }  ///< [units]
  std::uint64_t aside() const noexcept { return aside_; }    ///< [units]

 private:
  std::uint64_t spent_ = 0;
  std::uint64_t on_trees_ = 0;
  std::uint64_t budget_ = kUnlimited;
  std::uint64_t aside_ = 0;
};

}  // namespace godobject
