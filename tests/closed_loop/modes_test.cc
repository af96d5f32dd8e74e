// Every fault begins in the middle of every mode. While the drives have power, the reaction must be that of the table
// of faults. While they have none, no power may come.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/closed_loop/simulated_run.h"

namespace godobject::firmware {
namespace {

using sim::DriveFault;
using sim::FaultKind;

struct Cause {
  const char* name;
  FaultKind kind;
  int joint;
  std::int64_t cycles;
  double value;
};

constexpr std::int64_t kForGood = 100'000;

/// In the columns' order of the table below.
const std::vector<Cause> kCauses = {
    {"position lost", FaultKind::kReadingLost, 3, kForGood, 0.0},
    {"position late", FaultKind::kReadingLate, 3, kForGood, 2.0},
    {"encoder jumps", FaultKind::kEncoderJump, 3, kForGood, 0.3},
    {"not finite", FaultKind::kEncoderNotFinite, 3, 1, 0.0},
    {"drive trips", FaultKind::kDriveTrips, 3, 1, 0.0},
    {"supply lost", FaultKind::kSupplyLost, 3, kForGood, 0.0},
    {"sending fails", FaultKind::kSendFails, 3, kForGood, 0.0},
    {"commands lost", FaultKind::kCommandLost, 3, kForGood, 0.0},
    {"emergency stop", FaultKind::kEmergencyStop, sim::kAllJoints, kForGood, 0.0},
    {"enable released", FaultKind::kEnableReleased, sim::kAllJoints, kForGood, 0.0},
};

struct ModeRow {
  Mode mode;
  bool sign_test;
  std::vector<Fault> faults;  ///< as kCauses; kNone: it waits, or goes on, without power or with it as before
};

void PrintTo(const ModeRow& row, std::ostream* out) { *out << name(row.mode); }

SimulatedRun::Options options_for(const ModeRow& row) {
  SimulatedRun::Options options;
  options.path = {{0.0, 0.0, 0.06}};
  options.sign_test = row.sign_test;
  // another joint without supply for 60 cycles makes the mode BOOT last
  if (row.mode == Mode::kBoot) options.faults = {{FaultKind::kSupplyLost, 0, 0, 60}};
  return options;
}

constexpr std::int64_t kEndAsked = 700;  ///< long since running, without a sign test

/// The middle of the mode in a run without the fault.
std::int64_t middle(const ModeRow& row) {
  SimulatedRun run(plate(), options_for(row));
  run.run(kEndAsked);
  std::int64_t first = -1;
  std::int64_t last = -1;
  for (const SimulatedCycle& cycle : run.cycles) {
    if (cycle.record.mode != row.mode) continue;
    if (first < 0) first = cycle.number;
    last = cycle.number;
  }
  EXPECT_GE(first, 0) << name(row.mode);
  return (first + last + 1) / 2;
}

class ClosedLoopMode : public testing::TestWithParam<ModeRow> {};

TEST_P(ClosedLoopMode, MeetsEveryFault) {
  const ModeRow& row = GetParam();
  const std::int64_t begin = middle(row);
  ASSERT_EQ(row.faults.size(), kCauses.size());
  for (std::size_t i = 0; i < kCauses.size(); ++i) {
    const Cause& cause = kCauses[i];
    SimulatedRun::Options options = options_for(row);
    options.faults.push_back({cause.kind, cause.joint, begin, cause.cycles, cause.value});
    SimulatedRun run(plate(), options);
    run.run(row.mode == Mode::kEnding ? kEndAsked : begin + 400);
    const Fault found = run.controller().record().fault;
    EXPECT_EQ(found, row.faults[i]) << cause.name << ": " << describe(found);
    EXPECT_EQ(run.violation(), "") << cause.name;
    std::printf("%-11s %-16s %s\n", name(row.mode), cause.name, found == Fault::kNone ? "waits" : describe(found));
    if (found == Fault::kNone) continue;
    // from the cycle in which the fault is latched nothing is rendered but what a FADE leaves, and no power comes back
    bool latched = false;
    bool stopped = false;
    std::int64_t since = 0;
    for (const SimulatedCycle& cycle : run.cycles) {
      const Mode mode = cycle.record.mode;
      if (cycle.record.fault != Fault::kNone && !latched) since = cycle.number;
      latched = latched || cycle.record.fault != Fault::kNone;
      if (!latched) continue;
      stopped = stopped || mode >= Mode::kStopping;
      ASSERT_TRUE(mode == Mode::kFade || mode == Mode::kStopping || mode == Mode::kStopped || mode == Mode::kEnded)
          << cause.name << " in cycle " << cycle.number << ": " << name(mode);
      if (cycle.number >= since + Supervisor::kFade_ms) {
        ASSERT_EQ(cycle.record.share, 0.0) << cause.name;
      }
    }
    EXPECT_TRUE(stopped) << cause.name;
    EXPECT_TRUE(run.plant().velocities().isZero(1e-3)) << cause.name << ": the brakes hold";
  }
}

constexpr Fault kWaits = Fault::kNone;

INSTANTIATE_TEST_SUITE_P(
    Rows, ClosedLoopMode,
    testing::Values(
        // a drive that hears nothing before it is enabled does not become so; 2 s are waited for it, without a share
        // lost, late, jumps, not finite, trips, supply, sending, commands, emergency stop, enable switch
        ModeRow{
            Mode::kBoot,
            false,
            {kWaits, kWaits, kWaits, kWaits, Fault::kDriveLeft, kWaits, Fault::kSendFailed, kWaits, kWaits, kWaits}},
        ModeRow{Mode::kZeroCheck,
                false,
                {Fault::kPositionLost, Fault::kPositionLost, Fault::kPositionJump, Fault::kNotFinite, Fault::kDriveLeft,
                 Fault::kDriveLeft, Fault::kSendFailed, kWaits, kWaits, kWaits}},
        ModeRow{Mode::kIdle,
                false,
                {Fault::kPositionLost, Fault::kPositionLost, Fault::kPositionJump, Fault::kNotFinite, Fault::kDriveLeft,
                 Fault::kDriveLeft, Fault::kSendFailed, kWaits, kWaits, kWaits}},
        ModeRow{
            Mode::kEnabling,
            false,
            {Fault::kPositionLost, Fault::kPositionLost, Fault::kPositionJump, Fault::kNotFinite, Fault::kDriveLeft,
             Fault::kDriveLeft, Fault::kSendFailed, Fault::kDriveLeft, Fault::kEmergencyStop, Fault::kEnableReleased}},
        ModeRow{
            Mode::kSignTest,
            true,
            {Fault::kPositionLost, Fault::kPositionLost, Fault::kPositionJump, Fault::kNotFinite, Fault::kDriveLeft,
             Fault::kDriveLeft, Fault::kSendFailed, Fault::kDriveLeft, Fault::kEmergencyStop, Fault::kEnableReleased}},
        ModeRow{
            Mode::kArmed,
            false,
            {Fault::kPositionLost, Fault::kPositionLost, Fault::kPositionJump, Fault::kNotFinite, Fault::kDriveLeft,
             Fault::kDriveLeft, Fault::kSendFailed, Fault::kDriveLeft, Fault::kEmergencyStop, Fault::kEnableReleased}},
        ModeRow{
            Mode::kEngaging,
            false,
            {Fault::kPositionLost, Fault::kPositionLost, Fault::kPositionJump, Fault::kNotFinite, Fault::kDriveLeft,
             Fault::kDriveLeft, Fault::kSendFailed, Fault::kDriveLeft, Fault::kEmergencyStop, Fault::kEnableReleased}},
        ModeRow{
            Mode::kRunning,
            false,
            {Fault::kPositionLost, Fault::kPositionLost, Fault::kPositionJump, Fault::kNotFinite, Fault::kDriveLeft,
             Fault::kDriveLeft, Fault::kSendFailed, Fault::kDriveLeft, Fault::kEmergencyStop, Fault::kEnableReleased}},
        ModeRow{
            Mode::kEnding,
            false,
            {Fault::kPositionLost, Fault::kPositionLost, Fault::kPositionJump, Fault::kNotFinite, Fault::kDriveLeft,
             Fault::kDriveLeft, Fault::kSendFailed, Fault::kDriveLeft, Fault::kEmergencyStop, Fault::kEnableReleased}}),
    [](const testing::TestParamInfo<ModeRow>& row) { return std::string(name(row.param.mode)); });

}  // namespace
}  // namespace godobject::firmware
