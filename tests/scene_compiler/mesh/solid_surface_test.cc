#include "toolchain/scene_compiler/mesh/solid_surface.h"

#include <array>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/scene_compiler/brute_force.h"
#include "tests/scene_compiler/simple_meshes.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/scene_compiler/field/distance_probe.h"

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

/// Meshes with holes: the winding number of caps is taken from a whole number. The points lie all about, on the caps
/// and beside their rims, where the sum over all triangles must decide.
TEST(SolidSurface, HasTheWindingNumberOfASumWhereMeshesAreOpen) {
  const TriangleMesh open_box = box(Vector3d::Zero(), Vector3d::Ones(), {true, true, true, true, true, false});
  TriangleMesh pipe = box(Vector3d::Zero(), Vector3d::Ones(), {true, true, true, true, false, false});
  TriangleMesh doubled = open_box;  // its rim counts twice
  doubled.triangles.insert(doubled.triangles.end(), open_box.triangles.begin(), open_box.triangles.end());
  TriangleMesh holed = test::ball_mesh(0.5, 6);
  for (const std::ptrdiff_t at : {30, 40, 41, 60}) holed.triangles.erase(holed.triangles.begin() + at);
  for (Vector3d& vertex : holed.vertices) vertex += Vector3d::Constant(0.5);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-0.3, 1.3);
  std::uniform_real_distribution<double> beside(-0.01, 0.01);
  for (const TriangleMesh& mesh : {open_box, pipe, doubled, holed, turned_inside_out(open_box)}) {
    const SolidSurface surface(mesh, SurfaceKind::kSolid, 0.01);
    ASSERT_FALSE(surface.sealed());
    for (int i = 0; i < 3000; ++i) {
      Vector3d p(unit(random), unit(random), unit(random));
      if (i % 3 == 0) p.z() = 1.0;  // the lid of the boxes
      if (i % 3 == 1) {
        p = surface.mesh().vertices[random() % surface.mesh().vertices.size()] +
            Vector3d(beside(random), beside(random), beside(random));
      }
      const double sum = surface.solid_triangles().winding_number(p, std::numeric_limits<double>::infinity());
      ASSERT_NEAR(surface.winding_number(p), sum, 0.08) << p.transpose();
      if (std::abs(sum - 0.5) < 1e-6) continue;
      ASSERT_EQ(surface.winding_number(p) > 0.5, sum > 0.5) << p.transpose();
    }
  }
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
