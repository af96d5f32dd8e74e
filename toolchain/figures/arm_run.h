#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "toolchain/figures/crossing.h"
#include "toolchain/figures/statistics.h"
#include "toolchain/figures/telemetry_log.h"

namespace godobject::figures {

/// What the whole controller left of a run on an arm.
struct ArmLog {
  TelemetryLog cycles;
  std::vector<HandWork> hand;
  std::vector<double> torque_limits;  ///< of the joints [Nm]
};

/// Reads FOLDER/telemetry.csv, FOLDER/hand.csv and the limits of the arm's device file. Throws Failure: kNoInput,
/// kBadData, kBadConfig, and kBadData if telemetry and device file differ in their number of joints.
ArmLog read_arm_log(const std::filesystem::path& folder, const std::filesystem::path& device);

/// What a run shows.
struct ArmRun {
  std::string name;
  double voxel_size = 0.0;           ///< [m]
  Statistics statistics;             ///< of the cycles in which something was rendered; without times
  std::optional<Crossing> crossing;  ///< where the scene has a barrier
  double seconds = 0.0;
  int fault = 0;            ///< the first one, 0: none
  std::string last_mode;    ///< of the supervisor
  bool interrupted = true;  ///< it did not render at all, or more than once
  double distance = 0.0;    ///< largest of god object and device [m]
  double torque = 0.0;      ///< largest of a joint, share of its limit [1]
  int torque_joint = 0;     ///< of it, from 1
  double work = 0.0;        ///< of the hand on the tool, from the first to the last cycle that rendered [J]
  double least_work = 0.0;  ///< the least that this was meanwhile: below zero the hand had got back more [J]
};

/// `band`: distances are stored up to it [m]. Of `crossing` and `name` nothing is known here.
ArmRun arm_run(const ArmLog& log, double band);

/// What is claimed of the closed loop: it runs from start to end without a fault and renders without a break; nothing
/// penetrates, nothing pops through; no joint is asked for more than it can give; and seen from the hand it is passive:
/// at no time has the hand got back more work than it had put in. One sentence for each claim that a run misses, then
/// one with what holds in all of them. Nothing without runs.
std::vector<std::string> judge_arm_runs(const std::vector<ArmRun>& runs);

/// A quantity of the table of runs.
struct ArmColumn {
  const char* heading;
  std::string (*value)(const ArmRun& run);
};

const std::vector<ArmColumn>& arm_columns();

/// The table of runs for a terminal.
std::string arm_table(const std::vector<ArmRun>& runs);

}  // namespace godobject::figures
