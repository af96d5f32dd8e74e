#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/pipeline/contact/search/due_calendar.h"
#include "core/pipeline/contact/search/odometer.h"
#include "core/pipeline/contact/search/point_budget.h"
#include "core/pipeline/cycle/work.h"
#include "core/scene/field.h"
#include "core/scene/pointshell.h"
#include "core/scene/sample_bits.h"
#include "godobject/pose.h"

namespace godobject {

/// Step #1 of `contact`: finds the near points of a shell, those whose clearance in a field is below a search radius.
/// With memory it looks up a node of the sphere tree, or a point, only when the motion since the last look-up could
/// have made it near. So the cost of a cycle depends on the number of near items; the result does not depend on the
/// memory.
///
/// **Bound.** Let C = clearance(c), and let x be a point that was within r of c before the body travelled by t; then
/// |x - c| <= r + t. The field guarantees (DistanceField) that
///     clearance(x) >= min((C - r - t) / L, A),   L = lipschitz(), A = assured_clearance().
/// So for any search radius R <= A, x is not near while the present travelled + L R is at most
///     travelled + C - r   at the time of the look-up,
/// where `travelled` is the odometer's reading. Until then neither the node nor the point is looked up again. Where x
/// may be displaced by f >= 1 times the odometer's difference, C - r is divided by f, since L R >= L R / f.
///
/// Due items are looked up in batches (DistanceField::clearances, which returns C as the bound requires). A node that
/// may be near is replaced by its children, and replaces them once they are far. Points that may be near are looked up
/// exactly (DistanceField::samples) within the point budget, and again in every cycle as long as they would be due at
/// once.
class NearSearch {
 public:
  /// Returns the size of the memory for this shell [32-bit words].
  static std::size_t memory(const Pointshell& shell) noexcept { return DueCalendar::memory(shell) + shell.size; }

