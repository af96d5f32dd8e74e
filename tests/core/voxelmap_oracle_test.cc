// Voxelmap against a slow reader of the format in double precision, in random maps without symmetry.

#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "core/scene/sample_bits.h"
#include "core/scene/voxelmap.h"
#include "tests/support/random.h"
#include "tests/support/slow_field.h"

namespace godobject {
namespace {

using test::FieldParts;
using test::RandomField;
using test::SlowField;

/// Maps of all kinds: with and without refinements, exact bricks and far positions, and with different numbers of
/// positions.
std::vector<FieldParts> random_fields(test::Random& random, double noise) {
  std::vector<FieldParts> fields;
  fields.push_back(test::random_field({.bricks = {1, 1, 1}, .noise = noise, .refined = false, .far = false}, random));
  fields.push_back(test::random_field({.bricks = {3, 2, 4}, .noise = noise, .refined = false}, random));
  fields.push_back(test::random_field({.bricks = {2, 5, 3}, .voxel_size = 0.25, .noise = noise}, random));
  test::renumber_bricks(fields.back());      // an octant has the first brick
  fields.back().grid.band = 3.6 * 0.25;      // no whole number of voxels
  fields.back().grid.lipschitz_seam = 0.25;  // flatter than any distance: 1 counts
  fields.push_back(test::random_field({.bricks = {4, 3, 2}, .noise = noise, .exact = true}, random));
  return fields;
}

Vector3 vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

/// Returns a point in the grid or up to two voxels outside; every third is on a plane of the lattice or of a
/// refinement.
Vector3 any_point(const format::Grid& grid, test::Random& random, double beyond = 2.0) {
  Vector3 voxels;
  const bool on_plane = random.integer(0, 2) == 0;
  for (int axis = 0; axis < 3; ++axis) {
    voxels[axis] = random.between(-beyond, 4.0 * grid.bricks[axis] + beyond);
    if (on_plane && random.integer(0, 1) == 0) voxels[axis] = std::round(voxels[axis] * 32.0) / 32.0;
  }
  return vector(grid.origin) + grid.voxel_size * voxels;
}

constexpr double kQuanta = 1e-3;  // of single precision, with up to 3e4 quanta: less than this part of one

TEST(VoxelmapOracle, AgreesAboutDistanceAndClearance) {
  test::Random random(1);
  for (const FieldParts& parts : random_fields(random, 0.2)) {
    const SlowField slow(parts);
    const Voxelmap map = parts.map();
    int known = 0, outside = 0;
    for (int i = 0; i < 8000; ++i) {
      const Vector3 p = any_point(parts.grid, random);
      const FieldSample expected = slow.sample(p);
      const FieldSample sample = map.sample(p);
      const double rounding = kQuanta * parts.grid.quantum;
      ASSERT_NEAR(sample.distance, expected.distance, rounding) << p.transpose();
      ASSERT_NEAR(sample.clearance, expected.clearance, rounding) << p.transpose();
      if (!expected.known) {
        ASSERT_TRUE(!sample.known || parts.grid.band - std::fabs(sample.distance) < rounding) << p.transpose();
        ++outside;
        continue;
      }
      if (parts.grid.band - std::fabs(expected.distance) < rounding) continue;
      ++known;
      ASSERT_TRUE(sample.known) << p.transpose();
      if (slow.place(p).exact) continue;
      ASSERT_LE((sample.gradient - expected.gradient).norm(), 1e-5) << p.transpose();
    }
    EXPECT_GT(known, 500);
    EXPECT_GT(outside, 1000);
  }
}

/// In an exact brick the gradient is that of the slow reader's differences, where these have no crease.
TEST(VoxelmapOracle, AgreesAboutTheGradientInAnExactBrick) {
  test::Random random(2);
  int compared = 0;
  for (int k = 0; k < 4; ++k) {
    const FieldParts parts = test::random_field({.bricks = {3, 4, 2}, .exact = true, .refined = k > 1}, random);
    const SlowField slow(parts);
    const Voxelmap map = parts.map();
    const double step = 1e-4 * parts.grid.voxel_size;
    for (int i = 0; i < 6000; ++i) {
      const Vector3 p = any_point(parts.grid, random, 0.0);
      const SlowField::Place place = slow.place(p);
      const FieldSample sample = map.sample(p);
      if (!place.exact || !sample.known) continue;
      const Vector3 direction = random.direction();
      const SlowField::Place ahead = slow.place(p + step * direction);
      const SlowField::Place behind = slow.place(p - step * direction);
      if (ahead.brick != place.brick || behind.brick != place.brick || ahead.cell != place.cell ||
          behind.cell != place.cell) {
        continue;
      }
      const double high = slow.stored(ahead, p + step * direction);
      const double low = slow.stored(behind, p - step * direction);
      if (std::fabs(high - 2.0 * slow.stored(place, p) + low) > 4e-3 * step) continue;  // a crease
      ++compared;
      ASSERT_NEAR(sample.gradient.dot(direction), (high - low) / (2.0 * step), 5e-3) << p.transpose();
    }
  }
  EXPECT_GT(compared, 1000);
}

/// Single precision may round a point up to the upper face of its position. It stays in the last cell.
TEST(VoxelmapOracle, StaysInItsPositionJustBelowTheUpperFace) {
  test::Random random(11);
  for (const FieldParts& parts : random_fields(random, 0.2)) {
    const SlowField slow(parts);
    const Voxelmap map = parts.map();
    const double s = parts.grid.voxel_size;
    for (int i = 0; i < 2000; ++i) {
      Vector3 voxels;
      for (int axis = 0; axis < 3; ++axis) voxels[axis] = random.between(0.0, 4.0 * parts.grid.bricks[axis]);
      const int axis = i % 3;
      voxels[axis] = 4.0 * random.integer(1, parts.grid.bricks[axis]) - 1e-9;
      const Vector3 p = vector(parts.grid.origin) + s * voxels;
      const FieldSample expected = slow.sample(p);
      ASSERT_NEAR(map.sample(p).distance, expected.distance, kQuanta * parts.grid.quantum) << p.transpose();
    }
  }
}

TEST(VoxelmapOracle, AgreesAboutLayersAndBounds) {
  test::Random random(3);
  for (const FieldParts& parts : random_fields(random, 0.2)) {
    const SlowField slow(parts);
    const Voxelmap map = parts.map();
    const double s = parts.grid.voxel_size;
    int bounds = 0;
    for (int i = 0; i < 8000; ++i) {
      const Vector3 p = any_point(parts.grid, random, 10.0);
      const SlowField::Place place = slow.place(p);
      // half way between two nodes single precision decides
      const Vector3 of_half = (place.in_position.array() - place.in_position.array().floor() - 0.5).abs();
      if ((of_half.array() == 0.0 || of_half.array() > 1e-6).all()) {
        const LayerSample layer = map.layer(p);
        ASSERT_EQ(layer.layer, slow.layer(p).layer) << p.transpose();
        ASSERT_LE((layer.to_center - slow.layer(p).to_center).norm(), 2e-7 * s) << p.transpose();
      }
      const double radius = i % 5 == 0 ? 0.0 : s * std::exp(random.between(-5.0, 2.0));
      const double expected = slow.lower_bound(p, radius);
      const double bound = map.lower_bound(p, radius);
      const double rounding = place.stored ? 5e-4 * parts.grid.quantum : place.in_grid ? 1e-7 * s : 1e-12;
      if (expected >= 0.0 && expected < 2.0 * rounding) continue;
      if (expected < 0.0) {
        ASSERT_TRUE(bound == expected || bound < rounding) << p.transpose();
        continue;
      }
      ASSERT_NEAR(bound, expected, rounding) << p.transpose() << " radius " << radius;
      ++bounds;
    }
    EXPECT_GT(bounds, 300);
  }
}

TEST(VoxelmapOracle, HasTheConstantsOfItsGrid) {
  test::Random random(4);
  for (const FieldParts& parts : random_fields(random, 0.2)) {
    const Voxelmap map = parts.map();
    EXPECT_EQ(map.voxel_size(), parts.grid.voxel_size);
    EXPECT_EQ(map.band(), parts.grid.band);
    EXPECT_EQ(map.lipschitz(), parts.grid.clearance_slope);
    EXPECT_DOUBLE_EQ(map.assured_clearance(), SlowField(parts).assured());
    const Vector3 center = random.in_cube(3.0);
    double farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      Vector3 p;
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (corner >> axis & 1) == 0 ? parts.grid.surface_min[axis] : parts.grid.surface_max[axis];
      }
      farthest = std::max(farthest, (p - center).norm());
    }
    EXPECT_DOUBLE_EQ(map.surface_radius(center), farthest);
  }
}

