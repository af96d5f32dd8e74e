// Voxelmap::free_chords against a slow walk through the cells in double precision.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/scene/voxelmap.h"
#include "tests/support/random.h"
#include "tests/support/slow_field.h"

namespace godobject {
namespace {

using test::FieldParts;
using test::SlowField;

/// A chord in the field's frame with the radii of balls around its ends that are proved free [m].
struct Chord {
  Vector3 from, to;
  double free_from = 0.0, free_to = 0.0;
};

/// An answer, and how far its closest decision was from the other one [voxels].
struct Verdict {
  bool free = false;
  double doubt = HUGE_VAL;
  int cells = 0;
  int past_facets = 0;  ///< pieces that were proved by a plane for each facet

  bool is_above(double value, double bound) {
    doubt = std::min(doubt, std::fabs(value - bound));
    return value > bound;
  }
};

/// Walks along a chord as DistanceField::free_chords allows it: a ball around each end, and between them at most four
/// cells. In each cell the field along the chord is a cubic whose Bernstein coefficients must be positive; the cubic
/// follows from four values. In a cell with facets both ends must be above the planes of the set's first part, or a
/// plane must lie between the piece and each facet; and the cubic counts only if the cell is not whole. Positions and
/// distances have an allowance for single precision.
class SlowWalk {
 public:
  SlowWalk(const FieldParts& parts, const SlowField& field) : parts_(parts), field_(field) {}

