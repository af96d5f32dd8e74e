#pragma once

#include <array>
#include <cstdint>

#include "hal/can_frame.h"
#include "hal/canopen/object_numbers.h"
#include "hal/cia402/drive_identity.h"
#include "sim/object_dictionary.h"

namespace godobject::sim {

/// SDO abort codes of CiA 301 that a node uses.
enum class SdoAbort : std::uint32_t {
  kNone = 0,
  kCommand = 0x0504'0001,            ///< no expedited transfer
  kUnsupportedAccess = 0x0601'0000,  ///< a mapping is written while its PDO is valid or its count is not 0
  kWriteOnly = 0x0601'0001,
  kReadOnly = 0x0601'0002,
  kNoObject = 0x0602'0000,
  kNotMappable = 0x0604'0041,
  kMappingTooLong = 0x0604'0042,
  kLength = 0x0607'0010,
  kNoSub = 0x0609'0011,
  kValue = 0x0609'0030,
};

/// Codes of emergency messages, CiA 301.
enum EmergencyCode : std::uint16_t {
  kNoError = 0x0000,
  kHeartbeatError = 0x8130,
  kPdoTooShort = 0x8210,
  kPdoTooLong = 0x8220,
  kPdoTimeout = 0x8250,
};

/// Bits of the error register 1001.
inline constexpr std::uint8_t kGenericError = 1u << 0;
inline constexpr std::uint8_t kCommunicationError = 1u << 4;

/// A CANopen node by CiA 301: NMT states, boot-up, heartbeats in both directions, emergency messages, an expedited SDO
/// server, one RPDO and two TPDOs with mapping over SDO. `receive` takes frames, `take_frame` returns them, and the
/// caller passes the time. The device behind the node implements the private virtual functions. Real-time safe.
///
/// An RPDO of type 254 or 255 acts at once, others act at the next SYNC. Its event timer (:5) is a deadline, armed by
/// the first reception. A TPDO of type 1 to 240 is sampled at the end of every n-th SYNC and handed over to the wire
/// the time of `set_answer` later. One of type 254 or 255 is sent when the node becomes operational, by its event
/// timer, and when the device reports a change of an object in it. The device is told that the connection is lost
/// whenever the node leaves the operational state, or a deadline or heartbeat is missed.
class CanopenNode {
 public:
  // Times to the boot-up message, chosen: long against a cycle, short against a test.
  static constexpr std::int64_t kBoot_ns = 50'000'000;               ///< from supply
  static constexpr std::int64_t kReset_ns = 10'000'000;              ///< from NMT reset node
  static constexpr std::int64_t kResetCommunication_ns = 1'000'000;  ///< from NMT reset communication

  CanopenNode(const CanopenNode&) = delete;
  CanopenNode& operator=(const CanopenNode&) = delete;
  virtual ~CanopenNode() = default;

  /// Switches the supply, which is off at first. A node with supply boots and sends its boot-up `boot_ns` later.
  void set_supply(bool on, std::int64_t now_ns, std::int64_t boot_ns = kBoot_ns) noexcept;
  bool has_supply() const noexcept { return stage_ != Stage::kNoSupply; }

  /// Restarts the node, as NMT reset node does.
  void restart(std::int64_t now_ns) noexcept;

  void receive(const hal::CanFrame& frame, std::int64_t now_ns) noexcept;

  /// Runs the timers that are due by `now_ns`, after all frames that end at the same time.
  void run_timers(std::int64_t now_ns) noexcept;
  std::int64_t next_timer_ns() const noexcept;

  /// Takes the oldest frame to send. False: there is none.
  bool take_frame(hal::CanFrame& frame) noexcept;

  int number() const noexcept { return number_; }
  bool is_up() const noexcept { return stage_ == Stage::kUp; }
  hal::canopen::NmtState nmt_state() const noexcept { return nmt_; }
  bool is_operational() const noexcept { return is_up() && nmt_ == hal::canopen::kNmtOperational; }
  ObjectDictionary& objects() noexcept { return objects_; }
  const ObjectDictionary& objects() const noexcept { return objects_; }

  /// Sets the given fields of the identity, 1018; they stay over a reset.
  void set_identity(const hal::DriveIdentity& identity) noexcept;

  /// Sends an emergency message and sets 1001 to `error_register`.
  void send_emergency(std::uint16_t code, std::uint8_t error_register) noexcept;

  /// Time from the end of a SYNC until the TPDOs that answer it are handed over; 0 at first.
  void set_answer(std::int64_t answer_ns) noexcept { answer_ns_ = answer_ns; }

