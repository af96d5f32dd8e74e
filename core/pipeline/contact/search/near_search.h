#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/pipeline/contact/search/front.h"
#include "core/pipeline/contact/search/odometer.h"
#include "core/pipeline/contact/search/point_budget.h"
#include "core/pipeline/cycle/work.h"
#include "core/scene/field.h"
#include "core/scene/pointshell.h"
#include "core/scene/sample_bits.h"
#include "godobject/pose.h"

namespace godobject {

/// Step #1 of `contact`: finds the near points of a shell, those whose clearance in a field is below a search radius.
/// With memory it looks up a node of the sphere tree, or a point, only when it may have left the free ball of its last
/// look-up. So the cost of a cycle depends on the number of items that move far, compared with their clearance, and a
/// little on that of the others in the front. The memory does not change what is found, except for which near points
/// are bounded.
///
/// **Bound.** Let C = clearance(c) at the centre c of an item of radius r (a point: r = 0), let c' be where that centre
/// is now, and x a point of the item; then |x - c| <= r + |c' - c|. The field guarantees (DistanceField) that
///     clearance(x) >= min((C - r - |c' - c|) / L, A),   L = lipschitz(), A = assured_clearance().
/// So for any search radius R <= A, x is not near while C - r - |c' - c| >= L R. Front compares C - r with |c' - c|.
/// Between two comparisons |c' - c| grows by at most f t, where t is the difference of the odometer's readings and f >=
/// 1 the item's pace. So nothing is near while the present travelled + L R is at most
///     travelled + (C - r - |c' - c|) / f   at the comparison,
/// where `travelled` is the odometer's reading, since L R >= L R / f. Until then the item is not compared either.
///
/// Items that may be near are looked up in batches (DistanceField::clearances, which returns C as the bound requires).
/// A node that may be near is replaced by its children, and replaces them once they are far. Points that may be near
/// are looked up exactly (DistanceField::samples) within the point budget, and again in every cycle as long as they
/// would be found at once. Of those that are not nearer than an exact radius a bound is looked up in place of that.
class NearSearch {
 public:
  /// Returns the size of the memory for this shell [32-bit words].
  static std::size_t memory(const Pointshell& shell) noexcept { return Front::memory(shell) + shell.size; }

  /// Forgets all and starts. `words`: memory(shell) words that outlive the search; with none, every cycle visits the
  /// tree from its root. `slope`: the field's lipschitz(); `longest`: largest search radius, at most the field's
  /// assured clearance [m].
  void start(std::span<std::uint32_t> words, const Pointshell& shell, double slope, double longest) noexcept {
    *this = NearSearch{};
    slope_ = slope;
    ahead_ = kAhead * longest;
    words_ = words;
    certain_ = 0.0;
    if (words_.empty()) return;
    const std::size_t of_front = Front::memory(shell);
    front_.start(words_.first(of_front), shell);
    bounds_ = words_.subspan(of_front, shell.size);
  }

  /// Starts without a shell: no point is ever near.
  void start_without_shell() noexcept {
    words_ = {};
    certain_ = kNever;
  }

  /// Tells whether the last `find` proves that no clearance falls below `clearance` [m] up to the odometer's reading
  /// `travelled` [m]. `clearance` is at most the longest search radius.
  bool is_free(double travelled, double clearance) const noexcept { return travelled + slope_ * clearance < certain_; }

