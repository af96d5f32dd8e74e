#include "hal/cia402/read_object.h"

#include "hal/canopen/sdo.h"

namespace godobject::hal {

bool read_object(CanBus& bus, Clock& clock, int node, std::uint16_t index, std::uint8_t subindex,
                 std::uint32_t& value) noexcept {
  using canopen::SdoResponse;
  constexpr int kWait_ms = 1000;
  if (bus.send(canopen::sdo_read(node, index, subindex)) != SendResult::kSent) return false;
  for (int ms = 0; ms < kWait_ms; ++ms) {
    ReceivedFrame received;
    SdoResponse response;
    while (bus.receive(received)) {
      if (received.own || !canopen::parse_sdo_response(received.frame, response)) continue;
      if (response.node != node || response.index != index || response.subindex != subindex) continue;
      value = response.value;
      return response.kind == SdoResponse::Kind::kRead;
    }
    clock.sleep_until(clock.now_ns() + 1'000'000);
  }
  return false;
}

}  // namespace godobject::hal
