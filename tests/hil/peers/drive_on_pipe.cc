// A simulated drive, node 1, and the panel, node 20h, on a pipe (FramePipe). Their time advances by a millisecond for
// each millisecond of real time and for each received frame. Ends when stdin ends.
#include <memory>

#include "sim/can_device.h"
#include "tests/hil/peers/frame_pipe.h"
#include "tests/sim/one_joint.h"

int main() {
  using namespace godobject;
  const ArmModel arm = test::one_joint(1.0, 0.0);
  hal::BusLayout layout;
  layout.joint_count = 1;
  layout.drives[0].rated_torque = 100.0;
  layout.panel.bus = 0;
  const auto hardware = sim::usual_hardware(arm);
  sim::Plant plant(arm, JointVector::Zero());
  const auto device = std::make_unique<sim::CanDevice>(plant, layout, hardware);
  test::FramePipe pipe;
  hal::CanBus& bus = device->bus(0);
  do {
    hal::CanFrame frame;
    while (pipe.read(frame)) bus.send(frame);
    device->advance_to(device->now_ns() + 1'000'000);
    hal::ReceivedFrame received;
    while (bus.receive(received)) {
      if (!received.own) pipe.write(received.frame);
    }
  } while (pipe.wait(1));
}