  Verdict walk(const Chord& chord) const {
    Verdict verdict;
    const double s = parts_.grid.voxel_size;
    const Vector3 way = (chord.to - chord.from) / s;
    const double length = way.norm();
    const double allowance = 2e-5 * (1.0 + length);
    double covered = std::max(0.0, chord.free_from / s - allowance);
    const double to_cover = length - std::max(0.0, chord.free_to / s - allowance);
    if (verdict.is_above(covered, to_cover)) {
      verdict.free = true;
      return verdict;
    }
    for (int cells = 0; cells < 4; ++cells) {
      const Vector3 p = chord.from + s * std::min(1.0, covered / length) * way;
      const SlowField::Place place = field_.place(p);
      note_faces(p, place, verdict);
      if (!place.stored) return verdict;
      ++verdict.cells;
      const Vector3 direction = std::ldexp(1.0, place.level) * way / length;
      double step = to_cover - covered;
      for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] > 0.0) step = std::min(step, (1.0 - place.at[axis]) / direction[axis]);
        if (direction[axis] < 0.0) step = std::min(step, place.at[axis] / -direction[axis]);
      }
      const double steepest = test::slow_lipschitz(place.brick->lipschitz);
      double end = HUGE_VAL;
      if (field_.facets_of(place) == nullptr || !field_.is_whole(place)) {
        end = least_of_cubic(place, step * direction, allowance * steepest, verdict);
      }
      if (field_.facets_of(place) != nullptr) {
        const double past = end_past_facets(place, p, p + s * step / length * way, chord.free_from > 0.0,
                                            allowance * steepest, verdict);
        end = std::min(end, past);
      }
      if (end < 0.0) return verdict;
      const double ball = std::min(end, field_.near_band() / s) / steepest - allowance;
      const bool at_end = step == to_cover - covered;
      covered += step + std::max(0.0, ball);
      if (!at_end && ball < 1e-4) verdict.doubt = 0.0;  // the next cell begins at a face
      if (at_end || verdict.is_above(covered, to_cover)) {
        verdict.free = true;
        if (at_end && ball < 1e-4) verdict.doubt = 0.0;
        return verdict;
      }
    }
    return verdict;
  }

 private:
  /// Near a face of the cell rounding may choose the other cell.
  void note_faces(const Vector3& p, const SlowField::Place& place, Verdict& verdict) const {
    const Vector3 voxels =
        (p - Vector3(parts_.grid.origin[0], parts_.grid.origin[1], parts_.grid.origin[2])) / parts_.grid.voxel_size;
    for (int axis = 0; axis < 3; ++axis) {
      const double end = 4.0 * parts_.grid.bricks[axis];
      verdict.doubt = std::min({verdict.doubt, std::fabs(voxels[axis]), std::fabs(voxels[axis] - end)});
    }
    for (int axis = 0; place.stored && axis < 3; ++axis) {
      const double cells = std::min(std::fabs(place.at[axis]), std::fabs(1.0 - place.at[axis]));
      verdict.doubt = std::min(verdict.doubt, std::ldexp(cells, -place.level));
    }
    for (int axis = 0; place.in_grid && !place.stored && axis < 3; ++axis) {
      verdict.doubt = std::min({verdict.doubt, place.in_position[axis], 4.0 - place.in_position[axis]});
    }
  }

  /// Returns a bound of the distance at a piece's end in a cell with facets, or a negative number if the piece is not
  /// proved to pass them by more than `least` [voxels]. `outside`: the field is known to be positive at its begin.
  double end_past_facets(const SlowField::Place& place, const Vector3& from, const Vector3& to, bool outside,
                         double least, Verdict& verdict) const {
    const format::FacetSet& set = *field_.facets_of(place);
    const double s = parts_.grid.voxel_size;
    const double offset = parts_.grid.facet_offset / s;
    const double heights[] = {field_.least_height(set, from) / s, field_.least_height(set, to) / s};
    if (set.plane_count > 0 && verdict.is_above(heights[0], 0.0) && verdict.is_above(heights[1], 0.0)) {
      return verdict.is_above(std::min(heights[0], heights[1]) + offset, least) ? heights[1] + offset : -1.0;
    }
    double along = HUGE_VAL, end = HUGE_VAL;
    std::vector<BoundOfFacet> at_begin;
    for (std::uint32_t i = set.first; i < set.first + set.count; ++i) {
      const format::Facet& facet = parts_.facets[parts_.facet_numbers[i]];
      along = std::min(along, distance_past(facet, from, to) / s);
      end = std::min(end, distance_past(facet, to, to) / s);
      at_begin.push_back(bound_of(facet, from));
    }
    if (!verdict.is_above(along, std::fabs(offset))) return -1.0;
    outside = outside && field_.is_whole(place);
    if (!outside && !is_above_nearest(at_begin, verdict)) return -1.0;
    if (!verdict.is_above(along + offset, least)) return -1.0;
    ++verdict.past_facets;
    return end + offset;
  }

  /// Returns the heights of p above the plane of a facet's face and above those through its edges [m].
  static std::array<double, 4> heights_above(const format::Facet& facet, const Vector3& p) {
    Vector3 corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = Vector3(facet.vertex[k][0], facet.vertex[k][1], facet.vertex[k][2]);
    const Vector3 normal(facet.plane[0][0], facet.plane[1][0], facet.plane[2][0]);
    std::array<double, 4> heights = {normal.dot(p - corner[0])};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 out = (corner[(k + 1) % 3] - corner[k]).cross(normal).normalized();
      heights[k + 1] = out.dot(p - corner[k]);
    }
    return heights;
  }

  /// Returns how far a facet is at least from a piece by the planes that lie between them, or a number that is not
  /// positive [m].
  static double distance_past(const format::Facet& facet, const Vector3& from, const Vector3& to) {
    const std::array<double, 4> a = heights_above(facet, from), b = heights_above(facet, to);
    double most = std::max(std::min(a[0], b[0]), std::min(-a[0], -b[0]));
    for (std::size_t k = 1; k < 4; ++k) most = std::max(most, std::min(a[k], b[k]));
    return most;
  }

  struct BoundOfFacet {
    double least;        ///< of the distance [m]
    double above;        ///< height above the face [m]
    double most_beyond;  ///< largest height above the planes of the edges [m]
  };
  static BoundOfFacet bound_of(const format::Facet& facet, const Vector3& p) {
    const std::array<double, 4> heights = heights_above(facet, p);
    const double beyond = *std::max_element(heights.begin() + 1, heights.end());
    return {std::max(std::fabs(heights[0]), beyond), heights[0], beyond};
  }

  /// Tells whether a point is above the triangle that has the least bound; then no other one is nearer.
  bool is_above_nearest(std::vector<BoundOfFacet> bounds, Verdict& verdict) const {
    const double s = parts_.grid.voxel_size;
    std::sort(bounds.begin(), bounds.end(), [](const auto& a, const auto& b) { return a.least < b.least; });
    if (bounds.size() > 1) verdict.doubt = std::min(verdict.doubt, (bounds[1].least - bounds[0].least) / s);
    return verdict.is_above(bounds[0].above / s, 0.0) && verdict.is_above(-bounds[0].most_beyond / s, 0.0);
  }

  /// Returns the distance at the end of a step in a cell, or a negative number if a coefficient is not above `least`
  /// [voxels].
  double least_of_cubic(const SlowField::Place& place, const Vector3& step, double least, Verdict& verdict) const {
    double at[4];
    for (int third = 0; third < 4; ++third) {
      at[third] = parts_.grid.quantum / parts_.grid.voxel_size * field_.quanta(place, place.at + third / 3.0 * step);
    }
    const double b1 = (-5.0 * at[0] + 18.0 * at[1] - 9.0 * at[2] + 2.0 * at[3]) / 6.0;
    const double b2 = (2.0 * at[0] - 9.0 * at[1] + 18.0 * at[2] - 5.0 * at[3]) / 6.0;
    const double smallest = std::min({at[0], b1, b2, at[3]});
    return verdict.is_above(smallest, least) ? at[3] : -1.0;
  }

  const FieldParts& parts_;
  const SlowField& field_;
};

