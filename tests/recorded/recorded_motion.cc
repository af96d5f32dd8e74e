#include "tests/recorded/recorded_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <random>
#include <sstream>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "godobject/pose.h"
#include "godobject/report.h"
#include "toolchain/report/extremes/compiled_world.h"
#include "toolchain/report/extremes/rig.h"
#include "toolchain/report/extremes/run.h"

namespace godobject::test {
namespace {

using report::Setup;

/// Weights of the axes, all different, so that a swap of two axes changes the sum.
const Vector3 kParts(0.9, -0.7, 0.5);
const Vector3 kPartsOfTorque(-0.4, 0.6, 0.8);

class Sums {
 public:
  explicit Sums(RecordedMotion& motion) : motion_(motion) {}

  void next_cycle() { weight_ = 1.5 + std::sin(0.7 * ++cycle_); }
  void add(RecordedMotion::Sum which, double value) {
    motion_.sum[which] += weight_ * value;
    motion_.size[which] += weight_ * std::abs(value);
  }

 private:
  RecordedMotion& motion_;
  int cycle_ = 0;
  double weight_ = 1.0;
};

/// Random worlds and parameters, and a motion that leads into contact.
void add_any(std::vector<RecordedSession>& sessions) {
  constexpr const char* kMotions[] = {"press", "spin", "press", "jump"};
  std::mt19937 random(20);
  for (int i = 0; i < 160;) {
    Setup setup = report::any_setup(random);
    if (setup.world == "compiled") continue;
    setup.motion = kMotions[i % 4];
    setup.cycles = 150;
    sessions.push_back({fmt::format("any-{:03}-{}", i++, setup.world), setup});
  }
}

/// The extreme families of the report; faces of many points with friction, which presses and turns.
void add_extremes(std::vector<RecordedSession>& sessions) {
  std::mt19937 random(21);
  for (std::size_t row = 0; row < report::kRowCount; ++row) {
    for (int i = 0; i < 8; ++i) {
      Setup setup = report::setup_of(report::kRows[row], random);
      if (setup.motion == "seek") setup.motion = i % 2 == 0 ? "press" : "spin";
      setup.cycles = std::min(setup.cycles, 100);
      setup.friction = i % 4 != 0;
      sessions.push_back({fmt::format("row-{}-{}-{}", row, i, setup.world), setup});
    }
  }
}

/// Sessions in worlds from the scene compiler, with edges, facets and a second direction.
void add_compiled(std::vector<RecordedSession>& sessions) {
  constexpr std::pair<const char*, const char*> kWorlds[] = {
      {"mesh-box", "ell"},   {"mesh-box", "box"},    {"mesh-turned", "box"},  {"mesh-cavity", "box"},
      {"mesh-plate", "ell"}, {"mesh-shell", "ball"}, {"mesh-ball", "center"}, {"mesh-box", "center"}};
  constexpr const char* kMotions[] = {"spin", "press", "jump", "dash"};
  std::mt19937 random(22);
  for (const auto& [world, body] : kWorlds) {
    Setup setup = report::any_setup(random);
    setup.solver = format::Solver::kContact;
    report::choose_mesh(setup);
    setup.world = world;
    setup.body = body;
    for (int i = 0; i < 8; ++i) {
      Setup session = report::any_session_in(setup, random);
      session.motion = kMotions[i % 4];
      session.cycles = 200;
      session.start = i == 3 ? -0.5 : 1.5;
      sessions.push_back({fmt::format("{}-{}-{}", world, body, i), session});
    }
  }
}

constexpr std::size_t kWorkColumn = 1 + 2 * RecordedMotion::kWork;
const std::string kNotRecorded = "-";

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream in(line);
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

}  // namespace

std::vector<RecordedSession> recorded_sessions() {
  std::vector<RecordedSession> sessions;
  add_any(sessions);
  add_extremes(sessions);
  add_compiled(sessions);
  return sessions;
}

std::unique_ptr<report::Rig> RecordedWorlds::rig(const Setup& setup) {
  if (!report::is_compiled(setup)) return report::make_rig(setup, work_);
  const auto decides = [](const Setup& s) {
    return std::tie(s.world, s.body, s.seed, s.scale, s.far, s.width, s.voxel, s.points, s.body_scale);
  };
  if (!world_ || decides(setup) != decides(world_of_)) {
    world_of_ = setup;
    // the same world whichever session is its first
    const Setup any;
    world_of_.stiffness = any.stiffness;
    world_of_.coupling_rotation = any.coupling_rotation;
    world_of_.friction_static = any.friction_static;
    world_of_.friction_kinetic = any.friction_kinetic;
    world_ = std::make_shared<report::CompiledWorld>(world_of_, work_);
  }
  return report::make_rig_in(world_, setup);
}

RecordedMotion RecordedWorlds::run(const Setup& setup, double disturbance) {
  const std::unique_ptr<report::Rig> made = rig(setup);
  RecordedMotion motion;
  Sums sums(motion);
  const Pose world = report::placement(setup);
  const double force = setup.stiffness * setup.scale;
  std::optional<Pose> before;
  int k = 0;
  for (Pose H_WD : report::device_path(setup)) {
    H_WD.translation[k % 3] += (k % 2 == 0 ? disturbance : -disturbance) * setup.scale;
    ++k;
    const Motion velocity_W = before ? report::velocity_between(*before, H_WD, setup.period) : Motion{};
    before = H_WD;
    CycleReport r;
    sums.next_cycle();
    if (made->update(H_WD, velocity_W, r) != Status::kOk) {
      ++motion.count[RecordedMotion::kRefused];
      continue;
    }
    sums.add(RecordedMotion::kPosition, kParts.dot(r.H_WS.translation - world.translation) / setup.scale);
    const Quaternion turn = H_WD.rotation.conjugate() * r.H_WS.rotation;
    sums.add(RecordedMotion::kRotation, kParts.dot(log_rotation(turn)));
    const auto parts = [&](const Vector3& f, const Vector3& t) {
      return (kParts.dot(f) + kPartsOfTorque.dot(t) / setup.scale) / force;
    };
    const Wrench& spring = r.force.spring_W;
    const Wrench& total = r.force.total_W;
    sums.add(RecordedMotion::kSpring, parts(spring.force, spring.torque));
    sums.add(RecordedMotion::kDamping, parts(total.force - spring.force, total.torque - spring.torque));
    sums.add(RecordedMotion::kDepth, r.penetration / setup.scale);
    sums.add(RecordedMotion::kWork, static_cast<double>(r.work));
    motion.count[RecordedMotion::kContacts] += r.contacts;
    motion.count[RecordedMotion::kSubsteps] += r.substeps;
    motion.count[RecordedMotion::kDropped] += r.dropped;
    motion.count[RecordedMotion::kUnconverged] += r.unconverged ? 1 : 0;
    motion.count[RecordedMotion::kOutOfWork] += r.out_of_work ? 1 : 0;
    ++motion.count[RecordedMotion::kFree + static_cast<std::size_t>(r.outcome)];
  }
  return motion;
}

std::string record_header() {
  std::string text = "session";
  for (const char* sum : RecordedMotion::kSumNames) text += fmt::format(",{0},{0}_size", sum);
  for (const char* count : RecordedMotion::kCountNames) text += fmt::format(",{}", count);
  for (int outcome = 0; outcome < RecordedMotion::kCounts - RecordedMotion::kFree; ++outcome) {
    text += fmt::format(",{}", name(static_cast<Outcome>(outcome)));
  }
  return text;
}

std::string record_line(const std::string& session, const RecordedMotion& motion) {
  std::string text = session;
  for (std::size_t i = 0; i < RecordedMotion::kSums; ++i) {
    text += fmt::format(",{:.9g},{:.3g}", motion.sum[i], motion.size[i]);
  }
  for (const std::int64_t count : motion.count) text += fmt::format(",{}", count);
  return text;
}

std::string without_work(const std::string& line) {
  const std::vector<std::string> words = words_of(line);
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k) {
    text += (k == 0 ? "" : ",") + (k == kWorkColumn || k == kWorkColumn + 1 ? kNotRecorded : words[k]);
  }
  return text;
}

std::string difference(const std::string& was, const std::string& is) {
  constexpr double kRounding = 1e-6;  // of the terms' sizes
  constexpr double kOfWork = 1e-4;    // the same of work: a comparison of the search may fall to either side
  constexpr double kNothing = 1e-9;   // of all sums
  const std::vector<std::string> header = words_of(record_header());
  const std::vector<std::string> before = words_of(was);
  const std::vector<std::string> now = words_of(is);
  if (before.size() != header.size() || now.size() != header.size()) return "number of columns";
  for (std::size_t k = 1; k < header.size(); ++k) {
    const bool is_sum = k < 1 + 2 * RecordedMotion::kSums;
    if (is_sum && k % 2 == 0) continue;  // a size
    if (before[k] == kNotRecorded) continue;
    const double share = k == kWorkColumn ? kOfWork : kRounding;
    const double allowed = is_sum ? share * std::strtod(now[k + 1].c_str(), nullptr) + kNothing : 0.0;
    const double change = std::strtod(now[k].c_str(), nullptr) - std::strtod(before[k].c_str(), nullptr);
    if (!(std::abs(change) <= allowed)) return fmt::format("{} was {}, is {}", header[k], before[k], now[k]);
  }
  return {};
}

}  // namespace godobject::test
