#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/canopen/network.h"
#include "hal/cia402/bus_layout.h"

namespace godobject::hal::cia402 {

inline constexpr int kPanelStation = kMaxJoints;
inline constexpr int kMaxStations = kMaxJoints + 1;

/// The nodes of the controller: one a joint, then the operator's panel.
class Stations {
 public:
  explicit Stations(const BusLayout& layout) noexcept {
    for (auto& bus : stations_) bus.fill(-1);
    for (int joint = 0; joint < layout.joint_count; ++joint) {
      const DriveConfig& drive = layout.drives[static_cast<std::size_t>(joint)];
      add(joint, drive.bus, drive.node);
    }
    if (layout.panel.bus >= 0) add(kPanelStation, layout.panel.bus, layout.panel.node);
  }

  /// The station of a node, 0 to 127: its joint, kPanelStation, or -1: another node, or 0.
  int at(int bus, int node) const noexcept {
    return stations_[static_cast<std::size_t>(bus)][static_cast<std::size_t>(node)];
  }

  bool has(int station) const noexcept { return node(station) != 0; }
  int bus(int station) const noexcept { return bus_[static_cast<std::size_t>(station)]; }
  int node(int station) const noexcept { return node_[static_cast<std::size_t>(station)]; }

 private:
  void add(int station, int bus, int node) noexcept {
    stations_[static_cast<std::size_t>(bus)][static_cast<std::size_t>(node)] = static_cast<std::int8_t>(station);
    bus_[static_cast<std::size_t>(station)] = bus;
    node_[static_cast<std::size_t>(station)] = node;
  }

  std::array<std::array<std::int8_t, canopen::kMaxNode + 1>, kMaxBuses> stations_;
  std::array<int, kMaxStations> bus_{};
  std::array<int, kMaxStations> node_{};  // 0: no such station
};

}  // namespace godobject::hal::cia402
