#include "toolchain/scene_compiler/mesh/solid_surface.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/scene_compiler/brute_force.h"
#include "tests/scene_compiler/simple_meshes.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/scene_compiler/field/distance_probe.h"
#include "toolchain/scene_compiler/mesh/open_boundary.h"

namespace godobject::scene_compiler::solid_surface_test {
namespace {

using Eigen::Vector3d;

TriangleMesh unit_box() { return box(Vector3d::Zero(), Vector3d::Ones()); }

TEST(SolidSurface, GivesHandComputedDistancesOfABox) {
  const SolidSurface surface(unit_box(), SurfaceKind::kAuto, 0.1);
  EXPECT_DOUBLE_EQ(surface.signed_distance({0.5, 0.5, 0.5}), -0.5);
  EXPECT_DOUBLE_EQ(surface.signed_distance({0.5, 0.5, 0.9}), 0.5 - 0.5 - (1.0 - 0.9));
  EXPECT_DOUBLE_EQ(surface.signed_distance({0.5, 0.5, 3.0}), 2.0);
  EXPECT_DOUBLE_EQ(surface.signed_distance({2.0, 2.0, 0.5}), std::sqrt(2.0));  // to an edge
  EXPECT_DOUBLE_EQ(surface.signed_distance({2.0, 2.0, 2.0}), std::sqrt(3.0));  // to a corner
  EXPECT_NEAR(surface.winding_number({0.2, 0.3, 0.4}), 1.0, 1e-9);
  EXPECT_NEAR(surface.winding_number({1.2, 0.3, 0.4}), 0.0, 1e-9);
  EXPECT_NEAR(surface.components()[0].winding, 0.5, 1e-3);
}

TEST(SolidSurface, TakesAnOpenSheetForAShell) {
  const SolidSurface surface(box(Vector3d::Zero(), Vector3d::Ones(), {false, false, false, false, false, true}),
                             SurfaceKind::kAuto, 0.1);
  ASSERT_TRUE(surface.components()[0].shell);
  EXPECT_NEAR(surface.components()[0].winding, 0.0, 1e-9);
  EXPECT_NEAR(surface.signed_distance({0.5, 0.5, 1.0}), -0.05, 1e-12);
  EXPECT_NEAR(surface.signed_distance({0.5, 0.5, 1.3}), 0.25, 1e-12);
  EXPECT_NEAR(surface.signed_distance({0.5, 0.5, 0.7}), 0.25, 1e-12);
}

TEST(SolidSurface, ObeysTheSceneFileOverItsOwnJudgement) {
  const SolidSurface shell(unit_box(), SurfaceKind::kShell, 0.1);
  EXPECT_NEAR(shell.signed_distance({0.5, 0.5, 0.5}), 0.45, 1e-12);
  EXPECT_NEAR(shell.signed_distance({0.5, 0.5, 1.0}), -0.05, 1e-12);
  const SolidSurface solid(box(Vector3d::Zero(), Vector3d::Ones(), {true, true, true, true, true, false}),
                           SurfaceKind::kSolid, 0.1);
  EXPECT_LT(solid.signed_distance({0.5, 0.5, 0.5}), 0.0);
}

TEST(SolidSurface, TurnsASolidThatIsInsideOut) {
  const SolidSurface surface(turned_inside_out(unit_box()), SurfaceKind::kAuto, 0.1);
  EXPECT_TRUE(surface.components()[0].inside_out);
  EXPECT_FALSE(surface.components()[0].shell);
  EXPECT_NEAR(surface.signed_distance({0.5, 0.5, 0.5}), -0.5, 1e-12);
  EXPECT_GT(surface.signed_distance({1.5, 0.5, 0.5}), 0.0);
}

TEST(SolidSurface, LeavesACavityHollow) {
  const TriangleMesh cavity = turned_inside_out(box(Vector3d::Constant(0.3), Vector3d::Constant(0.7)));
  const SolidSurface surface(joined(unit_box(), cavity), SurfaceKind::kAuto, 0.1);
  ASSERT_EQ(surface.components().size(), 2u);
  EXPECT_FALSE(surface.components()[1].inside_out);
  EXPECT_NEAR(surface.signed_distance({0.5, 0.5, 0.5}), 0.2, 1e-12);
  EXPECT_NEAR(surface.signed_distance({0.5, 0.5, 0.15}), -0.15, 1e-12);
}

TEST(SolidSurface, TakesSheetsAboveEachOtherForShells) {
  const std::array<bool, 6> kTop = {false, false, false, false, false, true};
  const SolidSurface surface(joined(box({0, 0, -1}, {1, 1, 0}, kTop), box({0, 0, -1}, {1, 1, 0.05}, kTop)),
                             SurfaceKind::kAuto, 0.01);
  EXPECT_TRUE(surface.components()[0].shell);
  EXPECT_TRUE(surface.components()[1].shell);
  EXPECT_NEAR(surface.signed_distance({0.5, 0.5, 0.05}), -0.005, 1e-12);
}

TEST(SolidSurface, TakesTwoFacesOfAPlateForASolid) {
  const SolidSurface surface(joined(box({0, 0, 0}, {1, 1, 0.05}, {false, false, false, false, false, true}),
                                    box({0, 0, 0}, {1, 1, 0.05}, {false, false, false, false, true, false})),
                             SurfaceKind::kAuto, 0.01);
  EXPECT_FALSE(surface.components()[0].shell);
  EXPECT_FALSE(surface.components()[1].shell);
  EXPECT_NEAR(surface.signed_distance({0.5, 0.5, 0.02}), -0.02, 1e-12);
}

TEST(SolidSurface, MixesSolidAndShell) {
  const TriangleMesh sheet = box({2, 0, 0}, {3, 1, 1}, {false, false, false, false, false, true});
  const SolidSurface surface(joined(unit_box(), sheet), SurfaceKind::kAuto, 0.1);
  EXPECT_FALSE(surface.components()[0].shell);
  EXPECT_TRUE(surface.components()[1].shell);
  EXPECT_NEAR(surface.signed_distance({0.5, 0.5, 0.5}), -0.5, 1e-12);
  EXPECT_NEAR(surface.signed_distance({2.5, 0.5, 1.0}), -0.05, 1e-12);
  EXPECT_NEAR(surface.closest({2.5, 0.5, 1.2}).distance, 0.2, 1e-12);
  EXPECT_EQ(surface.component_of_triangle()[surface.closest({2.5, 0.5, 1.2}).triangle], 1u);
}

TEST(SolidSurface, CallsTheTeapotAndTheBunnySolid) {
  for (const char* name : {"teapot", "bunny_npm", "dragon_clean", "plate_2mm"}) {
    const SolidSurface surface(load(name, 1.0), SurfaceKind::kAuto, 0.01);
    for (const auto& component : surface.components()) {
      EXPECT_FALSE(component.shell) << name;
      EXPECT_FALSE(component.inside_out) << name;
      EXPECT_GT(component.winding, 0.25) << name;
    }
  }
}

TEST(SolidSurface, FindsWhatBruteForceFinds) {
  for (const auto& [name, scale] :
       {std::pair{"teapot", 0.037}, std::pair{"hole_round", 1.0}, std::pair{"bunny_npm", 0.0161497}}) {
    const SolidSurface surface(load(name, scale), SurfaceKind::kAuto, 0.01);
    const BruteForce truth(surface.mesh());
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(-0.15, 0.15);
    for (int i = 0; i < 300; ++i) {
      const Vector3d p(unit(random), unit(random), unit(random));
      const double distance = truth.distance(p);
      const double winding = truth.winding_number(p);
      EXPECT_NEAR(surface.closest(p).distance, distance, 1e-12) << name;
      EXPECT_NEAR(surface.closest(p, 1.01 * distance).distance, distance, 1e-12) << name;
      EXPECT_NEAR(surface.closest(p, 0.5 * distance).distance, distance, 1e-12) << name << ": a wrong hint";
      EXPECT_NEAR(surface.winding_number(p), winding, 0.08) << name;
      if (std::abs(winding - 0.5) > 1e-6) {
        EXPECT_EQ(surface.winding_number(p) > 0.5, winding > 0.5) << name << " " << winding;
      }
    }
  }
}

/// A cup with flat sides around the z axis: `sides` of them, each of `kRings` quads, and a bottom at z = 0 if asked
/// for.
TriangleMesh cup(std::uint32_t sides, double radius, double height, bool has_bottom) {
  constexpr std::uint32_t kRings = 9;
  TriangleMesh mesh;
  for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 0.1 + 2.0 * std::numbers::pi * i / sides;
      mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height * ring / kRings);
    }
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t low = ring * sides + i;
      const std::uint32_t next = ring * sides + (i + 1) % sides;
      mesh.triangles.push_back({low, next, next + sides});
      mesh.triangles.push_back({low, next + sides, low + sides});
    }
  }
  for (std::uint32_t i = 1; has_bottom && i + 1 < sides; ++i) mesh.triangles.push_back({0, i + 1, i});
  return mesh;
}

