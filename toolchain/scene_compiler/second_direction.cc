#include "toolchain/scene_compiler/second_direction.h"

#include <algorithm>
#include <span>

#include "toolchain/scene_compiler/relief.h"

namespace godobject::scene_compiler {
namespace {

constexpr double kAim = 0.85;  // of what is wanted: places between those that points are added for are a little worse
constexpr double kLeastPart = 0.25;  // of the aim, that the still surface may fall
constexpr int kRounds = 6;           // of adding; each looks at other places than the one before
constexpr std::uint32_t kFirstSeed = 11;
constexpr double kFurthest = 1.5;      // coverages, that the still body is looked at
constexpr double kRoughPart = 0.4;     // of the aim: a smaller fall needs no dense places
constexpr double kAskedFall = 0.93;    // of what the moving surface may fall, when points are added
constexpr double kAskedStretch = 1.2;  // instead of kStretch: for places in between, too
constexpr double kFinePart = 0.5;      // of the aim, between places where the surface falls soon

/// The largest fall over `reach` among the places that fall no more than `fall`.
double gentle_fall(const Relief& relief, double fall, double reach) {
  double largest = 0.0;
  for (const Gap& gap : gaps_of(relief, {}, {fall, reach, 1.0})) {
    if (gap.fall <= fall) largest = std::max(largest, gap.fall);
  }
  return largest;
}

double largest_fall(std::span<const Gap> gaps, double direct) {
  double largest = 0.0;
  for (const Gap& gap : gaps) {
    if (gap.distance > direct) largest = std::max(largest, gap.fall);
  }
  return largest;
}

void append(const std::vector<SurfaceSample>& more, std::vector<SurfaceSample>& samples) {
  samples.insert(samples.end(), more.begin(), more.end());
}

}  // namespace

BothDirections see_both_directions(const OuterSurface& still, const OuterSurface& moving, double wanted,
                                   MovingSampling& sampling, const Progress& progress) {
  BothDirections both;
  const double aim = kAim * wanted;
  const double coverage = largest_gap(moving, sampling.samples);
  const std::uint64_t most =
      std::min<std::uint64_t>(std::uint64_t{kMostPointsForOne} * sampling.points, format::kMaxPoints);
  const Relief::Resolution resolution{coverage, kRoughPart * aim, kFinePart * aim};
  double moving_fall = 0.0;  // what is asked of either surface
  double still_fall = 0.0;
  double reach = 0.0;
  for (int round = 0;; ++round) {
    const std::uint32_t seed = kFirstSeed + static_cast<std::uint32_t>(round);
    const auto share = [&](double part) { return (round + part) / (kRounds + 1); };
    const Relief on_still(still, resolution, seed, part_of(progress, share(0.0), share(0.5)));
    const Relief on_moving(moving, resolution, seed, part_of(progress, share(0.5), share(1.0)));
    both.area = on_still.area();
    if (round == 0) {
      still_fall = std::max(gentle_fall(on_still, 0.5 * aim, coverage), kLeastPart * aim);
      moving_fall = aim - still_fall;
    }
    const auto moving_gaps = [&] {
      return gaps_of(on_moving, sampling.samples, {moving_fall, 2.0 * coverage, kStretch});
    };
    const auto reach_of = [&](const std::vector<Gap>& gaps) {
      return std::min(largest_reach(gaps, aim), kFurthest * coverage);
    };
    std::vector<Gap> gaps;
    std::vector<Gap> still_gaps;
    if (round > 0) {
      gaps = moving_gaps();
      reach = reach_of(gaps);
      still_gaps = gaps_of(on_still, both.features, {still_fall, reach * kStretch, 1.0 / kStretch});
      both.between = bound_between(gaps, still_gaps, reach);
      if (both.between.bound <= wanted || round == kRounds) break;
    }
    append(points_to_add(on_moving, sampling.samples, {aim, kAskedFall * moving_fall, coverage, kStretch, true}, gaps,
                         most - sampling.samples.size()),
           sampling.samples);
    if (round == 0) {
      gaps = moving_gaps();
      still_fall = std::max(aim - largest_fall(gaps, aim), still_fall);
      reach = reach_of(gaps);
    }
    append(points_to_add(on_still, both.features, {aim, still_fall, reach * kAskedStretch, 1.0 / kAskedStretch, false},
                         still_gaps, kMostFeatures - both.features.size()),
           both.features);
  }
  both.added_points = static_cast<std::uint32_t>(sampling.samples.size()) - sampling.points;
  if (progress) progress(1.0);
  return both;
}

}  // namespace godobject::scene_compiler
