#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/pipeline/contact/qp/contact_rows.h"
#include "core/pipeline/contact/qp/least_constraint.h"
#include "core/pipeline/contact/search/near_points.h"
#include "core/pipeline/contact/search/near_search.h"
#include "core/pipeline/cycle/state.h"
#include "core/pipeline/cycle/step_times.h"
#include "core/pipeline/cycle/unconstrained_motion.h"
#include "core/pipeline/cycle/workspace_limit.h"
#include "core/scene/field.h"
#include "core/scene/pointshell.h"
#include "core/spatial/bounding_sphere.h"

namespace godobject {

/// The second direction: feature points of the still body against the moving body's distance.
template <DistanceField BodyField>
struct FeatureContacts {
  const BodyField& map;      ///< in S
  const Pointshell& points;  ///< in W, relative to `origin`
  Vector3 origin_W = Vector3::Zero();
  double body_radius = 0.0;  ///< no point of the moving body's surface is farther from the sphere's centre [m]
};

/// Memory of one cycle of `contact`; nothing in it survives the cycle. About 670 KiB, touched as far as used.
struct ContactWorkspace {
  ContactRows rows;
  ConstrainedStep step;
  NearPoints samples;
  NearPoints features;
  std::array<float, 2 * NearPoints::kCapacity> distances;  ///< to select rows by
};

/// Lengths of the contact solver, all from the voxel edge s and the margin m.
struct ContactLengths {
  double margin;               ///< m: the gap that is kept
  double rounding;             ///< of stored distances: a gap this much smaller is no smaller
  double wanted_margin;        ///< below it a gap may only grow, unless looking at the surface again does not help
  double least_margin;         ///< below it a gap may only grow
  double shortest_reach;       ///< near points are those within the reach
  double longest_reach;        ///< wanted; ContactSearch says what the fields allow
  double opening;              ///< a gap this much wider than the margin is no contact
  double largest_gain;         ///< that a point which started inside moves out in a sub-step
  double radius;               ///< R_max
  BoundingSphere sphere;       ///< around all sample points
  std::uint32_t point_budget;  ///< as Parameters
  CouplingMetric metric;

  /// In steady motion the reach is this much longer than the way.
  static constexpr double kReachOverWay = 1.25;

  static ContactLengths make(const Parameters& q) noexcept;
  static double shortest_reach_of(const Parameters& q) noexcept { return 0.125 * q.voxel_size; }

  /// Of a sub-step that is expected to go as far as `way`, where fields tell near from far up to `longest` [m].
  double reach_for(double way, double longest) const noexcept;
};

namespace detail {

/// What one sub-step knows about the surroundings at its start.
struct Surroundings {
  double left_out;  ///< `travel` up to which all points are free that are not near, or had no room [m]
  double smallest = std::numeric_limits<double>::infinity();  ///< stored distance of the near points
  bool swallowed = false;     ///< a point lies inside where the field does not say which way is out
  std::uint32_t dropped = 0;  ///< near points that found no room as rows
  std::uint32_t unseen = 0;   ///< points for which the budget did not suffice
};

/// Identifies feature points among contacts.
inline constexpr std::uint32_t kFeature = 1u << 31;

/// A contact between a point P (in S) and a surface whose distance grows along `gradient_S` as P moves.
struct ContactPoint {
  Vector3 point_S;
  Vector3 gradient_S;
};

/// Sample points: they move, the field stands in W.
struct SampleDirection {
  static constexpr std::uint32_t kId = 0;
  static Pose pose(const Pose& H_WS, const Vector3&) noexcept { return H_WS; }
  static ContactPoint contact(const Vector3& shell, const Vector3&, const Vector3& gradient,
                              const Matrix3& R_field_shell) noexcept {
    return {shell, R_field_shell.transpose() * gradient};
  }
  static Matrix3 from_S(const Matrix3& R_field_shell) noexcept { return R_field_shell; }
  static Vector3 point_S(const SampleBatch& batch, std::uint32_t k) noexcept {
    return {static_cast<double>(batch.x[k]), static_cast<double>(batch.y[k]), static_cast<double>(batch.z[k])};
  }