/// The largest error of a winding number that SolidSurface allows for.
constexpr double kMostWindingError = 0.08;

void expect_winding_of_a_sum(const SolidSurface& surface, const Vector3d& p) {
  const double sum = surface.solid_triangles().winding_number(p, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(surface.winding_number(p), sum, kMostWindingError) << p.transpose();
  if (std::abs(sum - 0.5) < 1e-6) return;
  EXPECT_EQ(surface.winding_number(p) > 0.5, sum > 0.5) << p.transpose();
}

/// Open meshes with few caps. The points are all around, in the plane of the rim, and beside the rim.
TEST(SolidSurface, HasTheWindingNumberOfASumWhereMeshesAreOpen) {
  const TriangleMesh open = cup(24, 0.5, 1.0, true);
  TriangleMesh doubled = open;  // its rim counts twice
  doubled.triangles.insert(doubled.triangles.end(), open.triangles.begin(), open.triangles.end());
  TriangleMesh holed = test::ball_mesh(0.5, 20);
  for (const std::ptrdiff_t at : {130, 180, 181, 320}) holed.triangles.erase(holed.triangles.begin() + at);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-0.6, 1.3);
  std::uniform_real_distribution<double> beside(-0.01, 0.01);
  for (const TriangleMesh& mesh : {open, cup(24, 0.5, 1.0, false), doubled, holed, turned_inside_out(open)}) {
    const SolidSurface surface(mesh, SurfaceKind::kSolid, 0.01);
    ASSERT_FALSE(surface.sealed());
    for (int i = 0; i < 3000; ++i) {
      Vector3d p(unit(random), unit(random), unit(random));
      if (i % 3 == 0) p.z() = 1.0;
      if (i % 3 == 1) {
        p = surface.mesh().vertices[random() % surface.mesh().vertices.size()] +
            Vector3d(beside(random), beside(random), beside(random));
      }
      expect_winding_of_a_sum(surface, p);
    }
  }
}

