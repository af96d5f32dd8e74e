#include "core/scene/voxelmap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cfloat>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include "core/scene/sample_bits.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/scene_image_builder.h"

namespace godobject {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Against the rounding of stored floats, lower_bound enlarges the ball by 2e-6 of it and by 1e-5 voxels. [m]
constexpr double kAllowance = 1e-5;

test::SceneDescription still_body(std::function<double(const Vector3&)> distance, const Vector3& half_edges,
                                  double voxel_size, double band) {
  test::SceneDescription description;
  description.distance = std::move(distance);
  description.surface_min = -half_edges;
  description.surface_max = half_edges;
  description.voxel_size = voxel_size;
  description.band = band;
  description.points = {Vector3(0.01, 0.0, 0.0)};
  return description;
}

double quantum_of(const test::SceneImage& image) { return test::open_scene(image).grid.quantum; }

constexpr double kQuantum = 0x1p-10;  // [m]

std::int16_t quanta(double value, int level = 0) {
  return static_cast<std::int16_t>(std::lround(std::ldexp(value / kQuantum, level)));
}

void fill(format::Brick& brick, double value, int level = 0) {
  std::fill(std::begin(brick.value), std::end(brick.value), quanta(value, level));
}

/// One brick of 4 x 4 x 4 cells with edge 1/4 m. Its first node is at the origin. A brick stores its values exactly.
struct OneBrick {
  format::Grid grid{};
  format::Brick brick{};
  std::uint32_t index = 0;

  OneBrick() {
    grid.voxel_size = 0.25;
    grid.band = 4.0;
    grid.lipschitz = 1.0;
    grid.lipschitz_seam = 1.0;
    grid.clearance_slope = 1.0;
    grid.quantum = kQuantum;
    std::fill(std::begin(grid.surface_max), std::end(grid.surface_max), 1.0);
    std::fill(std::begin(grid.bricks), std::end(grid.bricks), 1);
    grid.brick_count = 1;
  }
  void set(int x, int y, int z, double value) { brick.value[x + 5 * (y + 5 * z)] = quanta(value); }
  Voxelmap map() const { return {grid, std::span(&index, 1), std::span(&brick, 1), {}}; }
};

TEST(Voxelmap, InterpolatesACellByHand) {
  OneBrick one;
  // the cell from node (1, 2, 3) to (2, 3, 4): corners 1 .. 8, x fastest
  double corner = 1.0;
  for (const int z : {3, 4}) {
    for (const int y : {2, 3}) {
      for (const int x : {1, 2}) one.set(x, y, z, 0.125 * corner++);
    }
  }
  // 1/4 along x, 1/2 along y, 3/4 along z: 1 + 1/4 + 2/2 + 4 * 3/4 = 5.25 eighths
  const FieldSample sample = one.map().sample(0.25 * Vector3(1.25, 2.5, 3.75));
  EXPECT_TRUE(sample.known);
  EXPECT_EQ(sample.distance, 5.25 / 8.0);
  EXPECT_EQ(sample.gradient, Vector3(0.5, 1.0, 2.0));  // 1, 2 and 4 eighths per quarter metre
}

TEST(Voxelmap, InterpolatesTheProductTermsByHand) {
  OneBrick one;
  one.set(1, 1, 1, 1.0);  // x y z in the cell at the origin, because all other corners are 0
  const FieldSample sample = one.map().sample(0.25 * Vector3(0.5, 0.25, 0.75));
  EXPECT_EQ(sample.distance, 0.5 * 0.25 * 0.75);
  EXPECT_EQ(sample.gradient, 4.0 * Vector3(0.25 * 0.75, 0.5 * 0.75, 0.5 * 0.25));
}

TEST(Voxelmap, TellsKnownFromBandInsideAndOutside) {
  OneBrick one;
  one.grid.band = 0.5;
  for (int z = 0; z < 5; ++z) {
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 5; ++x) one.set(x, y, z, 0.5 * x - 1.0);  // -1 .. 1
    }
  }
  const Voxelmap map = one.map();
  const auto at = [&](double x) { return map.sample(Vector3(x, 0.5, 0.5)); };
  EXPECT_TRUE(at(0.5).known);
  EXPECT_EQ(at(0.5).distance, 0.0);
  EXPECT_EQ(at(0.5).gradient, Vector3(2.0, 0.0, 0.0));
  EXPECT_TRUE(at(0.74).known);
  for (const double x : {0.75, 0.8, 0.99, 1.0, 7.0}) {  // at the band, beyond it, at the grid's end, beyond the grid
    EXPECT_FALSE(at(x).known) << x;
    EXPECT_EQ(at(x).distance, 0.5) << x;
    EXPECT_EQ(at(x).gradient, Vector3::Zero()) << x;
  }
  for (const double x : {0.25, 0.1, 0.0}) {
    EXPECT_FALSE(at(x).known) << x;
    EXPECT_EQ(at(x).distance, -0.5) << x;
    EXPECT_EQ(at(x).gradient, Vector3::Zero()) << x;
  }
  EXPECT_EQ(at(-1e-9).distance, 0.5);  // before the grid there is free space, whatever is stored at its edge
}

