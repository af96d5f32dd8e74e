#include "firmware/cycle/fault.h"

namespace godobject::firmware {

const char* describe(Fault fault) noexcept {
  switch (fault) {
    case Fault::kNone: return "none";
    case Fault::kDrivesAbsent: return "not all drives answered; check power and wiring";
    case Fault::kNotAtRest: return "a joint moved with its brake closed; check the brakes";
    case Fault::kPositionLost: return "a joint's position was lost three times in a row; check wiring and bus load";
    case Fault::kPositionJump: return "a joint's position jumped; check its encoder";
    case Fault::kNotFinite: return "a reading was not a finite number; check the drives' scaling";
    case Fault::kEncoderStuck:
      return "a joint's position did not change although the joint should have moved; check its encoder";
    case Fault::kComputation: return "the cycle could not be computed; read the last rows of the telemetry";
    case Fault::kOverruns: return "the loop overran its period too often; run godobject-controller doctor";
    case Fault::kDriveLeft: return "a drive is not enabled; read its own error display";
    case Fault::kAlarm: return "a bus or a drive raised an alarm";
    case Fault::kSendFailed: return "torques could not be sent three times in a row; check the bus";
    case Fault::kEmergencyStop: return "emergency stop; release it and reset";
    case Fault::kEnableReleased: return "the enable switch was released; reset and hold it again";
    case Fault::kJointLimit:
      return "a joint is beyond its position limit; release its brake with the drive's own tool, move it back, and "
             "reset";
    case Fault::kTooFast: return "hand or joint was faster than its stop speed; reset";
    case Fault::kSignWrong:
      return "a joint moved against its torque, or the arm moved away by itself; check polarities and encoders";
    case Fault::kSignUndecided:
      return "a joint did not move when pushed; keep the hand still, check its brake and encoder";
    case Fault::kOutsideLimits:
      return "a joint is beyond its limits before the start; release its brake with the drive's own tool and move it "
             "back, or check its zero";
    case Fault::kComputedLate:
      return "cycles computed for longer than loop.compute too often; raise it, set or lower loop.cycle_budget, or run "
             "godobject-controller doctor";
    case Fault::kNotBalanced:
      return "the arm moved by itself before it rendered, as a wrong load moves it; correct masses and payload in the "
             "device file";
    case Fault::kDrifts:
      return "the arm drifted as a wrong load moves it; correct masses and payload in the device file";
    case Fault::kTorqueWrong:
      return "a drive's measured torque does not follow its command; read its own error display, check rated_torque "
             "and its current limits";
    case Fault::kDriveLimited:
      return "the drive limited its torque by itself for longer than bus.limited_time (statusword bit 11); check its "
             "current limits, supply voltage and temperature, or lower the joint's torque in the device file";
  }
  return "unknown fault";
}

const char* describe(hal::Alarm alarm) noexcept {
  switch (alarm) {
    case hal::Alarm::kNone: return "none";
    case hal::Alarm::kBusDown:
      return "a CAN interface is down or bus-off; check wiring and termination, set it up again";
    case hal::Alarm::kBadFrames: return "three invalid frames in a row from the drive; check the PDO mapping";
    case hal::Alarm::kNodeReset: return "the drive restarted; check its supply, then start the controller again";
    case hal::Alarm::kHeartbeatLost: return "the drive's heartbeat is missing; check its supply and the bus";
    case hal::Alarm::kDriveError: return "the drive sent an emergency message; look its code up in its manual";
    case hal::Alarm::kWrongMode:
      return "the drive left cyclic synchronous torque mode or the operational state; read its own error display";
    case hal::Alarm::kForeignMaster:
      return "another node sends frames that only this controller may send; stop the other master";
    case hal::Alarm::kForeignWrite: return "another node wrote to a drive; disconnect it and start again";
    case hal::Alarm::kParameterChanged:
      return "a parameter of the drive differs from the value written at the start; start again";
    case hal::Alarm::kAnswersLate:
      return "the drive answers a SYNC only after the next one, one period late; this drive cannot be used";
    case hal::Alarm::kPanelLost: return "the operator's panel no longer answers; check its wiring";
    case hal::Alarm::kPanelSilent:
      return "the operator's panel has not sent its inputs since the start; check that it answers SYNC with its TPDO1";
    case hal::Alarm::kTooHot: return "the drive is too hot; let it cool down, then reset";
    case hal::Alarm::kTemperatureLost:
      return "the drive did not answer three requests in a row for its temperature; compare temperature in the device "
             "file with the drive's manual, check wiring and bus load";
  }
  return "unknown alarm";
}

}  // namespace godobject::firmware