/// The kernels address index and nodes with 32 bits. A map too large for that is looked up one by one.
TEST(VoxelmapOracle, UsesItsKernelsWhereTheirAddressesSuffice) {
  test::Random random(5);
  const FieldParts parts = test::random_field({}, random);
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  const auto in_batches = [&parts](std::size_t index, std::size_t bricks, std::size_t refined) {
    return Voxelmap(parts.grid, std::span(parts.index.data(), index), std::span(parts.bricks.data(), bricks),
                    std::span(parts.refined.data(), refined))
        .in_batches();
  };
  EXPECT_TRUE(in_batches(1, 1, 0));
  EXPECT_FALSE(in_batches(1, 0, 0)) << "without bricks there is nothing to gather from";
  EXPECT_TRUE(in_batches(kMost - 1, 1, 0));
  EXPECT_FALSE(in_batches(kMost, 1, 0));
  EXPECT_TRUE(in_batches(1, kMost / 128 - 1, 0)) << "128 words a brick";
  EXPECT_FALSE(in_batches(1, kMost / 128, 0));
  EXPECT_TRUE(in_batches(1, 1, kMost / 9 - 1)) << "9 words a refinement";
  EXPECT_FALSE(in_batches(1, 1, kMost / 9));
}

Pose any_pose(const format::Grid& grid, test::Random& random) {
  return {exp_rotation(3.0 * random.direction()), vector(grid.origin) + random.in_cube(8.0 * grid.voxel_size)};
}

