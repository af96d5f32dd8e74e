#include "core/pipeline/contact/even_pressure.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "core/pipeline/contact/contact_scene.h"
#include "tests/support/analytic_worlds.h"
#include "tests/support/random.h"

namespace godobject::even_pressure_test {
namespace {

using test::AnalyticField;
using test::AnalyticRun;
using test::ContactCycle;
using test::HalfSpace;
using test::Random;
using test::SampledBody;
using test::SurfaceSamples;

constexpr double kMargin = 2e-5;
constexpr double kVoxel = 0.002;
constexpr double kBottom = -0.01;

/// The lower face of a box, its corners and its edges, whose normals lie between those of the faces. The edges have ten
/// times as many points as the face.
SurfaceSamples lower_face(double length, double width, int per_length = 41, int per_width = 31) {
  SurfaceSamples samples;
  const auto add = [&](double x, double y, const Vector3& into) {
    samples.points.push_back({x, y, kBottom});
    samples.normals.push_back(into.normalized());
  };
  for (int j = 0; j < per_width; ++j) {
    for (int i = 0; i < per_length; ++i) {
      add(length * ((i + 0.5) / per_length - 0.5), width * ((j + 0.5) / per_width - 0.5), Vector3::UnitZ());
    }
  }
  for (const double side : {1.0, -1.0}) {
    for (int i = 0; i <= 10 * per_length; ++i) {
      add(length * (i / (10.0 * per_length) - 0.5), 0.5 * width * side, {0.0, -side, 1.0});
    }
    for (int j = 0; j <= 10 * per_width; ++j) {
      add(0.5 * length * side, width * (j / (10.0 * per_width) - 0.5), {-side, 0.0, 1.0});
    }
  }
  return samples;
}

/// Places of a face with their shares of the load.
struct Load {
  std::vector<Eigen::Vector2d> at;
  std::vector<double> share;

  /// Returns the least mean distance from any place: by Weiszfeld's method until it does not move.
  double least_mean_distance() const {
    Eigen::Vector2d x = Eigen::Vector2d::Zero();
    double whole = 0.0;
    for (const double here : share) whole += here;
    double mean = 0.0;
    for (int k = 0; k < 60; ++k) {
      Eigen::Vector2d next = Eigen::Vector2d::Zero();
      double weights = 0.0;
      mean = 0.0;
      for (std::size_t i = 0; i < at.size(); ++i) {
        const double distance = std::max((at[i] - x).norm(), 1e-9);
        mean += share[i] / whole * distance;
        weights += share[i] / distance;
        next += share[i] / distance * at[i];
      }
      x = next / weights;
    }
    return mean;
  }
};

/// Returns the least mean distance under the linear pressure with the centre `centre` on a rectangle: by a fine sum,
/// and by the pressure's equations, not those of the code. Negative pressure counts as none.
double mean_distance(double length, double width, const Eigen::Vector2d& centre) {
  const double x2 = length * length / 12.0;  // second moments of a rectangle
  const double y2 = width * width / 12.0;
  Load load;
  constexpr int kParts = 100;
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; j < kParts; ++j) {
      const double x = length * ((i + 0.5) / kParts - 0.5);
      const double y = width * ((j + 0.5) / kParts - 0.5);
      const double p = 1.0 + centre.x() * x / x2 + centre.y() * y / y2;
      if (p <= 0.0) continue;
      load.at.push_back({x, y});
      load.share.push_back(p);
    }
  }
  return load.least_mean_distance();
}

/// Sample points that touch a floor, and the forces of the last cycle.
class OnFace {
 public:
  explicit OnFace(const SurfaceSamples& samples) : body_(samples, Vector3::Ones()), shell_(body_.pointshell()) {
    for (std::uint32_t i = 0; i < shell_.size; ++i) touch(i, kMargin);
  }

  void touch(std::uint32_t i, double distance) {
    near_->index[near_->count] = i;
    const Vector3 p = shell_.point(i);
    near_->x[near_->count] = static_cast<float>(p.x());
    near_->y[near_->count] = static_cast<float>(p.y());
    near_->z[near_->count] = static_cast<float>(p.z());
    near_->distance[near_->count++] = distance;
  }
  void push(const Vector3& point, double load, const Vector3& normal = Vector3::UnitZ()) {
    ContactForce& force = step.forces[step.force_count++];
    force.point = force.grip = point;
    force.normal = normal;
    force.multiplier = load;
  }
  ContactPatches patches() const {
    Parameters q;
    q.margin = kMargin;
    q.voxel_size = kVoxel;
    WorkMeter work;
    return detail::patches_of(step, *near_, ContactLengths::make(q), work);
  }
  NearPoints& near() { return *near_; }