  /// Forgets all and starts. `words`: memory(shell) words that outlive the search; with none, every cycle visits the
  /// tree from its root. `slope`: the field's lipschitz(); `longest`: largest search radius, at most the field's
  /// assured clearance [m].
  void start(std::span<std::uint32_t> words, const Pointshell& shell, double slope, double longest) noexcept {
    slope_ = slope;
    tick_ = longest / kTicks;
    words_ = words;
    certain_ = 0.0;
    if (words_.empty()) return;
    const std::size_t of_calendar = DueCalendar::memory(shell);
    calendar_.start(words_.first(of_calendar), shell);
    bounds_ = words_.subspan(of_calendar, shell.size);
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
  template <class Direction, DistanceField Field, class Visit, class LeaveOut>
  bool find(const Direction& direction, const Field& field, const Pointshell& shell, const Pose& H, double travelled,
            double radius, const PointBudget& budget, WorkMeter& work, Visit&& visit, LeaveOut&& leave_out,
            bool goes_on = false) noexcept {
    const Look<Direction, Field> look{
        direction, field, shell, H, H.rotation.toRotationMatrix(), travelled, travelled + slope_ * radius,
        radius,    work};
    certain_ = 0.0;
    if (!goes_on) next_ = 0;
    if (words_.empty()) {
      const double least = search_from_root(look, visit);
      if (work.is_spent()) return false;
      certain_ = least;
    } else {
      was_complete_ = DuePass<Direction, Field>(*this, look).run(budget, visit, leave_out);
      if (!was_complete_) return false;
      certain_ = tick_ * static_cast<double>(calendar_.certain());
    }
    return true;
  }

  /// Forgets where `find` stopped: no point has been visited.
  void start_over() noexcept { next_ = 0; }
  /// Tells whether a call with `goes_on` may follow the last `find`, which returned false: not without memory, and not
  /// after a choice among the points (PointBudget).
  bool may_go_on() const noexcept { return !words_.empty() && next_ != kNotInOrder; }

 private:
  static constexpr std::uint32_t kNotInOrder = ~0u;
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  static constexpr double kTicks = 64.0;          ///< of the calendar in the longest search radius
  static constexpr double kFieldRounding = 1e-5;  ///< of stored distances [voxels]
  static constexpr double kAhead = 0.25 * kTicks;
  static constexpr double kOpen = 0.125;  ///< a node less than this many radii away is opened
  static constexpr double kLeave = 3.0;   ///< once children are this many of its radii away, their parent replaces them
  static constexpr double kMostTicks = 1e18;

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
    double horizon;  ///< travelled + L radius: items that are free until less than this may be near [m]
    double radius;
    WorkMeter& work;

    /// Returns the rounding of stored distances [m].
    double rounding() const noexcept { return kFieldRounding * field.voxel_size(); }

    /// Returns the odometer's reading until which no point within `item_radius` of `center` (in the shell's frame) is
    /// near, from the clearance there [m].
    double free_until(double clearance, const Vector3& center, double item_radius) const noexcept {
      const double room = clearance - item_radius - rounding();
      if constexpr (Direction::kStretches) {
        const double lever = direction.lever(R * center + H.translation) + item_radius + std::max(0.0, room);
        return travelled + room / direction.stretch(lever);
      } else {
        return travelled + room;
      }
    }

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
        least = std::min(least, look.free_until(samples.clearance[k], shell.point(index[k]), 0.0));
      });
      samples.count = 0;
    };
    const auto node_count = static_cast<std::uint32_t>(shell.nodes.size());
    for (std::uint32_t n = 0; n < node_count && !look.work.is_spent();) {
      const format::Node& node = shell.nodes[n];
      const Vector3 center = center_of(node);
      look.work.add(Work::kBall);
      const double clearance = look.field.sample(look.R * center + look.H.translation).clearance;
      const double until = look.free_until(clearance, center, radius_of(node));
      if (until >= look.horizon) {
        least = std::min(least, until);
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
          calendar_(search.calendar_),
          look_(look),
          per_tick_(1.0 / search.tick_),
          node_count_(static_cast<std::uint32_t>(look.shell.nodes.size())) {}

    /// False: the budget of work was spent.
    template <class Visit, class LeaveOut>
    bool run(const PointBudget& budget, Visit& visit, LeaveOut& leave_out) noexcept {
      const bool has_all = look_at_due() && (calendar_.marked() <= budget.points || bound_marked()) &&
                           look_up_marked(budget, visit, leave_out);
      replace_children();
      return has_all;
    }

   private:
    // Rounded down, so that items are due slightly early. Converted as a signed number, which takes one instruction.
    std::uint64_t tick_of(double until) const noexcept {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::clamp(until * per_tick_, 0.0, kMostTicks)));
    }

    /// Files item `i`, which is free until this reading of the odometer.
    void file(std::uint32_t i, double until) noexcept {
      calendar_.file(i, tick_of(until));
      const std::uint32_t parent = calendar_.parent_of(i);
      if (parent == DueCalendar::kNone) return;
      const double enough = kLeave * static_cast<double>(calendar_.sphere_of(parent).radius);
      if (until - look_.horizon > enough && replacing_ != parent) calendar_.push(replacing_, parent);
    }

    /// Adds an item to the batch of bounds.
    void add(std::uint32_t i) noexcept {
      const std::uint32_t k = batch_.count;
      const DueCalendar::Sphere sphere = calendar_.sphere_of(i);
      item_[k] = i;
      batch_.x[k] = sphere.x;
      batch_.y[k] = sphere.y;
      batch_.z[k] = sphere.z;
      radius_[k] = sphere.radius;
      batch_.count = k + 1;
      if (batch_.count == PointBatch::kCapacity) flush();
    }

    /// Returns the reading until which item `k` of the batch is free.
    double until_of(std::uint32_t k) const noexcept {
      const Vector3 center(static_cast<double>(batch_.x[k]), static_cast<double>(batch_.y[k]),
                           static_cast<double>(batch_.z[k]));
      return look_.free_until(static_cast<double>(batch_.clearance[k]), center, static_cast<double>(radius_[k]));
    }

    /// Looks up the batch's bounds: files the far items, opens the other nodes, marks the other points.
    void flush() noexcept {
      look_.work.add(kind_, batch_.count);
      look_.field.clearances(look_.H, batch_);
      for (std::uint32_t k = 0; k < batch_.count; ++k) {
        const std::uint32_t i = item_[k];
        const double until = until_of(k);
        if (until >= look_.horizon + kOpen * static_cast<double>(radius_[k]) && !is_due_again(until)) {
          file(i, until);
        } else if (i < node_count_) {
          calendar_.push(opened_, i);
        } else {
          calendar_.mark(i - node_count_);
          search_.bounds_[i - node_count_] = std::bit_cast<std::uint32_t>(batch_.clearance[k]);
        }
      }
      batch_.count = 0;
    }

    /// Tells whether an item that is free until this reading would be due again in the next call at this pose, after
    /// one that the budget ended. A call would look at the same items again and again.
    bool is_due_again(double until) const noexcept {
      return !search_.was_complete_ && tick_of(until) <= tick_of(look_.horizon);
    }

    bool look_at_due() noexcept {
      const auto adder = [this](std::uint32_t i) noexcept { add(i); };
      // Without marked points, items that are due soon are looked up early: then most cycles of free motion need no
      // look-up. Not after a search that the budget ended: it would look at the same ones again.
      const double ahead = calendar_.marked() == 0 && search_.was_complete_ ? kAhead * search_.tick_ : 0.0;
      calendar_.take_due(tick_of(look_.horizon + ahead), adder, is_spent());
      while (batch_.count > 0 || opened_ != DueCalendar::kNone) {
        if (look_.work.is_spent()) {
          put_back();
          return false;
        }
        if (opened_ == DueCalendar::kNone) {
          flush();
        } else {
          DueCalendar::for_each_child(look_.shell, calendar_.pop(opened_), adder);
        }
      }
      return !look_.work.is_spent();
    }

    auto is_spent() const noexcept {
      return [this]() noexcept { return batch_.count == 0 && look_.work.is_spent(); };
    }

    /// Files all items without a look-up: they are due at once. Of an opened node these are its children, so that each
    /// call with room for a look-up goes on.
    void put_back() noexcept {
      const auto file_due = [this](std::uint32_t i) noexcept { calendar_.file(i, 0); };
      for (std::uint32_t k = 0; k < batch_.count; ++k) file_due(item_[k]);
      batch_.count = 0;
      while (opened_ != DueCalendar::kNone) {
        DueCalendar::for_each_child(look_.shell, calendar_.pop(opened_), file_due);
      }
    }

    /// Looks up bounds at this pose for all marked points: the budget compares them. False: as `run`.
    bool bound_marked() noexcept {
      kind_ = Work::kPoint;  // every call does it again
      const bool all = calendar_.for_each_marked([&](std::uint32_t i) noexcept {
        if (look_.work.is_spent()) return false;
        calendar_.unmark(i);
        add(node_count_ + i);
        return true;
      });
      flush();
      return all;
    }

    float bound(std::uint32_t point) const noexcept { return std::bit_cast<float>(search_.bounds_[point]); }

    template <class Visit, class LeaveOut>
    bool look_up_marked(const PointBudget& budget, Visit& visit, LeaveOut& leave_out) noexcept {
      const auto look_up = [&](std::uint32_t i) noexcept {
        const std::uint32_t k = samples_.count;
        item_[k] = i;
        const DueCalendar::Sphere point = calendar_.sphere_of(node_count_ + i);
        samples_.x[k] = point.x;
        samples_.y[k] = point.y;
        samples_.z[k] = point.z;
        samples_.count = k + 1;
        if (samples_.count < SampleBatch::kCapacity) return true;
        sample(visit);
        return !look_.work.is_spent();
      };
      bool all = true;
      if (calendar_.marked() <= budget.points) {
        all = calendar_.for_each_marked([&](std::uint32_t i) noexcept {
          if (i < search_.next_) return true;
          const bool goes_on = look_up(i);
          search_.next_ = i + 1;
          return goes_on;
        });
      } else {
        search_.next_ = kNotInOrder;
        look_.work.add(Work::kScan, 3 * calendar_.marked());
        detail::NearestFirst nearest(budget, static_cast<float>(look_.radius));
        const auto for_each_candidate = [&](const auto& visit_candidate) noexcept {
          return calendar_.for_each_marked([&](std::uint32_t i) noexcept {
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

    /// Looks up the batch of points that may be near. Far points are filed again; points that are not near, but would
    /// be due again at once, stay marked.
    template <class Visit>
    void sample(Visit& visit) noexcept {
      look_.work.add(Work::kPoint, samples_.count);
      look_.field.samples(look_.H, samples_);
      // for a stretch of 1
      const double due_below = look_.horizon - look_.travelled + look_.rounding();
      const std::uint64_t stays = look_.visit_near(samples_, item_, visit) | clearance_below(samples_, due_below);
      for_each_bit(first_bits(samples_.count) & ~stays, [&](std::uint32_t k) noexcept {
        const Vector3 p(static_cast<double>(samples_.x[k]), static_cast<double>(samples_.y[k]),
                        static_cast<double>(samples_.z[k]));
        const double until = look_.free_until(samples_.clearance[k], p, 0.0);
        if (until < look_.horizon) return;
        calendar_.unmark(item_[k]);
        file(node_count_ + item_[k], until);
      });
      samples_.count = 0;
    }

    /// Replaces children that are all filed and far by their node.
    void replace_children() noexcept {
      while (replacing_ != DueCalendar::kNone) {
        const std::uint32_t n = calendar_.pop(replacing_);
        bool all = !calendar_.is_filed(n);
        DueCalendar::for_each_child(look_.shell, n,
                                    [&](std::uint32_t child) noexcept { all &= calendar_.is_filed(child); });
        if (!all || look_.work.is_spent()) continue;
        look_.work.add(Work::kItem, 8);  // a batch of one
        add(n);
        look_.field.clearances(look_.H, batch_);
        batch_.count = 0;
        const double until = until_of(0);
        if (until - look_.horizon <= static_cast<double>(radius_[0])) continue;
        DueCalendar::for_each_child(look_.shell, n, [&](std::uint32_t child) noexcept { calendar_.take(child); });
        file(n, until);
      }
    }

    NearSearch& search_;
    DueCalendar& calendar_;
    const Look<Direction, Field>& look_;
    const double per_tick_;
    const std::uint32_t node_count_;
    PointBatch batch_;
    Indices item_;
    std::array<float, PointBatch::kCapacity> radius_;
    std::uint32_t opened_ = DueCalendar::kNone;     ///< nodes whose children need a look-up
    std::uint32_t replacing_ = DueCalendar::kNone;  ///< nodes that may replace their children again
    SampleBatch samples_;
    Work kind_ = Work::kItem;  ///< of the bounds that are looked up
  };

  std::span<std::uint32_t> words_;
  DueCalendar calendar_;
  std::span<std::uint32_t> bounds_;  ///< lower bounds of the marked points' clearances, a float a point [m]
  double slope_ = 1.0;               ///< the field's lipschitz()
  double tick_{};                    ///< the calendar's tick [m]
  std::uint32_t next_ = 0;           ///< points before this one have been visited, if the search goes on
  bool was_complete_ = true;         ///< the last search was not ended by the budget
  double certain_ = kNever;          ///< reading of the odometer until which the last search proves points free [m]
};

}  // namespace godobject
