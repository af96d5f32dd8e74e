#pragma once

#include "firmware/drives/drive_family.h"
#include "hal/cia402/bus_plan.h"

namespace godobject::firmware {

/// CiA 402 drives in cyclic synchronous torque mode over CANopen, as `[bus]` and `[[joint]]` of the device file name
/// them. Transports: simulated buses and SocketCAN interfaces, see can_transport.h.
class Cia402Family final : public DriveFamily {
 public:
  explicit Cia402Family(const hal::BusLayout& layout) noexcept : layout_(layout), plan_(hal::plan_buses(layout)) {}

  double delay() const noexcept override { return plan_.timing.delay_s; }
  std::string plan() const override;
  void require_plan() const override;
  std::vector<Finding> examine(const std::string& transport) const override;
  std::unique_ptr<DriveLink> connect(const LinkRequest& request) const override;

 private:
  hal::BusLayout layout_;
  hal::BusPlan plan_;
};

}  // namespace godobject::firmware