  ConstrainedStep step;

 private:
  SampledBody body_;
  Pointshell shell_;
  std::unique_ptr<NearPoints> near_ = std::make_unique<NearPoints>();
};

/// Corners carry the load of a rectangle. Its centre moves over the face; beyond a sixth of the length the linear
/// pressure does not reach the far side.
TEST(EvenPressure, IsLinearOverARectangleThatCornersHold) {
  constexpr double kLength = 0.04, kWidth = 0.03;
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    OnFace on(lower_face(kLength, kWidth));
    const double u = i == 0 ? 0.5 : random.between(0.36, 0.64);  // of length and width
    const double v = i == 0 ? 0.5 : random.between(0.36, 0.64);
    const auto corner = [&](double x, double y) { return Vector3(kLength * x, kWidth * y, kBottom); };
    on.push(corner(-0.5, -0.5), (1.0 - u) * (1.0 - v));
    on.push(corner(0.5, -0.5), u * (1.0 - v));
    on.push(corner(-0.5, 0.5), (1.0 - u) * v);
    on.push(corner(0.5, 0.5), u * v);
    const ContactPatches patches = on.patches();
    ASSERT_EQ(patches.count, 1u);
    const ContactPatch& face = patches.patch[0];
    const Eigen::Vector2d centre(kLength * (u - 0.5), kWidth * (v - 0.5));
    EXPECT_LT((face.centre - Vector3(centre.x(), centre.y(), kBottom)).norm(), 1e-8);
    Load corners;
    for (std::uint32_t j = 0; j < 4; ++j) {
      corners.at.push_back(on.step.forces[j].point.head<2>());
      corners.share.push_back(on.step.forces[j].multiplier);
    }
    const double of_forces = corners.least_mean_distance();
    const double expected = mean_distance(kLength, kWidth, centre) / of_forces;
    EXPECT_NEAR(face.share, expected, 0.01 * expected) << u << " " << v;
    // the points' friction acts on the lines to the centre, in the plane
    for (std::uint32_t j = 0; j < 4; ++j) {
      const Vector3 p = on.step.forces[j].point;
      const Vector3 grip = patches.grip(Vector3::UnitZ(), p, kMargin);
      EXPECT_LT((grip - face.centre - face.share * (p - face.centre)).norm(), 1e-9);
    }
  }
}

TEST(EvenPressure, NeedsAFaceAndSeveralForces) {
  const SurfaceSamples face = lower_face(0.04, 0.03);
  {
    OnFace on(face);
    on.push({0.01, 0.0, kBottom}, 1.0);
    EXPECT_EQ(on.patches().count, 0u) << "one force";
    on.push({0.01, 0.0, kBottom}, 1.0);
    EXPECT_EQ(on.patches().count, 0u) << "two forces at one point";
    on.push({-0.01, 0.01, kBottom}, 1.0, {0.1, 0.0, std::sqrt(0.99)});
    EXPECT_EQ(on.patches().count, 0u) << "another normal";
    on.push({-0.01, 0.01, kBottom + 2.0 * kMargin}, 1.0);
    EXPECT_EQ(on.patches().count, 0u) << "another plane";
    on.push({-0.01, 0.01, kBottom}, 1.0);
    EXPECT_EQ(on.patches().count, 1u);
    on.near().count = 11;
    EXPECT_EQ(on.patches().count, 0u) << "too few points";
  }
  OnFace on(face);
  on.push({0.02, 0.015, kBottom}, 1.0);
  on.push({-0.02, -0.015, kBottom}, 1.0);
  EXPECT_EQ(on.patches().count, 1u);
  for (std::uint32_t k = 0; k < on.near().count; ++k) on.near().distance[k] = 2.1 * kMargin;
  EXPECT_EQ(on.patches().count, 0u) << "nothing touches";
  for (std::uint32_t k = 0; k < on.near().count; ++k) {
    on.near().distance[k] = kMargin;
    on.near().y[k] = 0.0f;
  }
  EXPECT_EQ(on.patches().count, 0u) << "points on a line";
}