/// Asks a kernel about one chord, in one lane of a batch whose other points do not move.
class KernelWalk {
 public:
  KernelWalk(const Voxelmap& map, const detail::SampleKernel& kernel) : map_(map), kernel_(kernel) {}

  /// `p`: the point in its own frame; H0 and H1 move it to the chord's ends.
  bool is_free(const Eigen::Vector3f& p, const Pose& H0, const Pose& H1, const Chord& chord, std::uint32_t lane) {
    SampleBatch batch{};
    batch.count = lane + 1;
    for (std::uint32_t i = 0; i < batch.count; ++i) {
      batch.x[i] = p.x(), batch.y[i] = p.y(), batch.z[i] = p.z();
      batch.from_clearance[i] = batch.clearance[i] = 0.0;
    }
    batch.from_clearance[lane] = chord.free_from;
    batch.clearance[lane] = chord.free_to;
    const std::uint64_t free = map_.free_chords_by(&kernel_, H0, H1, batch);
    EXPECT_EQ(map_.free_chords(H0, H1, batch) >> lane & 1, free >> lane & 1) << "the map's own choice of a kernel";
    return (free >> lane & 1) != 0;
  }

 private:
  const Voxelmap& map_;
  const detail::SampleKernel& kernel_;
};

constexpr double kRounding = 4e-6;  // of single precision in positions and distances of some voxels [voxels]

class FreeChords : public testing::Test {
 protected:
  void SetUp() override {
    if (detail::sample_kernels().empty()) GTEST_SKIP() << "not run: this processor has no vectors that the core knows";
  }

  /// Returns a random pair of poses and a chord of up to `longest` voxels from a point in the grid.
  void draw(const format::Grid& grid, double longest) {
    const double s = grid.voxel_size;
    Vector3 start;
    for (int axis = 0; axis < 3; ++axis) {
      start[axis] = grid.origin[axis] + s * random_.between(0.0, 4.0 * grid.bricks[axis]);
    }
    H0_ = {exp_rotation(3.0 * random_.direction()), random_.in_cube(3.0 * s)};
    p_ = (H0_.inverse() * start).cast<float>();
    const Vector3 from = H0_ * p_.cast<double>();
    H1_ = H0_;
    H1_.rotation = (exp_rotation(random_.between(0.0, 0.05) * random_.direction()) * H0_.rotation).normalized();
    const Vector3 way = random_.between(0.0, longest) * s * random_.direction();
    H1_.translation += from + way - H1_ * p_.cast<double>();
    chord_ = {from, from + way, 0.0, 0.0};
  }

