#include "toolchain/live/simulated_run.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include <fmt/format.h>

#include "firmware/configuration/gain_check.h"
#include "firmware/cycle/control_cycle.h"
#include "firmware/drives/drive_family.h"
#include "firmware/simulation/simulated_arm.h"
#include "hal/linux/monotonic_clock.h"

namespace godobject::live {
namespace {

using firmware::CycleRecord;
using firmware::Rendering;

constexpr std::size_t kMostSamples = 4000;  // that wait for the server; chosen: some seconds
// Limits of the hand, chosen: below the speeds at which the reference arms stop, and a pull of 24 N and 2.4 Nm of the
// simulated operator's springs.
constexpr HandMotion::Limits kHand{.speed = 0.5, .turn = 2.5, .stretch = 0.08, .twist = 0.8};

HandMotion::Limits hand_limits(double scale) {
  return {scale * kHand.speed, kHand.turn, scale * kHand.stretch, kHand.twist};
}

firmware::ControllerConfig of_simulation(firmware::ControllerConfig config, bool steered) {
  config.loop.real_time = false;
  config.telemetry = {};
  if (steered) config.simulation.path.clear();
  return config;
}

/// The strength of the hand, which fades before a joint comes to its limit: a stop there would end the play.
double strength_of(const ArmModel& arm, const CycleRecord& record) {
  constexpr double kFade = 0.2;       // [rad]
  constexpr double kLookAhead = 0.2;  // [s]
  const JointVector q = record.q + kLookAhead * record.qd;
  double least = kFade;
  for (int i = 0; i < arm.joint_count; ++i) {
    const ArmJoint& joint = arm.joints[static_cast<std::size_t>(i)];
    least = std::min({least, q[i] - joint.lower, joint.upper - q[i]});
  }
  return std::max(0.0, least / kFade);
}

std::string fault_text(const CycleRecord& record) {
  if (record.fault == firmware::Fault::kNone) return "";
  if (record.fault != firmware::Fault::kAlarm) return firmware::describe(record.fault);
  const std::string joint = record.alarm_joint >= 0 ? fmt::format("joint {}: ", record.alarm_joint + 1) : "";
  return joint + firmware::describe(record.alarm);
}

LiveSample sample_of(const firmware::CycleTimes& times, const CycleRecord& record, std::int64_t computed_ns) {
  LiveSample sample;
  sample.t = 1e-9 * static_cast<double>(times.deadline_ns);
  sample.mode = name(record.mode);
  sample.fault = fault_text(record);
  sample.fault_number = static_cast<int>(record.fault);
  sample.outcome = name(record.outcome);
  sample.share = record.share;
  sample.q = record.q;
  sample.qd = record.qd;
  sample.torque = record.torque;
  sample.H_WD = record.H_WM;
  sample.H_WS = record.god_object_W;
  sample.wrench_R = record.F_G_R;
  sample.depth = record.penetration;
  sample.contacts = record.contacts;
  sample.computed = 1e-9 * static_cast<double>(computed_ns);
  sample.late = 1e-9 * static_cast<double>(times.late_ns);
  sample.absorbed = record.absorbed;
  return sample;
}

}  // namespace

SimulatedRun::SimulatedRun(const firmware::ControllerConfig& config, bool steered)
    : config_(of_simulation(config, steered)),
      steered_(steered),
      image_(config_.scene.image),
      scene_(firmware::configured(image_.scene(), config_)),
      session_(std::make_unique<firmware::Session>(config_, firmware::kSimulatedTransport)),
      placement_(session_->placement()),
      delay_(session_->delay()) {
  const Rendering rendering = session_->rendering();
  settings_.solver = rendering.solver;
  settings_.friction = rendering.friction;
  settings_.stiffness = rendering.stiffness;
  settings_.damping = rendering.damping;
  settings_.boundary = boundary_of(rendering);
  settings_.has_friction = scene_.settings.friction != 0;
  for (const Solver solver : {Solver::kContact, Solver::kCorrected, Solver::kPaper}) {
    if (Scene::of(scene_).holds(solver)) settings_.solvers.push_back(solver);
  }
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

SimulatedRun::~SimulatedRun() {
  thread_.request_stop();
  requests_.end = true;
}

/// One run after the other: the next one begins when a page has asked for a reset, or when the path is over.
void SimulatedRun::run(const std::stop_token& stop) {
  try {
    while (!stop.stop_requested()) {
      const std::string stopped = session_->run(*this, requests_);
      if (stop.stop_requested()) return;
      if (!begin_again_) {
        const std::lock_guard lock(mutex_);
        failure_ = stopped.empty() ? "the run has ended" : stopped;
        return;
      }
      session_ = std::make_unique<firmware::Session>(config_, firmware::kSimulatedTransport);
      hand_.reset();
      wall_mark_ns_ = mark_ns_ = 0;
      begin_again_ = false;
      requests_.end = false;  // before the loop looks whether to stop: the destructor asks to stop and then to end
      const std::lock_guard lock(mutex_);
      wanted_ = {settings_.solver, settings_.friction, settings_.stiffness, settings_.damping};
    }
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    failure_ = error.what();
  }
}

void SimulatedRun::restart() {
  begin_again_ = true;
  requests_.end = true;
}

void SimulatedRun::after_cycle(const firmware::CycleTimes& times, const CycleRecord& record, std::int64_t computed_ns,
                               firmware::SimulatedArm& arm, firmware::Session& session) {
  keep(sample_of(times, record, computed_ns));
  std::optional<Rendering> wanted;
  {
    const std::lock_guard lock(mutex_);
    wanted.swap(wanted_);
  }
  if (wanted && !session.change(*wanted)) take_back(session.rendering());
  if (steered_) move_hand(record, arm);
  const double path_end = config_.simulation.begin + arm.path_seconds() + 0.5;
  if (!config_.simulation.path.empty() && 1e-9 * static_cast<double>(arm.now_ns()) > path_end) restart();
  keep_to_real_time(arm.now_ns(), record.mode <= firmware::Mode::kEngaging);
}

/// Shows what the run renders after it could not be changed: this build leaves out what was asked for.
void SimulatedRun::take_back(const Rendering& rendering) {
  const std::lock_guard lock(mutex_);
  settings_.solver = rendering.solver;
  settings_.friction = rendering.friction;
  settings_.stiffness = rendering.stiffness;
  settings_.damping = rendering.damping;
}

void SimulatedRun::keep(LiveSample sample) {
  const std::lock_guard lock(mutex_);
  if (samples_.size() < kMostSamples) {
    samples_.push_back(std::move(sample));
  } else {
    lost_.fetch_add(1, std::memory_order_relaxed);
  }
}

/// The hand waits at the first pose until a page asks for another one.
void SimulatedRun::move_hand(const CycleRecord& record, firmware::SimulatedArm& arm) {
  const bool may_move = record.mode == firmware::Mode::kRunning || record.mode == firmware::Mode::kEngaging;
  if (!may_move) {
    hand_.reset();
    const std::lock_guard lock(mutex_);
    goal_.reset();
    return;
  }
  if (!hand_) hand_.emplace(hand_limits(placement_.mapping.scale), record.H_WM);
  {
    const std::lock_guard lock(mutex_);
    if (goal_) hand_->set_goal(*goal_);
  }
  const double strength = strength_of(placement_.device.model, record);
  hand_->advance(config_.device.bus.period, record.H_WM, strength);
  const Motion& velocity = hand_->velocity();
  arm.steer_hand(hand_->pose(), {strength * velocity.translation, strength * velocity.rotation});
}

/// Waits until the machine's clock has come to the run's time. At its start a run is as fast as it can be. One that the
/// machine cannot keep up with is slow, and catches up a moment at most.
void SimulatedRun::keep_to_real_time(std::int64_t now_ns, bool starts) {
  constexpr std::int64_t kMeasured_ns = 500'000'000;
  constexpr std::int64_t kMoment_ns = 50'000'000;
  constexpr std::int64_t kLongestStart_ns = 10'000'000'000;
  hal::MonotonicClock clock;
  const std::int64_t wall_ns = clock.now_ns();
  const bool behind = wall_ns - wall_ahead_ns_ > now_ns + kMoment_ns;
  const bool hurries = starts && now_ns < kLongestStart_ns;
  if (hurries || behind) wall_ahead_ns_ = wall_ns - now_ns;
  clock.sleep_until(now_ns + wall_ahead_ns_);
  if (wall_ns - wall_mark_ns_ > kMeasured_ns) {
    if (wall_mark_ns_ > 0)
      speed_ = static_cast<double>(now_ns - mark_ns_) / static_cast<double>(wall_ns - wall_mark_ns_);
    wall_mark_ns_ = wall_ns;
    mark_ns_ = now_ns;
  }
}

void SimulatedRun::take(std::vector<LiveSample>& samples) {
  const std::lock_guard lock(mutex_);
  samples.insert(samples.end(), samples_.begin(), samples_.end());
  samples_.clear();
}

std::optional<LiveSettings> SimulatedRun::settings() const {
  const std::lock_guard lock(mutex_);
  return settings_;
}

std::string SimulatedRun::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

double SimulatedRun::boundary_of(const Rendering& rendering) const {
  SceneView scene = scene_;
  scene.settings.stiffness = rendering.stiffness;
  scene.settings.damping = rendering.damping;
  const firmware::GainReport report =
      firmware::check_gains(scene, placement_.device.model, config_.workspace.posture, config_.workspace.scale,
                            {config_.device.bus.period, delay_, config_.loop.velocity_window});
  return report.margin / config_.gains.margin * rendering.stiffness;
}

std::string SimulatedRun::answer(const Request& request) {
  if (!steered_) return "this page only looks; start godobject-live with --hand";
  if (const auto* change_request = std::get_if<ChangeRequest>(&request)) return change(*change_request);
  if (const auto* hand = std::get_if<HandRequest>(&request)) {
    const std::lock_guard lock(mutex_);
    goal_ = hand->H_WM;
  }
  if (std::holds_alternative<ResetRequest>(request)) restart();
  return "";
}

std::string SimulatedRun::change(const ChangeRequest& request) {
  const LiveSettings now = *settings();
  LiveSettings next = now;
  next.solver = request.solver.value_or(now.solver);
  next.friction = request.friction.value_or(now.friction);
  next.stiffness = request.stiffness.value_or(now.stiffness);
  next.damping = request.damping.value_or(now.damping);
  if (std::find(now.solvers.begin(), now.solvers.end(), next.solver) == now.solvers.end()) {
    return "the scene image was compiled without this solver";
  }
  if (next.friction && !now.has_friction) return "the scene image was compiled without friction";
  const Rendering rendering{next.solver, next.friction, next.stiffness, next.damping};
  SceneView scene = scene_;
  scene.settings.stiffness = next.stiffness;
  scene.settings.damping = next.damping;
  if (!valid_gains(scene.settings)) return "the gains are out of range: stiffness above 0, damping 0 or more";
  if (next.stiffness != now.stiffness || next.damping != now.damping) next.boundary = boundary_of(rendering);
  next.beyond = next.stiffness > next.boundary;
  if (next.beyond && !request.beyond && next.boundary < 0.01 * next.stiffness) {
    return fmt::format("hardly any stiffness is stable on this arm with a damping of {:.3g} Ns/m; lower the damping",
                       next.damping);
  }
  if (next.beyond && !request.beyond) {
    return fmt::format(
        "{:.4g} N/m with {:.3g} Ns/m is beyond the stability boundary of this arm: at most {:.4g} N/m, which includes "
        "the factor gains.margin = {:g}",
        next.stiffness, next.damping, next.boundary, config_.gains.margin);
  }
  const std::lock_guard lock(mutex_);
  settings_ = next;
  wanted_ = rendering;
  return "";
}

}  // namespace godobject::live