/// Points on a diagonal of the plane's axes cover nothing.
TEST(EvenPressure, NeedsMoreThanALineAcross) {
  SurfaceSamples line;
  for (int i = -16; i <= 16; ++i) {
    line.points.push_back({i / 1024.0, i / 1024.0, kBottom});
    line.normals.push_back(Vector3::UnitZ());
  }
  OnFace on(line);
  on.push({1.0 / 64.0, 1.0 / 64.0, kBottom}, 1.0);
  on.push({-1.0 / 64.0, -1.0 / 64.0, kBottom}, 1.0);
  EXPECT_EQ(on.patches().count, 0u);
}

/// A face of 40 mm that is narrower than a thousandth of its length counts as a line, even if its points lie on its two
/// long sides only. One that is a little wider is a face. Both lie along either axis of the plane.
TEST(EvenPressure, TakesAFaceBelowAThousandthOfItsLengthForALine) {
  constexpr double kLength = 0.04;
  for (const double width : {0.9e-3 * kLength, 1.2e-3 * kLength}) {
    for (const bool along_x : {true, false}) {
      const auto at = [&](double along, double across) {
        return along_x ? Vector3(along, across, kBottom) : Vector3(across, along, kBottom);
      };
      SurfaceSamples sides;
      for (int i = -16; i <= 16; ++i) {
        for (const double side : {-0.5, 0.5}) {
          sides.points.push_back(at(kLength / 32.0 * i, width * side));
          sides.normals.push_back(Vector3::UnitZ());
        }
      }
      OnFace on(sides);
      on.push(at(0.5 * kLength, 0.5 * width), 1.0);
      on.push(at(-0.5 * kLength, -0.5 * width), 1.0);
      EXPECT_EQ(on.patches().count, width < 1e-3 * kLength ? 0u : 1u) << width << ' ' << along_x;
    }
  }
}

/// A face whose forces carry no load has no patch.
TEST(EvenPressure, HasNoPatchOnAFaceWithoutLoad) {
  SurfaceSamples face = lower_face(0.04, 0.03);
  for (Vector3& p : face.points) p.z() = 0.0;
  OnFace on(face);
  on.push({0.02, 0.015, 0.0}, 0.0);
  on.push({-0.02, -0.015, 0.0}, 0.0);
  EXPECT_EQ(on.patches().count, 0u);
}

/// A grid of twelve points is a face, eleven of them are not.
TEST(EvenPressure, NeedsTwelvePointsThatTouch) {
  SurfaceSamples grid;
  for (int i = 0; i < 12; ++i) {
    const int column = i % 4, row = i / 4;
    grid.points.push_back({0.01 * (column - 1.5), 0.01 * (row - 1.0), kBottom});
    grid.normals.push_back(Vector3::UnitZ());
  }
  OnFace on(grid);
  on.push({0.03, 0.01, kBottom}, 1.0);
  on.push({-0.03, -0.01, kBottom}, 1.0);
  EXPECT_EQ(on.patches().count, 1u);
  for (std::uint32_t away = 0; away < 12; ++away) {
    on.near().distance[away] = 2.1 * kMargin;
    EXPECT_EQ(on.patches().count, 0u) << "without point " << away;
    on.near().distance[away] = kMargin;
  }
  on.near().count = 11;
  EXPECT_EQ(on.patches().count, 0u) << "what lies behind the last point is no point";
}

/// Three points along one side cover their rectangle with few or many along the other, also between the points.
TEST(EvenPressure, CoversARectangleOfFewPoints) {
  constexpr double kLength = 0.04, kWidth = 0.03;
  const double of_forces = 0.5 * std::hypot(kLength, kWidth);
  const double expected = mean_distance(kLength, kWidth, Eigen::Vector2d::Zero()) / of_forces;
  for (const int more : {5, 6, 8, 9, 18, 27}) {
    for (const bool is_turned : {false, true}) {
      const int columns = is_turned ? more : 3, rows = is_turned ? 3 : more;
      SurfaceSamples grid;
      for (int i = 0; i < columns * rows; ++i) {
        const double u = i % columns / (columns - 1.0), v = i / columns / (rows - 1.0);
        grid.points.push_back({kLength * (u - 0.5), kWidth * (v - 0.5), kBottom});
        grid.normals.push_back(Vector3::UnitZ());
      }
      OnFace on(grid);
      on.push({0.5 * kLength, 0.5 * kWidth, kBottom}, 1.0);
      on.push({-0.5 * kLength, -0.5 * kWidth, kBottom}, 1.0);
      const ContactPatches patches = on.patches();
      ASSERT_EQ(patches.count, 1u) << columns << " by " << rows;
      EXPECT_NEAR(patches.patch[0].share, expected, 0.05 * expected) << columns << " by " << rows;
    }
  }
}