  /// Finds the near points of the shell at pose H in the field's frame: calls visit(batch, index, near) for batches of
  /// points that were looked up. `index` contains their numbers in the shell; `near` is a bit mask of those with a
  /// clearance below `radius` <= `longest` [m]. All near points are visited, in ascending order. `travelled`: the
  /// odometer's reading at H [m].
  ///
  /// With memory, and unless more points are marked than `budget.points`, points beyond `exact_radius` [m] are
  /// *bounded*: first the search calls visit_bounds(batch, index, bounded) for batches of points. Those of the bit mask
  /// `bounded` have a free ball about them, of the radius `batch.clearance` >= `exact_radius`, and are not looked up
  /// exactly. A point that was nearer at its last look-up is. Each near point is visited once, by one of both, unless a
  /// bound proves a larger ball than `radius` free; both visit in ascending order.
  ///
  /// With memory the search observes `budget`. It calls leave_out(clearance) for each point that may be near but is not
  /// looked up, with a lower bound of its clearance that is above `budget.always` [m].
  ///
  /// `Direction::stretch(lever)` >= 1: a point of the shell that stays within `lever` [m] of the centre of the moving
  /// body's sphere is displaced in the field's frame by at most this times the odometer's difference.
  /// `Direction::lever(q)`: that distance for a point q in the field's frame. Both are used only with
  /// `Direction::kStretches`; otherwise the stretch is 1.
  ///
  /// False: the budget of `work` was spent before the end, and nothing is known about points that were not visited.
  /// With memory the search of the tree goes on in the next call. If `may_go_on` the points do, too: a call with
  /// `goes_on` and the other arguments of this one visits only those that are left.
  ///
  /// Cost: a share of a batch for each due node and point, a look-up for each point that may be near; at most all nodes
  /// and points. Real-time safe.
  template <class Direction, DistanceField Field, class Visit, class VisitBounds, class LeaveOut>
  bool find(const Direction& direction, const Field& field, const Pointshell& shell, const Pose& H, double travelled,
            double radius, double exact_radius, const PointBudget& budget, WorkMeter& work, Visit&& visit,
            VisitBounds&& visit_bounds, LeaveOut&& leave_out, bool goes_on = false) noexcept {
    const Look<Direction, Field> look{
        direction,       field,  shell,        H,   H.rotation.toRotationMatrix(), travelled,
        slope_ * radius, radius, exact_radius, work};
    certain_ = 0.0;
    if (!goes_on) start_over();
    if (words_.empty()) {
      const double least = search_from_root(look, visit);
      if (work.is_spent()) return false;
      certain_ = least;
    } else {
      was_complete_ = DuePass<Direction, Field>(*this, look).run(budget, visit, visit_bounds, leave_out);
      if (!was_complete_) return false;
      certain_ = front_.certain();
    }
    return true;
  }

  /// Forgets where `find` stopped: no point has been visited.
  void start_over() noexcept { next_ = next_bound_ = 0; }
  /// Tells whether a call with `goes_on` may follow the last `find`, which returned false: not without memory, and not
  /// after a choice among the points (PointBudget).
  bool may_go_on() const noexcept { return !words_.empty() && next_ != kNotInOrder; }

 private:
  static constexpr std::uint32_t kNotInOrder = ~0u;
  static constexpr float kNearer = -1.0f;  ///< a bound: the point was nearer than the exact radius at its last look-up
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  static constexpr double kFieldRounding = 1e-5;  ///< of stored distances [voxels]
  static constexpr double kAhead = 0.25;          ///< of the longest search radius
  static constexpr double kAgain = 1.0 + 1e-5;    ///< derived: more than the roundings of a scan to single precision
  static constexpr double kOpen = 0.125;          ///< a node less than this many radii away is opened
  static constexpr double kLeave = 3.0;  ///< once children are this many of its radii away, their parent replaces them

  using Indices = std::array<std::uint32_t, SampleBatch::kCapacity>;  ///< numbers of a batch's points

  /// The arguments of one search.
  template <class Direction, DistanceField Field>
  struct Look {
    const Direction& direction;
    const Field& field;
    const Pointshell& shell;
    const Pose& H;
    const Matrix3 R;
    double travelled;
    double reach;  ///< L radius: an item in a ball of at least this is not near [m]
    double radius;
    double exact_radius;
    WorkMeter& work;

    /// Returns the rounding of stored distances [m].
    double rounding() const noexcept { return kFieldRounding * field.voxel_size(); }

    /// Returns the ball of an item from the clearance at its centre (in the shell's frame) [m].
    Front::Ball ball(double clearance, const Vector3& center, double item_radius) const noexcept {
      const double room = clearance - item_radius - rounding();
      if constexpr (Direction::kStretches) {
        const double lever = direction.lever(R * center + H.translation) + std::max(0.0, room);
        return {room, 1.0 / direction.stretch(lever)};
      } else {
        return {room, 1.0};
      }
    }

    /// Returns the odometer's reading until which an item stays in its ball [m].
    double free_until(const Front::Ball& ball) const noexcept { return travelled + ball.radius * ball.per_pace; }