/// Fills the batch with points that H moves to the grid or near it.
template <class Batch>
void fill(Batch& batch, const format::Grid& grid, const Pose& H, test::Random& random, std::uint32_t count) {
  batch.count = count;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vector3 p = H.inverse() * any_point(grid, random, i % 4 == 0 ? 12.0 : 2.0);
    batch.x[i] = static_cast<float>(p.x());
    batch.y[i] = static_cast<float>(p.y());
    batch.z[i] = static_cast<float>(p.z());
  }
}
template <class Batch>
Vector3 point(const Batch& batch, std::uint32_t i) {
  return {static_cast<double>(batch.x[i]), static_cast<double>(batch.y[i]), static_cast<double>(batch.z[i])};
}

/// Tells whether a point is near the border of its position or of the grid, where rounding decides.
bool near_border(const format::Grid& grid, const Vector3& p) {
  const Vector3 positions = (p - vector(grid.origin)) / (4.0 * grid.voxel_size);
  return ((positions.array() - positions.array().round()).abs() < 1e-4).any();
}

/// A batch's clearance is the exact one less a millionth of the sum of the point's coordinates and the translation's.
/// The millionth is more than the rounding, so no clearance is too large.
TEST(VoxelmapOracle, AgreesAboutClearancesInBatches) {
  test::Random random(6);
  const double noise = 0.02;  // so that the rounding of positions moves the distance by little more than itself
  for (int k = 0; k < 3; ++k) {
    for (const FieldParts& parts : random_fields(random, noise)) {
      const SlowField slow(parts);
      const Voxelmap map = parts.map();
      for (int i = 0; i < 40; ++i) {
        const Pose H = any_pose(parts.grid, random);
        PointBatch batch;
        fill(batch, parts.grid, H, random, PointBatch::kCapacity);
        const double s = parts.grid.voxel_size;
        const Vector3 shift = (H.translation - vector(parts.grid.origin)) / s;
        for (const detail::ClearanceKernel& kernel : detail::clearance_kernels()) {
          SCOPED_TRACE(kernel.name);
          std::fill_n(batch.clearance, batch.count, std::numeric_limits<float>::quiet_NaN());
          kernel.look_up(map.in_cells(H), batch.x, batch.y, batch.z, batch.clearance, batch.count);
          for (std::uint32_t n = 0; n < batch.count; ++n) {
            const Vector3 p = H * point(batch, n);
            if (near_border(parts.grid, p)) continue;
            const Vector3 voxels = (p - vector(parts.grid.origin)) / s;
            const double millionth = 1e-6 * s * (voxels.cwiseAbs().sum() + shift.cwiseAbs().sum());
            const double exact = slow.batch_clearance(p);
            const double found = static_cast<double>(batch.clearance[n]);
            ASSERT_LE(found, exact - 0.4 * millionth + 3e-7 * exact) << p.transpose();
            ASSERT_GE(found, exact - 1.6 * millionth - 3e-6 * exact) << p.transpose();
          }
        }
      }
    }
  }
}