TEST(Voxelmap, AnswersFarBricksFromTheIndexAlone) {
  OneBrick one;
  one.grid.band = 0.5;
  one.index = format::index_entry::encode_far(false, 2.0f);
  EXPECT_EQ(one.map().sample(Vector3::Constant(0.5)).distance, 0.5);
  EXPECT_FALSE(one.map().sample(Vector3::Constant(0.5)).known);
  EXPECT_NEAR(one.map().lower_bound(Vector3::Constant(0.5), 1.5), 0.5, kAllowance);
  EXPECT_EQ(one.map().lower_bound(Vector3::Constant(0.5), 2.5), -kInfinity);
  EXPECT_EQ(one.map().layer(Vector3::Constant(0.5)).layer, -2);
  // the clearance of the brick's centre minus the distance to the centre
  EXPECT_EQ(one.map().sample(Vector3::Constant(0.5)).clearance, 2.0);
  EXPECT_NEAR(one.map().sample(Vector3(0.5, 0.8, 0.9)).clearance, 1.5, kAllowance);
  EXPECT_NEAR(one.map().lower_bound(Vector3(0.5, 0.8, 0.9), 1.25), 0.25, kAllowance);

  one.index = format::index_entry::encode_far(true, 2.0f);
  EXPECT_EQ(one.map().sample(Vector3::Constant(0.5)).distance, -0.5);
  EXPECT_FALSE(one.map().sample(Vector3::Constant(0.5)).known);
  EXPECT_EQ(one.map().lower_bound(Vector3::Constant(0.5), 0.0), -kInfinity);
  EXPECT_EQ(one.map().layer(Vector3::Constant(0.5)).layer, 2);
}

TEST(Voxelmap, DividesByTheBricksSlopeAboutItAndByTheWholeFieldsBeyond) {
  OneBrick one;
  fill(one.brick, 3.0);
  one.brick.lipschitz = format::encode_lipschitz(2.0f);
  one.grid.lipschitz_seam = 2.5;
  const Vector3 center = Vector3::Constant(0.5);
  EXPECT_NEAR(one.map().lower_bound(center, 0.9), 1.2, 2.0 * kAllowance);
  EXPECT_NEAR(one.map().lower_bound(center, 1.1), 0.25, 3.0 * kAllowance) << "the radius exceeds a brick's edge";
  EXPECT_EQ(one.map().lower_bound(center, 1.3), -kInfinity);
  EXPECT_EQ(one.map().sample(center).clearance, 0.5) << "the clearance is limited to a brick's edge";
  one.grid.band = 0.75;
  constexpr double kRoundedBand = 0.75 - format::kMostRoundedOff * kQuantum;
  EXPECT_EQ(one.map().sample(center).clearance, kRoundedBand / 2.0);
  EXPECT_EQ(one.map().assured_clearance(), kRoundedBand / 2.5);
}

TEST(Voxelmap, TakesWhatIsNotFiniteForOutside) {
  const auto description =
      still_body([](const Vector3& p) { return test::ball_distance(p, 0.02); }, Vector3::Constant(0.02), 0.005, 0.01);
  const test::SceneImage image = test::build_scene_image(description);
  const Voxelmap map = test::open_scene(image).voxelmap;
  for (const double value : {kNaN, kInfinity, -kInfinity, DBL_MAX, -DBL_MAX}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vector3 p = Vector3::Zero();
      p[axis] = value;
      EXPECT_EQ(map.sample(p).distance, 0.01) << value;
      EXPECT_FALSE(map.sample(p).known) << value;
      EXPECT_EQ(map.layer(p).layer, -2) << value;
      EXPECT_FALSE(std::isnan(map.lower_bound(p, 0.001))) << value;
    }
    EXPECT_LE(map.lower_bound(Vector3::Constant(0.03), std::fabs(value)), 0.0) << value;
  }
}

