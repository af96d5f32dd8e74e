#pragma once

#include <array>
#include <cstdint>

#include "core/device/joint_vector.h"

namespace godobject::hal {

/// Figures of the buses since the start of the nodes, for log and report. No decision depends on them.
struct CanStatistics {
  std::uint64_t sent = 0;                        ///< frames handed over
  std::uint64_t full = 0;                        ///< frames for which a queue had no room
  std::uint64_t down = 0;                        ///< frames that an interface refused
  std::uint64_t received = 0;                    ///< frames of other nodes
  std::uint64_t malformed = 0;                   ///< frames of a known node with an invalid length or content
  std::uint64_t floods = 0;                      ///< cycles with more frames on a bus than a cycle takes
  std::uint64_t warnings = 0;                    ///< emergency messages that are only warnings
  std::array<std::uint64_t, kMaxJoints> lost{};  ///< cycles without a fresh sample
  std::array<std::uint64_t, kMaxJoints> late{};  ///< samples after their cycle, not used
  std::int64_t round_trip_ns = 0;  ///< last cycle: from the end of SYNC to the end of the last sample; 0: none
  std::int64_t longest_round_trip_ns = 0;
  double hottest = 0.0;    ///< highest temperature of a drive [degC]
  int hottest_joint = -1;  ///< -1: no drive has told one
};

}  // namespace godobject::hal
