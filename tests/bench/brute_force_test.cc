#include "toolchain/bench/brute_force.h"

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random.h"
#include "tests/support/small_scenes.h"
#include "toolchain/bench/peers.h"

namespace godobject::bench {
namespace {

using test::Random;

/// A lattice, points and room for the points that a scan finds.
struct ScanWorld {
  std::array<std::int32_t, 3> nodes;
  std::vector<float> values;
  std::vector<float> x, y, z;
  std::vector<std::uint32_t> order;
  std::size_t count;
  std::vector<std::uint32_t> scratch, index;
  std::array<std::vector<float>, 4> found;

  /// `value` is a function of node coordinates; the points are in lattice coordinates.
  template <class Value>
  ScanWorld(std::array<std::int32_t, 3> lattice, const std::vector<Vector3>& points, Value&& value)
      : nodes(lattice), count(points.size()) {
    for (int k = 0; k < nodes[2]; ++k) {
      for (int j = 0; j < nodes[1]; ++j) {
        for (int i = 0; i < nodes[0]; ++i) values.push_back(static_cast<float>(value(Vector3(i, j, k))));
      }
    }
    const std::size_t padded = (count + PointView::kPad - 1) / PointView::kPad * PointView::kPad;
    for (auto* component : {&x, &y, &z}) component->assign(padded, 0.0f);
    order.assign(padded, 0);
    for (std::size_t n = 0; n < count; ++n) {
      x[n] = static_cast<float>(points[n].x());
      y[n] = static_cast<float>(points[n].y());
      z[n] = static_cast<float>(points[n].z());
      order[n] = static_cast<std::uint32_t>(count - 1 - n);  // no order that a scan could guess
    }
    scratch.resize(padded + PointView::kPad);
    index.resize(padded + PointView::kPad);
    for (auto& component : found) component.resize(padded + PointView::kPad);
  }

  NearList scan(PointScan how, const LatticePose& pose, const ScanLimits& limits) {
    NearList near{index.data(), found[0].data(), found[1].data(), found[2].data(), found[3].data(), 0};
    const GridView grid{values.data(), {nodes[0], nodes[1], nodes[2]}};
    how(grid, {x.data(), y.data(), z.data(), order.data(), count}, pose, limits, scratch.data(), near);
    return near;
  }
};

constexpr LatticePose kStill{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};

TEST(PointScan, FindsALinearFieldExactly) {
  // phi = x - 2 y + 4 z - 3 in lattice units, of a voxel of half a metre
  const auto field = [](const Vector3& q) { return q.x() - 2.0 * q.y() + 4.0 * q.z() - 3.0; };
  ScanWorld world({5, 6, 7}, {{1.25, 3.5, 2.125}, {3.0, 1.0, 1.5}, {0.5, 4.75, 0.25}}, field);
  for (const NamedScan& scan : runnable_scans()) {
    SCOPED_TRACE(scan.name);
    const NearList near = world.scan(scan.scan, kStill, {0.0f, 4.0f, 2.0f});
    ASSERT_EQ(near.count, 2u);
    std::map<std::uint32_t, float> distance;
    for (std::size_t k = 0; k < near.count; ++k) {
      distance[near.index[k]] = near.distance[k];
      EXPECT_FLOAT_EQ(near.gradient_x[k], 2.0f);
      EXPECT_FLOAT_EQ(near.gradient_y[k], -4.0f);
      EXPECT_FLOAT_EQ(near.gradient_z[k], 8.0f);
    }
    EXPECT_FLOAT_EQ(distance.at(2), 1.25f - 7.0f + 8.5f - 3.0f);  // the first point
    EXPECT_FLOAT_EQ(distance.at(0), 0.5f - 9.5f + 1.0f - 3.0f);   // the last one
  }
}

TEST(PointScan, TurnsAndShiftsThePoints) {
  // a quarter turn about z: (1, 0, 0) goes to (0, 1, 0), then to (2, 3, 2)
  const LatticePose pose{{0, -1, 0, 1, 0, 0, 0, 0, 1}, {2, 2, 2}};
  ScanWorld world({5, 5, 5}, {{1.0, 0.0, 0.0}}, [](const Vector3& q) { return 10.0 * q.x() + q.y() - 100.0; });
  for (const NamedScan& scan : runnable_scans()) {
    const NearList near = world.scan(scan.scan, pose, {0.0f, 1.0f, 1.0f});
    ASSERT_EQ(near.count, 1u) << scan.name;
    EXPECT_FLOAT_EQ(near.distance[0], 20.0f + 3.0f - 100.0f);
  }
}

TEST(PointScan, TakesTheBorderForWhatLiesBeyondIt) {
  ScanWorld world({4, 4, 4}, {{-50.0, 1.0, 1.0}, {1.0, 99.0, 1.0}, {1.0, 1.0, -1e6}, {3.0, 3.0, 3.0}},
                  [](const Vector3&) { return 1.0; });
  for (const NamedScan& scan : runnable_scans()) {
    EXPECT_EQ(world.scan(scan.scan, kStill, {0.5f, 1.5f, 1.0f}).count, 0u) << scan.name;
    EXPECT_EQ(world.scan(scan.scan, kStill, {2.0f, 3.0f, 1.0f}).count, 4u) << scan.name;
  }
}

TEST(PointScan, DoesNotFindThePaddingBehindTheLastPoint) {
  for (const std::size_t count : {1u, 7u, 8u, 9u, 15u, 16u, 17u, 33u}) {
    ScanWorld world({3, 3, 3}, std::vector<Vector3>(count, Vector3(1.0, 1.0, 1.0)),
                    [](const Vector3&) { return -1.0; });
    for (const NamedScan& scan : runnable_scans()) {
      EXPECT_EQ(world.scan(scan.scan, kStill, {0.0f, 1.0f, 1.0f}).count, count) << scan.name;
    }
  }
}

TEST(PointScan, AllWaysFindTheSameOfARandomCloudAboutABall) {
  constexpr double kCut = 0.4;        // lattice units
  constexpr double kRounding = 2e-5;  // of coordinates up to 30 in single precision
  Random random(7);
  std::vector<Vector3> points;
  for (int i = 0; i < 1237; ++i) points.push_back(random.in_cube(14.0));
  const Vector3 center(15.3, 14.8, 15.1);
  ScanWorld world({31, 30, 32}, points, [&](const Vector3& q) { return (q - center).norm() - 8.0; });
  for (int trial = 0; trial < 20; ++trial) {
    const Matrix3 R = exp_rotation(random.motion(1.0, 3.0).rotation).toRotationMatrix();
    LatticePose pose;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) pose.m[3 * i + j] = static_cast<float>(R(i, j));
      pose.t[i] = static_cast<float>(15.0 + random.between(-4.0, 4.0));
    }
    std::map<std::uint32_t, std::array<float, 4>> wanted;
    const auto read = [&](const NearList& near) {
      std::map<std::uint32_t, std::array<float, 4>> result;
      for (std::size_t k = 0; k < near.count; ++k) {
        result[near.index[k]] = {near.distance[k], near.gradient_x[k], near.gradient_y[k], near.gradient_z[k]};
      }
      EXPECT_EQ(result.size(), near.count);
      return result;
    };
    const ScanLimits limits{static_cast<float>(kCut), static_cast<float>(kCut + 1.0), 1.0f};
    for (const NamedScan& scan : runnable_scans()) {
      SCOPED_TRACE(scan.name);
      const auto found = read(world.scan(scan.scan, pose, limits));
      if (wanted.empty()) wanted = found;
      EXPECT_GT(found.size(), 100u);
      for (const bool forth : {true, false}) {
        const auto& one = forth ? wanted : found;
        const auto& other = forth ? found : wanted;
        for (const auto& [index, values] : one) {
          if (std::fabs(static_cast<double>(values[0]) - kCut) < kRounding) continue;
          ASSERT_TRUE(other.contains(index)) << "at a distance of " << values[0];
          EXPECT_NEAR(values[0], other.at(index)[0], kRounding);
        }
      }
      // a coordinate on a cell's face may fall into either cell, with either's gradient
      std::size_t elsewhere = 0;
      for (const auto& [index, values] : found) {
        if (!wanted.contains(index)) continue;
        for (std::size_t c = 1; c < 4; ++c) elsewhere += std::fabs(values[c] - wanted[index][c]) > 1e-3f ? 1u : 0u;
      }
      EXPECT_LE(elsewhere, 3u);
    }
  }
}