TEST(Voxelmap, ReproducesALinearFieldToItsQuantum) {
  const Vector3 slope = Vector3(1.0, -2.0, 0.5).normalized();
  const auto description =
      still_body([&](const Vector3& p) { return slope.dot(p) - 0.003; }, Vector3::Constant(0.02), 0.0017, 0.017);
  const test::SceneImage image = test::build_scene_image(description);
  const Voxelmap map = test::open_scene(image).voxelmap;
  const double quantum = quantum_of(image);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-0.008, 0.008);
  for (int i = 0; i < 10000; ++i) {
    const Vector3 p(anywhere(random), anywhere(random), anywhere(random));
    const FieldSample sample = map.sample(p);
    ASSERT_TRUE(sample.known);
    // each node is off by half a quantum at most; a gradient uses two nodes a voxel apart along each axis
    ASSERT_NEAR(sample.distance, slope.dot(p) - 0.003, 0.5 * quantum + 1e-9) << p.transpose();
    ASSERT_LT((sample.gradient - slope).norm(), 1.7321 * quantum / 0.0017) << p.transpose();
    ASSERT_LT(quantum, 1e-3 * map.voxel_size());
  }
}

/// A brick whose lowest octant is halved again. Octant 0 is refined; its octants and octants 1 .. 7 of the brick are
/// bricks. `coarse` makes the last octants of both coarse: their look-ups use bricks 0 and 1.
struct HalvedTwice {
  OneBrick one;
  std::array<format::Brick, 17> bricks{};
  std::array<format::Refined, 2> refined{};

  explicit HalvedTwice(bool coarse = false) {
    one.index = format::index_entry::kRefined;
    one.grid.brick_count = static_cast<std::uint32_t>(bricks.size());
    for (std::uint32_t i = 0; i < 8; ++i) {
      refined[0].child[i] = i == 0 ? format::index_entry::kRefined | 1u : 1 + i;
      refined[1].child[i] = 9 + i;
    }
    refined[0].brick = 0;
    refined[1].brick = coarse ? 1 : format::kNoBrick;
    if (coarse) refined[0].child[7] = refined[1].child[7] = format::index_entry::kCoarse;
    for (std::size_t i = 0; i < bricks.size(); ++i) {
      fill(bricks[i], 0.0625 * static_cast<double>(i), level(i));
    }
  }
  static int level(std::size_t brick) { return brick == 0 ? 0 : brick < 9 ? 1 : 2; }
  void fill_all(double value) {
    for (std::size_t i = 0; i < bricks.size(); ++i) fill(bricks[i], value, level(i));
  }
  void set(std::size_t brick, int x, int y, int z, double value) {
    bricks[brick].value[x + 5 * (y + 5 * z)] = quanta(value, level(brick));
  }
  Voxelmap map() const { return {one.grid, std::span(&one.index, 1), bricks, refined}; }
};

TEST(Voxelmap, DescendsToTheOctantThatHoldsThePoint) {
  const HalvedTwice halved;  // a cube of 1 m; octants of 1/2 m, and of 1/4 m in the lowest one
  const Voxelmap map = halved.map();
  const auto number = [&map](const Vector3& p) { return 16.0 * map.sample(p).distance; };
  for (int octant = 0; octant < 8; ++octant) {
    const Vector3 low(octant & 1, octant >> 1 & 1, octant >> 2);
    if (octant > 0) {
      EXPECT_EQ(number(0.5 * low), 1 + octant);  // an octant owns its lower faces
      EXPECT_EQ(number(0.5 * low + Vector3::Constant(0.499)), 1 + octant);
    }
    EXPECT_EQ(number(0.25 * low), 9 + octant);
    EXPECT_EQ(number(0.25 * low + Vector3::Constant(0.249)), 9 + octant);
  }
}

TEST(Voxelmap, LooksCoarseOctantsUpInTheOwnNodes) {
  HalvedTwice halved(true);
  halved.fill_all(1.0);
  halved.set(0, 2, 2, 2, 0.25);  // the middle of the position, in cells of 1/4 m
  halved.set(0, 3, 2, 2, 0.75);
  halved.set(1, 2, 2, 2, -0.25);  // the middle of its lowest octant, in cells of 1/8 m
  halved.set(1, 3, 2, 2, 0.5);
  const Voxelmap map = halved.map();
  EXPECT_EQ(map.sample(Vector3::Constant(0.5)).distance, 0.25);
  EXPECT_EQ(map.sample(Vector3(0.625, 0.5, 0.5)).distance, 0.5);
  EXPECT_EQ(map.sample(Vector3(0.625, 0.5, 0.5)).gradient.x(), 2.0);
  EXPECT_EQ(map.sample(Vector3::Constant(0.25)).distance, -0.25);
  EXPECT_EQ(map.sample(Vector3(0.3125, 0.25, 0.25)).distance, 0.125);
  EXPECT_EQ(map.sample(Vector3(0.3125, 0.25, 0.25)).gradient.x(), 6.0);
  EXPECT_EQ(map.sample(Vector3(0.49, 0.5, 0.5)).distance, 1.0);  // the octants beside them are not coarse
  EXPECT_EQ(map.sample(Vector3(0.24, 0.25, 0.25)).distance, 1.0);
}