  static constexpr bool kStretches = false;
  double most_stretch() const noexcept { return 1.0; }
};

/// Feature points: they stand, the field moves with S. In S the point q moves by -(x + r x q).
struct FeatureDirection {
  static constexpr std::uint32_t kId = kFeature;
  static Pose pose(const Pose& H_WS, const Vector3& origin_W) noexcept {
    Pose H_WF;
    H_WF.translation = origin_W;
    return H_WS.inverse() * H_WF;
  }
  static ContactPoint contact(const Vector3&, const Vector3& field, const Vector3& gradient, const Matrix3&) noexcept {
    return {field, -gradient};
  }
  static Matrix3 from_S(const Matrix3&) noexcept { return -Matrix3::Identity(); }
  static Vector3 point_S(const SampleBatch& batch, std::uint32_t k) noexcept { return stored_position(batch, k); }

  FeatureDirection(const ContactLengths& lengths, double body_radius) noexcept
      : sphere(lengths.sphere), near_radius(body_radius + lengths.longest_reach) {}

  static constexpr bool kStretches = true;

  BoundingSphere sphere;  ///< in S; what is in it moves no farther than the odometer says
  double near_radius;     ///< about its centre: of the moving body's surface and, around it, the longest reach [m]

  double lever(const Vector3& q) const noexcept { return (q - sphere.center).norm(); }
  double stretch(double lever) const noexcept { return std::max(1.0, lever / sphere.radius); }
  /// Of the points that a motion within the longest reach can bring to the body: what is farther than near_radius from
  /// the sphere's centre comes nearer by the way of that alone.
  double most_stretch() const noexcept { return stretch(near_radius); }
};

inline constexpr double kFlat = 1e-3;     ///< a gradient this short has no direction
inline constexpr double kRecovery = 0.3;  ///< share of a lost margin that is regained at once

inline ContactRows::Gap gap_of(const ContactLengths& lengths) noexcept {
  return {lengths.margin, lengths.metric.tolerance, kRecovery, lengths.largest_gain};
}

/// Those of the chosen points of a batch that have a gradient with a direction, as rows while there is room; gives how
/// many found none.
template <class Direction>
std::uint32_t push_rows(const SampleBatch& batch, const std::uint32_t* index, std::uint64_t chosen, const Matrix3& R,
                        const ContactLengths& lengths, ContactRows& rows) noexcept {
  ContactRows::Batch contacts;
  std::uint32_t count = 0;
  for_each_bit(chosen & batch.known & steeper(batch, kFlat), [&](std::uint32_t k) noexcept {
    const std::uint32_t i = count++;
    const Vector3 point = Direction::point_S(batch, k);
    contacts.id[i] = Direction::kId | index[k];
    contacts.point_x[i] = point.x();
    contacts.point_y[i] = point.y();
    contacts.point_z[i] = point.z();
    contacts.gradient_x[i] = batch.gradient_x[k];
    contacts.gradient_y[i] = batch.gradient_y[k];
    contacts.gradient_z[i] = batch.gradient_z[k];
    contacts.distance[i] = batch.distance[k];
  });
  contacts.count = count;
  return rows.push(contacts, Direction::from_S(R), gap_of(lengths));
}

/// Step #1 of `contact`, one direction: all points with a clearance below `cut`, those of them with a gradient as rows
/// while there is room. `near` is empty before.
template <class Direction, DistanceField Field>
void find_near(NearSearch& search, const Direction& direction, const Field& field, const Pointshell& shell,
               const Pose& H, double way, double cut, const ContactLengths& lengths, NearPoints& near,
               ContactRows& rows, Surroundings& around) noexcept {
  const Matrix3 R = H.rotation.toRotationMatrix();
  const auto leave_out = [&](double clearance) noexcept {
    around.left_out = std::min(around.left_out, clearance / direction.most_stretch());
  };
  search.find(
      direction, field, shell, H, way, cut, PointBudget{lengths.point_budget, lengths.margin},
      [&](const SampleBatch& batch, const auto& index, std::uint64_t found) noexcept {
        const std::uint64_t held = near.push(index.data(), batch, found);
        for_each_bit(found & ~held, [&](std::uint32_t k) noexcept {
          leave_out(batch.clearance[k]);
          around.smallest = std::min(around.smallest, batch.distance[k]);
          around.swallowed |= batch.distance[k] <= 0.0;  // nothing will bring it out
          ++around.dropped;
        });
        for_each_bit(found & ~batch.known,
                     [&](std::uint32_t k) noexcept { around.swallowed |= batch.distance[k] < 0.0; });
        around.dropped += push_rows<Direction>(batch, index.data(), held, R, lengths, rows);
      },
      [&](double clearance) noexcept {
        leave_out(clearance);
        ++around.unseen;
      });
  around.smallest = std::min(around.smallest, near.least_distance());
  near.pad();
}

/// Rows of the chosen near points of one direction: those not farther than `deepest`, and every `stride`-th of the
/// others, which in the tree's order are spread over the surface.
template <class Direction, DistanceField Field>
void push_selected(const Field& field, const Pose& H, double deepest, std::uint32_t stride,
                   const ContactLengths& lengths, const NearPoints& near, ContactRows& rows) noexcept {
  const Matrix3 R = H.rotation.toRotationMatrix();
  SampleBatch batch;
  std::array<std::uint32_t, SampleBatch::kCapacity> index;
  const auto flush = [&]() noexcept {
    field.samples(H, batch);
    push_rows<Direction>(batch, index.data(), first_bits(batch.count), R, lengths, rows);
    batch.count = 0;
  };
  std::uint32_t others = 0;
  for (std::uint32_t k = 0; k < near.count && !rows.full(); ++k) {
    const bool chosen = near.distance[k] <= deepest || others++ % stride == 0;
    if (!chosen) continue;
    const std::uint32_t at = batch.count++;
    index[at] = near.index[k];
    batch.x[at] = near.x[k];
    batch.y[at] = near.y[k];
    batch.z[at] = near.z[k];
    if (batch.count == SampleBatch::kCapacity) flush();
  }
  if (batch.count > 0) flush();
}

/// Distance up to which near points are deepest (half of the rows' capacity), and the stride that spreads the rest over
/// the other half.
struct Selection {
  double deepest;
  std::uint32_t stride;
};
Selection select_rows(ContactWorkspace& workspace) noexcept;

/// Where a motion was found not to be free.
struct Obstacle {
  static constexpr std::uint32_t kNone = ~0u;
  std::uint32_t near = kNone;  ///< number of the near point for which none was last
  double way = 1.0;            ///< share of its chord
  bool exhausted = false;      ///< nothing in the way so far: free up to `way`, and no more balls
  FieldSample sample;          ///< there
};

/// Look-ups of the certificate, for chords that no kernel decides, that a cycle has left: what they do not cover is not
/// gone. Without vectors a flat face of a thousand points that slides by a millimetre a cycle takes 50000; with less
/// the god object would fall behind for good.
struct Budget {
  int balls = 1 << 17;
};

/// Free balls along the chord p0 p1, whose ends have the clearances c0 and c1, cover it; else the obstacle says where
/// not.
template <DistanceField Field>
bool chord_is_free(const Field& field, const Vector3& p0, double c0, const Vector3& p1, double c1, Budget& budget,
                   Obstacle& obstacle) noexcept {
  constexpr int kBalls = 64;
  const Vector3 way = p1 - p0;
  const double length = way.norm();
  double covered = c0;
  for (int ball = 0; ball < kBalls; ++ball) {
    if (covered + c1 >= length) return true;
    obstacle.way = covered / length;
    if (budget.balls <= 0) break;
    --budget.balls;
    obstacle.sample = field.sample(p0 + obstacle.way * way);
    if (!(obstacle.sample.clearance > 0.0)) return false;
    covered += obstacle.sample.clearance;
  }
  obstacle.exhausted = true;
  return false;
}

/// The certificate, one direction: no near point's chord from pose H0 to H1 meets the surface, and no gap shrinks below
/// the least margin. Points that started inside are let out. The point of `obstacle` is looked at first.
template <DistanceField Field>
bool motion_is_free(const Field& field, const Pose& H0, const Pose& H1, double kept, const ContactLengths& lengths,
                    const NearPoints& near, Budget& budget, Obstacle& obstacle) noexcept {
  obstacle.exhausted = false;
  if (near.count == 0) return true;
  const Matrix3 R0 = H0.rotation.toRotationMatrix();
  const Matrix3 R1 = H1.rotation.toRotationMatrix();
  SampleBatch ends;
  std::array<std::uint32_t, SampleBatch::kCapacity> number;
  const auto add = [&](std::uint32_t k) noexcept {
    const std::uint32_t at = ends.count++;
    number[at] = k;
    ends.x[at] = near.x[k];
    ends.y[at] = near.y[k];
    ends.z[at] = near.z[k];
    ends.from_clearance[at] = near.clearance[k];
    ends.from_distance[at] = near.distance[k];
  };
  const auto any_fails = [&]() noexcept {
    for (std::uint32_t i = ends.count; i % SampleBatch::kAtOnce != 0; ++i) ends.from_distance[i] = 0.0;
    field.samples(H1, ends);
    const std::uint64_t well = keeps_distance(ends, kept, lengths.rounding);
    std::uint64_t open = first_bits(ends.count) & ~(well & field.free_chords(H0, H1, ends));
    ends.count = 0;
    for (; open != 0; open &= open - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(open));
      const std::uint32_t k = number[i];
      const Vector3 p0 = R0 * near.point(k) + H0.translation;
      const bool is_free =
          chord_is_free(field, p0, near.clearance[k], stored_position(ends, i), ends.clearance[i], budget, obstacle);
      if (is_free && (well >> i & 1) != 0) continue;
      if (is_free) {
        obstacle.way = 1.0;
        obstacle.sample = stored_sample(ends, i);
      }
      obstacle.near = k;
      return true;
    }
    return false;
  };
  const Matrix3 turn = R1 - R0;
  const Vector3 shift = H1.translation - H0.translation;
  const std::uint32_t suspect = obstacle.near;
  if (suspect < near.count &&
      (near.leave_their_ball(suspect - suspect % 64, turn, shift, kept) >> suspect % 64 & 1) != 0) {
    add(suspect);
    if (any_fails()) return false;
  }
  for (std::uint32_t first = 0; first < near.count; first += 64) {
    std::uint64_t leaving = near.leave_their_ball(first, turn, shift, kept);
    if (suspect < near.count && suspect / 64 == first / 64) leaving &= ~(std::uint64_t{1} << suspect % 64);
    for (; leaving != 0; leaving &= leaving - 1) {
      add(first + static_cast<std::uint32_t>(std::countr_zero(leaving)));
      if (ends.count == SampleBatch::kCapacity && any_fails()) return false;
    }
  }
  return ends.count == 0 || !any_fails();
}

/// The surface as it looks from the obstacle, as one more row of the same point: where two faces of the field meet in a
/// valley, the gradient at the start knows only one of them. It asks for no more than the row at the start, so that
/// resting stays possible. False if there is no room or no gradient.
template <class Direction>
bool push_obstacle(const Pose& H0, const Pose& H1, const ContactLengths& lengths, const NearPoints& near,
                   const Obstacle& obstacle, ContactRows& rows) noexcept {
  if (rows.full() || !obstacle.sample.known || !(obstacle.sample.gradient.norm() > kFlat)) return false;
  const Matrix3 R0 = H0.rotation.toRotationMatrix();
  const Vector3 p = near.point(obstacle.near);
  const Vector3 p0 = R0 * p + H0.translation;
  const Vector3 way = obstacle.way * (H1 * p - p0);
  const ContactPoint contact = Direction::contact(p, p0, obstacle.sample.gradient, R0);
  const double steepness = contact.gradient_S.norm();
  // from the obstacle back to the start the distance changes by the gradient there
  const double need = (lengths.margin - obstacle.sample.distance + obstacle.sample.gradient.dot(way)) / steepness;
  rows.push(Direction::kId | near.index[obstacle.near], contact.gradient_S / steepness, contact.point_S,
            std::min(need, std::max(0.0, kRecovery * (lengths.margin - near.distance[obstacle.near]))));
  return true;
}

/// Reach of a cycle's first sub-step: the god object goes on as it did, or as the device did since the last cycle where
/// that is more, but no more than twice what it did. If it wants to go farther a second sub-step follows.
double first_reach(const State& state, const CycleInput& input, const ContactLengths& lengths, double longest) noexcept;

/// Largest share of the motion that points left out and the linearisation allow.
double allowed_share(const Motion& motion, const Surroundings& around, double reach, const ContactLengths& lengths,
                     bool constrained) noexcept;

/// How the surface looks at the points that hold the god object back where the motion from H0 to H1 has brought them.
struct Arrival {
  bool opened = false;     ///< one has left it: it came round an edge, where its row holds no longer
  double overshoot = 0.0;  ///< see `arrive`
};

/// Along the way v the energy of the coupling falls at first by |v|^2 a unit of way. Where the contact forces at the
/// end, whose multipliers lambda the rows know, point backwards, it rises there by
///     -sum of lambda (n_1 - n_0) . (p_1 - p_0) = overshoot |v|^2,
/// and by the secant it is least at 1 / (1 + overshoot) of the way. Above 1 the god object would go to and fro in a
/// valley of the field for ever.
template <DistanceField Field, DistanceField BodyField>
Arrival arrive(const Field& field, const Pointshell& shell, const FeatureContacts<BodyField>* features, const Pose& H0,
               const Pose& H1, const ContactLengths& lengths, const ConstrainedStep& step) noexcept {
  const Motion& v = step.motion;
  const double gyration = lengths.metric.gyration;
  const double squared_way = v.translation.squaredNorm() + gyration * gyration * v.rotation.squaredNorm();
  const double open = lengths.margin + lengths.opening;
  Arrival arrival;
  double rise = 0.0;
  for (std::uint32_t i = 0; i < step.force_count; ++i) {
    const ContactForce& force = step.forces[i];
    Vector3 normal_W = H0.rotation._transformVector(force.normal);
    Vector3 way_W;
    Vector3 gradient_W;
    double distance = 0.0;
    if ((force.id & kFeature) == 0) {
      const Vector3 p = shell.point(force.id);
      const Vector3 p1_W = H1 * p;
      const FieldSample sample = field.sample(p1_W);
      way_W = p1_W - H0 * p;
      gradient_W = sample.gradient;
      distance = sample.distance;
    } else if (features != nullptr) {
      const Vector3 q_W = features->origin_W + features->points.point(force.id & ~kFeature);
      const FieldSample sample = features->map.sample(H1.inverse() * q_W);
      way_W = H1 * (H0.inverse() * q_W) - q_W;
      gradient_W = -H1.rotation._transformVector(sample.gradient);
      distance = sample.distance;
    } else {
      continue;
    }
    arrival.opened |= distance > open;
    const double steepness = gradient_W.norm();
    if (steepness > kFlat) rise -= force.multiplier * (gradient_W / steepness - normal_W).dot(way_W);
  }
  if (rise > 0.0 && squared_way > 0.0) arrival.overshoot = rise / squared_way;
  return arrival;
}

/// Step #4: `least_constraint` with the workspace's faces. The motion ends in it but for what rounding and tolerances
/// leave.
inline void least_constraint_within(const WorkspaceBox& box, const Pose& H0, ContactRows& rows, const Motion& wanted,
                                    const CouplingMetric& metric, const ContactFriction* friction, const Motion& last,
                                    ConstrainedStep& step) noexcept {
  if (!box.limited) return least_constraint(rows, wanted, metric, friction, last, step);
  bool infeasible = false;
  push_within(box, metric.tolerance, [&](const Vector3& push_W) noexcept {
    Motion pushed = wanted;
    pushed.translation -= H0.rotation.conjugate()._transformVector(push_W);
    least_constraint(rows, pushed, metric, friction, last, step);
    infeasible |= step.infeasible;
    step.follows &= push_W.isZero(0.0);
    return H0 * step.motion.translation;
  });
  step.infeasible = infeasible;
}

/// Moves the origin of H1 to the nearest point of the workspace, and has the motion from H0 end there. Whether it had
/// to: then points may go farther than they did, though the origin does not (a turn about another point).
inline bool cut_off(const WorkspaceBox& box, const Pose& H0, Pose& H1, Motion& motion) noexcept {
  if (!box.limited || box.contains(H1.translation)) return false;
  H1.translation = box.nearest(H1.translation);
  motion.translation = H0.rotation.conjugate()._transformVector(H1.translation - H0.translation);
  return true;
}

/// What the sub-steps came to.
struct ContactResult {
  Pose H_WS;
  ConstrainedStep& step;
  double smallest = 0.0;       ///< stored distance at the last sub-step's start, of what was near
  std::uint32_t substeps = 0;  ///< with something near
  std::uint32_t dropped = 0;   ///< Surroundings' dropped and unseen
  bool cut = false;