TEST(BruteForce, FindsTheSamePointsAsTheTree) {
  const auto image = test::ball_over_plate();
  SceneView scene;
  ASSERT_EQ(SceneView::open(image.bytes(), scene), Status::kOk);
  Random random(3);
  std::vector<Pose> poses;
  std::vector<std::size_t> cycles;
  for (std::size_t i = 0; i < 50; ++i) {
    Pose H_WS;
    H_WS.rotation = exp_rotation(random.motion(1.0, 3.0).rotation);
    H_WS.translation = Vector3(random.between(-0.06, 0.06), random.between(-0.06, 0.06), random.between(-0.02, 0.035));
    poses.push_back(H_WS);
    cycles.push_back(i);
  }
  const Agreement found = agreement(scene, poses, cycles);
  EXPECT_EQ(found.poses, 50u);
  EXPECT_GT(found.points, 1000u);
  EXPECT_LT(found.worst, 1e-7);           // rounding of single precision, at 0.1 m
  EXPECT_LT(found.worst_distance, 1e-7);  // without refined bricks the grid is the same field
  EXPECT_EQ(found.missed_by_cull, 0u);
}

TEST(BruteForce, FindsNothingFarAway) {
  const auto image = test::ball_over_plate();
  SceneView scene;
  ASSERT_EQ(SceneView::open(image.bytes(), scene), Status::kOk);
  BruteForce brute(scene, 0.125 * scene.grid.voxel_size);
  Pose far;
  for (const Vector3& at : {Vector3(0.3, 0.0, 0.0), Vector3(0.0, 0.0, 0.04), Vector3(-1e3, 1e3, -1e3)}) {
    far.translation = at;
    for (const NamedScan& scan : runnable_scans()) EXPECT_EQ(brute.scan(scan.scan, far).count, 0u) << scan.name;
  }
}

}  // namespace
}  // namespace godobject::bench
