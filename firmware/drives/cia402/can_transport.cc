#include "firmware/drives/cia402/can_transport.h"

#include <cstdint>

#include <fmt/format.h>

#include "firmware/drives/cia402/can_buses.h"
#include "firmware/simulation/paced_clock.h"
#include "firmware/simulation/simulated_arm.h"
#include "hal/linux/monotonic_clock.h"
#include "sim/can_device.h"
#include "sim/virtual_clock.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware {
namespace {

using command::ExitCode;
using command::Failure;

/// The simulated operator holds the enable switch from this time on.
constexpr std::int64_t kHoldFrom_ns = 1'500'000'000;

/// Simulated drives on loopback buses in this process.
class SimulatedBuses final : public CanTransport {
 public:
  SimulatedBuses(const LinkRequest& request, const hal::BusLayout& layout)
      : real_time_(request.config->loop.real_time),
        arm_(*request.config, *request.placement),
        device_(std::make_unique<sim::CanDevice>(arm_.plant(), layout, arm_.hardware(),
                                                 sim::CanScript{.hold_from_ns = kHoldFrom_ns, .faults = {}})) {
    for (int i = 0; i < layout.bus_count; ++i) {
      names_.push_back(fmt::format("sim{}", i));
      buses_.push_back(&device_->bus(i));
    }
  }

  bool real_time() const noexcept override { return real_time_; }
  SimulatedArm* simulated_arm() noexcept override { return &arm_; }
  std::unique_ptr<hal::Clock> make_clock() override {
    if (real_time_) return std::make_unique<PacedClock>(*device_);
    return std::make_unique<sim::VirtualClock>(*device_);
  }

 private:
  bool real_time_;
  SimulatedArm arm_;
  std::unique_ptr<sim::CanDevice> device_;
};

/// This machine's CAN interfaces.
class MachineBuses final : public CanTransport {
 public:
  MachineBuses(const LinkRequest& request, const hal::BusLayout& layout)
      : interfaces_(split_names(request.transport), layout) {
    names_ = split_names(request.transport);
    buses_ = interfaces_.buses();
    warnings_ = interfaces_.warnings();
  }

  bool real_time() const noexcept override { return true; }
  SimulatedArm* simulated_arm() noexcept override { return nullptr; }
  std::unique_ptr<hal::Clock> make_clock() override { return std::make_unique<hal::MonotonicClock>(); }

 private:
  CanBuses interfaces_;
};

}  // namespace

std::unique_ptr<CanTransport> open_can_transport(const LinkRequest& request, const hal::BusLayout& layout) {
  if (request.transport == kSimulatedTransport) return std::make_unique<SimulatedBuses>(request, layout);
  if (layout.panel.bus < 0) {
    throw Failure(ExitCode::kBadConfig, fmt::format("{}: bus.panel_bus is missing; without a panel there is no "
                                                    "emergency stop: add one, or use --bus sim",
                                                    request.config->device.name));
  }
  return std::make_unique<MachineBuses>(request, layout);
}

}  // namespace godobject::firmware