TEST(Voxelmap, InterpolatesInTheHalvedCellByHand) {
  HalvedTwice halved;
  halved.fill_all(0.0);
  halved.set(9 + 7, 1, 1, 1, 1.0);  // starts at (1/4, 1/4, 1/4), cells of 1/16 m: x y z in the first cell
  const FieldSample sample = halved.map().sample(Vector3::Constant(0.25) + 0.0625 * Vector3(0.5, 0.25, 0.75));
  EXPECT_EQ(sample.distance, 0.5 * 0.25 * 0.75);
  EXPECT_EQ(sample.gradient, 16.0 * Vector3(0.25 * 0.75, 0.5 * 0.75, 0.5 * 0.25));
}

TEST(Voxelmap, TakesLayersFromTheUnrefinedNodes) {
  HalvedTwice halved;
  fill(halved.bricks[0], -0.5);
  EXPECT_EQ(halved.map().layer(Vector3(0.3, 0.1, 0.6)).layer, 2);
  EXPECT_NEAR((halved.map().layer(Vector3(0.3, 0.1, 0.6)).to_center - Vector3(-0.05, -0.1, -0.1)).norm(), 0.0, 1e-7);
}

TEST(Voxelmap, BoundsAHalvedPositionByItsSlope) {
  HalvedTwice halved;
  halved.fill_all(3.0);
  for (format::Brick& brick : halved.bricks) brick.lipschitz = format::encode_lipschitz(4.0f);
  halved.one.grid.lipschitz_seam = 100.0;
  EXPECT_NEAR(halved.map().lower_bound(Vector3::Constant(0.3), 0.25), 2.0, 4.0 * kAllowance);
  EXPECT_EQ(halved.map().lower_bound(Vector3::Constant(0.3), 1.01), -kInfinity);
  EXPECT_EQ(halved.map().sample(Vector3::Constant(0.3)).clearance, 0.25);
}

/// A union of balls and boxes, rotated. Its distance is 1-Lipschitz, with edges and saddles.
class RandomShapes {
 public:
  explicit RandomShapes(unsigned seed) : random_(seed) {
    for (int i = 0; i < 3; ++i) centers_[i] = 0.02 * Vector3(uniform(), uniform(), uniform());
    half_edges_ = Vector3::Constant(0.012) + 0.006 * Vector3(uniform(), uniform(), uniform());
    turn_ = exp_rotation(2.0 * Vector3(uniform(), uniform(), uniform()));
  }
  const Vector3* centers() const { return centers_; }
  double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }
  double operator()(const Vector3& p) const {
    return std::min({test::ball_distance(p - centers_[0], 0.01), test::ball_distance(p - centers_[1], 0.006),
                     test::box_distance(turn_ * (p - centers_[2]), half_edges_)});
  }

 private:
  std::mt19937 random_;
  Vector3 centers_[3];
  Vector3 half_edges_;
  Quaternion turn_;
};

/// Seeds from kRefinedFrom on have bricks refined along the surface. From kCoarseFrom on, only octants near the surface
/// are refined.
constexpr unsigned kRefinedFrom = 9;
constexpr unsigned kCoarseFrom = 11;

class VoxelmapOfRandomShapes : public ::testing::TestWithParam<unsigned> {
 protected:
  VoxelmapOfRandomShapes()
      : shapes_(GetParam()),
        image_(image_of(GetParam(), *this)),
        scene_(test::open_scene(image_)),
        map_(scene_.voxelmap) {}

  /// Returns the image of a seed; it is built once.
  static const test::SceneImage& image_of(unsigned seed, const VoxelmapOfRandomShapes& fixture) {
    static std::map<unsigned, test::SceneImage> images;
    const auto found = images.find(seed);
    if (found != images.end()) return found->second;
    return images.emplace(seed, test::build_scene_image(fixture.description())).first->second;
  }

  test::SceneDescription description() const {
    auto description = still_body(shapes_, Vector3::Constant(0.055), 0.002, 0.008);
    if (GetParam() >= kRefinedFrom) {
      // two points of the surface: once refined in the wide vicinity, four times close by, so that levels differ by one
      const Vector3 first = shapes_.centers()[0] + Vector3(0.0, 0.006, 0.008);
      const Vector3 second = shapes_.centers()[1] + Vector3(0.006, 0.0, 0.0);
      description.refined = [first, second](const Vector3& center, double edge) {
        return std::min((center - first).norm(), (center - second).norm()) < 2.6 * edge;
      };
    }
    if (GetParam() >= kCoarseFrom) {
      description.coarse = [distance = shapes_](const Vector3& center, double edge) {
        return std::fabs(distance(center)) > 1.2 * edge;
      };
    }
    return description;
  }

