#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "toolchain/figures/crossing.h"
#include "toolchain/figures/statistics.h"
#include "toolchain/figures/telemetry_log.h"

namespace godobject::figures {

/// The logs of a run of the whole controller on an arm.
struct ArmLog {
  TelemetryLog cycles;
  std::vector<HandWork> hand;
  std::vector<double> torque_limits;  ///< of the joints [Nm]
};

/// Reads FOLDER/telemetry.csv, FOLDER/hand.csv and the limits of the arm's device file. Throws Failure: kNoInput,
/// kBadData, kBadConfig, and kBadData if telemetry and device file differ in their number of joints.
ArmLog read_arm_log(const std::filesystem::path& folder, const std::filesystem::path& device);

/// Results of a run.
struct ArmRun {
  std::string name;
  double voxel_size = 0.0;           ///< [m]
  Statistics statistics;             ///< of the cycles that rendered; without times
  std::optional<Crossing> crossing;  ///< if the scene has a barrier
  double seconds = 0.0;
  int fault = 0;            ///< the first fault, 0: none
  std::string last_mode;    ///< of the supervisor
  bool interrupted = true;  ///< the cycles that rendered are not one uninterrupted sequence
  double distance = 0.0;    ///< largest distance of god object and device [m]
  double torque = 0.0;      ///< largest joint torque, as share of the joint's limit [1]
  int torque_joint = 0;     ///< number of that joint, from 1
  double work = 0.0;        ///< work of the hand on the tool, from the first to the last cycle that rendered [J]
  double least_work = 0.0;  ///< minimum of that work during the run; below zero the hand gained energy [J]
};

/// Returns the results of a run, without `crossing` and `name`. `band`: limit of the stored distances [m].
ArmRun arm_run(const ArmLog& log, double band);

/// Judges the claims on the closed loop: it runs from start to end without a fault and renders without interruption;
/// the god object does not penetrate or pop through; no joint torque exceeds its limit; and the loop is passive at the
/// hand: at no time has the hand received more work than it has done. Returns one sentence for each claim that a run
/// misses, then one sentence with the claims that all runs hold. Without runs the result is empty.
std::vector<std::string> judge_arm_runs(const std::vector<ArmRun>& runs);

/// A quantity of the table of runs.
struct ArmColumn {
  const char* heading;
  std::string (*value)(const ArmRun& run);
  bool on_phone = false;  ///< the page shows the column on a narrow screen, too
};

const std::vector<ArmColumn>& arm_columns();

/// Returns the table of runs for a terminal.
std::string arm_table(const std::vector<ArmRun>& runs);

}  // namespace godobject::figures
