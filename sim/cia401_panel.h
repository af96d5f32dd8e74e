#pragma once

#include <cstdint>

#include "hal/cia402/bus_layout.h"
#include "sim/canopen_node.h"

namespace godobject::sim {

/// The operator's panel: a CiA 401 module with eight digital inputs, 6000:1, inverted by 6002:1. Real-time safe.
class Cia401Panel final : public CanopenNode {
 public:
  Cia401Panel(const hal::PanelConfig& config, bool fd) noexcept;

  /// `inputs`: bits kPanel... of object_numbers.h.
  void set_inputs(std::uint8_t inputs) noexcept { inputs_ = inputs; }

 private:
  void sample() noexcept override {
    using namespace hal::canopen;
    objects().set(kDigitalInputs8, 1, inputs_ ^ objects().value(kInputPolarity8, 1));
  }
  SdoAbort check(const ObjectEntry&, std::uint32_t) const noexcept override { return SdoAbort::kNone; }
  void written(const ObjectEntry&, std::int64_t) noexcept override {}
  void connection_lost(std::uint16_t, std::int64_t) noexcept override {}
  void reset_device(bool, std::int64_t) noexcept override {}

  std::uint8_t inputs_ = 0;
};

}  // namespace godobject::sim