    /// Visits the near points of a batch; returns their bit mask.
    template <class Visit>
    std::uint64_t visit_near(const SampleBatch& batch, const Indices& index, Visit& visit) const noexcept {
      const std::uint64_t near = clearance_below(batch, radius) & first_bits(batch.count);
      if (near != 0) visit(batch, index, near);
      return near;
    }
  };

  /// Searches without memory, until the budget of work is spent. Returns the odometer's reading until which all points
  /// stay free.
  template <class Direction, DistanceField Field, class Visit>
  static double search_from_root(const Look<Direction, Field>& look, Visit& visit) noexcept {
    const Pointshell& shell = look.shell;
    double least = kNever;
    SampleBatch samples;
    Indices index;
    const auto look_up = [&]() noexcept {
      look.work.add(Work::kPoint, samples.count);
      look.field.samples(look.H, samples);
      const std::uint64_t near = look.visit_near(samples, index, visit);
      if (near != 0) least = std::min(least, look.travelled);
      for_each_bit(first_bits(samples.count) & ~near, [&](std::uint32_t k) noexcept {
        least = std::min(least, look.free_until(look.ball(samples.clearance[k], shell.point(index[k]), 0.0)));
      });
      samples.count = 0;
    };
    const auto node_count = static_cast<std::uint32_t>(shell.nodes.size());
    for (std::uint32_t n = 0; n < node_count && !look.work.is_spent();) {
      const format::Node& node = shell.nodes[n];
      const Vector3 center = center_of(node);
      look.work.add(Work::kBall);
      const double clearance = look.field.sample(look.R * center + look.H.translation).clearance;
      const Front::Ball ball = look.ball(clearance, center, radius_of(node));
      if (ball.radius * ball.per_pace >= look.reach) {
        least = std::min(least, look.free_until(ball));
        n = node.skip;
      } else if (node.leaf != 0) {
        for (std::uint32_t i = node.first_point; i < node.first_point + node.point_count; ++i) {
          const std::uint32_t k = samples.count++;
          index[k] = i;
          samples.x[k] = shell.x[i];
          samples.y[k] = shell.y[i];
          samples.z[k] = shell.z[i];
          if (samples.count == SampleBatch::kCapacity) look_up();
        }
        n = node.skip;
      } else {
        ++n;
      }
    }
    if (samples.count > 0) look_up();
    return least;
  }

  /// One search with memory: due items, then points that may be near, then nodes that replace their children.
  template <class Direction, DistanceField Field>
  class DuePass {
   public:
    DuePass(NearSearch& search, const Look<Direction, Field>& look) noexcept
        : search_(search),
          front_(search.front_),
          look_(look),
          place_(front_.place(look.R, look.H.translation)),
          enough_(kAgain * look.reach + 4.0 * static_cast<double>(place_.rounding)),
          node_count_(static_cast<std::uint32_t>(look.shell.nodes.size())) {}

    /// False: the budget of work was spent.
    template <class Visit, class VisitBounds, class LeaveOut>
    bool run(const PointBudget& budget, Visit& visit, VisitBounds& visit_bounds, LeaveOut& leave_out) noexcept {
      bool has_all = look_at_due();
      const bool has_room = front_.marked() <= budget.points;
      bounds_some_ = has_room && look_.exact_radius < look_.radius;
      has_all = has_all && (has_room || bound_marked()) && (!bounds_some_ || bound_outer(visit_bounds)) &&
                look_up_marked(budget, visit, leave_out);
      replace_children();
      look_.work.add(Work::kScan, front_.block_count());  // counted last: each call with room for a look-up goes on
      return has_all;
    }

   private:
    /// Tells whether an item may stay in the front: it is not near, and a scan at this pose does not find it again.
    bool may_stay(const Front::Ball& ball, double item_radius) const noexcept {
      return ball.radius * ball.per_pace > enough_ + kOpen * item_radius;
    }

    /// Notes the node above an item if the item is so far that the node may replace its children.
    void note_parent(std::uint32_t i, const Front::Ball& ball) noexcept {
      const std::uint32_t parent = front_.parent_of(i);
      if (parent == Front::kNone) return;
      const double enough = kLeave * static_cast<double>(look_.shell.nodes[parent].radius);
      if (ball.radius - look_.reach > enough) front_.push(replacing_, parent);
    }

