#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "core/pipeline/contact/contact_directions.h"
#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/contact_limits.h"
#include "core/pipeline/contact/contact_memory.h"
#include "core/pipeline/contact/search/kept_search.h"
#include "core/scene/sample_bits.h"

/// Step #1 of `contact`: the near points of one direction, and their rows.
namespace godobject::detail {

/// Appends rows for the chosen points of a batch that have a gradient, while there is room. Returns how many found
/// none. `index`: the points' numbers in the shell; `chosen`: a bit mask; `R`: rotation from the shell's to the field's
/// frame.
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
  return rows.push(contacts, Direction::from_S(R), lengths.gap_law());
}

/// Finds all points of one direction with a clearance below `search_radius` [m], and appends rows for those with a
/// gradient while there is room. Of points beyond `exact_radius` [m] only bounds are listed, without rows: once the
/// motion meets one, look_up_bounded makes rows of them. `H`: pose of the shell in the field's frame;
/// `travelled`: the odometer's reading there [m]; `near` must be empty, unless the search `goes_on`: see
/// NearSearch::find. Adds to `rows`, `around` and `work`. False: as NearSearch::find. Cost: NearSearch::find. Real-time
/// safe.
template <class Direction, DistanceField Field>
bool find_near(NearSearch& search, const Direction& direction, const Field& field, const Pointshell& shell,
               const Pose& H, double travelled, double search_radius, double exact_radius,
               const ContactLengths& lengths, const PointBudget& budget, WorkMeter& work, NearPoints& near,
               ContactRows& rows, Surroundings& around, bool goes_on = false) noexcept {
  const Matrix3 R = H.rotation.toRotationMatrix();
  const auto limit_displacement = [&](double clearance) noexcept {
    around.free_displacement = std::min(around.free_displacement, clearance / direction.most_stretch());
  };
  const bool has_all = search.find(
      direction, field, shell, H, travelled, search_radius, exact_radius, budget, work,
      [&](const SampleBatch& batch, const auto& index, std::uint64_t found) noexcept {
        const std::uint32_t before = near.count;
        const std::uint64_t stored = near.push(index.data(), batch, found);
        work.add(Work::kNear, near.count - before);
        for_each_bit(found & ~stored, [&](std::uint32_t k) noexcept {
          limit_displacement(batch.clearance[k]);
          around.smallest = std::min(around.smallest, batch.distance[k]);
          around.swallowed |= batch.distance[k] <= 0.0;  // no row moves it out
          ++around.unlisted;
        });
        for_each_bit(found & ~batch.known,
                     [&](std::uint32_t k) noexcept { around.swallowed |= batch.distance[k] < 0.0; });
        around.lacks_rows |= push_rows<Direction>(batch, index.data(), stored, R, lengths, rows) > 0;
      },
      [&](const PointBatch& batch, const auto& index, std::uint64_t bounded) noexcept {
        const std::uint64_t stored = near.push_bounds(index.data(), batch, bounded);
        for_each_bit(bounded & ~stored, [&](std::uint32_t k) noexcept {
          limit_displacement(static_cast<double>(batch.clearance[k]));
          ++around.unlisted;
        });
      },
      [&](double clearance) noexcept {
        limit_displacement(clearance);
        ++around.unseen;
      },
      goes_on);
  around.smallest = std::min(around.smallest, near.least_distance());
  near.pad();
  return has_all;
}

/// Looks up the listed points exactly of which only a bound is known, and whose ball the motion from H0 to H1 leaves:
/// poses of the shell in the field's frame. Appends their rows while there is room, and sets `lacks_rows` once there is
/// none. Returns whether there was such a point. Adds to `rows` and `work`. Cost: a look-up for each of them. Real-time
/// safe.
template <class Direction, DistanceField Field>
bool look_up_bounded(const Field& field, const Pose& H0, const Pose& H1, const ContactLengths& lengths,
                     NearPoints& near, ContactRows& rows, bool& lacks_rows, WorkMeter& work) noexcept {
  const Matrix3 R0 = H0.rotation.toRotationMatrix();
  const Matrix3 turn = H1.rotation.toRotationMatrix() - R0;
  const Vector3 shift = H1.translation - H0.translation;
  SampleBatch batch;
  std::array<std::uint32_t, SampleBatch::kCapacity> place;
  std::array<std::uint32_t, SampleBatch::kCapacity> number;
  bool found = false;
  for (std::uint32_t first = 0; first < near.bounded && !work.is_spent(); first += 64) {
    work.add(Work::kScan, 64);
    batch.count = 0;
    for_each_bit(near.leave_their_ball(first, turn, shift, lengths.margin), [&](std::uint32_t bit) noexcept {
      const std::uint32_t i = first + bit;
      if (!near.is_bound_only(i)) return;
      const std::uint32_t k = batch.count++;
      place[k] = i;
      number[k] = near.index[i];
      batch.x[k] = near.x[i];
      batch.y[k] = near.y[i];
      batch.z[k] = near.z[i];
    });
    if (batch.count == 0) continue;
    work.add(Work::kPoint, batch.count);
    work.add(Work::kNear, batch.count);
    field.samples(H0, batch);
    for (std::uint32_t k = 0; k < batch.count; ++k) near.set(place[k], batch, k);
    lacks_rows |= push_rows<Direction>(batch, number.data(), first_bits(batch.count), R0, lengths, rows) > 0;
    found = true;
  }
  return found;
}