/// Points exactly on the grid's lower faces are in the grid, those on the upper ones are not.
TEST(VoxelmapOracle, TakesTheLowerFacesForTheGridInBatches) {
  test::Random random(10);
  const FieldParts parts = test::random_field({.bricks = {2, 3, 4}, .refined = false, .far = false}, random);
  const SlowField slow(parts);
  const Voxelmap map = parts.map();
  const Pose H{Quaternion::Identity(), vector(parts.grid.origin)};
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      PointBatch batch;
      batch.count = PointBatch::kCapacity;
      for (std::uint32_t i = 0; i < batch.count; ++i) {
        Vector3 voxels;
        for (int k = 0; k < 3; ++k) voxels[k] = random.integer(1, 4 * parts.grid.bricks[k] * 8 - 1) / 8.0;
        voxels[axis] = upper ? 4.0 * parts.grid.bricks[axis] : 0.0;
        const Eigen::Vector3f p = (parts.grid.voxel_size * voxels).cast<float>();
        batch.x[i] = p.x(), batch.y[i] = p.y(), batch.z[i] = p.z();
      }
      for (const detail::ClearanceKernel& kernel : detail::clearance_kernels()) {
        kernel.look_up(map.in_cells(H), batch.x, batch.y, batch.z, batch.clearance, batch.count);
        for (std::uint32_t i = 0; i < batch.count; ++i) {
          const double exact = slow.batch_clearance(H * point(batch, i));
          ASSERT_NEAR(static_cast<double>(batch.clearance[i]), exact, 2e-4 * parts.grid.voxel_size) << kernel.name;
        }
      }
    }
  }
}

/// Every kernel that this processor can run is offered, so that the tests above run it.
TEST(VoxelmapOracle, HasTheKernelsOfThisProcessor) {
  const auto clearance = detail::clearance_kernels();
  const auto sample = detail::sample_kernels();
  ASSERT_GE(clearance.size(), 1u);
  EXPECT_EQ(std::string(clearance.back().name), "scalar");
  EXPECT_EQ(clearance.back().lanes, 1u);
  ASSERT_EQ(sample.size() + 1, clearance.size());
  for (std::size_t i = 0; i < sample.size(); ++i) {
    EXPECT_EQ(std::string(sample[i].name), clearance[i].name);
    EXPECT_EQ(sample[i].lanes, clearance[i].lanes);
    EXPECT_EQ(SampleBatch::kCapacity % sample[i].lanes, 0u);
    if (i > 0) {
      EXPECT_LT(sample[i].lanes, sample[i - 1].lanes) << "the widest comes first";
    }
  }
#if defined(__x86_64__)
  const bool has_512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
  const bool has_256 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  EXPECT_EQ(sample.size(), has_512 ? 2u : has_256 ? 1u : 0u);
#endif
}