  double steepest() const { return scene_.grid.lipschitz_seam * (1.0 + 1e-6); }

  Vector3 random_point(double reach) {
    return reach * Vector3(shapes_.uniform(), shapes_.uniform(), shapes_.uniform());
  }

  RandomShapes shapes_;
  const test::SceneImage& image_;
  SceneView scene_;
  Voxelmap map_;
};

TEST_P(VoxelmapOfRandomShapes, IsNearTheTruth) {
  for (int i = 0; i < 20000; ++i) {
    const Vector3 p = random_point(0.06);
    const double truth = shapes_(p);
    const double stored = map_.sample(p).distance;
    // the trilinear error of a 1-Lipschitz function, with values clipped to the band
    ASSERT_NEAR(stored, std::clamp(truth, -0.008, 0.008), 0.8661 * 0.002) << p.transpose();
  }
}

TEST_P(VoxelmapOfRandomShapes, GivesTheGradientOfItsOwnDistance) {
  constexpr double kStep = 1e-4;  // long compared with float rounding (1e-9), short compared with a voxel
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3 p = random_point(0.05);
    const FieldSample sample = map_.sample(p);
    if (!sample.known) continue;
    ASSERT_LE(sample.gradient.norm(), steepest()) << p.transpose();
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 step = kStep * Vector3::Unit(axis);
      const FieldSample ahead = map_.sample(p + step);
      const FieldSample behind = map_.sample(p - step);
      if (!ahead.known || !behind.known) continue;
      // within a cell the field is linear along an axis: differences are exact and the component is constant
      if (std::fabs(ahead.gradient[axis] - behind.gradient[axis]) > 1e-5) continue;
      ++compared;
      ASSERT_NEAR(sample.gradient[axis], (ahead.distance - behind.distance) / (2.0 * kStep), 1e-4) << p.transpose();
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST_P(VoxelmapOfRandomShapes, IsContinuous) {
  for (int i = 0; i < 20000; ++i) {
    const Vector3 p = random_point(0.06);
    const Vector3 q = p + random_point(1e-5);
    ASSERT_LE(std::fabs(map_.sample(p).distance - map_.sample(q).distance), steepest() * (q - p).norm() + 1e-8)
        << p.transpose() << " and " << q.transpose();
  }
}

TEST_P(VoxelmapOfRandomShapes, NeverPromisesMoreThanTheBallHolds) {
  int promised = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3 center = random_point(0.1);
    const double radius = 0.01 * std::fabs(shapes_.uniform());
    const double bound = map_.lower_bound(center, radius);
    ASSERT_TRUE(bound >= 0.0 || bound == -kInfinity) << bound;
    if (bound < 0.0) continue;
    ++promised;
    for (int k = 0; k < 50; ++k) {
      Vector3 offset = random_point(1.0);
      if (k % 2 == 0 || offset.norm() > 1.0) offset.normalize();  // half of them on the sphere, where the bound matters
      const FieldSample sample = map_.sample(center + radius * offset);
      ASSERT_GE(sample.distance, std::min(bound, map_.band()) - 1e-9) << center.transpose() << " r " << radius;
    }
  }
  EXPECT_GT(promised, 1000);
}