  test::Random random_{1};
  Eigen::Vector3f p_;
  Pose H0_, H1_;
  Chord chord_;
};

TEST_F(FreeChords, AreThoseOfASlowWalk) {
  std::vector<FieldParts> fields;
  fields.push_back(test::random_field({.bricks = {3, 2, 4}, .noise = 0.15, .refined = false}, random_));
  fields.push_back(test::random_field({.bricks = {2, 4, 3}, .voxel_size = 0.25, .noise = 0.3}, random_));
  fields.push_back(test::random_field({.bricks = {4, 3, 2}, .noise = 0.15, .exact = true}, random_));
  int free_after[5] = {}, blocked = 0, judged = 0, past_facets = 0;
  for (const FieldParts& parts : fields) {
    const SlowField field(parts);
    const Voxelmap map = parts.map();
    const SlowWalk slow(parts, field);
    for (int i = 0; i < 20000; ++i) {
      draw(parts.grid, i % 2 == 0 ? 1.0 : 3.0);
      const double length = (chord_.to - chord_.from).norm();
      if (i % 4 == 1) chord_.free_from = field.sample(chord_.from).clearance;
      if (i % 4 == 2) chord_.free_to = field.sample(chord_.to).clearance;
      if (i % 4 == 3)
        chord_.free_from = random_.between(0.0, 0.6) * length, chord_.free_to = random_.between(0.0, 0.6) * length;
      const Verdict verdict = slow.walk(chord_);
      if (verdict.doubt < kRounding) continue;
      ++judged;
      ++(verdict.free ? free_after[verdict.cells] : blocked);
      past_facets += verdict.free ? verdict.past_facets : 0;
      const std::uint32_t lane = static_cast<std::uint32_t>(i) % 16;
      for (const detail::SampleKernel& kernel : detail::sample_kernels()) {
        ASSERT_EQ(KernelWalk(map, kernel).is_free(p_, H0_, H1_, chord_, lane), verdict.free)
            << kernel.name << ", chord " << i << " from " << chord_.from.transpose() << " to " << chord_.to.transpose()
            << ", " << verdict.cells << " cells, doubt " << verdict.doubt;
      }
    }
  }
  EXPECT_GT(judged, 30000);
  EXPECT_GT(blocked, 3000);
  EXPECT_GT(past_facets, 100);
  for (const int count : free_after) EXPECT_GT(count, 50);
}