/// A triangle with points at random and a load outside of it. Its mirror images have the same share.
TEST(EvenPressure, IsThatOfTheMirroredFace) {
  Random random(7);
  std::uint32_t found = 0;
  for (int face = 0; face < 30; ++face) {
    const Vector3 corner = random.in_cube(0.02), to_second = random.in_cube(0.04), to_third = random.in_cube(0.04);
    SurfaceSamples samples;
    const int count = random.integer(12, 600);
    for (int i = 0; i < count; ++i) {
      const double a = random.between(0.0, 1.0), b = random.between(0.0, 1.0 - a);
      const Vector3 p = corner + a * to_second + b * to_third;
      samples.points.push_back({p.x(), p.y(), kBottom});
      samples.normals.push_back(Vector3::UnitZ());
    }
    OnFace on(samples);
    const Vector3 middle = corner + (to_second + to_third) / 3.0;
    for (const Vector3& off : {Vector3(0.05, 0.0, 0.0), Vector3(-0.05, 0.01, 0.0), Vector3(0.0, -0.02, 0.0)}) {
      on.push({middle.x() + off.x(), middle.y() + off.y(), kBottom}, 1.0);
    }
    const ContactPatches patches = on.patches();
    found += patches.count;             // none where the points are hardly more than a line
    for (const int axis : {0, 1, 0}) {  // across x, then across both, then across y
      float* const coordinate = axis == 0 ? on.near().x : on.near().y;
      for (std::uint32_t k = 0; k < on.near().count; ++k) coordinate[k] = -coordinate[k];
      for (std::uint32_t j = 0; j < on.step.force_count; ++j) on.step.forces[j].point[axis] *= -1.0;
      const ContactPatches mirrored = on.patches();
      ASSERT_EQ(mirrored.count, patches.count) << face;
      if (patches.count == 0) continue;
      EXPECT_NEAR(mirrored.patch[0].share, patches.patch[0].share, 1e-9) << face;
    }
  }
  EXPECT_GT(found, 20u);
}

/// A disc, a ring, a square that stands on its corner and an ell, with points at random and others along the rim.
TEST(EvenPressure, KnowsFacesOfOtherShapes) {
  constexpr double kHalf = 0.02;
  struct Shape {
    const char* name;
    bool (*inside)(double x, double y);
    double tolerance;
  };
  const Shape shapes[] = {
      {"disc", [](double x, double y) { return std::hypot(x, y) < kHalf; }, 0.03},
      {"ring", [](double x, double y) { return std::hypot(x, y) < kHalf && std::hypot(x, y) > 0.6 * kHalf; }, 0.08},
      {"diamond", [](double x, double y) { return std::fabs(x) + std::fabs(y) < kHalf; }, 0.03},
      {"ell", [](double x, double y) { return x < -0.2 * kHalf || y < -0.2 * kHalf; }, 0.08}};
  Random random(5);
  for (int face = 0; face < 40; ++face) {
    const Shape& shape = shapes[face % 4];
    // in the face's plane, whose axes the code chooses
    const Eigen::AngleAxisd turn(face < 4 ? 0.0 : random.between(0.0, M_PI), Vector3::UnitZ());
    SurfaceSamples samples;
    while (samples.points.size() < 1000) {
      Vector3 p = random.in_cube(kHalf);
      if (!shape.inside(p.x(), p.y())) continue;
      if (samples.points.size() % 2 == 1) {  // on the way out to the rim
        while (shape.inside(1.01 * p.x(), 1.01 * p.y()) && p.head<2>().cwiseAbs().maxCoeff() < 0.99 * kHalf) p *= 1.01;
      }
      samples.points.push_back(turn * Vector3(p.x(), p.y(), kBottom));
      samples.normals.push_back(Vector3::UnitZ());
    }
    OnFace on(samples);
    // two forces whose centre is the shape's
    Load even;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int i = 0; i < 100; ++i) {
      for (int j = 0; j < 100; ++j) {
        const Eigen::Vector2d at(kHalf * ((i + 0.5) / 50.0 - 1.0), kHalf * ((j + 0.5) / 50.0 - 1.0));
        if (!shape.inside(at.x(), at.y())) continue;
        even.at.push_back(at);
        even.share.push_back(1.0);
        sum += at;
      }
    }
    const Vector3 centre(sum.x() / static_cast<double>(even.at.size()), sum.y() / static_cast<double>(even.at.size()),
                         kBottom);
    on.push(turn * (centre + Vector3(0.03, 0.0, 0.0)), 1.0);
    on.push(turn * (centre - Vector3(0.03, 0.0, 0.0)), 1.0);
    const ContactPatches patches = on.patches();
    ASSERT_EQ(patches.count, 1u) << shape.name;
    const double expected = even.least_mean_distance();
    EXPECT_NEAR(0.03 * patches.patch[0].share, expected, shape.tolerance * expected) << shape.name;
  }
}

