#include "firmware/cycle/observation.h"

namespace godobject::firmware {

DriveSummary summarize(const hal::JointReading& reading, int joint_count) noexcept {
  using hal::DriveState;
  DriveSummary drives{
      .all_answer = true, .all_enabled = true, .none_moves = true, .any_fault = false, .all_fresh = true};
  for (int i = 0; i < joint_count; ++i) {
    const DriveState state = reading.state[static_cast<std::size_t>(i)];
    drives.all_answer = drives.all_answer && state != DriveState::kUnavailable;
    drives.all_enabled = drives.all_enabled && state == DriveState::kEnabled;
    drives.none_moves = drives.none_moves && (state == DriveState::kOff || state == DriveState::kFault);
    drives.any_fault = drives.any_fault || state == DriveState::kFault;
    drives.all_fresh = drives.all_fresh && reading.age[static_cast<std::size_t>(i)] == 0;
  }
  return drives;
}

}  // namespace godobject::firmware