/// A batch's clearance at a point must be consistent with `sample` at points near it, with any vectors.
TEST_P(VoxelmapOfRandomShapes, BoundsClearancesInBatches) {
  ASSERT_TRUE(map_.in_batches());
  int useful = 0;
  for (int i = 0; i < 400; ++i) {
    Pose H;
    H.rotation = exp_rotation(random_point(3.0));
    H.translation = random_point(i % 10 == 0 ? 1.0 : 0.02);
    PointBatch batch;
    batch.count = 1 + static_cast<std::uint32_t>(i) % PointBatch::kCapacity;
    for (std::uint32_t k = 0; k < batch.count; ++k) {
      const Vector3 p = H.inverse() * random_point(k % 10 == 0 ? 0.2 : 0.04);
      batch.x[k] = static_cast<float>(p.x());
      batch.y[k] = static_cast<float>(p.y());
      batch.z[k] = static_cast<float>(p.z());
    }
    const std::span<const detail::ClearanceKernel> kernels = detail::clearance_kernels();
    const detail::ClearanceKernel& kernel = kernels[static_cast<std::size_t>(i) % kernels.size()];
    SCOPED_TRACE(kernel.name);
    PointBatch scalar = batch;
    detail::look_up_clearances(map_.in_cells(H), scalar.x, scalar.y, scalar.z, scalar.clearance, scalar.count);
    const std::uint32_t lanes = (batch.count + kernel.lanes - 1) / kernel.lanes * kernel.lanes;
    // unused lanes hold NaN
    std::fill(batch.x + batch.count, batch.x + lanes, std::numeric_limits<float>::quiet_NaN());
    kernel.look_up(map_.in_cells(H), batch.x, batch.y, batch.z, batch.clearance, lanes);
    if (&kernel == &kernels.front()) {
      PointBatch chosen = batch;
      map_.clearances(H, chosen);
      ASSERT_TRUE(std::equal(batch.clearance, batch.clearance + batch.count, chosen.clearance));
    }
    for (std::uint32_t k = 0; k < batch.count; ++k) {
      const Vector3 p = H * Vector3(static_cast<double>(batch.x[k]), static_cast<double>(batch.y[k]),
                                    static_cast<double>(batch.z[k]));
      const double clearance = std::max(0.0, static_cast<double>(batch.clearance[k]));
      const double stored = map_.sample(p).clearance;
      // rounding may put a point near a brick's face into the neighbouring brick
      const double other = std::max(0.0, static_cast<double>(scalar.clearance[k]));
      ASSERT_GE(clearance, std::min(other, map_.assured_clearance()) / map_.lipschitz() - 1e-7) << p.transpose();
      ASSERT_GE(other, std::min(clearance, map_.assured_clearance()) / map_.lipschitz() - 1e-7) << p.transpose();
      if (clearance > 0.0 && stored < map_.assured_clearance()) ++useful;
      for (int j = 0; j < 20; ++j) {
        const Vector3 away = random_point(clearance);
        const double bound = (std::max(clearance, other) - away.norm()) / map_.lipschitz();
        ASSERT_GE(map_.sample(p + away).clearance, std::min(bound, map_.assured_clearance()) - 1e-8) << p.transpose();
      }
    }
  }
  EXPECT_GT(useful, 100);
}

/// A batch gives the same bits as `sample` at the same points, with every vector kernel.
TEST_P(VoxelmapOfRandomShapes, LooksUpInBatchesWhatItLooksUpSingly) {
  std::vector<const detail::SampleKernel*> kernels{nullptr};
  for (const detail::SampleKernel& kernel : detail::sample_kernels()) kernels.push_back(&kernel);
  int known = 0;
  for (int i = 0; i < 1200; ++i) {
    Pose H;
    H.rotation = exp_rotation(random_point(3.0));
    H.translation = random_point(0.02);
    SampleBatch batch;
    batch.count = 1 + static_cast<std::uint32_t>(i) % SampleBatch::kCapacity;
    for (std::uint32_t k = 0; k < batch.count; ++k) {
      Vector3 p = random_point(k % 10 == 0 ? 0.2 : 0.05);
      if (k % 3 == 0) p = 0.001 * (p / 0.001).array().round().matrix();  // on nodes and on faces of cells and bricks
      if (k % 6 != 0) p = H.inverse() * p;
      if (k % 23 == 7) p[static_cast<int>(k) % 3] = std::array{kNaN, kInfinity, -kInfinity, 1e30}[k % 4];
      batch.x[k] = static_cast<float>(p.x());
      batch.y[k] = static_cast<float>(p.y());
      batch.z[k] = static_cast<float>(p.z());
    }
    if (i % 2 == 0) H = Pose{};  // then the points are exactly on them
    const detail::SampleKernel* const kernel = kernels[static_cast<std::size_t>(i) % kernels.size()];
    SCOPED_TRACE(kernel != nullptr ? kernel->name : "one by one");
    map_.samples_by(kernel, H, batch);
    for (std::uint32_t k = 0; k < batch.count; ++k) {
      const Vector3 p(static_cast<double>(batch.x[k]), static_cast<double>(batch.y[k]),
                      static_cast<double>(batch.z[k]));
      const Vector3 p_field = stored_position(batch, k);
      if (p.allFinite()) {
        ASSERT_LE((p_field - H * p).norm(), 1e-15 * (1.0 + p.norm()));
      }
      const FieldSample single = map_.sample(p_field);
      const FieldSample found = stored_sample(batch, k);
      ASSERT_EQ(found.known, single.known) << p_field.transpose();
      ASSERT_EQ(found.distance, single.distance) << p_field.transpose();
      ASSERT_EQ(found.clearance, single.clearance) << p_field.transpose();
      ASSERT_EQ(found.gradient, single.gradient) << p_field.transpose();
      known += single.known;
    }
  }
  EXPECT_GT(known, 1000);
}