/// A face of two pads, of three quarters and of one quarter of its area; between them nothing touches. The places are
/// nearest to one in the larger pad, far from the load's centre.
TEST(EvenPressure, KnowsAFaceOfTwoPads) {
  constexpr double kWidth = 0.02;
  constexpr double kCentre = 0.03;  // of the area; pads to 30 mm and from 70 to 80 mm
  const auto is_on_pad = [](double y) { return y < 0.03 - 1e-9 || y > 0.07 + 1e-9; };
  SurfaceSamples samples;
  for (int i = 0; i <= 80; ++i) {
    if (!is_on_pad(1e-3 * i)) continue;
    for (int j = 0; j <= 40; ++j) {
      samples.points.push_back({kWidth * (j / 40.0 - 0.5), 1e-3 * i - kCentre, kBottom});
      samples.normals.push_back(Vector3::UnitZ());
    }
  }
  Load even;
  for (int i = 0; i < 160; ++i) {
    const double y = 5e-4 * (i + 0.5);
    if (!is_on_pad(y)) continue;
    for (int j = 0; j < 40; ++j) {
      even.at.push_back({kWidth * ((j + 0.5) / 40.0 - 0.5), y - kCentre});
      even.share.push_back(1.0);
    }
  }
  OnFace on(samples);
  on.push({0.0, 0.04, kBottom}, 1.0);
  on.push({0.0, -0.04, kBottom}, 1.0);
  const ContactPatches patches = on.patches();
  ASSERT_EQ(patches.count, 1u);
  const double expected = even.least_mean_distance();
  EXPECT_NEAR(0.04 * patches.patch[0].share, expected, 0.03 * expected);
}

/// Forces inside of the face never act farther out than they are.
TEST(EvenPressure, LeavesForcesNearTheCentreWhereTheyAre) {
  OnFace on(lower_face(0.04, 0.03));
  on.push({0.004, 0.003, kBottom}, 1.0);
  on.push({-0.004, -0.003, kBottom}, 1.0);
  const ContactPatches patches = on.patches();
  ASSERT_EQ(patches.count, 1u);
  EXPECT_EQ(patches.patch[0].share, 1.0);
}

/// Two faces at right angles, as in a corner.
TEST(EvenPressure, TellsTwoFacesApart) {
  SurfaceSamples samples = lower_face(0.04, 0.03);
  const std::size_t count = samples.points.size();
  for (std::size_t i = 0; i < count; ++i) {  // the same face again, standing at x = 0.02
    const Vector3 p = samples.points[i];
    const Vector3 n = samples.normals[i];
    samples.points.push_back({0.02, p.y(), p.x() + 0.01});
    samples.normals.push_back({-n.z(), n.y(), n.x()});
  }
  OnFace on(samples);
  on.push({-0.02, -0.015, kBottom}, 1.0);
  on.push({0.02, -0.015, 0.03}, 3.0, -Vector3::UnitX());
  on.push({0.02, 0.015, kBottom}, 1.0);
  on.push({0.02, 0.015, -0.01}, 1.0, -Vector3::UnitX());
  const ContactPatches patches = on.patches();
  ASSERT_EQ(patches.count, 2u);
  EXPECT_LT((patches.patch[0].centre - Vector3(0.0, 0.0, kBottom)).norm(), 1e-8);
  EXPECT_LT((patches.patch[1].centre - Vector3(0.02, -0.0075, 0.02)).norm(), 1e-8);
  EXPECT_EQ(patches.grip(Vector3::UnitY(), {0.0, 0.0, kBottom}, kMargin), Vector3(0.0, 0.0, kBottom));
  EXPECT_EQ(patches.grip(Vector3::UnitZ(), {0.01, 0.0, 0.0}, kMargin), Vector3(0.01, 0.0, 0.0)) << "above the face";
  EXPECT_NE(patches.grip(Vector3::UnitZ(), {0.01, 0.0, kBottom}, kMargin), Vector3(0.01, 0.0, kBottom));
}

