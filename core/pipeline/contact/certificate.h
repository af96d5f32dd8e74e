#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/contact_limits.h"
#include "core/pipeline/contact/search/near_points.h"
#include "core/pipeline/cycle/work.h"
#include "core/scene/field.h"
#include "core/scene/sample_bits.h"

/// The certificate of `contact`. It accepts a motion only if the chord of every near point, from the old pose to the
/// new one, meets no stored surface, and no gap shrinks below the least margin. Other points need no look-up: the
/// motion is short enough that their clearance covers it (`Surroundings::free_displacement`). So a point whose stored
/// distance is positive never gets one <= 0.
///
/// A chord is free if the balls at its two ends (radius: FieldSample::clearance) cover it, if a kernel proves it cell
/// by cell (DistanceField::free_chords), or if further free balls along the chord cover it.
namespace godobject::detail {

/// The first near point whose chord was not proved free.
struct Obstacle {
  static constexpr std::uint32_t kNone = ~0u;
  std::uint32_t near = kNone;  ///< number of the near point; kNone: no motion has failed yet
  double share = 1.0;          ///< share of its chord at which `sample` was looked up [1]
  bool exhausted = false;      ///< the chord is free up to `share`, but the look-ups were used up
  FieldSample sample;          ///< the field at `share`
};

/// The remaining look-ups for free balls in a cycle, and its meter of work.
struct Budget {
  WorkMeter& work;
  int balls = kMostBallsOfCycle;

  /// Counts a ball. False: there is none left.
  bool take_ball() noexcept {
    if (balls <= 0 || work.is_spent()) return false;
    --balls;
    work.add(Work::kBall);
    return true;
  }
};

/// Tells whether free balls cover the chord from p0 to p1, in the field's frame [m]; c0 and c1 are the clearances at
/// its ends [m]. If they do not, `obstacle` receives the place. Cost: at most kMostBallsOfChord look-ups. Real-time
/// safe.
template <DistanceField Field>
bool chord_is_free(const Field& field, const Vector3& p0, double c0, const Vector3& p1, double c1, Budget& budget,
                   Obstacle& obstacle) noexcept {
  const Vector3 chord = p1 - p0;
  const double length = chord.norm();
  double covered = c0;
  for (int ball = 0; ball < kMostBallsOfChord; ++ball) {
    if (covered + c1 >= length) return true;
    obstacle.share = covered / length;
    if (!budget.take_ball()) break;
    obstacle.sample = field.sample(p0 + obstacle.share * chord);
    if (!(obstacle.sample.clearance > 0.0)) return false;
    covered += obstacle.sample.clearance;
  }
  obstacle.exhausted = true;
  return false;
}

/// The certificate of one direction for a motion of the shell from pose H0 to H1 in the field's frame.
template <DistanceField Field>
class Certificate {
 public:
  /// `least_gap`: no gap may shrink below it [m]. `rounding`: of stored distances [m].
  Certificate(const Field& field, const Pose& H0, const Pose& H1, double least_gap, double rounding,
              const NearPoints& near, Budget& budget, Obstacle& obstacle) noexcept
      : field_(field),
        H0_(H0),
        H1_(H1),
        R0_(H0.rotation.toRotationMatrix()),
        least_gap_(least_gap),
        rounding_(rounding),
        near_(near),
        budget_(budget),
        obstacle_(obstacle) {}

  /// Tells whether all chords are free. Points that start inside may move freely. The point of `obstacle` is tested
  /// first, since it is the most likely to fail again.
  bool holds() noexcept {
    const Matrix3 turn = H1_.rotation.toRotationMatrix() - R0_;
    const Vector3 shift = H1_.translation - H0_.translation;
    const std::uint32_t suspect = obstacle_.near;
    const bool has_suspect = suspect < near_.count;
    if (has_suspect && (leaving(suspect - suspect % 64, turn, shift) >> suspect % 64 & 1) != 0) {
      add(suspect);
      if (any_fails()) return false;
    }
    for (std::uint32_t first = 0; first < near_.count; first += 64) {
      budget_.work.add(Work::kScan, 64);
      std::uint64_t open = leaving(first, turn, shift);
      if (has_suspect && suspect / 64 == first / 64) open &= ~(std::uint64_t{1} << suspect % 64);
      for (; open != 0; open &= open - 1) {
        add(first + static_cast<std::uint32_t>(std::countr_zero(open)));
        if (ends_.count == SampleBatch::kCapacity && any_fails()) return false;
      }
    }
    return ends_.count == 0 || !any_fails();
  }

 private:
  /// Returns a bit mask of the 64 near points from `first` on: those whose own ball does not cover the chord.
  std::uint64_t leaving(std::uint32_t first, const Matrix3& turn, const Vector3& shift) const noexcept {
    return near_.leave_their_ball(first, turn, shift, least_gap_);
  }

  void add(std::uint32_t k) noexcept {
    const std::uint32_t at = ends_.count++;
    number_[at] = k;
    ends_.x[at] = near_.x[k];
    ends_.y[at] = near_.y[k];
    ends_.z[at] = near_.z[k];
    ends_.from_clearance[at] = near_.clearance[k];
    ends_.from_distance[at] = near_.distance[k];
  }

  /// Looks up the ends of the chords in the batch and empties it. True: a chord was not proved free.
  bool any_fails() noexcept {
    if (budget_.work.is_spent()) {
      obstacle_.exhausted = true;
      obstacle_.share = 0.0;
      return true;
    }
    budget_.work.add(Work::kChord, ends_.count);
    for (std::uint32_t i = ends_.count; i % SampleBatch::kAtOnce != 0; ++i) ends_.from_distance[i] = 0.0;
    field_.samples(H1_, ends_);
    const std::uint64_t keeps_gap = keeps_distance(ends_, least_gap_, rounding_);
    std::uint64_t open = first_bits(ends_.count) & ~(keeps_gap & field_.free_chords(H0_, H1_, ends_));
    ends_.count = 0;
    for (; open != 0; open &= open - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(open));
      if (fails(i, (keeps_gap >> i & 1) != 0)) return true;
    }
    return false;
  }

  bool fails(std::uint32_t i, bool keeps_gap) noexcept {
    const std::uint32_t k = number_[i];
    const Vector3 p0 = R0_ * near_.point(k) + H0_.translation;
    const bool is_free = chord_is_free(field_, p0, near_.clearance[k], stored_position(ends_, i), ends_.clearance[i],
                                       budget_, obstacle_);
    if (is_free && keeps_gap) return false;
    if (is_free) {
      obstacle_.share = 1.0;
      obstacle_.sample = stored_sample(ends_, i);
    }
    obstacle_.near = k;
    return true;
  }

  const Field& field_;
  const Pose& H0_;
  const Pose& H1_;
  const Matrix3 R0_;
  double least_gap_;
  double rounding_;
  const NearPoints& near_;
  Budget& budget_;
  Obstacle& obstacle_;
  SampleBatch ends_;
  std::array<std::uint32_t, SampleBatch::kCapacity> number_;
};

/// Tells whether the certificate holds for the motion of one direction from H0 to H1. If not, `obstacle` receives the
/// first chord that failed. Real-time safe.
template <DistanceField Field>
bool motion_is_free(const Field& field, const Pose& H0, const Pose& H1, double least_gap, const ContactLengths& lengths,
                    const NearPoints& near, Budget& budget, Obstacle& obstacle) noexcept {
  obstacle.exhausted = false;
  if (near.count == 0) return true;
  return Certificate<Field>(field, H0, H1, least_gap, lengths.rounding, near, budget, obstacle).holds();
}

}  // namespace godobject::detail