/// The choice among more near points than rows.
struct Selection {
  double deepest;        ///< points up to this distance become rows: half of the capacity [m]
  std::uint32_t stride;  ///< every stride-th of the others becomes a row: a quarter of the capacity
};
/// Returns the choice among the near points of both directions. It leaves a quarter of the capacity for rows that the
/// motion turns out to need. Cost: linear in their number. Real-time safe.
Selection select_rows(ContactWorkspace& workspace) noexcept;

/// The row of a near point: the normal component of the point's displacement has to reach the required gain.
struct NearRow {
  bool exists = false;     ///< false: no gradient is known at the point; then the rest is not set
  Vector3 point_S;         ///< [m]
  Vector3 normal_S;        ///< unit vector along which the distance grows
  double required_gain{};  ///< [m]
};

/// Computes rows of near points of one direction, from the gradients in their list. H: pose of the shell in the field's
/// frame. `regain`: share of what the gap law demands of lost gaps; with 0 they only must not shrink. Real-time safe.
template <class Direction>
class NearRows {
 public:
  NearRows(const NearPoints& near, const Pose& H, const ContactLengths& lengths, double regain) noexcept
      : near_(near), H_(H), R_(H.rotation.toRotationMatrix()), law_(lengths.gap_law()), regain_(regain) {}

  /// Returns the row of near point `k`.
  NearRow row(std::uint32_t k) const noexcept {
    const Vector3 p = near_.point(k);
    const ContactPoint contact = Direction::contact(p, R_ * p + H_.translation, near_.gradient(k), R_);
    const double steepness = contact.gradient_S.norm();
    NearRow row;
    if (!(steepness > kFlat)) return row;
    const double gain = law_.required_gain((law_.margin - near_.distance[k]) / steepness);
    row.exists = true;
    row.point_S = contact.point_S;
    row.normal_S = contact.gradient_S / steepness;
    row.required_gain = gain > 0.0 ? regain_ * gain : gain;
    return row;
  }

  /// Appends the row of near point `k` if it exists and there is room.
  void push(std::uint32_t k, ContactRows& rows) const noexcept {
    const NearRow near_row = row(k);
    if (!near_row.exists || rows.full()) return;
    rows.push(Direction::kId | near_.index[k], near_row.normal_S, near_row.point_S, near_row.required_gain);
  }

 private:
  const NearPoints& near_;
  const Pose& H_;
  const Matrix3 R_;
  const GapLaw law_;
  const double regain_;
};

/// Appends rows for the selected near points of one direction; H is the pose of the shell in the field's frame. In the
/// tree's order every k-th point is spread over the surface. Real-time safe.
template <class Direction>
void push_selected(const Pose& H, const Selection& selection, const ContactLengths& lengths, const NearPoints& near,
                   ContactRows& rows) noexcept {
  const NearRows<Direction> near_rows(near, H, lengths, 1.0);
  std::uint32_t others = 0;
  for (std::uint32_t k = 0; k < near.count && !rows.full(); ++k) {
    if (near.is_bound_only(k)) continue;
    if (near.distance[k] <= selection.deepest || others++ % selection.stride == 0) near_rows.push(k, rows);
  }
}

/// Appends rows of near points that the step would violate: of each 64 neighbours in the tree's order the one that is
/// violated most. `regain`: as in NearRows; after a step without a common solution it is 0. Returns the number of such
/// groups, also of those that found no room. H is the pose of the shell in the field's frame. Cost: some 10
/// instructions a near point. Real-time safe.
template <class Direction>
std::uint32_t push_violated(const Pose& H, const ConstrainedStep& step, const ContactLengths& lengths, double regain,
                            const NearPoints& near, ContactRows& rows) noexcept {
  const double tolerance = 2.0 * lengths.metric.tolerance;  // rows of the step are met within one
  const Motion& motion = step.motion;
  const NearRows<Direction> near_rows(near, H, lengths, step.infeasible ? 0.0 : regain);
  const ShellDisplacement displacement = Direction::displacement(H, motion);
  std::uint32_t groups = 0;
  for (std::uint32_t first = 0; first < near.count; first += 64) {
    double most = tolerance;
    std::uint32_t worst = ContactRows::kNone;
    for_each_bit(near.end_below(first, displacement.turn, displacement.shift, lengths.margin),
                 [&](std::uint32_t i) noexcept {
                   const NearRow row = near_rows.row(first + i);
                   if (!row.exists) return;
                   const double gain = row.normal_S.dot(motion.translation + motion.rotation.cross(row.point_S));
                   const double violation = row.required_gain - gain;
                   if (!(violation > most)) return;
                   most = violation;
                   worst = first + i;
                 });
    if (worst == ContactRows::kNone) continue;
    ++groups;
    near_rows.push(worst, rows);
  }
  return groups;
}

}  // namespace godobject::detail
