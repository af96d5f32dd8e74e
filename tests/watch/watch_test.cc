// The watch finds each planted fault, and finds nothing in the cycles of a correct solver.
#include "toolchain/watch/watch.h"

#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "toolchain/report/extremes/run.h"

namespace godobject::watch {
namespace {

using report::Rig;
using report::Setup;

/// The values that a planted fault may change after a correct cycle.
struct Faulty {
  const Setup& setup;
  Pose H_WD;
  Motion velocity_W;
  Pose H_WS_before;
  CycleReport& report;
  Status& status;
  std::vector<Pose>& path;

  /// Moves the god object to a pose, with the spring and the sub-steps that belong to it.
  void move_to(const Pose& H_WS) const {
    const double k = setup.stiffness;
    const double k_rotation = k * setup.coupling_rotation * setup.scale * setup.scale;
    const Wrench damping{report.force.total_W.force - report.force.spring_W.force,
                         report.force.total_W.torque - report.force.spring_W.torque};
    report.H_WS = H_WS;
    report.force.spring_W.force = k * (H_WS.translation - H_WD.translation);
    report.force.spring_W.torque =
        k_rotation * H_WD.rotation._transformVector(log_rotation(H_WD.rotation.conjugate() * H_WS.rotation));
    report.force.total_W.force = report.force.spring_W.force + damping.force;
    report.force.total_W.torque = report.force.spring_W.torque + damping.torque;
    path.assign(1, H_WS);
  }
};
using Fault = std::function<void(const Faulty&)>;

/// A correct solver whose results a fault changes from the hundredth cycle on.
class FaultyRig final : public Rig {
 public:
  FaultyRig(const Setup& setup, Fault fault)
      : setup_(setup), rig_(report::make_rig(setup, {})), fault_(std::move(fault)) {}

  Status update(const Pose& H_WD, const Motion& velocity_W, CycleReport& report) override {
    Status status = rig_->update(H_WD, velocity_W, report);
    path_.assign(rig_->path().begin(), rig_->path().end());
    if (++cycle_ > 100 && fault_) fault_({setup_, H_WD, velocity_W, last_, report, status, path_});
    last_ = report.H_WS;
    return status;
  }
  std::span<const Pose> path() const override { return path_; }
  WatchedSession watched() const override { return rig_->watched(); }