/// The kernel changes its answer along a path of chords at the place where the slow walk changes its answer.
TEST_F(FreeChords, ChangeWhereTheSlowWalkChanges) {
  const FieldParts parts = test::random_field({.bricks = {3, 2, 4}, .noise = 0.15, .far = false}, random_);
  const SlowField field(parts);
  const Voxelmap map = parts.map();
  const SlowWalk slow(parts, field);
  int compared = 0;
  for (int i = 0; i < 3000; ++i) {
    draw(parts.grid, 2.0);
    const Chord whole = chord_;
    const Vector3 shift = parts.grid.voxel_size * random_.direction();
    const int kind = i % 3;
    const double length = (whole.to - whole.from).norm();
    // the chord moves sideways, its end moves, or the balls at its ends grow
    const auto chord_at = [&](double share) {
      Chord chord = whole;
      if (kind == 0) chord.from += share * shift;
      if (kind != 2) chord.to += share * shift;
      if (kind == 2) chord.free_from = share * length, chord.free_to = 0.5 * share * length;
      return chord;
    };
    const auto kernel_at = [&](const detail::SampleKernel& kernel, const Chord& chord) {
      Pose H0 = H0_, H1 = H1_;
      H0.translation += chord.from - whole.from;
      H1.translation += chord.to - whole.to;
      return KernelWalk(map, kernel).is_free(p_, H0, H1, chord, 3);
    };
    const bool at_begin = slow.walk(chord_at(0.0)).free;
    if (slow.walk(chord_at(1.0)).free == at_begin) continue;
    double low = 0.0, high = 1.0;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (low + high);
      (slow.walk(chord_at(middle)).free == at_begin ? low : high) = middle;
    }
    for (const double away : {-3.2e-5, -1.6e-5, -8e-6, -4e-6, 4e-6, 8e-6, 1.6e-5, 3.2e-5}) {
      const Verdict verdict = slow.walk(chord_at(low + away));
      if (verdict.doubt < 0.5 * kRounding) continue;
      ++compared;
      for (const detail::SampleKernel& kernel : detail::sample_kernels()) {
        ASSERT_EQ(kernel_at(kernel, chord_at(low + away)), verdict.free)
            << kernel.name << ", chord " << i << " at " << low << " and " << away << ", doubt " << verdict.doubt;
      }
    }
  }
  EXPECT_GT(compared, 1000);
}

/// Balls around both ends that overlap by the rounding prove a chord free, wherever it is.
TEST_F(FreeChords, NeedNoFieldWhereTheBallsMeet) {
  FieldParts parts = test::random_field({.refined = false}, random_);
  for (std::uint32_t& entry : parts.index) entry = format::index_entry::encode_far(false, 1.0f);
  const Voxelmap map = parts.map();
  for (int i = 0; i < 300; ++i) {
    draw(parts.grid, 3.0);
    const double s = parts.grid.voxel_size;
    const double length = (chord_.to - chord_.from).norm();
    const double allowance = 2e-5 * (s + length);  // at each end
    const double share = i % 3 == 0 ? 0.0 : random_.between(0.2, 0.8);
    if (length < 0.01 * s) continue;
    for (const double excess : {0.7, 1.3}) {
      Chord chord = chord_;
      const double sum = length + excess * (share == 0.0 ? allowance : 2.0 * allowance);
      chord.free_from = share * sum;
      chord.free_to = (1.0 - share) * sum;
      for (const detail::SampleKernel& kernel : detail::sample_kernels()) {
        ASSERT_EQ(KernelWalk(map, kernel).is_free(p_, H0_, H1_, chord, 2), excess > 1.0) << kernel.name << " " << i;
      }
    }
  }
}

/// The grid's lower faces belong to it: a chord that begins there is walked.
TEST_F(FreeChords, BeginOnTheLowerFacesOfTheGrid) {
  FieldParts parts = test::random_field({.bricks = {1, 1, 1}, .refined = false, .far = false}, random_);
  std::fill(std::begin(parts.bricks[0].value), std::end(parts.bricks[0].value), std::int16_t{700});
  const Voxelmap map = parts.map();
  const double s = parts.grid.voxel_size;
  Pose H0;
  H0.translation = Vector3(parts.grid.origin[0], parts.grid.origin[1], parts.grid.origin[2]);
  for (int axis = 0; axis < 3; ++axis) {
    for (std::uint32_t lane = 0; lane < 16; ++lane) {
      Eigen::Vector3f p = Eigen::Vector3f::Constant(static_cast<float>(1.5 * s));
      p[axis] = 0.0f;
      Pose H1 = H0;
      H1.translation += 0.5 * s * Vector3::Ones();
      for (const detail::SampleKernel& kernel : detail::sample_kernels()) {
        EXPECT_TRUE(KernelWalk(map, kernel).is_free(p, H0, H1, {}, lane)) << kernel.name << " " << axis << " " << lane;
      }
    }
  }
}

}  // namespace
}  // namespace godobject
