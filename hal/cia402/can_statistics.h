#pragma once

#include <array>
#include <cstdint>

#include "core/device/joint_vector.h"

namespace godobject::hal {

/// What has gone over the buses since the nodes were started: for the log and the report, nobody decides by it.
struct CanStatistics {
  std::uint64_t sent = 0;       ///< frames handed over
  std::uint64_t full = 0;       ///< frames for which a queue had no room
  std::uint64_t down = 0;       ///< frames that an interface no longer took
  std::uint64_t received = 0;   ///< frames of others
  std::uint64_t malformed = 0;  ///< frames of a known node with a length or content that it cannot have sent
  std::uint64_t floods = 0;     ///< times that a bus had more frames than a cycle takes
  std::uint64_t warnings = 0;   ///< emergency messages that power may outlive
  std::array<std::uint64_t, kMaxJoints> lost{};  ///< cycles without a fresh sample
  std::array<std::uint64_t, kMaxJoints> late{};  ///< samples that came after their cycle, used by nobody
  std::int64_t round_trip_ns = 0;  ///< of the last cycle: end of SYNC to the end of the last sample; 0: none
  std::int64_t longest_round_trip_ns = 0;
};

}  // namespace godobject::hal