/// The middle of a flat rim is rounded, so that its caps may reach beyond the mesh by some roundings.
TEST(SolidSurface, HasTheWindingNumberOfASumOneRoundingFromARim) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(-0.02, 0.02);
  for (const std::uint32_t sides : {12u, 24u, 64u}) {
    for (int millimetres = 40; millimetres < 200; millimetres += 3) {
      const double height = 0.001 * millimetres;
      const SolidSurface surface(cup(sides, 0.02, height, true), SurfaceKind::kSolid, 0.01);
      for (int i = 0; i < 8; ++i) {
        double z = height;
        for (int step = 0; step < 1 + i % 4; ++step) z = std::nextafter(z, i % 8 < 4 ? 1.0 : 0.0);
        expect_winding_of_a_sum(surface, {unit(random), unit(random), z});
      }
    }
  }
}

/// Random triangles that share edges in all ways: flat, on a lattice, and in general position.
TEST(OpenBoundary, HasAnIntegerWindingNumberTogetherWithItsSolids) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(-0.2, 1.2);
  const auto vertex = [&](int kind) {
    const Vector3d p(unit(random), unit(random), kind == 1 ? 0.3 : unit(random));
    return kind == 0 ? Vector3d(0.5 * (2.0 * p).array().round()) : p;
  };
  for (int round = 0; round < 300; ++round) {
    TriangleMesh mesh;
    for (int i = 0; i < 12; ++i) mesh.vertices.push_back(vertex(round % 3));
    for (int i = 0; i < 4 + round % 60; ++i) {
      const auto a = static_cast<std::uint32_t>(random() % 12);
      mesh.triangles.push_back({a, (a + 1 + static_cast<std::uint32_t>(random() % 5)) % 12,
                                (a + 6 + static_cast<std::uint32_t>(random() % 6)) % 12});
    }
    const SolidSurface surface(mesh, round % 2 == 0 ? SurfaceKind::kAuto : SurfaceKind::kSolid, 0.01);
    const OpenBoundary boundary = open_boundary(surface.mesh(), surface.components(), surface.component_of_triangle());
    for (int i = 0; i < 50; ++i) {
      const Vector3d p(unit(random), unit(random), unit(random));
      const double together =
          surface.solid_triangles().winding_number(p, kInfinity) + boundary.caps.winding_number(p, kInfinity);
      EXPECT_NEAR(together, std::round(together), 1e-9) << round;
      expect_winding_of_a_sum(surface, p);
    }
  }
}

