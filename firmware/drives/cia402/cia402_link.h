#pragma once

#include <memory>
#include <string>
#include <vector>

#include "firmware/drives/cia402/can_transport.h"
#include "firmware/drives/drive_link.h"
#include "hal/cia402/can_drives.h"

namespace godobject::firmware {

/// CiA 402 drives on connected CAN buses.
class Cia402Link final : public DriveLink {
 public:
  /// The drives on the buses of `layout`. Throws as `DriveFamily::connect`.
  Cia402Link(const LinkRequest& request, const hal::BusLayout& layout, const hal::BusTiming& timing);

  hal::JointDrives& drives() noexcept override { return drives_; }
  SimulatedArm* simulated_arm() noexcept override { return transport_->simulated_arm(); }
  bool real_time() const noexcept override { return transport_->real_time(); }
  std::unique_ptr<hal::Clock> make_clock() override { return transport_->make_clock(); }
  const std::vector<std::string>& bus_names() const noexcept override { return transport_->names(); }
  const std::vector<std::string>& warnings() const noexcept override { return warnings_; }
  bool start(hal::Clock& clock, const std::atomic<bool>& end) override;
  void stop() noexcept override { drives_.stop_nodes(); }
  const std::int64_t& round_trip_ns() const noexcept override { return drives_.statistics().round_trip_ns; }
  std::string statistics() const override;
  std::string alarm() const override;
  CommissioningReport commission(hal::Clock& clock, const std::atomic<bool>& end) override;

 private:
  hal::BusLayout layout_;
  std::unique_ptr<CanTransport> transport_;
  hal::CanDrives drives_;
  std::vector<std::string> warnings_;
};

}  // namespace godobject::firmware
