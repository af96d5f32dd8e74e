// Example 3: a loop of 1 kHz with a device of your own. `Device` is the part to replace: here it is a handle of 0.5 kg
// that a hand presses down with 5 N and that is free to move up and down. The loop keeps absolute deadlines, so that
// the duration of a cycle does not add up.
//
// usage: 3_own_device X.scene; the numbers suit the ball above a plate that write_scene makes

#include <time.h>

#include <cstdio>

#include <godobject/god_object.h>

#include "aligned_file.h"

namespace {

constexpr double kPeriod = 1e-3;  // [s]

class Device {
 public:
  /// The handle's pose in W, and its velocity.
  godobject::GodObject::Input read() {
    godobject::GodObject::Input input;
    input.H_WM.translation.z() = height_;
    input.velocity_W.translation.z() = speed_;
    return input;
  }

  /// Displays a force; a real device would turn it into motor torques here. Limit it to what your device may do.
  void write(const godobject::Wrench& wrench_W) {
    constexpr double kMass = 0.5, kDamping = 4.0, kPress = -5.0;
    speed_ += kPeriod / kMass * (kPress - kDamping * speed_ + wrench_W.force.z());
    height_ += kPeriod * speed_;
  }

 private:
  double height_ = 0.04;  // [m]
  double speed_ = 0.0;
};

timespec after(timespec time, long ns) {
  time.tv_nsec += ns;
  if (time.tv_nsec >= 1'000'000'000) {
    time.tv_nsec -= 1'000'000'000;
    time.tv_sec += 1;
  }
  return time;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: 3_own_device X.scene\n"), 64;
  AlignedBytes image = read_file(argv[1]);
  godobject::Scene scene;
  auto status = godobject::Scene::open(image.span(), scene);
  if (status != godobject::Status::kOk)
    return std::fprintf(stderr, "%s: %s\n", argv[1], godobject::describe(status)), 65;
  godobject::GodObject god_object;
  AlignedBytes memory(godobject::GodObject::memory_size(scene));
  status = god_object.start(scene, scene.default_solver(), scene.has_friction(), memory.span());
  if (status != godobject::Status::kOk)
    return std::fprintf(stderr, "%s: %s\n", argv[1], godobject::describe(status)), 65;

  Device device;
  godobject::CycleReport report;
  timespec deadline{};
  clock_gettime(CLOCK_MONOTONIC, &deadline);
  for (int cycle = 0; cycle < 2000; ++cycle) {
    deadline = after(deadline, 1'000'000);
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr);
    // on a bad pose the force is zero and the god object is held
    if (god_object.update(device.read(), report) != godobject::Status::kOk) std::fprintf(stderr, "bad pose\n");
    device.write(report.force.total_W);
  }
  std::printf("after two seconds the handle rests on %.2f N\n", report.force.total_W.force.z());
  return 0;
}