/// A chord that a kernel calls free is free everywhere. The kernel finds most of the free chords. All vectors agree.
TEST_P(VoxelmapOfRandomShapes, KnowsWhichChordsAreFree) {
  constexpr int kLooks = 400;  // samples along a chord
  const auto kernels = detail::sample_kernels();
  if (kernels.empty()) GTEST_SKIP() << "not run: this processor has no vectors that the core knows";
  int free = 0, known_free = 0, blocked = 0, through_cells = 0;
  for (int i = 0; i < 1500; ++i) {
    Pose H0;
    H0.rotation = exp_rotation(random_point(3.0));
    H0.translation = random_point(0.02);
    Pose H1 = H0;
    const double stride = i % 3 == 0 ? 2e-4 : (i % 3 == 1 ? 1e-3 : 4e-3);  // up to two voxels
    H1.translation += random_point(stride);
    H1.rotation = (H1.rotation * exp_rotation(random_point(20.0 * stride))).normalized();
    SampleBatch batch;
    batch.count = 1 + static_cast<std::uint32_t>(i) % SampleBatch::kCapacity;
    for (std::uint32_t k = 0; k < batch.count; ++k) {
      Vector3 p = random_point(0.05);
      for (int newton = 0; newton < 3 && k % 8 != 0; ++newton) {  // near the surface
        const FieldSample sample = map_.sample(p);
        if (sample.known) p -= (sample.distance - 1e-5) * sample.gradient / (sample.gradient.squaredNorm() + 1e-9);
      }
      p = H0.inverse() * p;
      if (k % 23 == 7 && i % 4 != 0) p[static_cast<int>(k) % 3] = std::array{kNaN, kInfinity, -kInfinity, 1e30}[k % 4];
      batch.x[k] = static_cast<float>(p.x());
      batch.y[k] = static_cast<float>(p.y());
      batch.z[k] = static_cast<float>(p.z());
    }
    const auto point = [&](std::uint32_t k) {
      return Vector3(static_cast<double>(batch.x[k]), static_cast<double>(batch.y[k]), static_cast<double>(batch.z[k]));
    };
    for (std::uint32_t k = 0; k < batch.count; ++k) {
      batch.from_clearance[k] = map_.sample(H0 * point(k)).clearance;
    }
    map_.samples(H1, batch);
    const std::uint64_t found = map_.free_chords_by(&kernels.front(), H0, H1, batch) & first_bits(batch.count);
    for (const detail::SampleKernel& kernel : kernels) {
      SCOPED_TRACE(kernel.name);
      std::feclearexcept(FE_ALL_EXCEPT);
      ASSERT_EQ(map_.free_chords_by(&kernel, H0, H1, batch) & first_bits(batch.count), found);
      if (i % 4 == 0) {
        ASSERT_EQ(std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW), 0);
      }
    }
    ASSERT_EQ(map_.free_chords_by(nullptr, H0, H1, batch), 0u);
    for (std::uint32_t k = 0; k < batch.count; ++k) {
      const Vector3 p0 = H0 * point(k);
      const Vector3 way = H1 * point(k) - p0;
      const bool known = (found >> k & 1) != 0;
      if (!way.allFinite()) {
        ASSERT_FALSE(known && p0.hasNaN());
        continue;
      }
      double least = std::numeric_limits<double>::infinity();
      for (int look = 0; look <= kLooks; ++look) {
        least = std::min(least, map_.sample(p0 + static_cast<double>(look) / kLooks * way).distance);
      }
      if (known) {
        ASSERT_GT(least, 0.0) << p0.transpose();
      }
      if (batch.from_clearance[k] + batch.clearance[k] >= way.norm()) continue;
      ++through_cells;
      blocked += least <= 0.0;
      if (least <= 1e-7) continue;  // rounding decides here
      ++free;
      known_free += known;
    }
  }
  EXPECT_GT(through_cells, 1000);
  EXPECT_GT(blocked, 100);
  EXPECT_GT(known_free, 0.85 * free) << "free chords: " << free;
}

