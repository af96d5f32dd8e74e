#include "firmware/controller/companion.h"
#include "firmware/controller/session.h"
#include "firmware/simulation/simulated_arm.h"
#include "hal/linux/monotonic_clock.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware {

std::string Session::run(Companion& companion, RunRequests& requests) {
  if (link_->simulated_arm() == nullptr || link_->real_time()) {
    throw command::Failure(command::ExitCode::kInternal, "a run of a real arm, or in real time, has no companion");
  }
  hal::MonotonicClock stopwatch;
  RunSetup setup = run_setup({}, stopwatch);
  setup.cycles = 0;
  const std::unique_ptr<hal::Clock> clock = link_->make_clock();
  if (!link_->start(*clock, requests.end)) return "";
  run_accompanied(setup, *clock, requests, companion);
  link_->stop();
  return describe_stop();
}

void Session::run_accompanied(const RunSetup& setup, hal::Clock& clock, RunRequests& requests, Companion& companion) {
  SimulatedArm& arm = *link_->simulated_arm();
  TelemetryRecord record;
  run_controller(setup, clock, *cycle_, requests, ring_, report_, [&] {
    while (ring_.pop(record)) {
      companion.after_cycle(record.times, record.cycle, report_.computed_ns, arm, *this);
    }
  });
}

Rendering Session::rendering() const noexcept {
  return {cycle_->solver(), cycle_->friction(), scene_.settings.stiffness, scene_.settings.damping};
}

bool Session::change(const Rendering& rendering) noexcept {
  const format::Settings before = scene_.settings;
  scene_.settings.stiffness = rendering.stiffness;
  scene_.settings.damping = rendering.damping;
  if (valid_gains(scene_.settings) && cycle_->start(rendering.solver, rendering.friction) == Status::kOk) return true;
  scene_.settings = before;
  return false;
}

}  // namespace godobject::firmware