/// A pressed face that turns about its normal resists with the torque of even pressure,
///     mu N times the least mean distance of its places,
/// and a face that slides with mu N. The corners alone are 25 mm from the middle, the places 13.5 mm in the mean.
TEST(EvenPressure, TurnsAFaceWithTheTorqueOfEvenPressure) {
  constexpr double kLength = 0.04, kWidth = 0.03, kRatio = 0.3;
  const AnalyticField floor(HalfSpace{}, kVoxel);
  SurfaceSamples samples = lower_face(kLength, kWidth, 30, 23);
  const SampledBody body(samples, Vector3::Constant(2e-4));
  Pose start;
  start.translation.z() = kMargin - kBottom;
  for (const double offset : {0.0, 0.003}) {  // of the load's centre from the middle
    AnalyticRun<AnalyticField, ContactCycle<true>> run(floor, body, start);
    run.parameters.margin = kMargin;
    run.parameters.friction = {kRatio, kRatio, 0.0};
    const auto device = [&](double angle) {
      Pose pose = start;
      pose.translation.z() -= 0.006;
      // a small turn about y moves the load's centre along x
      const double k = run.parameters.coupling_translation / run.parameters.coupling_rotation;
      pose.rotation = exp_rotation(Vector3(0.0, 0.0, angle)) * exp_rotation(Vector3(0.0, 0.006 * offset * k, 0.0));
      return pose;
    };
    for (int i = 0; i < 50; ++i) ASSERT_EQ(run.step(device(0.0)), Status::kOk);
    for (int i = 0; i < 1000; ++i) ASSERT_EQ(run.step(device(5e-4 * i)), Status::kOk);
    const Wrench& wrench = run.report.force.spring_W;
    const Vector3 lever = run.state.H_WS.rotation._transformVector(Vector3(0.0, 0.0, kBottom));
    const double load = wrench.force.z();
    const Vector3 at_face = wrench.torque - lever.cross(wrench.force);
    const Eigen::Vector2d centre(-at_face.y() / load, at_face.x() / load);
    ASSERT_NEAR(centre.norm(), offset, 2e-4);
    // in the frame of the face; the torque about the load's centre
    const Vector3 to_centre(centre.x(), centre.y(), 0.0);
    const double torque = (at_face - to_centre.cross(wrench.force)).z();
    const Vector3 in_face = run.state.H_WS.rotation.conjugate()._transformVector(to_centre);
    const double even = kRatio * load * mean_distance(kLength, kWidth, in_face.head<2>());
    EXPECT_NEAR(std::fabs(torque), even, 0.05 * even) << offset;
    EXPECT_FALSE(run.report.unconverged);
  }
}

/// The friction of a face that slides without turning is mu N against the motion, whatever its shape.
TEST(EvenPressure, LeavesSlidingFrictionAsItIs) {
  constexpr double kRatio = 0.3;
  const AnalyticField floor(HalfSpace{}, kVoxel);
  const SampledBody body(lower_face(0.04, 0.03, 30, 23), Vector3::Constant(2e-4));
  Pose start;
  start.translation.z() = kMargin - kBottom;
  AnalyticRun<AnalyticField, ContactCycle<true>> run(floor, body, start);
  run.parameters.margin = kMargin;
  run.parameters.friction = {kRatio, kRatio, 0.0};
  for (int i = 0; i < 300; ++i) {
    Pose device = start;
    device.translation += Vector3(1e-4 * i, 0.0, -0.004);
    ASSERT_EQ(run.step(device), Status::kOk);
  }
  const Vector3& force = run.report.force.spring_W.force;
  EXPECT_NEAR(force.x(), -kRatio * force.z(), 1e-3 * force.z());
  EXPECT_NEAR(force.y(), 0.0, 1e-3 * force.z());
}

}  // namespace
}  // namespace godobject::even_pressure_test