/// A point that does not move has a free chord if it is outside, and no free chord if it is inside.
TEST_P(VoxelmapOfRandomShapes, KnowsChordsOfNoLength) {
  int outside = 0, inside = 0;
  for (const detail::SampleKernel& kernel : detail::sample_kernels()) {
    SCOPED_TRACE(kernel.name);
    for (int i = 0; i < 3000; ++i) {
      SampleBatch batch;
      const Vector3 p = random_point(0.05);
      batch.count = 1;
      batch.x[0] = static_cast<float>(p.x());
      batch.y[0] = static_cast<float>(p.y());
      batch.z[0] = static_cast<float>(p.z());
      map_.samples_by(&kernel, Pose{}, batch);
      batch.from_clearance[0] = batch.clearance[0];
      const bool known = (map_.free_chords_by(&kernel, Pose{}, Pose{}, batch) & 1) != 0;
      if (batch.distance[0] <= 0.0) {
        ASSERT_FALSE(known);
        ++inside;
      } else if (batch.clearance[0] > 1e-6) {
        ASSERT_TRUE(known);
        ++outside;
      }
    }
  }
  if (detail::sample_kernels().empty()) GTEST_SKIP() << "not run: this processor has no vectors that the core knows";
  EXPECT_GT(inside, 20);
  EXPECT_GT(outside, 20);
}

TEST_P(VoxelmapOfRandomShapes, PromisesSomethingInFreeSpace) {
  for (int i = 0; i < 20000; ++i) {
    const Vector3 center = random_point(0.1);
    const double truth = shapes_(center);
    // a loose bound is legal, but it would send every point of the tree to the field; a loss of two brick diagonals is
    // allowed
    if (truth > 2.0 * 4.0 * 1.7321 * 0.002) {
      ASSERT_GE(map_.lower_bound(center, 0.0), 0.0) << center.transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, VoxelmapOfRandomShapes, ::testing::Range(1u, kCoarseFrom + 2u));

/// Chords low over a flat floor, along planes and lines of nodes and between them.
TEST(Voxelmap, KnowsChordsAlongTheLattice) {
  OneBrick one;
  one.grid.band = 0.5;
  for (int z = 0; z < 5; ++z) {
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 5; ++x) one.set(x, y, z, 0.25 * z - 0.5);
    }
  }
  const Voxelmap map = one.map();
  for (const detail::SampleKernel& kernel : detail::sample_kernels()) {
    for (const double y : {0.25, 0.3, 0.5}) {
      for (const double from : {0.1, 0.25, 0.375}) {
        SampleBatch batch;
        batch.count = 1;
        batch.x[0] = static_cast<float>(from);
        batch.y[0] = static_cast<float>(y);
        batch.z[0] = 0.5f + 0.001f;
        Pose H1;
        H1.translation.x() = 0.375;
        batch.from_clearance[0] = map.sample(Vector3(from, y, 0.501)).clearance;
        map.samples_by(&kernel, H1, batch);
        EXPECT_EQ(map.free_chords_by(&kernel, Pose{}, H1, batch) & 1, 1u) << kernel.name << " at " << from << ", " << y;
        H1.translation.z() = -0.0011;
        map.samples_by(&kernel, H1, batch);
        EXPECT_EQ(map.free_chords_by(&kernel, Pose{}, H1, batch) & 1, 0u) << kernel.name << " at " << from << ", " << y;
      }
    }
  }
}

TEST(Voxelmap, NumbersTheLayersByHand) {
  OneBrick one;  // voxels of 1/4 m around the nodes; the surface is at x = 1/2
  one.grid.band = 0.5;
  for (int z = 0; z < 5; ++z) {
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 5; ++x) one.set(x, y, z, 0.25 * x - 0.5);
    }
  }
  const Voxelmap map = one.map();
  const auto at = [&](double x) { return map.layer(Vector3(x, 0.5, 0.5)).layer; };
  EXPECT_EQ(at(0.5), 0);
  EXPECT_EQ(at(0.62), 0);
  EXPECT_EQ(at(0.63), -1);
  EXPECT_EQ(at(0.99), -2);
  EXPECT_EQ(at(0.38), 0);
  EXPECT_EQ(at(0.37), 1);
  EXPECT_EQ(at(0.0), 2);
  EXPECT_EQ(at(5.0), -2);

  const LayerSample sample = map.layer(Vector3(0.375, 0.5625, 0.4375));
  EXPECT_EQ(sample.layer, 0);  // a point half way belongs to the node above
  EXPECT_EQ(sample.to_center, Vector3(0.125, -0.0625, 0.0625));
}

TEST(Voxelmap, RoundsALayerHalfWayInwards) {
  OneBrick one;
  fill(one.brick, -0.375);  // 1.5 voxels deep
  EXPECT_EQ(one.map().layer(Vector3::Constant(0.5)).layer, 2);
  fill(one.brick, 0.375);
  EXPECT_EQ(one.map().layer(Vector3::Constant(0.5)).layer, -1);
}

}  // namespace
}  // namespace godobject