  /// `storage`: of the step, which is the last one's at first.
  ContactResult(const State& state, ConstrainedStep& storage) noexcept : H_WS(state.H_WS), step(storage) {
    step = state.contact;
  }

  /// Nothing is in the way of the device.
  void follow(const Pose& H_WD) noexcept {
    H_WS = H_WD;
    step.release();
    smallest = std::numeric_limits<double>::infinity();
    dropped = 0;
    cut = false;
  }
};

/// Steps #6 and #7, the finite check, and the only place where `state` changes.
Status finish(const CycleInput& input, const ContactResult& result, bool inside, const Parameters& parameters,
              State& state, CycleReport& report) noexcept;

}  // namespace detail

/// What step #1 of `contact` remembers from cycle to cycle: where nothing can be near yet. Results do not depend on it.
struct ContactSearch {
  Odometer odometer;
  NearSearch samples;
  NearSearch features;
  double longest_reach = 0.0;  ///< `travel` of a sub-step beyond which no field tells near from far [m]

  /// Words that it remembers.
  static std::size_t memory(const Pointshell& shell, const Pointshell& features) noexcept {
    return NearSearch::memory(shell) + NearSearch::memory(features);
  }

  /// Begins anew. `memory`: as many words, which must outlive it; or none, then it looks everywhere in every cycle.
  template <DistanceField Field, DistanceField BodyField>
  void start(const Field& field, const Pointshell& shell, const FeatureContacts<BodyField>* feature_contacts,
             const ContactLengths& lengths, std::span<std::uint32_t> memory) noexcept {
    odometer.reset();
    longest_reach = std::min(lengths.longest_reach, field.assured_clearance());
    const std::size_t of_samples = memory.empty() ? 0 : NearSearch::memory(shell);
    if (feature_contacts != nullptr) {
      const BodyField& map = feature_contacts->map;
      const double stretch = detail::FeatureDirection{lengths, feature_contacts->body_radius}.most_stretch();
      longest_reach = std::min(longest_reach, map.assured_clearance() / stretch);
      features.start(memory.subspan(of_samples), feature_contacts->points, map.lipschitz(), stretch * longest_reach);
    } else {
      features.start_without_shell();
    }
    samples.start(memory.first(of_samples), shell, field.lipschitz(), longest_reach);
  }

