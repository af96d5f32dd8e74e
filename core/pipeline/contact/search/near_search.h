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
#include "core/scene/field.h"
#include "core/scene/pointshell.h"
#include "core/scene/sample_bits.h"
#include "core/spatial/bounding_sphere.h"
#include "godobject/pose.h"

namespace godobject {

/// A bound on how far any point of the moving body has gone in a session.
class Odometer {
 public:
  void reset() noexcept { *this = Odometer{}; }

  /// The body, all of whose points lie in `sphere`, always the same, is at H_WS now. Whatever way it took, only the
  /// poses that are looked at count.
  void move_to(const Pose& H_WS, const BoundingSphere& sphere) noexcept {
    const Vector3 center = H_WS * sphere.center;
    if (started_) way_ += farthest_way(sphere, H_, center_, H_WS, center);
    H_ = H_WS;
    center_ = center;
    started_ = true;
  }

  double way() const noexcept { return way_; }

 private:
  Pose H_;
  Vector3 center_ = Vector3::Zero();  ///< of the sphere [m]
  double way_ = 0.0;                  ///< [m]
  bool started_ = false;
};

/// How many points a search may look up exactly. Of more that may be near it takes those with the least bound of
/// their clearance, and where bounds are equal some spread over the shell.
struct PointBudget {
  std::uint32_t points = std::numeric_limits<std::uint32_t>::max();
  double always = 0.0;  ///< whose bound is no more than this is looked up in any case [m]
};

/// Step #1 of `contact`: the points of a shell whose clearance in a field is below a bound. With memory of its own it
/// looks at a node of the sphere tree, or at a point, only when the motion since it was last looked at could have
/// brought it there, so a cycle costs as much as there is near; what it finds does not depend on it.
///
/// **Bound.** Let C = clearance(c) and |x - c| <= r + t for a point x that was within r of c when the body had gone t
/// less. The field says (DistanceField) that
///     clearance(x) >= min((C - r - t) / L, A),   L = lipschitz(), A = assured_clearance().
/// So for any bound `cut` <= A, x is not near while way + L cut, way the odometer's reading, has not exceeded
///     way + C - r   as it was there,
/// and neither node nor point is looked at again before. Where x may move by f >= 1 times what the odometer says,
/// C - r is divided by f, since L cut >= L cut / f.
///
/// What is due is looked at in batches (DistanceField::clearances, which knows C as the bound needs it); a node that
/// may be near gives way to its children, and takes their place again once they are far. Points that may be near are
/// looked up (DistanceField::samples), as far as a budget goes, and again in every cycle as long as they would come due
/// at once.
class NearSearch {
 public:
  /// Words that a search of this shell remembers.
  static std::size_t memory(const Pointshell& shell) noexcept { return DueCalendar::memory(shell) + shell.size; }

  /// Begins anew. `memory`: memory(shell) words that outlive the search, or none; then all nodes are looked at in every
  /// cycle. `slope`: the field's lipschitz(); `longest`: largest `cut`, at most the field's assured clearance [m].
  void start(std::span<std::uint32_t> memory, const Pointshell& shell, double slope, double longest) noexcept {
    slope_ = slope;
    tick_ = longest / kTicks;
    memory_ = memory;
    certain_ = 0.0;
    if (memory_.empty()) return;
    const std::size_t of_calendar = DueCalendar::memory(shell);
    calendar_.start(memory_.first(of_calendar), shell);
    bounds_ = memory_.subspan(of_calendar, shell.size);
  }

  /// There is no shell: nothing ever comes near.
  void start_without_shell() noexcept {
    memory_ = {};
    certain_ = kNever;
  }

  /// The last `find` knows that up to this reading of the odometer nothing comes nearer than `cut`, at most the
  /// longest.
  bool is_free(double way, double cut) const noexcept { return way + slope_ * cut < certain_; }

