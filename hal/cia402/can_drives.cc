#include "hal/cia402/can_drives.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "hal/canopen/emergency.h"
#include "hal/canopen/network.h"
#include "hal/canopen/sdo.h"

namespace godobject::hal {
namespace {

using namespace canopen;
using cia402::AlarmDetail;
using cia402::kPanelStation;

int cycles(double duration, double period) noexcept {
  return std::max(1, static_cast<int>(std::lround(duration / period)));
}

/// So many cycles, or as many milliseconds if they take more.
int at_least(int count, double period) noexcept { return std::max(count, cycles(1e-3 * count, period)); }

}  // namespace

CanDrives::CanDrives(const BusLayout& layout, std::span<CanBus* const> buses, const BusTiming& timing,
                     FrameTap* tap) noexcept
    : layout_(layout),
      timing_(timing),
      tap_(tap),
      stations_(layout),
      heartbeat_cycles_(cycles(layout.drive_heartbeat, layout.period)),
      timeout_cycles_(cycles(layout.heartbeat_timeout, layout.period)),
      read_back_cycles_(cycles(layout.read_back_interval, layout.period)),
      held_cycles_(at_least(kHeldCycles, layout.period)),
      probe_cycles_(at_least(kProbeCycles, layout.period)),
      probe_silent_(at_least(kProbeSilent, layout.period)),
      near_heartbeat_(at_least(3, layout.period)),
      most_panel_lost_(cycles_to_loss(layout.period)) {
  assert(static_cast<int>(buses.size()) == layout.bus_count && layout.bus_count <= kMaxBuses);
  for (std::size_t b = 0; b < buses.size(); ++b) buses_[b].wire = buses[b];
  restart();
}

void CanDrives::restart() noexcept {
  for (int b = 0; b < layout_.bus_count; ++b) {
    Bus& bus = buses_[static_cast<std::size_t>(b)];
    bus = {.wire = bus.wire, .watch = cia402::ParameterWatch(layout_, b)};
  }
  for (int i = 0; i < layout_.joint_count; ++i) {
    const DriveConfig& drive = layout_.drives[static_cast<std::size_t>(i)];
    joint(i) = {.channel = cia402::JointChannel(drive, layout_.fd, layout_.period)};
  }
  panel_ = Panel();
  reading_ = JointReading();
  alarm_.clear();
  statistics_ = CanStatistics();
  power_ = PowerRequest::kOff;
  probe_ = to_heartbeat_ = 0;
  withheld_ = -1;
}

BringUpResult CanDrives::bring_up(Clock& clock, const std::atomic<bool>* end) noexcept {
  std::array<CanBus*, kMaxBuses> wires{};
  std::ranges::transform(buses_, wires.begin(), &Bus::wire);
  restart();
  probe_ = probe_cycles_ + 1;
  const BringUpResult result =
      hal::bring_up(layout_, {wires.data(), static_cast<std::size_t>(layout_.bus_count)}, clock, tap_, end);
  anothers_ = result.status == BringUpStatus::kSecondMaster || !result.began;
  return result;
}

void CanDrives::stop_nodes() noexcept {
  if (anothers_) return;
  for (int bus = 0; bus < layout_.bus_count; ++bus) send_on(bus, nmt_frame(kNmtStop, 0));
}

SendResult CanDrives::send_on(int bus, const CanFrame& frame) noexcept {
  const SendResult result = buses_[static_cast<std::size_t>(bus)].wire->send(frame);
  switch (result) {
    case SendResult::kSent: ++statistics_.sent; break;
    case SendResult::kFull: ++statistics_.full; break;
    case SendResult::kDown:
      ++statistics_.down;
      alarm_.raise({.alarm = Alarm::kBusDown, .bus = bus});
      break;
  }
  return result;
}

void CanDrives::request() noexcept {
  sync_failed_ = false;
  if (probe_ > 0) --probe_;
  CanFrame sync = sync_frame();
  sync.fd = layout_.fd;
  for (int b = 0; b < layout_.bus_count; ++b) {
    Bus& bus = buses_[static_cast<std::size_t>(b)];
    bus.echo_ns = bus.sample_ns = 0;
    // frames that are still in the queue would be late, and all frames after them
    bus.holds = bus.unechoed > 0 && ++bus.held < held_cycles_;
    bus.asked = false;
    if (!bus.holds) {
      bus.unechoed = 0;
      bus.held = 0;  // a SYNC that has not returned in this time never will
      if (probe_ == 0 || probe_ > probe_silent_) bus.asked = send_on(b, sync) == SendResult::kSent;
      if (bus.asked) ++bus.unechoed;
    }
    if (!bus.asked && probe_ == 0) sync_failed_ = true;
  }
  if (!(layout_.answer > 0.0)) send_heartbeat_or_sdo();
}

void CanDrives::receive(JointReading& reading) noexcept {
  for (int bus = 0; bus < layout_.bus_count; ++bus) drain(bus);
  check_health();
  for (int i = 0; i < layout_.joint_count; ++i) {
    close_joint(i);
    check_temperature(i);
  }
  if (layout_.panel.bus >= 0) close_panel();
  if (layout_.answer > 0.0) send_heartbeat_or_sdo();
  reading_.alarm = alarm_.first().alarm;
  reading_.alarm_joint = alarm_.first().joint;
  reading = reading_;
}

void CanDrives::check_health() noexcept {
  statistics_.round_trip_ns = 0;
  for (int b = 0; b < layout_.bus_count; ++b) {
    const Bus& bus = buses_[static_cast<std::size_t>(b)];
    const BusHealth health = bus.wire->health();
    // a bus without an acknowledging node does not become bus-off; its frames only do not return
    const bool unheard = health.unreturned > kMostUnreturned;
    if (health.down || health.bus_off || unheard) alarm_.raise({.alarm = Alarm::kBusDown, .bus = b});
    alarm_.raise(bus.watch.finding());
    if (bus.echo_ns > 0) {  // without a sample the difference is negative
      statistics_.round_trip_ns = std::max(statistics_.round_trip_ns, bus.sample_ns - bus.echo_ns);
      statistics_.longest_round_trip_ns = std::max(statistics_.longest_round_trip_ns, statistics_.round_trip_ns);
    }
  }
}

void CanDrives::check_temperature(int i) noexcept {
  const auto at = static_cast<std::size_t>(i);
  const int bus = stations_.bus(i);
  const cia402::TemperatureWatch& watch = buses_[static_cast<std::size_t>(bus)].watch.temperature(i);
  const TemperatureConfig& config = watch.config();
  if (!config.exists()) return;
  reading_.warm[at] = watch.is_warm();
  reading_.temperature_lost[at] = watch.is_lost();
  if (statistics_.hottest_joint < 0 ? watch.celsius() > -1e9 : watch.celsius() > statistics_.hottest) {
    statistics_.hottest = watch.celsius();
    statistics_.hottest_joint = i;
  }
  alarm_.raise({.alarm = watch.alarm(),
                .bus = bus,
                .joint = i,
                .index = config.index,
                .subindex = config.subindex,
                .celsius = watch.celsius(),
                .most_celsius = config.stop});
}

void CanDrives::drain(int b) noexcept {
  Bus& bus = buses_[static_cast<std::size_t>(b)];
  ReceivedFrame received;
  for (int count = 0; bus.wire->receive(received);) {
    if (tap_ != nullptr) tap_->on_frame(b, received);
    if (received.own) {
      take_own(bus, received);
    } else {
      ++statistics_.received;
      take(b, received);
    }
    if (++count == kMostFrames) {
      ++statistics_.floods;
      return;
    }
  }
}

void CanDrives::take_own(Bus& bus, const ReceivedFrame& received) noexcept {
  if (received.frame.id != kCobSync) return;
  if (bus.unechoed > 0) --bus.unechoed;
  bus.echo_ns = received.time_ns;
}

void CanDrives::take(int bus, const ReceivedFrame& received) noexcept {
  const CanFrame& frame = received.frame;
  if (is_of_master(frame.id)) return take_foreign_master(bus, frame);
  const auto station = [&](std::uint16_t base) { return stations_.at(bus, node_of(frame.id, base)); };
  if (const int i = station(kCobTpdo1); i >= 0) return take_sample(bus, i, received);
  if (const int i = joint_of(station(kCobTpdo2)); i >= 0) return take_mode(i, frame);
  if (const int i = station(kCobEmergency); i >= 0) return take_emergency(bus, i, frame);
  if (const int i = station(kCobHeartbeat); i >= 0) return take_heartbeat(bus, i, frame);
  if (station(kCobSdoResponse) >= 0) {
    SdoResponse response;
    if (parse_sdo_response(frame, response)) {
      buses_[static_cast<std::size_t>(bus)].watch.take(response);
    } else {
      ++statistics_.malformed;
    }
  }
}

void CanDrives::take_foreign_master(int bus, const CanFrame& frame) noexcept {
  int node = node_of(frame.id, kCobSdoRequest);
  bool writes = is_sdo_write(frame);
  if (frame.id == kCobNmt) {
    writes = true;
    node = frame.length == 2 ? frame.data[1] & kMaxNode : 0;
  }
  const int station = stations_.at(bus, node);
  alarm_.raise({.alarm = writes ? Alarm::kForeignWrite : Alarm::kForeignMaster,
                .bus = bus,
                .joint = joint_of(station),
                .id = frame.id});
}

void CanDrives::take_sample(int b, int station, const ReceivedFrame& received) noexcept {
  Bus& bus = buses_[static_cast<std::size_t>(b)];
  const bool in_time = bus.asked && bus.unechoed == 0;
  if (probe_ > 0 && probe_ <= probe_silent_) {
    alarm_.raise({.alarm = Alarm::kAnswersLate, .bus = b, .joint = joint_of(station), .id = received.frame.id});
  }
  if (station == kPanelStation) {
    if (received.frame.length != 1) {
      ++statistics_.malformed;
    } else if (in_time) {
      panel_.inputs = received.frame.data[0];
      panel_.fresh = true;
      bus.sample_ns = received.time_ns;
    }
    return;
  }
  Joint& drive = joint(station);
  if (!in_time) {
    ++statistics_.late[static_cast<std::size_t>(station)];
    return;
  }
  if (!drive.channel.take(received.frame)) {
    ++statistics_.malformed;
    if (++drive.bad_frames >= kMostBadFrames) {
      alarm_.raise({.alarm = Alarm::kBadFrames, .bus = b, .joint = station, .id = received.frame.id});
    }
    return;
  }
  drive.bad_frames = 0;
  drive.fresh = true;
  bus.sample_ns = received.time_ns;
}

/// Takes a mode at any time: a drive sends it when it changes.
void CanDrives::take_mode(int i, const CanFrame& frame) noexcept {
  if (frame.length != 1) {
    ++statistics_.malformed;
    return;
  }
  joint(i).mode = static_cast<std::int8_t>(frame.data[0]);
}

void CanDrives::take_emergency(int bus, int station, const CanFrame& frame) noexcept {
  Emergency emergency;
  if (parse_emergency(frame, emergency) && is_warning(emergency.code)) {
    ++statistics_.warnings;
  } else {  // also a malformed one: its sender has a problem
    alarm_.raise(
        {.alarm = Alarm::kDriveError, .bus = bus, .joint = joint_of(station), .id = frame.id, .found = emergency.code});
  }
}

void CanDrives::take_heartbeat(int bus, int station, const CanFrame& frame) noexcept {
  Heartbeat heartbeat;
  if (!parse_heartbeat(frame, heartbeat)) {
    ++statistics_.malformed;
    return;
  }
  (station == kPanelStation ? panel_.silent : joint(station).silent) = 0;
  if (heartbeat.state == kNmtOperational) return;
  alarm_.raise({.alarm = heartbeat.state == kNmtBoot ? Alarm::kNodeReset : Alarm::kWrongMode,
                .bus = bus,
                .joint = joint_of(station),
                .id = frame.id,
                .expected = kNmtOperational,
                .found = heartbeat.state});
}

/// Completes the reading of one joint in this cycle.
void CanDrives::close_joint(int i) noexcept {
  const auto at = static_cast<std::size_t>(i);
  Joint& drive = joint(i);
  if (drive.fresh) {
    drive.age = 0;
    reading_.position[i] = drive.channel.position();
    reading_.torque[i] = drive.channel.torque();
    reading_.limited[at] = drive.channel.limited();
  } else {
    ++drive.age;
    if (probe_ == 0) ++statistics_.lost[at];
  }
  drive.fresh = false;
  const bool silent = drive.age > static_cast<std::uint32_t>(timeout_cycles_);
  reading_.age[at] = drive.age;
  reading_.state[at] = silent || probe_ > 0 ? DriveState::kUnavailable : drive.channel.state();

  const AlarmDetail of_joint{.bus = stations_.bus(i), .joint = i};
  const auto raise = [&](Alarm alarm) {
    AlarmDetail detail = of_joint;
    detail.alarm = alarm;
    alarm_.raise(detail);
  };
  if (drive.channel.left_torque_mode()) raise(Alarm::kWrongMode);
  if (drive.mode != kModeTorque) {
    AlarmDetail detail = of_joint;
    detail.alarm = Alarm::kWrongMode;
    detail.index = kModeDisplay;
    detail.expected = static_cast<std::uint32_t>(kModeTorque);
    detail.found = static_cast<std::uint32_t>(drive.mode);
    alarm_.raise(detail);
  }
  drive.silent = std::min(drive.silent + 1, timeout_cycles_ + 2);
  if (drive.silent > timeout_cycles_ + 1) raise(Alarm::kHeartbeatLost);
}

void CanDrives::close_panel() noexcept {
  if (panel_.fresh) {
    panel_.lost = 0;
    panel_.seen = true;
  } else if (probe_ == 0) {
    panel_.lost = std::min(panel_.lost + 1, most_panel_lost_);
    if (panel_.lost == most_panel_lost_) {
      panel_.inputs = 0;
      alarm_.raise({.alarm = panel_.seen ? Alarm::kPanelLost : Alarm::kPanelSilent, .bus = layout_.panel.bus});
    }
  }
  panel_.fresh = false;
  panel_.silent = std::min(panel_.silent + 1, timeout_cycles_ + 2);
  reading_.emergency_stop = (panel_.inputs & kPanelStopReleased) == 0;
  reading_.enable_switch = (panel_.inputs & kPanelEnable) != 0;
  reading_.clutch_open = (panel_.inputs & kPanelClutch) != 0;
}

void CanDrives::begin_reset() noexcept {
  alarm_.reset();
  for (int i = 0; i < layout_.joint_count; ++i) joint(i).bad_frames = 0;
}

bool CanDrives::send(const JointCommand& command) noexcept {
  if (command.power == PowerRequest::kReset && power_ != PowerRequest::kReset) begin_reset();
  power_ = command.power;
  bool all_sent = !sync_failed_;
  for (int i = 0; i < layout_.joint_count; ++i) {
    if (i == withheld_ && command.power == PowerRequest::kOff) continue;
    CanFrame rpdo;
    const bool finite = joint(i).channel.command(command.power, command.torque[i], rpdo);
    // after a SYNC that is still in the queue it would be late, and after a stall many would come at once
    const bool goes_out = buses_[static_cast<std::size_t>(stations_.bus(i))].unechoed == 0;
    const bool sent = goes_out && send_on(stations_.bus(i), rpdo) == SendResult::kSent;
    all_sent = all_sent && finite && sent;
  }
  return all_sent;
}

/// True if a heartbeat on this bus is due in this cycle or the next ones, or overdue: together with an SDO exchange it
/// would delay samples beyond their collection.
bool CanDrives::heartbeat_is_near(int bus) const noexcept {
  const auto is_near = [this](int silent) { return silent > heartbeat_cycles_ - near_heartbeat_; };
  for (int i = 0; i < layout_.joint_count; ++i) {
    if (stations_.bus(i) == bus && is_near(joints_[static_cast<std::size_t>(i)].silent)) return true;
  }
  return layout_.panel.bus == bus && is_near(panel_.silent);
}

/// Uses the wire between samples and torques, which is idle while the torques are computed. If the drives answer at
/// once the frame is handed over right after SYNC: the samples go first. Otherwise it is handed over after the
/// collection, or the samples would find the wire occupied.
void CanDrives::send_heartbeat_or_sdo() noexcept {
  const bool heartbeat = --to_heartbeat_ <= 0;
  if (heartbeat) to_heartbeat_ = heartbeat_cycles_;
  for (int b = 0; b < layout_.bus_count; ++b) {
    Bus& bus = buses_[static_cast<std::size_t>(b)];
    ++bus.since_sdo;
    if (bus.holds) continue;
    if (heartbeat) {
      send_on(b, heartbeat_frame(kControllerNode, kNmtOperational));
      continue;
    }
    const int overdue = bus.since_sdo - bus.watch.interval(read_back_cycles_);
    if (overdue < 0 || (overdue < heartbeat_cycles_ && heartbeat_is_near(b))) continue;
    bus.since_sdo = 0;
    CanFrame request;
    if (bus.watch.next(request)) send_on(b, request);
  }
}

}  // namespace godobject::hal