  /// The last look knows that in a motion with a `travel` of `way` from here no clearance will be below `cut`, at most
  /// the longest reach.
  bool is_free(double way, double cut) const noexcept {
    return samples.is_free(odometer.way() + way, cut) && features.is_free(odometer.way() + way, cut);
  }
};

/// One cycle of `contact`: least-constraint motion over the contact points, in certified sub-steps; no filter.
///
/// Each sub-step (at most kMaxSubsteps, one in steady contact): near points and rows of both directions; the motion
/// nearest to the device that all rows allow; shortened until no chord of any point meets a stored surface. What was
/// shortened is gone on with, and so is a motion that brought a contact round an edge. One that would go beyond the
/// bottom of a valley of the field ends there.
///
/// Guarantee: a point whose stored distance is positive keeps it so, whatever the device does: points left out are free
/// for the motion they are bounded for, the others' chords are looked at all along. (Not before the first pose's
/// penetration is left, see below.)
///
/// A point that may be near but is not looked up, because the budget is spent, is left out and free for as far as its
/// bound says: then the god object may lag, which is counted, but it crosses nothing.
///
/// Bounds: a look-up a point and attempt (at most 14 a sub-step), Budget::balls for the chords, 7 solves a sub-step.
///
/// A first pose that penetrates is left by moving out along the gradients; where they contradict each other or the
/// field does not know the way (deeper than the band), the god object goes with the device, without force, until it is
/// free. `features` may be null. Real-time safe; times: step #1 holds every look-up, the certificate's as well.
template <bool kFriction, DistanceField Field, DistanceField BodyField>
Status contact_cycle(const Field& field, const Pointshell& shell, const FeatureContacts<BodyField>* features,
                     const Parameters& q, const CycleInput& input, ContactSearch& search, State& state,
                     ContactWorkspace& workspace, CycleReport& report, StepTimes* times = nullptr) noexcept {
  using detail::FeatureDirection;
  using detail::SampleDirection;
  constexpr int kSecondLooks = 6;  // at what stood in the way
  constexpr int kAttempts = 14;
  constexpr double kOvershoot = 0.5;
  constexpr std::uint32_t kFreeSubsteps = 64;
  detail::begin(times);
  const ContactLengths lengths = ContactLengths::make(q);
  const ContactFriction friction{q.friction.static_ratio, q.friction.kinetic_ratio,
                                 q.friction.viscous / (q.stiffness * q.coupling_translation * q.period)};
  const Vector3 origin_W = features != nullptr ? features->origin_W : Vector3::Zero();
  const SampleDirection sample_direction;
  const FeatureDirection feature_direction(lengths, features != nullptr ? features->body_radius : 0.0);

  detail::ContactResult result(state, workspace.step);
  const Motion wanted = unconstrained_motion(state.H_WS, input.H_WD);
  Motion last = state.contact.motion;
  bool inside = state.inside;
  bool opened = false;
  Motion whole;
  detail::Budget budget;
  double reach = 0.0;
  double most_reach = 0.0;
  double longest_way = 0.0;  // of the sub-steps, by travel [m]
  // beyond it a gap does not hold a motion back that it is free for, and is not told
  const double free_cut = std::min(std::max(lengths.margin, lengths.shortest_reach), search.longest_reach);
  std::uint32_t free_substeps = 0;
  do {
    const Pose H0 = result.H_WS;
    const bool first = result.substeps + free_substeps == 0;
    const Motion free = first ? wanted : unconstrained_motion(H0, input.H_WD);  // #3 (32), (33)
    const double free_way = travel(lengths.sphere, free);
    if (!first) detail::end(times, &StepTimes::solve_ns);  // #1
    search.odometer.move_to(H0, lengths.sphere);
    if (search.is_free(free_way, free_cut)) {
      result.follow(input.H_WD);
      inside = false;
      break;
    }
    if (first) reach = detail::first_reach(state, input, lengths, search.longest_reach);
    detail::Surroundings around{.left_out = reach};
    workspace.rows.count = 0;
    const double gone = search.odometer.way();
    workspace.samples.count = 0;
    if (!search.samples.is_free(gone, reach)) {
      detail::find_near(search.samples, sample_direction, field, shell, H0, gone, reach, lengths, workspace.samples,
                        workspace.rows, around);
    }
    workspace.features.count = 0;
    Pose H0_features;
    const double feature_reach = reach * feature_direction.most_stretch();
    if (features != nullptr && !search.features.is_free(gone, feature_reach)) {
      H0_features = FeatureDirection::pose(H0, origin_W);
      detail::find_near(search.features, feature_direction, features->map, features->points, H0_features, gone,
                        feature_reach, lengths, workspace.features, workspace.rows, around);
    }
    if (around.dropped > 0) {
      const detail::Selection selection = detail::select_rows(workspace);
      workspace.rows.count = 0;
      detail::push_selected<SampleDirection>(field, H0, selection.deepest, selection.stride, lengths, workspace.samples,
                                             workspace.rows);
      if (features != nullptr && workspace.features.count > 0) {
        detail::push_selected<FeatureDirection>(features->map, H0_features, selection.deepest, selection.stride,
                                                lengths, workspace.features, workspace.rows);
      }
    }
    detail::end(times, &StepTimes::step1_ns);
    result.smallest = around.smallest;
    result.dropped = around.dropped + around.unseen;
    // a point inside has no clearance, so it is near; the first pose is judged by both directions
    inside = (inside || (first && !state.started)) && around.smallest <= 0.0;
    const bool alone = workspace.samples.count + workspace.features.count == 0;
    if (alone) {
      ++free_substeps;
    } else {
      ++result.substeps;
    }
    if (alone &&
        (search.is_free(free_way, free_cut) || detail::allowed_share(free, around, reach, lengths, false) == 1.0)) {
      result.follow(input.H_WD);
      break;
    }

    const ContactFriction* const cone = kFriction ? &friction : nullptr;
    detail::least_constraint_within(q.workspace, H0, workspace.rows, free, lengths.metric, cone, last,
                                    result.step);                  // #4
    if (inside && (around.swallowed || result.step.infeasible)) {  // nobody knows the way out: with the device
      result.step = ConstrainedStep{};
      result.H_WS = input.H_WD;
      result.cut = false;
      break;
    }

    double share = detail::allowed_share(result.step.motion, around, reach, lengths, workspace.rows.count > 0);
    Motion motion;
    Pose H1;
    detail::Obstacle at_sample, at_feature;
    int looks = kSecondLooks;
    bool shortened = false;
    opened = false;
    for (int attempt = 0;; ++attempt) {
      if (attempt == kAttempts) {
        H1 = H0;
        motion = Motion{};
        share = 0.0;
        break;
      }
      motion = {share * result.step.motion.translation, share * result.step.motion.rotation};
      H1 = result.step.follows && share == 1.0 ? input.H_WD : H0 * set_matrix(motion);
      if (detail::cut_off(q.workspace, H0, H1, motion) && travel(lengths.sphere, motion) > around.left_out) {
        share *= 0.5;
        shortened = false;
        continue;
      }
      detail::end(times, &StepTimes::solve_ns);  // the certificate
      Pose H1_features;
      const double kept = looks > 0 ? lengths.wanted_margin : lengths.least_margin;
      const bool samples_free =
          detail::motion_is_free(field, H0, H1, kept, lengths, workspace.samples, budget, at_sample);
      bool features_free = true;
      if (features != nullptr && workspace.features.count > 0) {
        H1_features = FeatureDirection::pose(H1, origin_W);
        features_free = detail::motion_is_free(features->map, H0_features, H1_features, kept, lengths,
                                               workspace.features, budget, at_feature);
      }
      const bool is_free = samples_free && features_free;
      detail::Arrival arrival;
      if (is_free && share == 1.0 && travel(lengths.sphere, motion) > lengths.metric.tolerance) {
        arrival = detail::arrive(field, shell, features, H0, H1, lengths, result.step);
      }
      detail::end(times, &StepTimes::step1_ns);
      if (arrival.overshoot > kOvershoot) {
        share = 1.0 / (1.0 + arrival.overshoot);
        shortened = true;
        continue;
      }
      opened = arrival.opened;
      if (is_free) break;
      shortened = false;
      if (at_sample.exhausted || at_feature.exhausted) {
        const double way =
            std::min(at_sample.exhausted ? at_sample.way : 1.0, at_feature.exhausted ? at_feature.way : 1.0);
        share *= attempt < kSecondLooks ? way : std::min(way, 0.25);
        continue;
      }
      bool seen = false;
      if (looks > 0 && !samples_free) {
        seen = detail::push_obstacle<SampleDirection>(H0, H1, lengths, workspace.samples, at_sample, workspace.rows);
      }
      if (features != nullptr && looks > 0 && !features_free) {
        seen = detail::push_obstacle<FeatureDirection>(H0_features, H1_features, lengths, workspace.features,
                                                       at_feature, workspace.rows) ||
               seen;
      }
      looks = seen ? looks - 1 : 0;
      if (seen) {
        const bool infeasible = result.step.infeasible;
        detail::least_constraint_within(q.workspace, H0, workspace.rows, free, lengths.metric, cone, last, result.step);
        result.step.infeasible |= infeasible;
        share = detail::allowed_share(result.step.motion, around, reach, lengths, true);
      } else {
        share *= attempt < kSecondLooks ? 0.5 : 0.25;
      }
    }
    const double rest = (1.0 - share) * travel(lengths.sphere, result.step.motion);
    result.step.motion = motion;
    last = motion;
    whole.translation += motion.translation;
    whole.rotation += motion.rotation;
    result.H_WS = H1;
    result.cut = share < 1.0 && !shortened;
    if (share == 0.0) break;
    most_reach = std::min(std::max(most_reach, 2.0 * reach), search.longest_reach);
    longest_way = std::max(longest_way, travel(lengths.sphere, motion));
    // what is left of a motion that was cut may change its direction, but is seldom twice as long; what follows one
    // that went round an edge is seldom longer than all before
    const double expected = result.cut ? 2.0 * rest : longest_way;
    reach = std::min(most_reach, lengths.reach_for(expected, search.longest_reach));
  } while ((result.cut || opened) && !inside && budget.balls > 0 && result.substeps < kMaxSubsteps &&
           free_substeps < kFreeSubsteps);
  if (result.substeps == 0 && result.step.follows) {
    result.step.motion = wanted;  // however many pieces it came in
  } else if (result.substeps + free_substeps > 1) {
    // whether a point slipped is a matter of the whole cycle; the sum keeps the slip of a point that stuck at nought
    result.step.motion = whole;
  }

  const Status status = detail::finish(input, result, inside, q, state, report);  // #6, #7
  detail::end(times, &StepTimes::solve_ns);
  return status;
}

}  // namespace godobject