/// The same on processors without AVX-512 and without AVX2, in an emulator, which ends a program with a forbidden
/// instruction.
TEST(VoxelmapOracle, ChoosesItsKernelsOnOtherProcessors) {
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  if (std::system("command -v qemu-x86_64 > /dev/null") != 0) GTEST_SKIP() << "not run: qemu-x86_64 is missing";
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  for (const std::string processor : {"Haswell", "Nehalem"}) {
    const std::string command = "qemu-x86_64 -cpu " + processor + " '" + self +
                                "' --gtest_filter=VoxelmapOracle.HasTheKernelsOfThisProcessor:"
                                "VoxelmapOracle.LooksUpBatchesOfAnySize > /dev/null 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }
#else
  GTEST_SKIP() << "not run: these processors are x86-64, and the emulator runs no sanitizer";
#endif
}

/// The map chooses the widest kernel. It looks up a whole number of vectors, and leaves the batch's other points alone.
TEST(VoxelmapOracle, LooksUpBatchesOfAnySize) {
  test::Random random(7);
  const FieldParts parts = test::random_field({}, random);
  const Voxelmap map = parts.map();
  const detail::ClearanceKernel& widest = detail::clearance_kernels().front();
  for (std::uint32_t count = 0; count <= PointBatch::kCapacity; ++count) {
    const Pose H = any_pose(parts.grid, random);
    PointBatch batch;
    fill(batch, parts.grid, H, random, PointBatch::kCapacity);
    std::fill_n(batch.clearance, PointBatch::kCapacity, -7.0f);
    PointBatch whole = batch;
    widest.look_up(map.in_cells(H), whole.x, whole.y, whole.z, whole.clearance, PointBatch::kCapacity);
    batch.count = count;
    std::fill(batch.x + count, std::end(batch.x), std::numeric_limits<float>::quiet_NaN());
    std::feclearexcept(FE_ALL_EXCEPT);
    map.clearances(H, batch);
    ASSERT_EQ(std::fetestexcept(FE_INVALID), 0) << "a point beyond the batch was looked up";
    for (std::uint32_t i = 0; i < PointBatch::kCapacity; ++i) {
      if (i < count) {
        ASSERT_EQ(batch.clearance[i], whole.clearance[i]) << i << " of " << count;
      } else if (i >= (count + widest.lanes - 1) / widest.lanes * widest.lanes) {
        ASSERT_EQ(batch.clearance[i], -7.0f) << i << " of " << count;
      }
    }
  }
}

/// The numbers in a batch behind its points have no effect, not even an exception of the processor.
TEST(VoxelmapOracle, LooksAtNoPointBehindABatch) {
  test::Random random(12);
  const FieldParts parts = test::random_field({.exact = true}, random);
  const Voxelmap map = parts.map();
  constexpr int kWatched = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
  for (const detail::SampleKernel& kernel : detail::sample_kernels()) {
    SCOPED_TRACE(kernel.name);
    for (std::uint32_t count = 0; count <= SampleBatch::kCapacity; ++count) {
      const Pose H0 = any_pose(parts.grid, random);
      Pose H1 = H0;
      H1.translation += parts.grid.voxel_size * random.direction();
      SampleBatch batch;
      fill(batch, parts.grid, H0, random, count);
      for (float* axis : {batch.x, batch.y, batch.z}) {
        std::fill(axis + count, axis + SampleBatch::kCapacity, std::numeric_limits<float>::quiet_NaN());
      }
      std::fill_n(batch.from_clearance, SampleBatch::kCapacity, std::numeric_limits<double>::quiet_NaN());
      for (std::uint32_t i = 0; i < count; ++i) batch.from_clearance[i] = map.sample(H0 * point(batch, i)).clearance;
      std::feclearexcept(FE_ALL_EXCEPT);
      map.samples_by(&kernel, H1, batch);
      ASSERT_EQ(std::fetestexcept(kWatched), 0) << "samples, " << count << " points";
      map.free_chords_by(&kernel, H0, H1, batch);
      ASSERT_EQ(std::fetestexcept(kWatched), 0) << "chords, " << count << " points";
    }
  }
}

TEST(VoxelmapOracle, LooksUpOneByOneWhereNothingIsStored) {
  test::Random random(8);
  FieldParts parts = test::random_field({.refined = false}, random);
  parts.bricks = std::vector<format::Brick>();
  ASSERT_EQ(parts.bricks.data(), nullptr) << "the map has the address of a brick";
  for (std::uint32_t& entry : parts.index) entry = format::index_entry::encode_far(false, 0.25f);
  const Voxelmap map = parts.map();
  const Pose H = any_pose(parts.grid, random);
  PointBatch batch;
  fill(batch, parts.grid, H, random, 21);
  map.clearances(H, batch);
  SampleBatch samples;
  fill(samples, parts.grid, H, random, 21);
  map.samples(H, samples);
  for (std::uint32_t i = 0; i < 21; ++i) {
    const double exact = map.sample(H * point(batch, i)).clearance;
    EXPECT_LE(static_cast<double>(batch.clearance[i]), exact);
    EXPECT_GE(static_cast<double>(batch.clearance[i]), exact * (1.0 - 2e-6));
    EXPECT_EQ(stored_sample(samples, i).clearance, map.sample(stored_position(samples, i)).clearance);
  }
  EXPECT_EQ(map.free_chords(H, H, samples), 0u);
}

/// Every kernel gives the bits of `sample`, in maps whose axes differ, for batches of every size.
TEST(VoxelmapOracle, GivesTheSameBitsInBatches) {
  test::Random random(9);
  std::vector<const detail::SampleKernel*> kernels{nullptr};
  for (const detail::SampleKernel& kernel : detail::sample_kernels()) kernels.push_back(&kernel);
  for (const FieldParts& parts : random_fields(random, 0.3)) {
    const Voxelmap map = parts.map();
    for (int i = 0; i < 192; ++i) {
      const Pose H = i % 2 == 0 ? Pose{} : any_pose(parts.grid, random);
      SampleBatch batch;
      fill(batch, parts.grid, H, random, SampleBatch::kCapacity);
      batch.count = 1 + static_cast<std::uint32_t>(i) % SampleBatch::kCapacity;
      batch.known = ~std::uint64_t{0};
      const SampleBatch before = batch;
      for (const detail::SampleKernel* kernel : kernels) {
        SCOPED_TRACE(kernel != nullptr ? kernel->name : "one by one");
        batch = before;
        map.samples_by(kernel, H, batch);
        for (std::uint32_t k = 0; k < batch.count; ++k) {
          const Vector3 p = stored_position(batch, k);
          ASSERT_LE((p - H * point(before, k)).norm(), 1e-14);
          const FieldSample found = stored_sample(batch, k);
          const FieldSample single = map.sample(p);
          ASSERT_EQ(found.known, single.known) << p.transpose();
          ASSERT_EQ(found.distance, single.distance) << p.transpose();
          ASSERT_EQ(found.clearance, single.clearance) << p.transpose();
          ASSERT_EQ(found.gradient, single.gradient) << p.transpose();
        }
      }
    }
  }
}

}  // namespace
}  // namespace godobject