  /// For scripts of faults.
  void mute_heartbeat(bool muted) noexcept { heartbeat_muted_ = muted; }
  void ignore_deadline() noexcept {
    deadline_ignored_ = true;
  }  ///< the RPDO has no deadline, whatever its object contains
  /// Aborts every request from now on, or those for an object; kNone: none.
  void refuse_sdo(SdoAbort with, std::uint16_t index = 0) noexcept {
    refusal_ = with;
    refused_index_ = index;
  }

 protected:
  /// `fd`: PDOs are FD frames. The device adds its objects beyond 1FFF in its own constructor.
  CanopenNode(int number, std::uint32_t device_type, std::uint8_t tpdo_type, bool fd) noexcept;

  /// Reports a change of an object: TPDOs of type 254 or 255 with this object are sent.
  void changed(std::uint16_t index) noexcept;

 private:
  static constexpr std::size_t kTpdos = 2;

  /// A TPDO: its objects, from 1800 and 1A00 on, and its times.
  struct Tpdo {
    std::uint16_t communication;
    std::uint16_t mapping;
    std::int64_t event_at_ns;
    std::int64_t answer_at_ns;  ///< time at which `answer` is handed over
    hal::CanFrame answer{};
    std::uint32_t syncs = 0;
  };

  enum class Stage : std::uint8_t { kNoSupply, kBooting, kUp };

  /// Puts present values into the dictionary before they are read.
  virtual void sample() noexcept = 0;
  /// True if an object beyond 1FFF may have this value.
  virtual SdoAbort check(const ObjectEntry& entry, std::uint32_t value) const noexcept = 0;
  /// An object beyond 1FFF has been written at `now_ns`.
  virtual void written(const ObjectEntry& entry, std::int64_t now_ns) noexcept = 0;
  /// `code`: of the emergency message about it; kNoError: the node was told to leave the operational state.
  virtual void connection_lost(std::uint16_t code, std::int64_t now_ns) noexcept = 0;
  /// Resets the device as by switching it on; without supply it is off.
  virtual void reset_device(bool supply, std::int64_t now_ns) noexcept = 0;

  void boot(std::int64_t now_ns, std::int64_t boot_ns, bool all_objects) noexcept;
  void enter(hal::canopen::NmtState state, std::uint16_t reason, std::int64_t now_ns) noexcept;
  void on_nmt(const hal::CanFrame& frame, std::int64_t now_ns) noexcept;
  void on_sync(std::int64_t now_ns) noexcept;
  void on_rpdo(const hal::CanFrame& frame, std::int64_t now_ns) noexcept;
  void apply_rpdo(std::int64_t now_ns) noexcept;
  bool is_event_driven(const Tpdo& tpdo) const noexcept;
  bool sample_tpdo(const Tpdo& tpdo, hal::CanFrame& frame) noexcept;
  void send_tpdo(const Tpdo& tpdo) noexcept;
  void on_heartbeat(std::int64_t now_ns) noexcept;
  void on_sdo(const hal::CanFrame& request, std::int64_t now_ns) noexcept;
  SdoAbort upload(std::uint16_t index, std::uint8_t sub, hal::CanFrame& response) noexcept;
  SdoAbort download(const hal::CanFrame& request, std::int64_t now_ns) noexcept;
  SdoAbort check_communication(const ObjectEntry& entry, std::uint32_t value) noexcept;
  SdoAbort check_mapping(const ObjectEntry& entry, std::uint32_t value) noexcept;
  int mapped_bytes(std::uint16_t mapping) const noexcept;
  void put(const hal::CanFrame& frame) noexcept;

  static constexpr std::size_t kOutbox = 16;

  int number_;
  bool fd_;
  ObjectDictionary objects_;
  Stage stage_ = Stage::kNoSupply;
  hal::canopen::NmtState nmt_ = hal::canopen::kNmtBoot;
  std::int64_t boot_at_ns_;
  std::int64_t heartbeat_at_ns_;
  std::int64_t consumer_at_ns_;  ///< deadline of the next heartbeat of the controller
  std::int64_t command_at_ns_;   ///< deadline of the next RPDO
  std::array<Tpdo, kTpdos> tpdos_;
  std::int64_t answer_ns_ = 0;
  bool command_waits_ = false;  ///< an RPDO waits for the next SYNC
  hal::CanFrame command_;
  bool heartbeat_muted_ = false;
  bool deadline_ignored_ = false;
  SdoAbort refusal_ = SdoAbort::kNone;
  std::uint16_t refused_index_ = 0;  // 0: all
  std::array<hal::CanFrame, kOutbox> outbox_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace godobject::sim
