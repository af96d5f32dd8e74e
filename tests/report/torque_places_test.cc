// An arm led through places where the field jumps: the sent torques never jump, and a missing limiter is found.
#include "toolchain/report/extremes/torque_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "toolchain/report/extremes/led_arm.h"

namespace godobject::report {
namespace {

class AtPlace : public testing::TestWithParam<Place> {
 protected:
  AtPlace() : work_(testing::TempDir() + "/torque_places." + std::to_string(static_cast<int>(GetParam()))) {
    std::filesystem::create_directories(work_);
    device_ = firmware::read_device_file(GODOBJECT_DEVICES_DIR "/lwr.toml");
  }
  ~AtPlace() override { std::filesystem::remove_all(work_); }

  TorqueSteps steps(const SceneView& scene, Solver solver, const firmware::TorqueLimits& used, std::uint32_t seed) {
    return torque_steps(GetParam(), scene, device_, solver, true, {.limits = used}, seed);
  }

  std::filesystem::path work_;
  firmware::Device device_;
};

/// The check can fail: without a limit it finds the steps of the solvers.
TEST_P(AtPlace, NoTorqueThatIsSentChangesFasterThanItMayUnlessTheLimiterIsLeftOut) {
  const files::SceneImage image = place_scene(GetParam(), work_);
  const firmware::TorqueLimits none{.rate = 2.0};  // from one end of a joint's torques to the other
  double unlimited = 0.0;
  for (const Solver solver : {Solver::kPaper, Solver::kCorrected, Solver::kContact}) {
    for (const std::uint32_t seed : {100u, 101u}) {
      const TorqueSteps found = steps(image.scene, solver, {}, seed);
      EXPECT_LE(found.sent, 1.0 + 1e-9);
      EXPECT_LE(found.sent_at_once, 1.0 + 1e-9);
      EXPECT_GT(found.sent, 0.0);
      EXPECT_EQ(found.idle_runs, 0) << "there " << found.there << ", rendered " << found.rendered;
      EXPECT_TRUE(std::isfinite(found.computed));
      std::printf("[ measured ] %s, solver %u: %.3g of the allowed change sent, %.3g computed, %.3g N\n",
                  kPlaceNames[static_cast<std::size_t>(GetParam())], static_cast<unsigned>(solver), found.sent,
                  found.computed, found.force);
      const TorqueSteps free = steps(image.scene, solver, none, seed);
      EXPECT_NEAR(free.sent_at_once, found.computed, 1e-9) << "what is computed is sent";
      unlimited = std::max(unlimited, free.sent_at_once);
    }
  }
  EXPECT_GT(unlimited, 1.0) << "nothing here that the limiter has to hold";
}

INSTANTIATE_TEST_SUITE_P(All, AtPlace,
                         testing::Values(Place::kStartInside, Place::kStartDeep, Place::kDeep, Place::kOutsideGrid,
                                         Place::kGridBorder, Place::kMedialAxis),
                         [](const auto& place) { return "Place" + std::to_string(static_cast<int>(place.param)); });

}  // namespace
}  // namespace godobject::report