    void insert(std::uint32_t i, const Front::Ball& ball) noexcept {
      front_.insert(i, place_, ball, look_.free_until(ball));
      note_parent(i, ball);
    }

    /// Adds an item, given with its sphere, to the batch of bounds.
    void add(std::uint32_t i, const Front::Sphere& sphere) noexcept {
      const std::uint32_t k = batch_.count;
      item_[k] = i;
      batch_.x[k] = sphere.x;
      batch_.y[k] = sphere.y;
      batch_.z[k] = sphere.z;
      radius_[k] = sphere.radius;
      batch_.count = k + 1;
      if (batch_.count == PointBatch::kCapacity) flush();
    }

    /// Returns the ball of item `k` of the batch.
    Front::Ball ball_of(std::uint32_t k) const noexcept {
      const Vector3 center(static_cast<double>(batch_.x[k]), static_cast<double>(batch_.y[k]),
                           static_cast<double>(batch_.z[k]));
      return look_.ball(static_cast<double>(batch_.clearance[k]), center, static_cast<double>(radius_[k]));
    }

    /// Looks up the batch's bounds: gives far items a ball in the front, opens the other nodes, marks the other points.
    void flush() noexcept {
      if (batch_.count == 0) return;
      look_.work.add(kind_, batch_.count);
      look_.field.clearances(look_.H, batch_);
      for (std::uint32_t k = 0; k < batch_.count; ++k) {
        const std::uint32_t i = item_[k];
        const Front::Ball ball = ball_of(k);
        if (may_stay(ball, static_cast<double>(radius_[k]))) {
          insert(i, ball);
        } else if (i < node_count_) {
          front_.push(opened_, i);
        } else {
          front_.mark(i - node_count_);
          search_.bounds_[i - node_count_] = std::bit_cast<std::uint32_t>(batch_.clearance[k]);
        }
      }
      batch_.count = 0;
    }

    void add(std::uint32_t i) noexcept { add(i, front_.sphere_of(i)); }

    /// Calls visit(child) for the children of the next opened node, which leaves the front.
    template <class Visit>
    void open_next(Visit&& visit) noexcept {
      const std::uint32_t n = front_.pop(opened_);
      if (front_.has(n)) front_.remove(n);
      Front::for_each_child(look_.shell, n, visit);
    }

    /// Compares the front with its balls. False: the budget of work was spent.
    bool scan() noexcept {
      // Without marked points, items that are due soon are looked up early: then most cycles of free motion need no
      // look-up. Not after a search that the budget ended: it would look at the same ones again.
      const double ahead = front_.marked() == 0 && search_.was_complete_ ? search_.ahead_ : 0.0;
      const auto visit = [this](std::uint32_t slot) noexcept { add(front_.item_in(slot), front_.sphere_in(slot)); };
      const auto go_on = [this](std::uint32_t blocks) noexcept {
        if (look_.work.is_spent()) return false;
        look_.work.add(Work::kBlock, blocks);
        return true;
      };
      const bool all = front_.scan(place_, look_.travelled, look_.reach + ahead, visit, go_on);
      flush();
      return all;
    }

    bool look_at_due() noexcept {
      const bool all = scan();
      while (batch_.count > 0 || opened_ != Front::kNone) {
        if (!all || look_.work.is_spent()) {
          put_back();
          return false;
        }
        if (opened_ == Front::kNone) {
          flush();
        } else {
          open_next([this](std::uint32_t i) noexcept { add(i); });
        }
      }
      return all && !look_.work.is_spent();
    }

    /// Inserts all items without a look-up: they are due at once. Of an opened node these are its children, so that
    /// each call with room for a look-up goes on.
    void put_back() noexcept {
      const auto insert_due = [this](std::uint32_t i) noexcept { front_.insert_due(i); };
      for (std::uint32_t k = 0; k < batch_.count; ++k) insert_due(item_[k]);
      batch_.count = 0;
      while (opened_ != Front::kNone) open_next(insert_due);
    }

