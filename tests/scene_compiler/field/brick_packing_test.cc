#include "toolchain/scene_compiler/field/brick_packing.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/scene_compiler/field/refinement.h"

namespace godobject::scene_compiler::brick_packing_test {
namespace {

TEST(BrickPacking, RoundsSlopesUpByLittle) {
  EXPECT_EQ(format::encode_lipschitz(1.0f), 0);
  EXPECT_EQ(format::decode_lipschitz(0), 1.0f);
  EXPECT_EQ(format::decode_lipschitz(format::encode_lipschitz(1.5f)), 1.5f);
  EXPECT_EQ(format::decode_lipschitz(format::encode_lipschitz(4096.0f)), 4096.0f);
  EXPECT_EQ(format::encode_lipschitz(format::kLargestLipschitz), 0xffff);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> power(0.0f, 15.9f);
  for (int i = 0; i < 10000; ++i) {
    const float lipschitz = std::exp2(power(random));
    const float stored = format::decode_lipschitz(format::encode_lipschitz(lipschitz));
    ASSERT_GE(stored, lipschitz);
    ASSERT_LE(stored, lipschitz * (1.0f + 1.0f / 4096.0f));
  }
}

/// One position, halved once in its first octant.
DistanceGrid two_levels() {
  DistanceGrid field;
  field.grid.voxel_size = 0.01;
  field.grid.quantum = 2.0 * 0.00868 / 32767.0;  // the largest just fits
  field.bricks.resize(2);
  for (int i = 0; i < format::kBrickValues; ++i) {
    field.bricks[0].value[i] = 1e-4f * static_cast<float>(i - 60);  // -6 .. 6.4 mm
    field.bricks[1].value[i] = -7e-5f * static_cast<float>(i);      // .. -8.68 mm: the largest of all, halved once
  }
  for (Brick& brick : field.bricks) brick.lipschitz = 1.0f;
  field.index = {format::index_entry::kRefined};
  field.refined.resize(1);
  std::fill(std::begin(field.refined[0].child), std::end(field.refined[0].child), format::index_entry::kCoarse);
  field.refined[0].child[0] = 1;
  return field;
}

TEST(BrickPacking, RoundsToTheNearestByLevels) {
  DistanceGrid field = two_levels();
  field.bricks[1].deviation = static_cast<float>(2.5 * field.grid.quantum);
  field.bricks[1].exact = 65535;
  const std::vector<format::Brick> packed = packed_bricks(field);
  for (std::size_t b = 0; b < 2; ++b) {
    const double unit = b == 0 ? field.grid.quantum : 0.5 * field.grid.quantum;
    for (int i = 0; i < format::kBrickValues; ++i) {
      ASSERT_NEAR(unit * packed[b].value[i], static_cast<double>(field.bricks[b].value[i]), 0.5001 * unit) << b << i;
    }
  }
  EXPECT_EQ(packed[1].value[124], -32767);
  EXPECT_EQ(packed[0].deviation, 0);
  EXPECT_EQ(packed[1].deviation, 3);
  EXPECT_EQ(packed[1].exact, 65535);
}

TEST(BrickPacking, RefusesWhatDoesNotFit) {
  DistanceGrid field = two_levels();
  const auto refuses = [&field](auto change) {
    DistanceGrid spoiled = field;
    change(spoiled.bricks[1]);
    EXPECT_THROW(packed_bricks(spoiled), command::Failure);
  };
  refuses([](Brick& brick) { brick.exact = 65536; });
  refuses([](Brick& brick) { brick.lipschitz = 65536.0f; });
  refuses([&](Brick& brick) { brick.deviation = static_cast<float>(65536.0 * field.grid.quantum); });
  field.grid.quantum = 0.011 * field.grid.voxel_size;
  EXPECT_THROW(packed_bricks(field), command::Failure);
}

/// Rounding is far below the error of interpolation between the nodes.
TEST(BrickPacking, IsNothingBesideTheFieldsTolerance) {
  constexpr double kVoxel = 0.004;
  constexpr double kTolerance = 0.05;  // the scene file's default
  const SolidSurface surface(load("bracket", 1.0), SurfaceKind::kSolid, 2.0 * kVoxel);
  DistanceGrid field = make_distance_grid(surface, kVoxel, default_band(kVoxel, 1.5 * kVoxel), {});
  refine(field, surface, SurfaceTolerance::of_depth(kTolerance * kVoxel), {});
  EXPECT_LT(0.5 * field.grid.quantum, 0.01 * kTolerance * kVoxel);
  // every node is a whole number of its unit, and the largest fills the range
  const std::vector<format::Brick> packed = packed_bricks(field);
  int largest = 0;
  for (std::size_t b = 0; b < packed.size(); ++b) {
    for (int node = 0; node < format::kBrickValues; ++node) {
      const int value = packed[b].value[node];
      largest = std::max(largest, std::abs(value));
      if (value == 0) continue;
      const auto exact = static_cast<double>(field.bricks[b].value[node]);
      const double level = std::round(std::log2(field.grid.quantum * value / exact));
      ASSERT_NEAR(exact / std::ldexp(field.grid.quantum, -static_cast<int>(level)), value, 1e-2);
      ASSERT_LE(level, format::kMaxRefinement);
    }
  }
  EXPECT_GT(largest, 32767 - 2 * 136);
}

}  // namespace
}  // namespace godobject::scene_compiler::brick_packing_test
