#include "hal/cia402/bring_up.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "hal/canopen/network.h"
#include "hal/canopen/sdo.h"
#include "hal/cia402/parameters.h"
#include "hal/cia402/stations.h"

namespace godobject::hal {
namespace {

using namespace canopen;
using cia402::kMaxStations;
using cia402::kPanelStation;
using cia402::ParameterStep;
using Kind = ParameterStep::Kind;

constexpr std::int64_t kMillisecond_ns = 1'000'000;
/// Time in which another master shows itself. Chosen: five heartbeats of a controller like this one (20 ms).
constexpr std::int64_t kListen_ns = 100 * kMillisecond_ns;
/// Time after the last boot-up in which a node may still boot again, as one does whose supply bounces. Chosen: the boot
/// time of the simulated nodes.
constexpr std::int64_t kSettle_ns = 50 * kMillisecond_ns;
/// Longest time of an SDO exchange, and from NMT start to operational. Chosen: the simulated nodes answer within a
/// millisecond, but a drive may store an object in non-volatile memory before it answers. A longer time only delays the
/// message about a dead node.
constexpr std::int64_t kSdoTimeout_ns = 1000 * kMillisecond_ns;
constexpr std::int64_t kStartTimeout_ns = 1000 * kMillisecond_ns;
/// Frames of a bus taken in a millisecond. Derived: the shortest frame, 47 bits, takes 47 us at 1 Mbit/s: 21 in a
/// millisecond. Three times that catches up after a stall.
constexpr int kMostFrames = 64;

class BringUp {
 public:
  BringUp(const BusLayout& layout, std::span<CanBus* const> buses, Clock& clock, FrameTap* tap,
          const std::atomic<bool>* end) noexcept
      : layout_(layout), buses_(buses), clock_(clock), tap_(tap), end_(end), stations_(layout) {}

  BringUpResult run() noexcept {
    if (listen() && boot() && identify_all() && set_up_all() && start_all()) result_ = BringUpResult();
    result_.began = began_;
    return result_;
  }

 private:
  struct Station {
    bool booted = false;
    bool mode_told{};  // since NMT start
    NmtState state = kNmtBoot;
  };

  bool listen() noexcept;
  bool boot() noexcept;
  bool identify_all() noexcept;
  bool identify(int joint) noexcept;
  bool compare_identity(int joint) noexcept;
  int joint_of_drive(const DriveIdentity& wanted) const noexcept;
  bool set_up_all() noexcept;
  bool set_up(int station) noexcept;
  bool start_all() noexcept;

  bool check_ratio(int station, std::uint16_t index, double expected, double or_this) noexcept;
  bool check_temperature(int joint) noexcept;
  bool do_step(int station, const ParameterStep& step) noexcept;
  bool exchange(int station, const CanFrame& request) noexcept;
  bool send(int bus, const CanFrame& frame) noexcept;
  template <class Done>
  bool wait(std::int64_t timeout_ns, Done&& done) noexcept;
  bool poll() noexcept;
  bool take(int bus, const CanFrame& frame) noexcept;
  bool fail(BringUpStatus status, int bus) noexcept;
  bool fail_at(BringUpStatus status, int station) noexcept;

