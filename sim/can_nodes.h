#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/cia402/bus_layout.h"
#include "sim/cia401_panel.h"
#include "sim/cia402_slave.h"
#include "sim/drive_fault.h"
#include "sim/joint_motor.h"
#include "sim/plant.h"

namespace godobject::sim {

/// The operator's actions at the panel, and faults of the drives.
struct CanScript {
  std::int64_t hold_from_ns = 0;  ///< the enable switch is released before this time, and held from then on
  /// All kinds but kEncoderNotFinite and those of lost or late readings and commands, which are faults of a bus here.
  std::span<const DriveFault> faults;
};

/// All nodes on the buses of a layout but the controller: a CiA 402 drive for each joint of the plant, and the
/// operator's panel. The caller passes frames and time. Real-time safe.
class CanNodes {
 public:
  /// The plant is at time zero; plant, layout and script outlive this. All nodes have supply and boot, as if switched
  /// on at time zero. Steps of encoders and torques are the layout's, see Cia402Slave.
  CanNodes(Plant& plant, const hal::BusLayout& layout, std::span<const JointHardwareParameters> joints,
           const CanScript& script = {}) noexcept;

  std::int64_t now_ns() const noexcept { return now_ns_; }
  std::int64_t cycle() const noexcept { return now_ns() / period_ns_; }
  std::int64_t period_ns() const noexcept { return period_ns_; }
  int node_count() const noexcept { return joint_count_ + (panel_ ? 1 : 0); }

  /// Advances time to `ns`, at most to the next cycle; no timer may be due before. The plant may stay behind until
  /// something can act on it or read it.
  void pass_to(std::int64_t ns) noexcept;

  /// Advances plant and drives' loops to now, in equal steps of at most `Plant::kStep_ns`.
  void settle() noexcept;

  /// Passes a frame that has ended now to all nodes of a bus but its sender; a sender of -1, or beyond the nodes, is no
  /// node. Before frames of other senders the plant settles; a node's frame moves no drive.
  void receive(int bus, const hal::CanFrame& frame, int sender) noexcept;

  /// Runs the timers that are due now, after all frames that have ended now.
  void run_timers() noexcept;
  std::int64_t next_timer_ns() const noexcept;

  /// Nodes are numbered by joint; the panel is last.
  CanopenNode& node(int i) noexcept;
  const CanopenNode& node(int i) const noexcept;
  int bus_of(int i) const noexcept;
  const Cia402Slave& drive(int joint) const noexcept { return *drives_[static_cast<std::size_t>(joint)]; }
  Cia402Slave& drive(int joint) noexcept { return *drives_[static_cast<std::size_t>(joint)]; }
  const Plant& plant() const noexcept { return plant_; }

  /// Exchanges the drives of two joints before their first frame: each has the node number of the other one, is known
  /// by its own identity, and moves its own joint. So the drive that the controller knows as that of joint i moves
  /// joint j, and the other way round.
  void swap_drives(int i, int j) noexcept;

  void press_emergency_stop(bool pressed) noexcept { emergency_stop_ = pressed; }
  void hold_enable_switch(bool held) noexcept { enable_switch_ = held; }
  void open_clutch(bool open) noexcept { clutch_ = open; }

 private:
  void begin_cycle() noexcept;
  void update_drives() noexcept;
  void update_panel() noexcept;

  Plant& plant_;
  const hal::BusLayout& layout_;
  CanScript script_;
  std::int64_t period_ns_;
  int joint_count_;
  std::int64_t now_ns_ = 0;
  std::array<std::optional<Cia402Slave>, kMaxJoints> drives_;
  std::array<int, kMaxJoints> moved_{};  // joint of the plant that a drive moves
  std::optional<Cia401Panel> panel_;
  bool emergency_stop_ = false;
  bool enable_switch_ = true;
  bool clutch_ = false;
};

}  // namespace godobject::sim
