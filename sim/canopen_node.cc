#include "sim/canopen_node.h"

#include <algorithm>
#include <optional>

#include "sim/virtual_clock.h"

namespace godobject::sim {

using namespace hal::canopen;

namespace {

constexpr std::uint32_t kInvalid = 1u << 31;
constexpr std::uint32_t kExtended = 1u << 29;
constexpr std::uint8_t kEventDriven = 254;  // and 255: event-driven, by manufacturer or device profile
constexpr int kMaxMapped = 8;
constexpr std::int64_t kMs_ns = 1'000'000;

std::uint32_t get(const hal::CanFrame& frame, int from, int bytes) noexcept {
  std::uint32_t value = 0;
  for (int i = 0; i < bytes; ++i)
    value |= static_cast<std::uint32_t>(frame.data[static_cast<std::size_t>(from + i)]) << (8 * i);
  return value;
}

void set(hal::CanFrame& frame, int from, int bytes, std::uint32_t value) noexcept {
  for (int i = 0; i < bytes; ++i) {
    frame.data[static_cast<std::size_t>(from + i)] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

constexpr std::uint16_t cob(std::uint32_t entry) noexcept { return static_cast<std::uint16_t>(entry & 0x7FF); }

/// A mapping entry: index, sub-index, length in bits.
struct Mapped {
  std::uint16_t index;
  std::uint8_t sub;
  int bits;
  explicit constexpr Mapped(std::uint32_t entry) noexcept
      : index(static_cast<std::uint16_t>(entry >> 16)),
        sub(static_cast<std::uint8_t>(entry >> 8)),
        bits(static_cast<int>(entry & 0xFF)) {}
};

hal::CanFrame frame_of(std::uint16_t id, std::uint8_t length) noexcept {
  hal::CanFrame frame;
  frame.id = id;
  frame.length = length;
  return frame;
}

}  // namespace

CanopenNode::CanopenNode(int number, std::uint32_t device_type, std::uint8_t tpdo_type, bool fd) noexcept
    : number_(number),
      fd_(fd),
      boot_at_ns_(kNever),
      heartbeat_at_ns_(kNever),
      consumer_at_ns_(kNever),
      command_at_ns_(kNever),
      tpdos_{{{kTpdo1Communication, kTpdo1Mapping, kNever, kNever},
              {kTpdo2Communication, kTpdo2Mapping, kNever, kNever}}} {
  using enum ObjectType;
  using enum ObjectAccess;
  const auto node = static_cast<std::uint32_t>(number);
  const auto add = [this](std::uint16_t index, std::uint8_t sub, ObjectType type, ObjectAccess access,
                          std::uint32_t initial) {
    objects_.add({index, sub, type, access, Mapping::kNo, initial});
  };
  add(kDeviceType, 0, kU32, kConst, device_type);
  add(kErrorRegister, 0, kU8, kReadOnly, 0);
  add(kSyncCob, 0, kU32, kReadWrite, kCobSync);
  add(kSyncPeriod, 0, kU32, kReadWrite, 0);
  add(kEmergencyCob, 0, kU32, kReadWrite, kCobEmergency + node);
  add(kConsumerHeartbeat, 0, kU8, kConst, 1);
  add(kConsumerHeartbeat, 1, kU32, kReadWrite, 0);
  add(kProducerHeartbeat, 0, kU16, kReadWrite, 0);
  add(kIdentity, 0, kU8, kConst, 4);
  add(kIdentity, 1, kU32, kConst, 0);  // vendor: none
  add(kIdentity, 2, kU32, kConst, 1);
  add(kIdentity, 3, kU32, kConst, 0x0001'0000);
  add(kIdentity, 4, kU32, kConst, node);
  add(kSyncOverflow, 0, kU8, kReadWrite, 0);
  add(kErrorBehaviour, 0, kU8, kConst, 1);
  add(kErrorBehaviour, 1, kU8, kReadWrite, 0);
  add(0x1200, 0, kU8, kConst, 2);
  add(0x1200, 1, kU32, kConst, kCobSdoRequest + node);
  add(0x1200, 2, kU32, kConst, kCobSdoResponse + node);
  add(kRpdo1Communication, 0, kU8, kConst, 5);
  add(kRpdo1Communication, 1, kU32, kReadWrite, kCobRpdo1 + node);
  add(kRpdo1Communication, 2, kU8, kReadWrite, 255);
  add(kRpdo1Communication, 5, kU16, kReadWrite, 0);
  add(kRpdo1Mapping, 0, kU8, kReadWrite, 0);
  for (std::uint8_t i = 1; i <= kMaxMapped; ++i) add(kRpdo1Mapping, i, kU32, kReadWrite, 0);
  add(kTpdo1Communication, 0, kU8, kConst, 5);
  add(kTpdo1Communication, 1, kU32, kReadWrite, kCobTpdo1 + node);
  add(kTpdo1Communication, 2, kU8, kReadWrite, tpdo_type);
  add(kTpdo1Communication, 5, kU16, kReadWrite, 0);
  add(kTpdo2Communication, 0, kU8, kConst, 5);
  add(kTpdo2Communication, 1, kU32, kReadWrite, kInvalid | (kCobTpdo2 + node));
  add(kTpdo2Communication, 2, kU8, kReadWrite, 255);
  add(kTpdo2Communication, 5, kU16, kReadWrite, 0);
  for (const Tpdo& tpdo : tpdos_) {
    add(tpdo.mapping, 0, kU8, kReadWrite, 0);
    for (std::uint8_t i = 1; i <= kMaxMapped; ++i) add(tpdo.mapping, i, kU32, kReadWrite, 0);
  }
}

void CanopenNode::set_identity(const hal::DriveIdentity& identity) noexcept {
  for (const hal::IdentityField& field : hal::kIdentityFields) {
    const std::optional<std::uint32_t>& value = identity.*field.value;
    if (value) objects_.set_initial(kIdentity, field.subindex, *value);
  }
}

void CanopenNode::put(const hal::CanFrame& frame) noexcept {
  if (count_ == kOutbox) return;  // all mailboxes are full: the frame is lost
  outbox_[(first_ + count_++) % kOutbox] = frame;
}

bool CanopenNode::take_frame(hal::CanFrame& frame) noexcept {
  if (count_ == 0) return false;
  frame = outbox_[first_];
  first_ = (first_ + 1) % kOutbox;
  --count_;
  return true;
}

void CanopenNode::set_supply(bool on, std::int64_t now_ns, std::int64_t boot_ns) noexcept {
  if (on == has_supply()) return;
  count_ = 0;
  if (on) return boot(now_ns, boot_ns, true);
  stage_ = Stage::kNoSupply;
  boot_at_ns_ = heartbeat_at_ns_ = consumer_at_ns_ = command_at_ns_ = kNever;
  for (Tpdo& tpdo : tpdos_) tpdo.event_at_ns = tpdo.answer_at_ns = kNever;
  reset_device(false, now_ns);
}

void CanopenNode::restart(std::int64_t now_ns) noexcept {
  if (is_up()) boot(now_ns, kReset_ns, true);
}

void CanopenNode::boot(std::int64_t now_ns, std::int64_t boot_ns, bool all_objects) noexcept {
  if (is_operational()) connection_lost(kNoError, now_ns);
  stage_ = Stage::kBooting;
  nmt_ = kNmtBoot;
  heartbeat_at_ns_ = consumer_at_ns_ = command_at_ns_ = kNever;
  for (Tpdo& tpdo : tpdos_) {
    tpdo.event_at_ns = tpdo.answer_at_ns = kNever;
    tpdo.syncs = 0;
  }
  command_waits_ = false;
  boot_at_ns_ = boot_ns == kNever ? kNever : now_ns + boot_ns;
  objects_.restore(0x1000, 0x1FFF);
  if (!all_objects) return;
  objects_.restore(0x2000, 0xFFFF);
  reset_device(true, now_ns);
}

void CanopenNode::enter(NmtState state, std::uint16_t reason, std::int64_t now_ns) noexcept {
  if (state == nmt_) return;
  const bool was_operational = is_operational();
  nmt_ = state;
  command_at_ns_ = kNever;
  command_waits_ = false;
  for (Tpdo& tpdo : tpdos_) {
    const std::uint32_t event_ms = objects_.value(tpdo.communication, 5);
    const bool timed = is_operational() && is_event_driven(tpdo) && event_ms > 0;
    tpdo.event_at_ns = timed ? now_ns + event_ms * kMs_ns : kNever;
    tpdo.answer_at_ns = kNever;
    tpdo.syncs = 0;
  }
  if (was_operational) connection_lost(reason, now_ns);
  if (!is_operational()) return;
  for (const Tpdo& tpdo : tpdos_) {
    if (is_event_driven(tpdo)) send_tpdo(tpdo);
  }
}

bool CanopenNode::is_event_driven(const Tpdo& tpdo) const noexcept {
  return objects_.value(tpdo.communication, 2) >= kEventDriven;
}

void CanopenNode::changed(std::uint16_t index) noexcept {
  if (!is_operational()) return;
  for (const Tpdo& tpdo : tpdos_) {
    if (!is_event_driven(tpdo)) continue;
    const auto count = static_cast<std::uint8_t>(objects_.value(tpdo.mapping));
    bool holds = false;
    for (std::uint8_t i = 1; i <= count; ++i) holds = holds || Mapped(objects_.value(tpdo.mapping, i)).index == index;
    if (holds) send_tpdo(tpdo);
  }
}

void CanopenNode::receive(const hal::CanFrame& frame, std::int64_t now_ns) noexcept {
  if (!is_up()) return;
  if (frame.id == kCobNmt) return on_nmt(frame, now_ns);
  const std::uint32_t consumed = objects_.value(kConsumerHeartbeat, 1);
  if (consumed != 0 && frame.id == kCobHeartbeat + ((consumed >> 16) & 0x7F)) return on_heartbeat(now_ns);
  if (nmt_ == kNmtStopped) return;
  if (frame.id == kCobSdoRequest + number_) return on_sdo(frame, now_ns);
  if (nmt_ != kNmtOperational) return;
  if (frame.id == cob(objects_.value(kSyncCob))) return on_sync(now_ns);
  const std::uint32_t rpdo = objects_.value(kRpdo1Communication, 1);
  if ((rpdo & kInvalid) == 0 && frame.id == cob(rpdo)) return on_rpdo(frame, now_ns);
}

void CanopenNode::on_nmt(const hal::CanFrame& frame, std::int64_t now_ns) noexcept {
  if (frame.length != 2 || (frame.data[1] != 0 && frame.data[1] != number_)) return;
  switch (frame.data[0]) {
    case kNmtStart: return enter(kNmtOperational, kNoError, now_ns);
    case kNmtStop: return enter(kNmtStopped, kNoError, now_ns);
    case NmtCommand::kNmtPreOperational: return enter(kNmtPreOperationalState, kNoError, now_ns);
    case kNmtResetNode: return boot(now_ns, kReset_ns, true);
    case kNmtResetCommunication: return boot(now_ns, kResetCommunication_ns, false);
    default: return;
  }
}

void CanopenNode::on_sync(std::int64_t now_ns) noexcept {
  if (command_waits_) apply_rpdo(now_ns);
  for (Tpdo& tpdo : tpdos_) {
    const std::uint32_t every = objects_.value(tpdo.communication, 2);
    if (every < 1 || every > 240 || ++tpdo.syncs % every != 0) continue;
    if (answer_ns_ == 0) {
      send_tpdo(tpdo);
    } else if (sample_tpdo(tpdo, tpdo.answer)) {
      tpdo.answer_at_ns = now_ns + answer_ns_;
    }
  }
}

void CanopenNode::on_rpdo(const hal::CanFrame& frame, std::int64_t now_ns) noexcept {
  const int mapped = mapped_bytes(kRpdo1Mapping);
  if (frame.length < mapped) return send_emergency(kPdoTooShort, kGenericError | kCommunicationError);
  if (frame.length > mapped) send_emergency(kPdoTooLong, kGenericError | kCommunicationError);
  const std::uint32_t deadline_ms = objects_.value(kRpdo1Communication, 5);
  command_at_ns_ = deadline_ms == 0 || deadline_ignored_ ? kNever : now_ns + deadline_ms * kMs_ns;
  command_ = frame;
  if (objects_.value(kRpdo1Communication, 2) >= kEventDriven) return apply_rpdo(now_ns);
  command_waits_ = true;
}

void CanopenNode::apply_rpdo(std::int64_t now_ns) noexcept {
  command_waits_ = false;
  const auto count = static_cast<std::uint8_t>(objects_.value(kRpdo1Mapping));
  int from = 0;
  for (std::uint8_t i = 1; i <= count; ++i) {
    const Mapped mapped(objects_.value(kRpdo1Mapping, i));
    ObjectEntry* entry = objects_.find(mapped.index, mapped.sub);
    if (entry == nullptr) return;
    entry->value = get(command_, from, mapped.bits / 8);
    from += mapped.bits / 8;
    written(*entry, now_ns);
  }
}

/// Samples a TPDO into a frame. False: the TPDO is invalid.
bool CanopenNode::sample_tpdo(const Tpdo& tpdo, hal::CanFrame& frame) noexcept {
  const std::uint32_t id = objects_.value(tpdo.communication, 1);
  if ((id & kInvalid) != 0) return false;
  sample();
  frame = frame_of(cob(id), 0);
  frame.fd = fd_;
  const auto count = static_cast<std::uint8_t>(objects_.value(tpdo.mapping));
  for (std::uint8_t i = 1; i <= count; ++i) {
    const Mapped mapped(objects_.value(tpdo.mapping, i));
    set(frame, frame.length, mapped.bits / 8, objects_.value(mapped.index, mapped.sub));
    frame.length = static_cast<std::uint8_t>(frame.length + mapped.bits / 8);
  }
  return true;
}

void CanopenNode::send_tpdo(const Tpdo& tpdo) noexcept {
  hal::CanFrame frame;
  if (sample_tpdo(tpdo, frame)) put(frame);
}

void CanopenNode::on_heartbeat(std::int64_t now_ns) noexcept {
  const std::uint32_t ms = objects_.value(kConsumerHeartbeat, 1) & 0xFFFF;
  consumer_at_ns_ = ms == 0 ? kNever : now_ns + ms * kMs_ns;
}

void CanopenNode::send_emergency(std::uint16_t code, std::uint8_t error_register) noexcept {
  objects_.set(kErrorRegister, 0, error_register);
  const std::uint32_t emergency = objects_.value(kEmergencyCob);
  if (!is_up() || nmt_ == kNmtStopped || (emergency & kInvalid) != 0) return;
  hal::CanFrame frame = frame_of(cob(emergency), 8);
  set(frame, 0, 2, code);
  frame.data[2] = error_register;
  put(frame);
}

std::int64_t CanopenNode::next_timer_ns() const noexcept {
  std::int64_t next = std::min({boot_at_ns_, heartbeat_at_ns_, consumer_at_ns_, command_at_ns_});
  for (const Tpdo& tpdo : tpdos_) next = std::min({next, tpdo.event_at_ns, tpdo.answer_at_ns});
  return next;
}

void CanopenNode::run_timers(std::int64_t now_ns) noexcept {
  if (boot_at_ns_ <= now_ns) {
    boot_at_ns_ = kNever;
    stage_ = Stage::kUp;
    nmt_ = kNmtPreOperationalState;
    put(frame_of(static_cast<std::uint16_t>(kCobHeartbeat + number_), 1));  // data 0: boot-up
  }
  if (heartbeat_at_ns_ <= now_ns) {
    heartbeat_at_ns_ += objects_.value(kProducerHeartbeat) * kMs_ns;
    hal::CanFrame frame = frame_of(static_cast<std::uint16_t>(kCobHeartbeat + number_), 1);
    frame.data[0] = nmt_;
    if (!heartbeat_muted_) put(frame);
  }
  if (consumer_at_ns_ <= now_ns) {
    consumer_at_ns_ = kNever;
    send_emergency(kHeartbeatError, kGenericError | kCommunicationError);
    const std::uint32_t behaviour = objects_.value(kErrorBehaviour, 1);
    if (is_operational() && behaviour == 0) enter(kNmtPreOperationalState, kHeartbeatError, now_ns);
    if (is_operational() && behaviour == 2) enter(kNmtStopped, kHeartbeatError, now_ns);
    if (is_operational()) connection_lost(kHeartbeatError, now_ns);
  }
  if (command_at_ns_ <= now_ns) {
    command_at_ns_ = kNever;  // the next RPDO arms it again
    send_emergency(kPdoTimeout, kGenericError | kCommunicationError);
    connection_lost(kPdoTimeout, now_ns);
  }
  for (Tpdo& tpdo : tpdos_) {
    if (tpdo.answer_at_ns <= now_ns) {
      tpdo.answer_at_ns = kNever;
      put(tpdo.answer);
    }
    if (tpdo.event_at_ns <= now_ns) {
      tpdo.event_at_ns += objects_.value(tpdo.communication, 5) * kMs_ns;
      send_tpdo(tpdo);
    }
  }
}

void CanopenNode::on_sdo(const hal::CanFrame& request, std::int64_t now_ns) noexcept {
  constexpr std::uint8_t kSpecifier = 0xE0;
  constexpr std::uint8_t kDownload = 0x20;
  constexpr std::uint8_t kUpload = 0x40;
  constexpr std::uint8_t kAbort = 0x80;
  if (request.length != 8 || (request.data[0] & kSpecifier) == kAbort) return;
  hal::CanFrame response = frame_of(static_cast<std::uint16_t>(kCobSdoResponse + number_), 8);
  std::copy_n(request.data.begin() + 1, 3, response.data.begin() + 1);
  SdoAbort abort = SdoAbort::kCommand;
  const auto index = static_cast<std::uint16_t>(get(request, 1, 2));
  if (refusal_ != SdoAbort::kNone && (refused_index_ == 0 || refused_index_ == index)) {
    abort = refusal_;
  } else if ((request.data[0] & kSpecifier) == kUpload) {
    abort = upload(index, request.data[3], response);
  } else if ((request.data[0] & kSpecifier) == kDownload) {
    response.data[0] = 0x60;
    abort = download(request, now_ns);
  }
  if (abort != SdoAbort::kNone) {
    response.data[0] = kAbort;
    set(response, 4, 4, static_cast<std::uint32_t>(abort));
  }
  put(response);
}

SdoAbort CanopenNode::upload(std::uint16_t index, std::uint8_t sub, hal::CanFrame& response) noexcept {
  sample();
  const ObjectEntry* entry = objects_.find(index, sub);
  if (entry == nullptr) return objects_.has(index) ? SdoAbort::kNoSub : SdoAbort::kNoObject;
  if (!entry->readable()) return SdoAbort::kWriteOnly;
  const int bytes = size_of(entry->type);
  response.data[0] = static_cast<std::uint8_t>(0x43 | ((4 - bytes) << 2));
  set(response, 4, bytes, entry->value);
  return SdoAbort::kNone;
}

SdoAbort CanopenNode::download(const hal::CanFrame& request, std::int64_t now_ns) noexcept {
  constexpr std::uint8_t kExpedited = 1u << 1;
  constexpr std::uint8_t kSizeGiven = 1u << 0;
  const auto index = static_cast<std::uint16_t>(get(request, 1, 2));
  ObjectEntry* entry = objects_.find(index, request.data[3]);
  if (entry == nullptr) return objects_.has(index) ? SdoAbort::kNoSub : SdoAbort::kNoObject;
  if (!entry->writable()) return SdoAbort::kReadOnly;
  if ((request.data[0] & kExpedited) == 0) return SdoAbort::kCommand;
  const int bytes = size_of(entry->type);
  if ((request.data[0] & kSizeGiven) != 0 && 4 - ((request.data[0] >> 2) & 3) != bytes) return SdoAbort::kLength;
  const std::uint32_t value = get(request, 4, bytes);
  const bool communication = index < 0x2000;
  const SdoAbort abort = communication ? check_communication(*entry, value) : check(*entry, value);
  if (abort != SdoAbort::kNone) return abort;
  entry->value = value;
  if (index == kProducerHeartbeat) heartbeat_at_ns_ = value == 0 ? kNever : now_ns + value * kMs_ns;
  if (index == kConsumerHeartbeat) consumer_at_ns_ = kNever;
  if (index == kRpdo1Communication) command_at_ns_ = kNever;
  if (!communication) written(*entry, now_ns);
  return SdoAbort::kNone;
}

SdoAbort CanopenNode::check_communication(const ObjectEntry& entry, std::uint32_t value) noexcept {
  const bool pdo =
      entry.index == kRpdo1Communication || entry.index == kTpdo1Communication || entry.index == kTpdo2Communication;
  if (pdo && entry.sub == 1) {
    if ((value & kExtended) != 0 || cob(value) == 0) return SdoAbort::kValue;
    const bool stays_valid = ((entry.value | value) & kInvalid) == 0;
    return stays_valid && cob(value) != cob(entry.value) ? SdoAbort::kValue : SdoAbort::kNone;
  }
  if (pdo && entry.sub == 2) return value > 240 && value < 252 ? SdoAbort::kValue : SdoAbort::kNone;
  if (entry.index == kErrorBehaviour && value > 2) return SdoAbort::kValue;
  const bool mapping = entry.index == kRpdo1Mapping || entry.index == kTpdo1Mapping || entry.index == kTpdo2Mapping;
  if (mapping) return check_mapping(entry, value);
  return SdoAbort::kNone;
}

SdoAbort CanopenNode::check_mapping(const ObjectEntry& entry, std::uint32_t value) noexcept {
  const bool receives = entry.index == kRpdo1Mapping;
  const auto communication = static_cast<std::uint16_t>(entry.index - kRpdo1Mapping + kRpdo1Communication);
  if ((objects_.value(communication, 1) & kInvalid) == 0) return SdoAbort::kUnsupportedAccess;
  if (entry.sub > 0) {
    if (objects_.value(entry.index) != 0) return SdoAbort::kUnsupportedAccess;
    const Mapped mapped(value);
    const ObjectEntry* object = objects_.find(mapped.index, mapped.sub);
    if (object == nullptr) return objects_.has(mapped.index) ? SdoAbort::kNoSub : SdoAbort::kNoObject;
    const Mapping needed = receives ? Mapping::kFromNetwork : Mapping::kToNetwork;
    const bool fits = object->mapping == needed && mapped.bits == 8 * size_of(object->type);
    return fits ? SdoAbort::kNone : SdoAbort::kNotMappable;
  }
  if (value > kMaxMapped) return SdoAbort::kValue;
  int bits = 0;
  for (std::uint8_t i = 1; i <= value; ++i) {
    const std::uint32_t mapped = objects_.value(entry.index, i);
    if (mapped == 0) return SdoAbort::kNotMappable;
    bits += Mapped(mapped).bits;
  }
  return bits > 64 ? SdoAbort::kMappingTooLong : SdoAbort::kNone;
}

int CanopenNode::mapped_bytes(std::uint16_t mapping) const noexcept {
  const auto count = static_cast<std::uint8_t>(objects_.value(mapping));
  int bits = 0;
  for (std::uint8_t i = 1; i <= count; ++i) bits += Mapped(objects_.value(mapping, i)).bits;
  return bits / 8;
}

}  // namespace godobject::sim