    /// Looks up bounds at this pose for all marked points: the budget compares them. False: as `run`.
    bool bound_marked() noexcept {
      kind_ = Work::kPoint;  // every call does it again
      const bool all = front_.for_each_marked([&](std::uint32_t i) noexcept {
        if (look_.work.is_spent()) return false;
        front_.unmark(i);
        add(node_count_ + i);
        return true;
      });
      flush();
      return all;
    }

    float bound(std::uint32_t point) const noexcept { return std::bit_cast<float>(search_.bounds_[point]); }
    void set_bound(std::uint32_t point, float bound) noexcept {
      search_.bounds_[point] = std::bit_cast<std::uint32_t>(bound);
    }

    /// Looks up bounds for the marked points that were not nearer than the exact radius at their last look-up: visits
    /// those that still are not, returns far ones to the front, and leaves the others to look_up_marked. False: as
    /// `run`.
    template <class VisitBounds>
    bool bound_outer(VisitBounds& visit_bounds) noexcept {
      const bool all = front_.for_each_marked([&](std::uint32_t i) noexcept {
        if (i < std::max(search_.next_bound_, search_.next_) || bound(i) == kNearer) return true;
        const std::uint32_t k = batch_.count++;
        item_[k] = i;
        batch_.x[k] = look_.shell.x[i];
        batch_.y[k] = look_.shell.y[i];
        batch_.z[k] = look_.shell.z[i];
        if (batch_.count < PointBatch::kCapacity) return true;
        search_.next_bound_ = i + 1;
        visit_outer(visit_bounds);
        return !look_.work.is_spent();
      });
      if (!all) return false;
      if (batch_.count > 0) visit_outer(visit_bounds);
      search_.next_bound_ = std::numeric_limits<std::uint32_t>::max();
      return true;
    }

    template <class VisitBounds>
    void visit_outer(VisitBounds& visit_bounds) noexcept {
      look_.work.add(Work::kBounded, batch_.count);
      look_.field.clearances(look_.H, batch_);
      const auto exact = static_cast<float>(look_.exact_radius);
      const auto radius = static_cast<float>(look_.radius);
      std::uint64_t nearer = 0;
      std::uint64_t outer = 0;
      for (std::uint32_t k = 0; k < batch_.count; ++k) {
        nearer |= std::uint64_t{!(batch_.clearance[k] >= exact)} << k;
        outer |= std::uint64_t{batch_.clearance[k] >= exact && batch_.clearance[k] <= radius} << k;
      }
      for_each_bit(nearer, [&](std::uint32_t k) noexcept { set_bound(item_[k], kNearer); });
      for_each_bit(first_bits(batch_.count) & ~(nearer | outer), [&](std::uint32_t k) noexcept {
        radius_[k] = 0.0f;
        const Front::Ball ball = ball_of(k);
        if (!may_stay(ball, 0.0)) return;
        front_.unmark(item_[k]);
        insert(node_count_ + item_[k], ball);
      });
      if (outer != 0) visit_bounds(batch_, item_, outer);
      batch_.count = 0;
    }

    template <class Visit, class LeaveOut>
    bool look_up_marked(const PointBudget& budget, Visit& visit, LeaveOut& leave_out) noexcept {
      const auto look_up = [&](std::uint32_t i) noexcept {
        const std::uint32_t k = samples_.count;
        item_[k] = i;
        samples_.x[k] = look_.shell.x[i];
        samples_.y[k] = look_.shell.y[i];
        samples_.z[k] = look_.shell.z[i];
        samples_.count = k + 1;
        if (samples_.count < SampleBatch::kCapacity) return true;
        sample(visit);
        return !look_.work.is_spent();
      };
      bool all = true;
      if (front_.marked() <= budget.points) {
        all = front_.for_each_marked([&](std::uint32_t i) noexcept {
          if (i < search_.next_ || (bounds_some_ && bound(i) != kNearer)) return true;
          const bool goes_on = look_up(i);
          search_.next_ = i + 1;
          return goes_on;
        });
      } else {
        search_.next_ = kNotInOrder;
        look_.work.add(Work::kScan, 3 * front_.marked());
        detail::NearestFirst nearest(budget, static_cast<float>(look_.radius));
        const auto for_each_candidate = [&](const auto& visit_candidate) noexcept {
          return front_.for_each_marked([&](std::uint32_t i) noexcept {
            return !(static_cast<double>(bound(i)) < look_.radius) || visit_candidate(i);
          });
        };
        for_each_candidate([&](std::uint32_t i) noexcept {
          nearest.count(bound(i));
          return true;
        });
        nearest.spread();
        all = for_each_candidate([&](std::uint32_t i) noexcept {
          if (nearest.takes(bound(i))) return look_up(i);
          leave_out(static_cast<double>(bound(i)));
          return true;
        });
      }
      if (samples_.count > 0) sample(visit);
      return all;
    }

