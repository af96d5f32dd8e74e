#include "toolchain/scene_compiler/second_direction.h"

#include <algorithm>
#include <span>

#include "toolchain/scene_compiler/relief.h"

namespace godobject::scene_compiler {
namespace {

constexpr double kAim = 0.85;  // of what is wanted: places between those that points are added for are a little worse
constexpr int kRounds = 2;     // of adding; each looks at other places than the one before
constexpr std::uint32_t kFirstSeed = 11;
constexpr double kFurthest = 1.5;  // reach, of the coverage that was measured

/// The largest fall over `reach` among the places that fall no more than `fall`.
double gentle_fall(const Relief& relief, double fall, double reach) {
  double largest = 0.0;
  for (const Gap& gap : gaps_of(relief, {}, reach)) {
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
  const Relief::Resolution resolution{coverage, 0.5 * aim, aim};
  for (int round = 0;; ++round) {
    const std::uint32_t seed = kFirstSeed + static_cast<std::uint32_t>(round);
    const auto share = [&](double part) { return (round + part) / (kRounds + 1); };
    const Relief on_still(still, resolution, seed, part_of(progress, share(0.0), share(0.5)));
    const Relief on_moving(moving, resolution, seed, part_of(progress, share(0.5), share(1.0)));
    both.area = on_still.area();
    const auto moving_gaps = [&] { return gaps_of(on_moving, sampling.samples, 2.0 * coverage); };
    const auto reach_of = [&](const std::vector<Gap>& gaps) {
      return std::min(largest_reach(gaps, 0.5 * aim), kFurthest * coverage);
    };
    if (round > 0) {
      const std::vector<Gap> gaps = moving_gaps();
      const double reach = reach_of(gaps);
      both.between = bound_between(gaps, gaps_of(on_still, both.features, reach), reach);
      if (both.between.bound <= wanted || round == kRounds) break;
    }
    const double gentle = gentle_fall(on_still, 0.5 * aim, coverage);
    append(
        points_to_add(on_moving, sampling.samples, {aim, aim - gentle, coverage, true}, most - sampling.samples.size()),
        sampling.samples);
    const std::vector<Gap> gaps = moving_gaps();
    const double fall = std::max(aim - largest_fall(gaps, aim), 0.5 * aim);
    append(points_to_add(on_still, both.features, {aim, fall, reach_of(gaps), false},
                         kMostFeatures - both.features.size()),
           both.features);
  }
  both.added_points = static_cast<std::uint32_t>(sampling.samples.size()) - sampling.points;
  if (progress) progress(1.0);
  return both;
}

}  // namespace godobject::scene_compiler