  const BusLayout& layout_;
  std::span<CanBus* const> buses_;
  Clock& clock_;
  FrameTap* tap_;
  const std::atomic<bool>* end_;
  bool began_ = false;
  cia402::Stations stations_;
  std::array<Station, kMaxStations> seen_{};
  bool boot_is_over_ = false;
  int asked_ = -1;  // station whose response is awaited; -1: none
  const ParameterStep* step_ = nullptr;
  bool absent_{};  // the station lacks the object of the last step
  bool answered_{};
  SdoResponse response_;
  std::array<DriveIdentity, kMaxJoints> identities_{};  // of the drives that answer, by joint
  BringUpResult result_;
};

bool BringUp::fail(BringUpStatus status, int bus) noexcept {
  result_.status = status;
  result_.bus = bus;
  return false;
}

bool BringUp::fail_at(BringUpStatus status, int station) noexcept {
  result_.node = stations_.node(station);
  result_.joint = station == kPanelStation ? -1 : station;
  if (step_ != nullptr) {
    result_.index = step_->index;
    result_.subindex = step_->subindex;
  }
  return fail(status, stations_.bus(station));
}

/// Processes one frame of another node. False: the start has failed.
bool BringUp::take(int bus, const CanFrame& frame) noexcept {
  if (is_of_master(frame.id)) {
    result_.found = frame.id;
    return fail(BringUpStatus::kSecondMaster, bus);
  }
  Heartbeat heartbeat;
  if (parse_heartbeat(frame, heartbeat)) {
    const int station = stations_.at(bus, heartbeat.node);
    if (station < 0) return true;
    Station& seen = seen_[static_cast<std::size_t>(station)];
    if (heartbeat.state == kNmtBoot) {
      if (boot_is_over_) return fail_at(BringUpStatus::kStartedAnew, station);
      seen.booted = true;
    }
    seen.state = heartbeat.state;
    return true;
  }
  if (const int node = node_of(frame.id, kCobTpdo2); node != 0) {
    const int station = stations_.at(bus, node);
    if (station >= 0 && frame.length == 1) seen_[static_cast<std::size_t>(station)].mode_told = true;
    return true;
  }
  SdoResponse response;
  if (asked_ >= 0 && parse_sdo_response(frame, response) && stations_.at(bus, response.node) == asked_ &&
      response.index == step_->index && response.subindex == step_->subindex) {
    response_ = response;
    answered_ = true;
  }
  return true;
}

/// Takes the received frames of all buses. False: the start has failed.
bool BringUp::poll() noexcept {
  if (end_ != nullptr && end_->load(std::memory_order_relaxed)) return fail(BringUpStatus::kEnded, -1);
  for (std::size_t b = 0; b < buses_.size(); ++b) {
    const int bus = static_cast<int>(b);
    ReceivedFrame received;
    for (int count = 0; count < kMostFrames && buses_[b]->receive(received); ++count) {
      if (tap_ != nullptr) tap_->on_frame(bus, received);
      if (!received.own && !take(bus, received.frame)) return false;
    }
    const BusHealth health = buses_[b]->health();
    if (health.down || health.bus_off) return fail(BringUpStatus::kBusDown, bus);
  }
  return true;
}

/// Waits until `done()`. False: the time is over, or the start has failed.
template <class Done>
bool BringUp::wait(std::int64_t timeout_ns, Done&& done) noexcept {
  const std::int64_t end_ns = clock_.now_ns() + timeout_ns;
  while (poll()) {
    if (done()) return true;
    if (clock_.now_ns() >= end_ns) return false;
    clock_.sleep_until(clock_.now_ns() + kMillisecond_ns);
  }
  return false;
}

bool BringUp::send(int bus, const CanFrame& frame) noexcept {
  CanBus& wire = *buses_[static_cast<std::size_t>(bus)];
  SendResult sent = SendResult::kFull;
  const bool over = wait(kSdoTimeout_ns, [&] {
    sent = wire.send(frame);
    return sent != SendResult::kFull;
  });
  if (sent == SendResult::kSent) return true;
  if (result_.status != BringUpStatus::kOk) return false;
  return fail(over ? BringUpStatus::kBusDown : BringUpStatus::kCannotSend, bus);
}

bool BringUp::listen() noexcept {
  wait(kListen_ns, [] { return false; });
  return result_.status == BringUpStatus::kOk;
}

bool BringUp::boot() noexcept {
  for (Station& station : seen_) station = Station();
  began_ = true;
  for (int bus = 0; bus < layout_.bus_count; ++bus) {
    if (!send(bus, nmt_frame(kNmtResetCommunication, 0))) return false;
  }
  const auto silent = [this] {
    for (int i = 0; i < kMaxStations; ++i) {
      if (stations_.has(i) && !seen_[static_cast<std::size_t>(i)].booted) return i;
    }
    return -1;
  };
  if (!wait(std::llround(1e9 * layout_.boot_timeout), [&] { return silent() < 0; })) {
    if (result_.status != BringUpStatus::kOk) return false;
    const int bus = stations_.bus(silent());
    // no node acknowledges: the bus is at fault and not this node
    if (buses_[static_cast<std::size_t>(bus)]->health().unreturned > 0) return fail(BringUpStatus::kCannotSend, bus);
    return fail_at(BringUpStatus::kNoBootUp, silent());
  }
  wait(kSettle_ns, [] { return false; });
  boot_is_over_ = true;
  return result_.status == BringUpStatus::kOk;
}

bool BringUp::exchange(int station, const CanFrame& request) noexcept {
  answered_ = false;
  asked_ = station;
  if (!send(stations_.bus(station), request)) return false;
  const bool answered = wait(kSdoTimeout_ns, [this] { return answered_; });
  asked_ = -1;
  if (answered) return true;
  return result_.status == BringUpStatus::kOk && fail_at(BringUpStatus::kNoAnswer, station);
}

bool BringUp::do_step(int station, const ParameterStep& step) noexcept {
  const int node = stations_.node(station);
  step_ = &step;
  result_ = BringUpResult();
  absent_ = false;
  const bool reads = step.kind == Kind::kExpect || step.kind == Kind::kExpectIfThere;
  const bool may_be_absent = step.kind == Kind::kExpectIfThere || step.kind == Kind::kWriteIfThere;
  const CanFrame request = reads ? sdo_read(node, step.index, step.subindex)
                                 : sdo_write(node, step.index, step.subindex, step.value, step.size);
  if (!exchange(station, request)) return false;
  result_.expected = step.value;
  result_.found = response_.value;
  if (response_.kind == SdoResponse::Kind::kAborted) {
    absent_ = response_.value == kAbortNoObject || response_.value == kAbortNoSubindex;
    return (may_be_absent && absent_) || fail_at(BringUpStatus::kRefused, station);
  }
  if (!reads) return response_.kind == SdoResponse::Kind::kWritten || fail_at(BringUpStatus::kNoAnswer, station);
  if (response_.kind != SdoResponse::Kind::kRead || (response_.size != 0 && response_.size != step.size)) {
    result_.expected = static_cast<std::uint32_t>(step.size);
    result_.found = static_cast<std::uint32_t>(response_.size);
    return fail_at(BringUpStatus::kWrongSize, station);
  }
  return step.accepts(response_.value) ||
         fail_at(step.or_more ? BringUpStatus::kTooLow : BringUpStatus::kWrongValue, station);
}

/// Compares sub-index 1 over sub-index 2 of an object with the expected ratio, to a thousandth (chosen: device files
/// give gears with four digits). A drive may lack the object.
bool BringUp::check_ratio(int station, std::uint16_t index, double expected, double or_this) noexcept {
  constexpr std::uint32_t kAny = 0;  // mask
  const ParameterStep over{Kind::kExpectIfThere, index, 1, 4, 0, kAny};
  if (!do_step(station, over)) return false;
  if (absent_) return true;
  const double numerator = response_.value;
  const ParameterStep under{Kind::kExpect, index, 2, 4, 0, kAny};
  if (!do_step(station, under)) return false;
  const double found = numerator / response_.value;
  const auto is_near = [found](double ratio) { return std::fabs(found - ratio) <= 1e-3 * ratio; };
  if (is_near(expected) || is_near(or_this)) return true;
  result_.ratio_expected = expected;
  result_.ratio_found = found;
  return fail_at(BringUpStatus::kWrongRatio, station);
}

bool BringUp::check_temperature(int joint) noexcept {
  constexpr std::uint32_t kAny = 0;  // mask
  const TemperatureConfig& config = layout_.drives[static_cast<std::size_t>(joint)].temperature;
  if (!config.exists()) return true;
  const ParameterStep step{Kind::kExpect, config.index, config.subindex, config.size, 0, kAny};
  if (!do_step(joint, step)) return false;
  result_.celsius = celsius(config, response_.value);
  result_.most_celsius = config.stop;
  if (result_.celsius < config.stop) return true;
  return fail_at(BringUpStatus::kTooHot, joint);
}

bool BringUp::set_up(int station) noexcept {
  cia402::ParameterSteps steps;
  bool done = true;
  if (station == kPanelStation) {
    cia402::panel_steps(layout_, steps);
  } else {
    const DriveConfig& drive = layout_.drives[static_cast<std::size_t>(station)];
    cia402::drive_steps(layout_, drive, steps);
    done = check_ratio(station, kEncoderResolution, drive.counts, drive.counts) &&
           check_ratio(station, kGearRatio, std::fabs(drive.gear), 1.0);
  }
  std::array<bool, cia402::ParameterSteps::kCapacity> lacks{};
  const std::span<const ParameterStep> all = steps.all();
  for (std::size_t i = 0; done && i < all.size(); ++i) {
    // an object that could not be written is not read back
    for (std::size_t k = 0; k < i; ++k) lacks[i] = lacks[i] || (lacks[k] && all[k].is_of_same_object(all[i]));
    if (lacks[i]) continue;
    done = do_step(station, all[i]);
    lacks[i] = absent_;
  }
  done = done && (station == kPanelStation || check_temperature(station));
  step_ = nullptr;
  return done;
}

/// Reads the identity of a joint's drive. A field that the drive lacks, or does not give, stays empty.
bool BringUp::identify(int joint) noexcept {
  constexpr std::uint32_t kAny = 0;  // mask
  const DriveIdentity& expected = layout_.drives[static_cast<std::size_t>(joint)].identity;
  for (const IdentityField& field : kIdentityFields) {
    const ParameterStep step{Kind::kExpectIfThere, kIdentity, field.subindex, 4, 0, kAny};
    const bool done = do_step(joint, step);
    const bool given = done && !absent_;
    if (given) identities_[static_cast<std::size_t>(joint)].*field.value = response_.value;
    const std::optional<std::uint32_t>& wanted = expected.*field.value;
    if (given || (done && !wanted)) continue;
    if (done) {
      result_.expected = *wanted;
      return fail_at(BringUpStatus::kNoIdentity, joint);
    }
    // a drive that answers, but not with a number of four bytes: nobody has asked for it
    const bool refused = result_.status == BringUpStatus::kRefused || result_.status == BringUpStatus::kWrongSize;
    if (wanted || !refused) return false;
    result_ = BringUpResult();
  }
  step_ = nullptr;
  return true;
}

/// Returns the joint whose drive has the serial number and all other fields of `wanted`; -1: none.
int BringUp::joint_of_drive(const DriveIdentity& wanted) const noexcept {
  for (int i = 0; wanted.serial && i < layout_.joint_count; ++i) {
    const DriveIdentity& seen = identities_[static_cast<std::size_t>(i)];
    if (seen.serial && may_be_same(seen, wanted)) return i;
  }
  return -1;
}

/// Compares the identity of a joint's drive, once those of all drives are known.
bool BringUp::compare_identity(int joint) noexcept {
  const DriveIdentity& expected = layout_.drives[static_cast<std::size_t>(joint)].identity;
  const DriveIdentity& seen = identities_[static_cast<std::size_t>(joint)];
  if (may_be_same(expected, seen)) return true;
  const int other = joint_of_drive(expected);
  const auto differs = [&](const IdentityField& field) {
    return expected.*field.value && expected.*field.value != seen.*field.value;
  };
  // another product has another serial number, too: the first field tells more. A swap shows in the serial number
  const IdentityField& first = *std::ranges::find_if(kIdentityFields, differs);
  const IdentityField& shown = other >= 0 && differs(kIdentityFields.back()) ? kIdentityFields.back() : first;
  result_ = BringUpResult();
  result_.index = kIdentity;
  result_.subindex = shown.subindex;
  result_.expected = *(expected.*shown.value);
  result_.found = *(seen.*shown.value);
  result_.other_joint = other;
  if (other < 0) return fail_at(BringUpStatus::kWrongDrive, joint);
  const DriveIdentity& of_other = layout_.drives[static_cast<std::size_t>(other)].identity;
  const bool swapped = of_other.serial && joint_of_drive(of_other) == joint;
  return fail_at(swapped ? BringUpStatus::kDrivesSwapped : BringUpStatus::kDriveElsewhere, joint);
}

/// Compares nothing before all drives have answered: only then a swap can be told from a wrong drive.
bool BringUp::identify_all() noexcept {
  for (int i = 0; i < layout_.joint_count; ++i) {
    if (!identify(i)) return false;
  }
  for (int i = 0; i < layout_.joint_count; ++i) {
    if (!compare_identity(i)) return false;
  }
  return true;
}

bool BringUp::set_up_all() noexcept {
  for (int i = 0; i < kMaxStations; ++i) {
    if (stations_.has(i) && !set_up(i)) return false;
  }
  return true;
}

bool BringUp::start_all() noexcept {
  for (Station& station : seen_) station.mode_told = false;
  for (int i = 0; i < kMaxStations; ++i) {
    if (stations_.has(i) && !send(stations_.bus(i), nmt_frame(kNmtStart, stations_.node(i)))) return false;
  }
  const auto first_without = [this](auto&& good) {
    for (int i = 0; i < kMaxStations; ++i) {
      if (stations_.has(i) && !good(i, seen_[static_cast<std::size_t>(i)])) return i;
    }
    return -1;
  };
  const auto stands = [&] { return first_without([](int, const Station& s) { return s.state == kNmtOperational; }); };
  const auto untold = [&] {
    return first_without([](int i, const Station& s) { return i == kPanelStation || s.mode_told; });
  };
  if (wait(kStartTimeout_ns + std::llround(1e9 * layout_.mode_refresh), [&] { return stands() < 0 && untold() < 0; }))
    return true;
  if (result_.status != BringUpStatus::kOk) return false;
  if (const int station = stands(); station >= 0) {
    result_.expected = kNmtOperational;
    result_.found = seen_[static_cast<std::size_t>(station)].state;
    return fail_at(BringUpStatus::kNotOperational, station);
  }
  result_.index = kModeDisplay;
  return fail_at(BringUpStatus::kModeNotTold, untold());
}

}  // namespace

const char* describe(BringUpStatus status) noexcept {
  switch (status) {
    case BringUpStatus::kOk: return "all nodes are operational";
    case BringUpStatus::kBusDown:
      return "the interface is down or bus-off; check wiring and termination, set it up again";
    case BringUpStatus::kSecondMaster:
      return "another node sends frames that only a master may send; stop the other master";
    case BringUpStatus::kCannotSend:
      return "frames do not leave the interface; check that a node is connected, and the bit rate";
    case BringUpStatus::kNoBootUp: return "did not boot in time; check its supply, node number and bit rate";
    case BringUpStatus::kStartedAnew: return "rebooted during its setup; check its supply";
    case BringUpStatus::kNoAnswer: return "did not answer; check wiring and bus load";
    case BringUpStatus::kRefused: return "refused an object; compare it with the drive's manual";
    case BringUpStatus::kWrongSize: return "has an object of another size; this drive cannot be used";
    case BringUpStatus::kWrongValue: return "has a wrong value; correct the device file or the drive";
    case BringUpStatus::kTooLow:
      return "has too low a value; raise it in the drive, or lower the joint's torque limit in the device file";
    case BringUpStatus::kWrongRatio: return "contradicts the device file; correct the file or the drive";
    case BringUpStatus::kEnded: return "the start was asked to end";
    case BringUpStatus::kNotOperational: return "did not become operational; read its own error display";
    case BringUpStatus::kModeNotTold:
      return "does not send its mode by TPDO2, type 255 with an event timer; this drive cannot be used";
    case BringUpStatus::kWrongDrive:
      return "is not the drive that the device file names; connect that drive, or correct identity in the device file";
    case BringUpStatus::kDriveElsewhere:
      return "is not the drive that the device file names; that drive answers as another joint's; exchange the drives, "
             "their cables or their node numbers, or correct identity in the device file";
    case BringUpStatus::kDrivesSwapped:
      return "the drives of two joints are swapped, or their cables or node numbers; swap them back, or correct "
             "identity in the device file";
    case BringUpStatus::kTooHot: return "is too hot; let it cool down, then start again";
    case BringUpStatus::kNoIdentity:
      return "does not have a part of its identity that the device file names; delete that key of identity";
  }
  return "unknown status";
}

BringUpResult bring_up(const BusLayout& layout, std::span<CanBus* const> buses, Clock& clock, FrameTap* tap,
                       const std::atomic<bool>* end) noexcept {
  return BringUp(layout, buses, clock, tap, end).run();
}

}  // namespace godobject::hal