    /// Looks up the batch of points that may be near. Far points return to the front; points that are not near, but
    /// would be found again at this pose, stay marked. From now on bounds suffice for those beyond the exact radius.
    template <class Visit>
    void sample(Visit& visit) noexcept {
      look_.work.add(Work::kPoint, samples_.count);
      look_.field.samples(look_.H, samples_);
      const std::uint64_t stays =
          look_.visit_near(samples_, item_, visit) | clearance_below(samples_, look_.reach + look_.rounding());
      for_each_bit(first_bits(samples_.count) & ~clearance_below(samples_, look_.exact_radius),
                   [&](std::uint32_t k) noexcept { set_bound(item_[k], 0.0f); });
      for_each_bit(first_bits(samples_.count) & ~stays, [&](std::uint32_t k) noexcept {
        const Vector3 p(static_cast<double>(samples_.x[k]), static_cast<double>(samples_.y[k]),
                        static_cast<double>(samples_.z[k]));
        const Front::Ball ball = look_.ball(samples_.clearance[k], p, 0.0);
        if (!may_stay(ball, 0.0)) return;
        front_.unmark(item_[k]);
        insert(node_count_ + item_[k], ball);
      });
      samples_.count = 0;
    }

    /// Replaces children that are all in the front and far by their node.
    void replace_children() noexcept {
      while (replacing_ != Front::kNone) {
        const std::uint32_t n = front_.pop(replacing_);
        bool all = !front_.has(n);
        Front::for_each_child(look_.shell, n, [&](std::uint32_t child) noexcept { all &= front_.has(child); });
        if (!all || look_.work.is_spent()) continue;
        look_.work.add(Work::kItem, 8);  // a batch of one
        add(n);
        look_.field.clearances(look_.H, batch_);
        batch_.count = 0;
        const Front::Ball ball = ball_of(0);
        if (!may_stay(ball, static_cast<double>(radius_[0]) / kOpen)) continue;
        Front::for_each_child(look_.shell, n, [&](std::uint32_t child) noexcept { front_.remove(child); });
        insert(n, ball);
      }
    }

    NearSearch& search_;
    Front& front_;
    const Look<Direction, Field>& look_;
    const Front::Place place_;
    const double enough_;  ///< a ball of less does not let its item stay in the front [m]
    const std::uint32_t node_count_;
    PointBatch batch_;
    Indices item_;
    std::array<float, PointBatch::kCapacity> radius_;
    std::uint32_t opened_ = Front::kNone;     ///< nodes whose children need a look-up
    std::uint32_t replacing_ = Front::kNone;  ///< nodes that may replace their children again
    SampleBatch samples_;
    bool bounds_some_ = false;  ///< of points beyond the exact radius bounds are looked up
    Work kind_ = Work::kItem;   ///< of the bounds that are looked up
  };

  std::span<std::uint32_t> words_;
  Front front_;
  std::span<std::uint32_t> bounds_;  ///< lower bounds of the marked points' clearances [m], or kNearer, a float a point
  double slope_ = 1.0;               ///< the field's lipschitz()
  double ahead_{};                   ///< distance that a search without near points looks ahead [m]
  std::uint32_t next_ = 0;           ///< points before this one have been visited, if the search goes on
  std::uint32_t next_bound_ = 0;     ///< points before this one have a bound, or are to be looked up exactly
  bool was_complete_ = true;         ///< the last search was not ended by the budget
  double certain_ = kNever;          ///< reading of the odometer until which the last search proves points free [m]
};

}  // namespace godobject
