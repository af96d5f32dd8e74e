#include "sim/cia402_slave.h"

#include <algorithm>
#include <cmath>

namespace godobject::sim {

using namespace hal::canopen;

namespace {

/// Parameters with the drive's own encoder and torque steps, at the joint's side of the gear.
JointHardwareParameters with_steps(JointHardwareParameters joint, const hal::DriveConfig& config) noexcept {
  joint.encoder_step = 2.0 * M_PI / (config.counts * config.gear);
  joint.torque_step = 1e-3 * config.gear * config.rated_torque;
  joint.counter_at_zero = 0;
  return joint;
}

/// Value of 6085. It only must not be zero: the drive's own loop brings the joint to rest, without a ramp.
constexpr std::uint32_t kQuickStopCounts = 1'000'000;

hal::DriveConfig with_temperature(hal::DriveConfig config) noexcept {
  if (!config.temperature.exists()) config.temperature = kUsualTemperature;
  return config;
}

ObjectEntry temperature_entry(const hal::TemperatureConfig& config) noexcept {
  using enum ObjectType;
  const ObjectType type = config.size == 1   ? config.is_signed ? kI8 : kU8
                          : config.size == 2 ? config.is_signed ? kI16 : kU16
                          : config.is_signed ? kI32
                                             : kU32;
  return {config.index, config.subindex, type, ObjectAccess::kReadOnly, Mapping::kNo, 0};
}

std::uint32_t rounded(double value) noexcept { return static_cast<std::uint32_t>(std::llround(value)); }

}  // namespace

const char* name(PowerState state) noexcept {
  switch (state) {
    case PowerState::kNotReady: return "not ready";
    case PowerState::kSwitchOnDisabled: return "switch on disabled";
    case PowerState::kReady: return "ready";
    case PowerState::kSwitchedOn: return "switched on";
    case PowerState::kEnabled: return "enabled";
    case PowerState::kQuickStop: return "quick stop";
    case PowerState::kFaultReaction: return "fault reaction";
    case PowerState::kFault: return "fault";
  }
  return "unknown";
}

Cia402Slave::Cia402Slave(const hal::DriveConfig& config, const JointHardwareParameters& joint, bool fd) noexcept
    : CanopenNode(config.node, kServoDrive, 255, fd),
      config_(with_temperature(config)),
      motor_(with_steps(joint, config)) {
  using enum ObjectType;
  using enum ObjectAccess;
  const double torque_unit = 1e-3 * config.gear * config.rated_torque;  // torque of a permille [Nm]
  const double most = std::min(joint.torque_limit / torque_unit, 65535.0);
  set_identity(config.identity);
  objects().set_initial(kRpdo1Mapping, 0, 1);
  objects().set_initial(kRpdo1Mapping, 1, 0x6040'0010);
  objects().set_initial(kTpdo1Mapping, 0, 1);
  objects().set_initial(kTpdo1Mapping, 1, 0x6041'0010);
  for (const ObjectEntry& entry : {
           ObjectEntry{kTripObject, 0, kU16, kWriteOnly, Mapping::kNo, 0},
           temperature_entry(config_.temperature),
           {kAbortConnectionOption, 0, kI16, kReadWrite, Mapping::kNo, 1},
           {kErrorCode, 0, kU16, kReadOnly, Mapping::kNo, 0},
           {kControlword, 0, kU16, kReadWrite, Mapping::kFromNetwork, 0},
           {kStatusword, 0, kU16, kReadOnly, Mapping::kToNetwork, 0},
           {kQuickStopOption, 0, kI16, kReadWrite, Mapping::kNo, 2},
           {kFaultReactionOption, 0, kI16, kReadWrite, Mapping::kNo, 2},
           {kMode, 0, kI8, kReadWrite, Mapping::kNo, 0},
           {kModeDisplay, 0, kI8, kReadOnly, Mapping::kToNetwork, 0},
           {kPosition, 0, kI32, kReadOnly, Mapping::kToNetwork, 0},
           {kVelocity, 0, kI32, kReadOnly, Mapping::kToNetwork, 0},
           {kTargetTorque, 0, kI16, kReadWrite, Mapping::kFromNetwork, 0},
           {kMaxTorque, 0, kU16, kReadWrite, Mapping::kNo, rounded(most)},
           {kTorqueDemand, 0, kI16, kReadOnly, Mapping::kToNetwork, 0},
           {kMotorRatedCurrent, 0, kU32, kConst, Mapping::kNo, 1000},
           {kMotorRatedTorque, 0, kU32, kConst, Mapping::kNo, rounded(1e3 * config.rated_torque)},
           {kActualTorque, 0, kI16, kReadOnly, Mapping::kToNetwork, 0},
           {kPolarity, 0, kU8, kReadWrite, Mapping::kNo, 0},
           {kQuickStopDeceleration, 0, kU32, kReadWrite, Mapping::kNo, kQuickStopCounts},
           {kEncoderResolution, 0, kU8, kConst, Mapping::kNo, 2},
           {kEncoderResolution, 1, kU32, kConst, Mapping::kNo, rounded(config.counts)},
           {kEncoderResolution, 2, kU32, kConst, Mapping::kNo, 1},
           {kGearRatio, 0, kU8, kConst, Mapping::kNo, 2},
           {kGearRatio, 1, kU32, kConst, Mapping::kNo, rounded(1e3 * config.gear)},
           {kGearRatio, 2, kU32, kConst, Mapping::kNo, 1000},
           {kInterpolationPeriod, 0, kU8, kConst, Mapping::kNo, 2},
           {kInterpolationPeriod, 1, kU8, kReadWrite, Mapping::kNo, 1},
           {kInterpolationPeriod, 2, kI8, kReadWrite, Mapping::kNo, static_cast<std::uint32_t>(-3)},
           {kPositiveTorqueLimit, 0, kU16, kReadWrite, Mapping::kNo, rounded(most)},
           {kNegativeTorqueLimit, 0, kU16, kReadWrite, Mapping::kNo, rounded(most)},
           {kSupportedModes, 0, kU32, kConst, Mapping::kNo, kSupportsTorque},
       }) {
    objects().add(entry);
  }
}

Cia402Slave::Command Cia402Slave::command_of(std::uint16_t controlword) noexcept {
  if ((controlword & 0x02) == 0) return Command::kDisableVoltage;
  if ((controlword & 0x04) == 0) return Command::kQuickStop;
  if ((controlword & 0x01) == 0) return Command::kShutdown;
  return (controlword & 0x08) == 0 ? Command::kSwitchOn : Command::kEnable;
}

bool Cia402Slave::polarity(int bit) const noexcept { return (objects().value(kPolarity) >> bit & 1u) != 0; }

std::int8_t Cia402Slave::mode_display() const noexcept {
  return slipped_mode_ != kModeTorque ? slipped_mode_ : static_cast<std::int8_t>(objects().signed_value(kMode));
}

void Cia402Slave::slip_mode(std::int8_t mode) noexcept {
  if (mode == slipped_mode_) return;
  slipped_mode_ = mode;
  changed(kModeDisplay);
}

bool Cia402Slave::has_power() const noexcept {
  return state_ == PowerState::kEnabled || state_ == PowerState::kQuickStop || state_ == PowerState::kFaultReaction;
}

std::uint16_t Cia402Slave::statusword() const noexcept {
  constexpr std::uint16_t kVoltage = 1u << 4;
  constexpr std::uint16_t kRemote = 1u << 9;
  constexpr std::uint16_t kLimited = 1u << 11;
  constexpr std::uint16_t kFollows = 1u << 12;
  constexpr std::array<std::uint16_t, 8> kOfState{0x00, 0x40, 0x21, 0x23, 0x27, 0x07, 0x0F, 0x08};
  unsigned word = kOfState[static_cast<std::size_t>(state_)] | kVoltage;
  if (is_operational()) word |= kRemote;
  if (limited_) word |= kLimited;
  if (state_ == PowerState::kEnabled && objects().signed_value(kMode) == kModeTorque) word |= kFollows;
  return static_cast<std::uint16_t>(word);
}

void Cia402Slave::sample() noexcept {
  const double read = encoder_stuck_ ? stuck_at_ : position_ + encoder_jump_;
  const std::int32_t counts = motor_.counter(config_.sign * (read - config_.zero));
  const double speed = config_.sign * velocity_ / motor_.parameters().encoder_step;
  const double torque = motor_.torque() / motor_.parameters().torque_step;
  const auto position = static_cast<std::uint32_t>(counts);
  objects().set(kStatusword, 0, statusword());
  const hal::TemperatureConfig& heat = config_.temperature;
  objects().set(heat.index, heat.subindex, rounded(temperature_ / heat.scale));
  objects().set(kModeDisplay, 0, static_cast<std::uint8_t>(mode_display()));
  objects().set(kPosition, 0, polarity(7) ? 0u - position : position);
  objects().set(kVelocity, 0, rounded(polarity(6) ? -speed : speed));
  objects().set(kTorqueDemand, 0, objects().value(kTargetTorque));
  objects().set(kActualTorque, 0, rounded(polarity(5) ? -torque : torque));
}

SdoAbort Cia402Slave::check(const ObjectEntry& entry, std::uint32_t value) const noexcept {
  const auto none_above = [value](std::uint32_t most) { return value > most ? SdoAbort::kValue : SdoAbort::kNone; };
  switch (entry.index) {
    case kAbortConnectionOption: return none_above(3);
    case kQuickStopOption:
    case kFaultReactionOption: return none_above(2);
    case kMode: return value != 0 && value != kModeTorque ? SdoAbort::kValue : SdoAbort::kNone;
    default: return SdoAbort::kNone;
  }
}

void Cia402Slave::written(const ObjectEntry& entry, std::int64_t now_ns) noexcept {
  if (entry.index == kControlword) obey(static_cast<std::uint16_t>(entry.value), now_ns);
  if (entry.index == kMode) changed(kModeDisplay);
  if (entry.index == kTripObject) trip(static_cast<std::uint16_t>(entry.value), now_ns);
}

void Cia402Slave::enter(PowerState state, std::int64_t now_ns) noexcept {
  state_ = state;
  command_since_ns_ = now_ns;
  limited_ = false;
  const bool stops = state == PowerState::kQuickStop || state == PowerState::kFaultReaction;
  if (stops) motor_.begin_stop(now_ns, position_, velocity_);
  if (!stops && state != PowerState::kEnabled) motor_.cut(now_ns);
}

/// Makes the transition that the controlword requests; numbers of the standard. `update` makes 3 and 4.
void Cia402Slave::obey(std::uint16_t controlword, std::int64_t now_ns) noexcept {
  constexpr std::uint16_t kFaultReset = 1u << 7;
  ++commands_;
  const bool had_reset_bit = reset_bit_;
  reset_bit_ = (controlword & kFaultReset) != 0;
  const Command command = command_of(controlword);
  if (command != command_) command_since_ns_ = now_ns;
  command_ = command;
  if (state_ == PowerState::kFault) {
    if (!reset_bit_ || had_reset_bit) return;
    objects().set(kErrorCode, 0, 0);
    send_emergency(kNoError, 0);
    return enter(PowerState::kSwitchOnDisabled, now_ns);  // 15
  }
  const bool powerless = command == Command::kDisableVoltage || command == Command::kQuickStop;
  switch (state_) {
    case PowerState::kSwitchOnDisabled:
      if (command == Command::kShutdown) enter(PowerState::kReady, now_ns);  // 2
      return;
    case PowerState::kReady:
      if (powerless) enter(PowerState::kSwitchOnDisabled, now_ns);  // 7
      return;
    case PowerState::kSwitchedOn:
      if (powerless) return enter(PowerState::kSwitchOnDisabled, now_ns);           // 10
      if (command == Command::kShutdown) return enter(PowerState::kReady, now_ns);  // 6
      if (command == Command::kSwitchOn) motor_.set_brake(false, now_ns);
      return;
    case PowerState::kEnabled:
      if (command == Command::kSwitchOn) return enter(PowerState::kSwitchedOn, now_ns);              // 5
      if (command == Command::kShutdown) return enter(PowerState::kReady, now_ns);                   // 8
      if (command == Command::kDisableVoltage) return enter(PowerState::kSwitchOnDisabled, now_ns);  // 9
      if (command == Command::kQuickStop) quick_stop(now_ns);                                        // 11
      return;
    case PowerState::kQuickStop:
      if (command == Command::kDisableVoltage) enter(PowerState::kSwitchOnDisabled, now_ns);  // 12
      return;
    case PowerState::kNotReady:
    case PowerState::kFaultReaction:
    case PowerState::kFault: return;
  }
}

void Cia402Slave::quick_stop(std::int64_t now_ns) noexcept {
  const bool cuts = objects().value(kQuickStopOption) == 0;
  enter(cuts ? PowerState::kSwitchOnDisabled : PowerState::kQuickStop, now_ns);
}

void Cia402Slave::fault(std::uint16_t code, std::int64_t now_ns) noexcept {
  if (state_ == PowerState::kFaultReaction || state_ == PowerState::kFault) return;
  ++trips_;
  objects().set(kErrorCode, 0, code);
  const bool cuts = objects().value(kFaultReactionOption) == 0 || !has_power();
  enter(cuts ? PowerState::kFault : PowerState::kFaultReaction, now_ns);
}

void Cia402Slave::trip(std::uint16_t code, std::int64_t now_ns) noexcept {
  if (!is_up() || state_ == PowerState::kFaultReaction || state_ == PowerState::kFault) return;
  send_emergency(code, kGenericError);
  fault(code, now_ns);
}

void Cia402Slave::disable(std::int64_t now_ns) noexcept {
  if (state_ != PowerState::kNotReady && state_ != PowerState::kFaultReaction && state_ != PowerState::kFault) {
    enter(PowerState::kSwitchOnDisabled, now_ns);
  }
}

void Cia402Slave::connection_lost(std::uint16_t code, std::int64_t now_ns) noexcept {
  const bool idle = state_ == PowerState::kNotReady || state_ == PowerState::kSwitchOnDisabled;
  if (idle || state_ == PowerState::kFaultReaction || state_ == PowerState::kFault) return;
  const std::uint32_t option = objects().value(kAbortConnectionOption);
  if (option >= 2 && has_power()) ++trips_;
  switch (option) {
    case 1: return fault(code, now_ns);
    case 2: return enter(PowerState::kSwitchOnDisabled, now_ns);
    case 3:
      if (state_ == PowerState::kEnabled) return quick_stop(now_ns);
      if (state_ != PowerState::kQuickStop) enter(PowerState::kSwitchOnDisabled, now_ns);
      return;
    default: return;
  }
}

void Cia402Slave::reset_device(bool supply, std::int64_t now_ns) noexcept {
  enter(PowerState::kNotReady, now_ns);
  command_ = Command::kDisableVoltage;
  reset_bit_ = false;
  if (!supply) return;
  set_encoder_fault(0.0, false);
}

void Cia402Slave::set_encoder_fault(double jump, bool stuck) noexcept {
  if (stuck && !encoder_stuck_) stuck_at_ = position_ + encoder_jump_;
  encoder_jump_ = jump;
  encoder_stuck_ = stuck;
}

void Cia402Slave::run_stop(PowerState end, std::int64_t now_ns) noexcept {
  switch (motor_.stop(now_ns, position_, velocity_)) {
    case Stopping::kSlowing: return;
    case Stopping::kHeld: return enter(end, now_ns);
    case Stopping::kRunsAway:
      if (state_ == PowerState::kFaultReaction) return enter(PowerState::kFault, now_ns);
      trip(kRunsAway, now_ns);
      return enter(PowerState::kFault, now_ns);  // the loop itself failed: no second stop
  }
}

void Cia402Slave::follow_torque() noexcept {
  if (mode_display() != kModeTorque) return motor_.set_torque(0.0);
  const std::int32_t asked = objects().signed_value(kTargetTorque);
  const auto limit = [this](std::uint16_t of_direction) {
    const double own = std::min(own_limit_ / motor_.parameters().torque_step, 65535.0);
    const std::uint32_t set = std::min(objects().value(kMaxTorque), objects().value(of_direction));
    return static_cast<std::int32_t>(std::min(set, static_cast<std::uint32_t>(own)));
  };
  const std::int32_t permille = std::clamp(asked, -limit(kNegativeTorqueLimit), limit(kPositiveTorqueLimit));
  limited_ = permille != asked;
  motor_.set_torque(motor_.parameters().torque_step * (polarity(5) ? -permille : permille));
}

void Cia402Slave::update(std::int64_t now_ns, double position, double velocity) noexcept {
  position_ = position;
  velocity_ = velocity;
  motor_.update(now_ns);
  switch (state_) {
    case PowerState::kNotReady:
      if (is_up()) enter(PowerState::kSwitchOnDisabled, now_ns);  // 0, 1
      return;
    case PowerState::kReady: {
      const bool asked = command_ == Command::kSwitchOn || command_ == Command::kEnable;
      if (asked && now_ns - command_since_ns_ >= motor_.parameters().enable_ns) {
        enter(PowerState::kSwitchedOn, now_ns);  // 3
      }
      return;
    }
    case PowerState::kSwitchedOn:
      if (command_ != Command::kEnable) return;
      motor_.set_brake(true, now_ns);
      if (motor_.brake_holds()) return;
      enter(PowerState::kEnabled, now_ns);  // 4
      return follow_torque();
    case PowerState::kEnabled: return follow_torque();
    case PowerState::kQuickStop: return run_stop(PowerState::kSwitchOnDisabled, now_ns);
    case PowerState::kFaultReaction: return run_stop(PowerState::kFault, now_ns);  // 14
    case PowerState::kSwitchOnDisabled:
    case PowerState::kFault: return;
  }
}

}  // namespace godobject::sim
