#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "toolchain/figures/crossing.h"
#include "toolchain/figures/replay_log.h"

namespace godobject::figures {

/// Run time of part of a cycle over the cycles in contact [us]; zeros without contact.
struct Times {
  double p50 = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

/// Results of one solver in one scene. A cycle is in contact if a point collides or the god object penetrates.
struct Statistics {
  std::size_t cycles = 0;
  std::size_t contact_cycles = 0;
  double penetration_max = 0.0;   ///< of a sample point in contact; negative: none was inside. 0 without contact [m]
  double penetration_at = 0.0;    ///< its time [s]
  bool depth_is_bound = false;    ///< it reaches the limit of the stored distances; the true depth may be larger
  double penetration_mean = 0.0;  ///< over the cycles in contact, depths below zero counted as zero [m]
  double peak_force = 0.0;        ///< [N]
  double force_step = 0.0;        ///< largest change of the force from one cycle to the next [N]
  double force_step_at = 0.0;     ///< its time [s]
  double peak_contacts = 0.0;
  Times step1;               ///< #1
  Times solve;               ///< #2-#7
  std::size_t over_1ms = 0;  ///< of all cycles, those whose #1-#7 took longer than 1 ms
  // number of cycles with this status
  std::size_t cut = 0;
  std::size_t overflow = 0;
  std::size_t infeasible = 0;
};

/// Returns the statistics of a replay. `band`: limit of the stored distances [m].
Statistics statistics(const ReplayLog& log, double band);

/// A line of the table: one solver in one scene.
struct Entry {
  std::string scene;
  std::string solver;
  double voxel_size = 0.0;  ///< [m]
  Statistics statistics;
  std::optional<Crossing> crossing;  ///< if the scene has a barrier
};

}  // namespace godobject::figures