/// A cup has few and small caps. Without every second triangle a ball has many, and a short wide pipe has large ones.
TEST(OpenBoundary, DoesNotSumOverManyOrLargeCaps) {
  const SolidSurface open(cup(24, 0.5, 1.0, true), SurfaceKind::kSolid, 0.01);
  EXPECT_TRUE(open_boundary(open.mesh(), open.components(), open.component_of_triangle()).caps_are_small);
  TriangleMesh every_second = test::ball_mesh(0.5, 20);
  std::size_t number = 0;
  std::erase_if(every_second.triangles, [&](const auto&) { return ++number % 2 == 0; });
  const SolidSurface many(every_second, SurfaceKind::kSolid, 0.01);
  EXPECT_FALSE(open_boundary(many.mesh(), many.components(), many.component_of_triangle()).caps_are_small);
  const SolidSurface large(cup(24, 0.5, 0.05, false), SurfaceKind::kSolid, 0.01);
  EXPECT_FALSE(open_boundary(large.mesh(), large.components(), large.component_of_triangle()).caps_are_small);
}

TEST(DistanceProbe, GivesTheSameOnAWalkAsAlone) {
  for (const char* name : {"teapot", "bunny_npm", "cube_100mm"}) {
    const double scale = std::string(name) == "teapot" ? 0.037 : std::string(name) == "bunny_npm" ? 0.0161497 : 1.0;
    const SolidSurface surface(load(name, scale), SurfaceKind::kAuto, 0.01);
    DistanceProbe probe(surface);
    std::mt19937_64 random(2);
    std::normal_distribution<double> step(0.0, 0.003);
    Vector3d p = surface.mesh().vertices[0];
    for (int i = 0; i < 3000; ++i) {
      p += Vector3d(step(random), step(random), step(random));
      if (p.norm() > 0.2) p = surface.mesh().vertices[static_cast<std::size_t>(i) % surface.mesh().vertices.size()];
      ASSERT_EQ(probe.signed_distance(p), surface.signed_distance(p))
          << name << " step " << i << " " << surface.winding_number(p);
    }
  }
}

/// Steps through edges and corners of a box and through the diagonals of its faces, where a crossing is not sure.
TEST(DistanceProbe, CountsStepsThroughEdges) {
  const SolidSurface surface(test::box_mesh({2.0, 2.0, 2.0}), SurfaceKind::kSolid, 0.01);
  ASSERT_TRUE(surface.sealed());
  DistanceProbe probe(surface);
  constexpr std::array<double, 5> kPlaces = {-1.5, -0.5, 0.0, 0.5, 1.5};
  std::mt19937_64 random(4);
  for (int i = 0; i < 5000; ++i) {
    const Vector3d p(kPlaces[random() % 5], kPlaces[random() % 5], kPlaces[random() % 5]);
    ASSERT_EQ(probe.signed_distance(p), surface.signed_distance(p)) << i;
  }
}

/// Walks that cross the surface all the time, some through its hole: the sides are those of a sum at each place.
TEST(DistanceProbe, CountsCrossingsBesideAHole) {
  TriangleMesh holed = test::ball_mesh(0.02, 6);
  holed.triangles.erase(holed.triangles.begin() + 30);
  const SolidSurface surface(holed, SurfaceKind::kSolid, 0.01);
  ASSERT_FALSE(surface.sealed());
  DistanceProbe probe(surface);
  std::mt19937_64 random(3);
  std::normal_distribution<double> any(0.0, 1.0);
  int insides = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double step = i % 50 == 0 ? 0.02 : 1e-4;
    const Vector3d direction = Vector3d(any(random), any(random), any(random)).normalized();
    const Vector3d p = (0.019 + step * any(random)) * direction;
    const double distance = probe.signed_distance(p);
    ASSERT_EQ(distance, surface.signed_distance(p)) << i << " " << surface.winding_number(p);
    insides += distance < 0.0 ? 1 : 0;
  }
  EXPECT_GT(insides, 2000);
  EXPECT_LT(insides, 18'000);
}

}  // namespace
}  // namespace godobject::scene_compiler::solid_surface_test