  /// Calls visit(batch, index, near) for batches of points that were looked up: their numbers in the shell, and those
  /// with a clearance below `cut` <= `longest`, a bit each. All that are so near are visited, ascending. The shell is
  /// at H in the field's frame; `way` is the odometer's reading there. Cost: a share of a batch for each node and
  /// point that is due, a look-up for each that may be near; at most all nodes and points.
  ///
  /// With memory the budget is kept, and leave_out(clearance) is called for each point that may be near but was not
  /// looked up, with a bound of its clearance, more than `budget.always`.
  ///
  /// `Direction::stretch(lever)`: a point of the shell that stays within `lever` [m] of the centre of the moving body's
  /// sphere moves in the field's frame by at most this times the odometer's difference; 1 or more. `lever(q)`: of a
  /// point in the field's frame. Always 1 and not asked for without `Direction::kStretches`.
  template <class Direction, DistanceField Field, class Visit, class LeaveOut>
  void find(const Direction& direction, const Field& field, const Pointshell& shell, const Pose& H, double way,
            double cut, const PointBudget& budget, Visit&& visit, LeaveOut&& leave_out) noexcept {
    const Matrix3 R = H.rotation.toRotationMatrix();
    const double needed = way + slope_ * cut;
    const double rounding = kFieldRounding * field.voxel_size();
    // until when a ball of this radius about a point of the shell is not near
    const auto free_until = [&](double clearance, const Vector3& center, double radius) noexcept {
      const double room = clearance - radius - rounding;
      if constexpr (Direction::kStretches) {
        return way +
               room / direction.stretch(direction.lever(R * center + H.translation) + radius + std::max(0.0, room));
      } else {
        return way + room;
      }
    };
    const auto near_of = [&](const SampleBatch& batch, const Indices& index) noexcept {
      const std::uint64_t near = clearance_below(batch, cut) & first_bits(batch.count);
      if (near != 0) visit(batch, index, near);
      return near;
    };
    if (memory_.empty()) {
      certain_ = look_everywhere(field, shell, R, H, way, needed, free_until, near_of);
    } else {
      const double room_needed = needed - way + rounding;  // of a point whose chords do not stretch
      look_at_due(field, shell, H, needed, room_needed, cut, budget, free_until, near_of, leave_out);
      certain_ = tick_ * static_cast<double>(calendar_.certain());
    }
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  static constexpr double kTicks = 64.0;          ///< of the calendar in the longest cut
  static constexpr double kFieldRounding = 1e-5;  ///< of stored distances [voxels]

  using Indices = std::array<std::uint32_t, SampleBatch::kCapacity>;  ///< of a batch's points

  /// Without memory. Until when all that is not near is free.
  template <DistanceField Field, class FreeUntil, class NearOf>
  static double look_everywhere(const Field& field, const Pointshell& shell, const Matrix3& R, const Pose& H,
                                double way, double needed, const FreeUntil& free_until,
                                const NearOf& near_of) noexcept {
    double least = kNever;
    SampleBatch samples;
    Indices index;
    const auto look_up = [&]() noexcept {
      field.samples(H, samples);
      const std::uint64_t near = near_of(samples, index);
      if (near != 0) least = std::min(least, way);
      for_each_bit(first_bits(samples.count) & ~near, [&](std::uint32_t k) noexcept {
        least = std::min(least, free_until(samples.clearance[k], shell.point(index[k]), 0.0));
      });
      samples.count = 0;
    };
    const auto node_count = static_cast<std::uint32_t>(shell.nodes.size());
    for (std::uint32_t n = 0; n < node_count;) {
      const format::Node& node = shell.nodes[n];
      const Vector3 center = center_of(node);
      const double until = free_until(field.sample(R * center + H.translation).clearance, center, radius_of(node));
      if (until >= needed) {
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

  template <DistanceField Field, class FreeUntil, class NearOf, class LeaveOut>
  void look_at_due(const Field& field, const Pointshell& shell, const Pose& H, double needed, double room_needed,
                   double cut, const PointBudget& budget, const FreeUntil& free_until, const NearOf& near_of,
                   LeaveOut& leave_out) noexcept {
    const double per_tick = 1.0 / tick_;
    // rounded down: due a little early; by way of a signed number, which the processor converts to
    const auto tick_of = [&](double until) noexcept {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::clamp(until * per_tick, 0.0, kMostTicks)));
    };
    const auto node_count = static_cast<std::uint32_t>(shell.nodes.size());
    // with nothing near what comes due soon is looked at early: then most cycles of free flight look at nothing
    const std::uint64_t now = tick_of(needed + (calendar_.marked() == 0 ? kAhead * tick_ : 0.0));
    PointBatch batch;
    Indices item;
    std::array<float, PointBatch::kCapacity> radius;
    std::uint32_t opened = DueCalendar::kNone;   // nodes whose children are to be looked at
    std::uint32_t leaving = DueCalendar::kNone;  // nodes that may stand for their children again
    const auto file = [&](std::uint32_t i, double until) noexcept {
      calendar_.file(i, tick_of(until));
      const std::uint32_t parent = calendar_.parent_of(i);
      if (parent == DueCalendar::kNone) return;
      if (until - needed > kLeave * static_cast<double>(calendar_.sphere_of(parent).radius) && leaving != parent) {
        calendar_.push(leaving, parent);
      }
    };
    const auto until_of = [&](std::uint32_t k) noexcept {
      const Vector3 center(static_cast<double>(batch.x[k]), static_cast<double>(batch.y[k]),
                           static_cast<double>(batch.z[k]));
      return free_until(static_cast<double>(batch.clearance[k]), center, static_cast<double>(radius[k]));
    };
    const auto flush = [&]() noexcept {
      field.clearances(H, batch);
      for (std::uint32_t k = 0; k < batch.count; ++k) {
        const std::uint32_t i = item[k];
        const double until = until_of(k);
        if (until >= needed + kOpen * static_cast<double>(radius[k])) {
          file(i, until);
        } else if (i < node_count) {
          calendar_.push(opened, i);
        } else {
          calendar_.mark(i - node_count);
          bounds_[i - node_count] = std::bit_cast<std::uint32_t>(batch.clearance[k]);
        }
      }
      batch.count = 0;
    };
    const auto add = [&](std::uint32_t i) noexcept {
      const std::uint32_t k = batch.count;
      const DueCalendar::Sphere sphere = calendar_.sphere_of(i);
      item[k] = i;
      batch.x[k] = sphere.x;
      batch.y[k] = sphere.y;
      batch.z[k] = sphere.z;
      radius[k] = sphere.radius;
      batch.count = k + 1;
      if (batch.count == PointBatch::kCapacity) flush();
    };
    calendar_.take_due(now, add);
    while (batch.count > 0 || opened != DueCalendar::kNone) {
      if (opened == DueCalendar::kNone) {
        flush();
      } else {
        DueCalendar::for_each_child(shell, calendar_.pop(opened), add);
      }
    }
    if (calendar_.marked() > budget.points) bound_marked(node_count, add, flush);
    SampleBatch samples;
    const auto sample = [&]() noexcept {
      field.samples(H, samples);
      // what is not near, but would be due again at once, stays marked
      const std::uint64_t stays = near_of(samples, item) | clearance_below(samples, room_needed);
      for_each_bit(first_bits(samples.count) & ~stays, [&](std::uint32_t k) noexcept {
        const Vector3 p(static_cast<double>(samples.x[k]), static_cast<double>(samples.y[k]),
                        static_cast<double>(samples.z[k]));
        const double until = free_until(samples.clearance[k], p, 0.0);
        if (until < needed) return;
        calendar_.unmark(item[k]);
        file(node_count + item[k], until);
      });
      samples.count = 0;
    };
    const auto look_up = [&](std::uint32_t i) noexcept {
      const std::uint32_t k = samples.count;
      item[k] = i;
      const DueCalendar::Sphere point = calendar_.sphere_of(node_count + i);
      samples.x[k] = point.x;
      samples.y[k] = point.y;
      samples.z[k] = point.z;
      samples.count = k + 1;
      if (samples.count == SampleBatch::kCapacity) sample();
    };
    if (calendar_.marked() <= budget.points) {
      calendar_.for_each_marked(look_up);
    } else {
      NearestFirst nearest(budget, static_cast<float>(cut));
      const auto for_each_candidate = [&](const auto& visit) noexcept {
        calendar_.for_each_marked([&](std::uint32_t i) noexcept {
          if (static_cast<double>(bound(i)) < cut) visit(i);
        });
      };
      for_each_candidate([&](std::uint32_t i) noexcept { nearest.count(bound(i)); });
      nearest.spread();
      for_each_candidate([&](std::uint32_t i) noexcept {
        if (nearest.takes(bound(i))) {
          look_up(i);
        } else {
          leave_out(static_cast<double>(bound(i)));
        }
      });
    }
    if (samples.count > 0) sample();
    // a node whose children are all filed and far
    while (leaving != DueCalendar::kNone) {
      const std::uint32_t n = calendar_.pop(leaving);
      bool all = !calendar_.is_filed(n);
      DueCalendar::for_each_child(shell, n, [&](std::uint32_t child) noexcept { all &= calendar_.is_filed(child); });
      if (!all) continue;
      add(n);
      field.clearances(H, batch);
      batch.count = 0;
      const double until = until_of(0);
      if (until - needed <= static_cast<double>(radius[0])) continue;
      DueCalendar::for_each_child(shell, n, [&](std::uint32_t child) noexcept { calendar_.take(child); });
      file(n, until);
    }
  }

  /// Of what was marked before, too, a budget needs bounds as they are here.
  template <class Add, class Flush>
  void bound_marked(std::uint32_t node_count, const Add& add, const Flush& flush) noexcept {
    std::uint32_t again = DueCalendar::kNone;
    calendar_.for_each_marked([&](std::uint32_t i) noexcept {
      calendar_.unmark(i);
      calendar_.push(again, node_count + i);
    });
    while (again != DueCalendar::kNone) add(calendar_.pop(again));
    flush();
  }

  /// Keeps a budget: counts bounds by their size, then takes the least ones.
  class NearestFirst {
   public:
    NearestFirst(const PointBudget& budget, float longest) noexcept
        : points_(budget.points), always_(static_cast<float>(budget.always)), per_bound_(kSizes / longest) {}

    void count(float bound) noexcept {
      if (bound > always_) {
        ++count_[size(bound)];
      } else if (points_ > 0) {
        --points_;
      }
    }

    void spread() noexcept {
      while (last_ + 1 < kSizes && count_[last_] <= points_) points_ -= count_[last_++];
      stride_ = points_ > 0 ? (count_[last_] + points_ - 1) / points_ : std::numeric_limits<std::uint32_t>::max();
    }

    bool takes(float bound) noexcept {
      if (!(bound > always_)) return true;
      const std::uint32_t size_here = size(bound);
      return size_here < last_ || (size_here == last_ && points_ > 0 && seen_++ % stride_ == 0);
    }

   private:
    static constexpr std::uint32_t kSizes = 256;

    std::uint32_t size(float bound) const noexcept {
      return std::min(kSizes - 1, static_cast<std::uint32_t>(std::max(0.0f, bound * per_bound_)));
    }

    std::array<std::uint32_t, kSizes> count_{};
    std::uint32_t points_;  ///< left
    float always_;
    float per_bound_;
    std::uint32_t last_ = 0;  ///< the size of which some are taken
    std::uint32_t stride_ = 1;
    std::uint32_t seen_ = 0;
  };

  float bound(std::uint32_t point) const noexcept { return std::bit_cast<float>(bounds_[point]); }

  static constexpr double kAhead = 0.25 * kTicks;
  static constexpr double kOpen = 0.125;  ///< a node less than this many radii away is opened
  static constexpr double kLeave = 3.0;   ///< children this many of its radii away may be stood for by their parent
  static constexpr double kMostTicks = 1e18;

  std::span<std::uint32_t> memory_;
  DueCalendar calendar_;
  std::span<std::uint32_t> bounds_;  ///< of a marked point's clearance, a float a point [m]
  double slope_ = 1.0;               ///< the field's lipschitz()
  double tick_ = 1.0;                ///< of the calendar [m]
  double certain_ = kNever;          ///< until when nothing comes nearer than the longest cut [m]
};

}  // namespace godobject