 private:
  Setup setup_;
  std::unique_ptr<Rig> rig_;
  Fault fault_;
  std::vector<Pose> path_;
  Pose last_;
  int cycle_ = 0;
};

Findings run(const Setup& setup, const Fault& fault) {
  FaultyRig rig(setup, fault);
  return run_setup(setup, rig);
}

Setup pressed(bool friction) {
  Setup setup{.world = "plane",
              .body = "box",
              .motion = "seek",
              .seed = 11,
              .cycles = 1500,
              .friction = friction,
              .points = 40};
  setup.depth = 0.3;
  setup.spin = 1.0;
  setup.friction_static = 0.4;
  setup.friction_kinetic = 0.35;
  return setup;
}

Setup one_point(bool friction) {
  Setup setup = pressed(friction);
  setup.body = "point";
  setup.points = 1;
  return setup;
}

Setup within_box() {
  Setup setup = pressed(false);
  setup.workspace = 1.0;
  return setup;
}

struct Planted {
  std::string name;
  Property property;
  Setup setup;
  Fault fault;
};

using Plant = std::function<void(const char* name, Property property, const Setup& setup, const Fault& fault)>;

Vector3 tangential_of(const Vector3& v) { return {v.x(), v.y(), 0.0}; }

/// The plane of these setups is z = 0, so that the normal is z.
void plant_in_the_wrench(const Plant& plant) {
  plant("NanTorque", Property::kFinite, pressed(false),
        [](const Faulty& f) { f.report.force.total_W.torque.y() = std::nan(""); });
  plant("LongRotation", Property::kFinite, pressed(false),
        [](const Faulty& f) { f.report.H_WS.rotation.coeffs() *= 1.0 + 1e-8; });
  plant("Refusal", Property::kStatus, pressed(false), [](const Faulty& f) { f.status = Status::kOutOfRange; });
  plant("ForceInTheDevicesFrame", Property::kSpring, pressed(false), [](const Faulty& f) {
    const Vector3 F = f.report.force.spring_W.force;
    f.report.force.spring_W.force = f.H_WD.rotation.conjugate() * F;
    f.report.force.total_W.force += f.report.force.spring_W.force - F;
  });
  plant("TorqueReversed", Property::kSpring, pressed(false),
        [](const Faulty& f) { f.report.force.spring_W.torque *= -1.0; });
  plant("ForceOnePercentOff", Property::kSpring, pressed(false),
        [](const Faulty& f) { f.report.force.spring_W.force *= 1.01; });
  plant("DampingReversed", Property::kDamper, pressed(false), [](const Faulty& f) {
    DeviceForce& F = f.report.force;
    F.total_W.force = 2.0 * F.spring_W.force - F.total_W.force;
    F.total_W.torque = 2.0 * F.spring_W.torque - F.total_W.torque;
  });
  plant("DampingOfHalfTheSize", Property::kDamping, one_point(false), [](const Faulty& f) {
    f.report.force.total_W.force = 0.5 * (f.report.force.total_W.force + f.report.force.spring_W.force);
  });
  plant("NoDamping", Property::kDamping, one_point(false),
        [](const Faulty& f) { f.report.force.total_W = f.report.force.spring_W; });
  plant("DampingOfThreeQuartersInSeveralContacts", Property::kDamping, pressed(false), [](const Faulty& f) {
    if (f.report.contacts < 2) return;
    DeviceForce& F = f.report.force;
    F.total_W.force = 0.75 * F.total_W.force + 0.25 * F.spring_W.force;
    F.total_W.torque = 0.75 * F.total_W.torque + 0.25 * F.spring_W.torque;
  });
  plant("NoDampingOfSeveralContacts", Property::kDamping, pressed(false), [](const Faulty& f) {
    if (f.report.contacts > 1) f.report.force.total_W = f.report.force.spring_W;
  });
}

/// The same plane.
void plant_in_the_motion(const Plant& plant) {
  const double voxel = 0.1 * 0.02;
  Setup through = one_point(false);
  through.world = "plate";
  through.motion = "dash";
  plant("TeleportThroughThePlate", Property::kNoCrossing, through, [](const Faulty& f) { f.move_to(f.H_WD); });
  plant("LeavesTheBox", Property::kWorkspace, within_box(), [](const Faulty& f) {
    Pose moved = f.report.H_WS;
    moved.translation.x() += 3.0 * f.setup.scale;
    f.move_to(moved);
  });
  plant("FartherThanAtRest", Property::kNotFarther, pressed(false), [voxel](const Faulty& f) {
    Pose moved = f.report.H_WS;
    moved.translation += voxel * (moved.translation - f.H_WD.translation + 1e-9 * Vector3::UnitZ()).normalized();
    f.move_to(moved);
  });
  plant("ForceAsideOnASmoothPlane", Property::kNoPull, pressed(false), [voxel](const Faulty& f) {
    if (f.report.contacts == 0) return;
    Pose moved = f.report.H_WS;
    moved.translation.x() += voxel;
    f.move_to(moved);
    f.path.assign(1, moved);
  });
  plant("FrictionWithTheSlip", Property::kFriction, one_point(true), [](const Faulty& f) {
    if (f.report.contacts != 1) return;
    Pose moved = f.report.H_WS;
    moved.translation -= 2.0 * tangential_of(moved.translation - f.H_WD.translation);
    f.move_to(moved);
  });
  plant("FrictionWithoutASetting", Property::kFriction, one_point(false), [](const Faulty& f) {
    if (f.report.contacts != 1) return;
    Pose moved = f.report.H_WS;
    moved.translation.x() += 0.2 * std::fabs(moved.translation.z() - f.H_WD.translation.z());
    f.move_to(moved);
  });
  plant("DrivenByItsForce", Property::kNoWork, pressed(false), [voxel, cycle = 0](const Faulty& f) mutable {
    if (f.report.contacts == 0) return;
    Pose moved = f.report.H_WS;
    moved.translation.z() += 0.05 * voxel * (++cycle % 5);  // up by four steps, then down at once
    f.move_to(moved);
  });
  Setup free = pressed(false);
  free.motion = "rest";
  free.start = 5.0;
  free.depth = -3.0;
  plant("StaysBehindInFreeSpace", Property::kArrives, free, [voxel](const Faulty& f) {
    if (f.report.contacts > 0) return;
    Pose moved = f.report.H_WS;
    moved.translation.z() += 0.3 * voxel;
    f.move_to(moved);
  });
  plant("GoesHalfTheWay", Property::kOptimum, pressed(false), [](const Faulty& f) {
    Pose moved = f.report.H_WS;
    moved.translation = 0.1 * moved.translation + 0.9 * f.H_WS_before.translation;
    f.move_to(moved);
  });
  Setup moving = pressed(false);
  moving.motion = "press";
  moving.speed = 200.0;  // never at rest for long
  plant("CutForEverUnderAMovingDevice", Property::kLag, moving, [](const Faulty& f) {
    f.report.outcome = Outcome::kCut;
    f.move_to(f.H_WS_before);
  });
  plant("CutForEver", Property::kLag, pressed(false), [](const Faulty& f) {
    f.report.outcome = Outcome::kCut;
    f.move_to(f.H_WS_before);
  });
}

void plant_under_friction(const Plant& plant) {
  Setup groove = pressed(true);
  groove.world = "groove";
  groove.cycles = 6000;
  groove.friction_static = groove.friction_kinetic = 0.2;
  plant("FrictionWithTheSlipInAGroove", Property::kNoWork, groove, [](const Faulty& f) {
    if (f.report.contacts == 0) return;
    Pose moved = f.report.H_WS;
    moved.translation.y() -= 2.0 * (moved.translation.y() - f.H_WD.translation.y());
    f.move_to(moved);
  });
  const auto late = [](int cycles) {
    return [poses = std::deque<Pose>(), cycles](const Faulty& f) mutable {
      poses.push_back(f.report.H_WS);
      if (poses.size() <= static_cast<std::size_t>(cycles)) return;
      f.move_to(poses.front());
      poses.pop_front();
    };
  };
  plant("RubsACycleLate", Property::kNoPull, pressed(true), late(1));
  plant("RubsThreeCyclesLate", Property::kNoPull, pressed(true), late(3));
  plant("RubsInAGrooveThreeCyclesLate", Property::kNoPull, groove, late(3));
}

void plant_in_the_report(const Plant& plant) {
  const double voxel = 0.1 * 0.02;
  plant("WrongPenetration", Property::kReport, pressed(false),
        [voxel](const Faulty& f) { f.report.penetration += 0.01 * voxel; });
  plant("FreeWithContacts", Property::kReport, pressed(false),
        [](const Faulty& f) { f.report.outcome = Outcome::kFree; });
  plant("OverflowWithoutADrop", Property::kReport, pressed(false),
        [](const Faulty& f) { f.report.outcome = Outcome::kOverflow; });
  plant("StartInsideWhileOutside", Property::kReport, pressed(false),
        [](const Faulty& f) { f.report.outcome = Outcome::kStartInside; });
  Setup through = one_point(false);
  through.world = "plate";
  through.motion = "dash";
  plant("TeleportThatSaysStartInside", Property::kReport, through, [](const Faulty& f) {
    const Vector3 there = f.H_WD.translation;
    if (f.H_WS_before.translation.z() * there.z() >= 0.0) return;
    f.move_to(f.H_WD);  // into the plate first
    Pose inside = f.H_WD;
    inside.translation.z() = 0.0;
    f.path.insert(f.path.begin(), inside);
    f.report.outcome = Outcome::kStartInside;
    f.report.contacts = 1;
  });
  plant("PathThatEndsElsewhere", Property::kReport, pressed(false), [](const Faulty& f) { f.path.assign(1, Pose{}); });
}

std::vector<Planted> planted_faults() {
  std::vector<Planted> all;
  const Plant plant = [&all](const char* name, Property property, const Setup& setup, const Fault& fault) {
    all.push_back({name, property, setup, fault});
  };
  plant_in_the_wrench(plant);
  plant_in_the_motion(plant);
  plant_under_friction(plant);
  plant_in_the_report(plant);
  return all;
}

class PlantedFault : public ::testing::TestWithParam<Planted> {};

TEST_P(PlantedFault, IsFound) {
  const Planted& planted = GetParam();
  const Findings correct = run(planted.setup, nullptr);
  EXPECT_EQ(correct.violations(), 0) << correct.first();
  EXPECT_GT(correct[planted.property].judged, 0) << "the setup does not judge the property";
  const Findings found = run(planted.setup, planted.fault);
  EXPECT_GT(found[planted.property].violated, 0) << describe(planted.property);
}

INSTANTIATE_TEST_SUITE_P(All, PlantedFault, ::testing::ValuesIn(planted_faults()),
                         [](const auto& test) { return test.param.name; });

/// Each property that an analytic world can judge has a planted fault; the mesh's has its own test.
TEST(PlantedFaults, CoverEveryProperty) {
  std::array<bool, kPropertyCount> covered{};
  covered[static_cast<std::size_t>(Property::kMesh)] = true;
  for (const Planted& planted : planted_faults()) covered[static_cast<std::size_t>(planted.property)] = true;
  for (std::size_t i = 0; i < kPropertyCount; ++i) {
    EXPECT_TRUE(covered[i]) << describe(static_cast<Property>(i));
  }
}

/// A world that is turned and shifted gives a turned wrench.
TEST(TurnedWorlds, GiveTurnedWrenches) {
  for (const bool friction : {false, true}) {
    report::Setup setup{.world = "groove",
                        .body = "box",
                        .motion = "press",
                        .seed = 5,
                        .cycles = 400,
                        .friction = friction,
                        .points = 60};
    setup.depth = 0.3;
    report::Setup turned = setup;
    turned.far = 3.0;
    const auto rig = report::make_rig(setup, {});
    const auto turned_rig = report::make_rig(turned, {});
    const Pose H_WO = report::placement(turned);
    ASSERT_GT(log_rotation(H_WO.rotation).norm(), 0.3);
    const std::vector<Pose> path = report::device_path(setup);
    CycleReport here, there;
    double most = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < path.size(); ++k) {
      const Vector3 v = k == 0 ? Vector3::Zero() : Vector3((path[k].translation - path[k - 1].translation) / 1e-3);
      ASSERT_EQ(rig->update(path[k], {v, Vector3::Zero()}, here), Status::kOk);
      ASSERT_EQ(turned_rig->update(H_WO * path[k], {H_WO.rotation * v, Vector3::Zero()}, there), Status::kOk);
      const Wrench& F = here.force.total_W;
      const Wrench& G = there.force.total_W;
      largest = std::max(largest, F.force.norm());
      most = std::max(most, (H_WO.rotation * F.force - G.force).norm() +
                                (H_WO.rotation * F.torque - G.torque).norm() / setup.scale);
    }
    EXPECT_GT(largest, 1.0);
    EXPECT_LT(most, 1e-3 * largest) << "friction " << friction;
  }
}

/// Without friction and damping the wrench does no work on a closed path; with them it takes work from the hand.
TEST(ClosedPath, GivesTheHandNoWork) {
  for (const bool loses : {false, true}) {
    report::Setup setup{
        .world = "plane", .body = "box", .motion = "press", .seed = 1, .cycles = 1, .friction = loses, .points = 60};
    setup.damping = loses ? 20.0 : 0.0;
    const auto rig = report::make_rig(setup, {});
    CycleReport report;
    double work = 0.0, turned_over = 0.0;
    Wrench before;
    Pose last;
    constexpr int kCycles = 4000;
    for (int k = 0; k <= kCycles; ++k) {
      const double t = 2.0 * M_PI * k / kCycles;
      Pose H_WD;
      H_WD.translation = setup.scale * Vector3(0.5 * std::sin(t), 0.3 * std::sin(2.0 * t), 0.3 + 0.8 * std::cos(t));
      H_WD.rotation = exp_rotation(Vector3(0.2 * std::sin(t), 0.1 * std::sin(2.0 * t), 0.3 * std::sin(t)));
      Motion moved;
      if (k > 0) moved = {H_WD.translation - last.translation, log_rotation(H_WD.rotation * last.rotation.conjugate())};
      ASSERT_EQ(rig->update(H_WD, {moved.translation / 1e-3, moved.rotation / 1e-3}, report), Status::kOk);
      const Wrench& F = report.force.total_W;
      const double part =
          0.5 * (F.force + before.force).dot(moved.translation) + 0.5 * (F.torque + before.torque).dot(moved.rotation);
      work += part;
      turned_over += std::fabs(part);
      before = F;
      last = H_WD;
    }
    EXPECT_GT(turned_over, 1e-3);
    if (loses) {
      EXPECT_LT(work, -0.05 * turned_over);
    } else {
      EXPECT_NEAR(work, 0.0, 2e-3 * turned_over);
    }
  }
}

}  // namespace
}  // namespace godobject::watch
