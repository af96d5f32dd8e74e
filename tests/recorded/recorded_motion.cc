#include "tests/recorded/recorded_motion.h"

#include <cmath>
#include <memory>
#include <random>

#include <fmt/format.h>

#include "godobject/pose.h"
#include "godobject/report.h"
#include "toolchain/report/extremes/rig.h"
#include "toolchain/report/extremes/run.h"

namespace godobject::test {
namespace {

using report::Setup;

constexpr int kAnalytic = 160;
constexpr int kCompiled = 4;

/// Parts of no direction alike, so that two axes that change places change the sum.
const Vector3 kParts(0.9, -0.7, 0.5);

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

}  // namespace

std::vector<RecordedSession> recorded_sessions() {
  constexpr const char* kMotions[] = {"press", "spin", "press", "jump"};
  constexpr const char* kMeshWorlds[] = {"mesh-box", "mesh-turned", "mesh-cavity", "mesh-ball"};
  constexpr const char* kMeshBodies[] = {"ell", "box", "box", "center"};
  std::vector<RecordedSession> sessions;
  std::mt19937 random(20);
  while (sessions.size() < kAnalytic) {
    Setup setup = report::any_setup(random);
    if (setup.world == "compiled") continue;
    setup.motion = kMotions[sessions.size() % 4];
    setup.cycles = 150;
    sessions.push_back({fmt::format("{}-{:03}", setup.world, sessions.size()), setup});
  }
  for (std::size_t i = 0; i < kCompiled; ++i) {
    Setup setup = report::any_setup(random);
    setup.solver = format::Solver::kContact;
    report::choose_mesh(setup);
    setup.world = kMeshWorlds[i];
    setup.body = kMeshBodies[i];
    setup.motion = "spin";
    setup.start = 1.5;
    setup.cycles = 500;
    sessions.push_back({setup.world, setup});
  }
  return sessions;
}

RecordedMotion run_recorded(const Setup& setup, const std::filesystem::path& work) {
  const std::unique_ptr<report::Rig> rig = report::make_rig(setup, work);
  RecordedMotion motion;
  Sums sums(motion);
  const Pose world = report::placement(setup);
  const double force = setup.stiffness * setup.scale;
  Pose before;
  bool has_before = false;
  for (const Pose& H_WD : report::device_path(setup)) {
    Motion velocity_W;
    if (has_before) {
      velocity_W = {
          (H_WD.translation - before.translation) / setup.period,
          H_WD.rotation._transformVector(log_rotation(before.rotation.conjugate() * H_WD.rotation)) / setup.period};
    }
    before = H_WD;
    has_before = true;
    CycleReport r;
    sums.next_cycle();
    if (rig->update(H_WD, velocity_W, r) != Status::kOk) {
      ++motion.count[RecordedMotion::kRefused];
      continue;
    }
    sums.add(RecordedMotion::kPosition, kParts.dot(r.H_WS.translation - world.translation) / setup.scale);
    const Quaternion turn = H_WD.rotation.conjugate() * r.H_WS.rotation;
    sums.add(RecordedMotion::kRotation, kParts.dot(log_rotation(turn)));
    const Wrench& spring = r.force.spring_W;
    const Wrench& total = r.force.total_W;
    sums.add(RecordedMotion::kSpring, kParts.dot(spring.force + spring.torque / setup.scale) / force);
    sums.add(RecordedMotion::kDamping,
             kParts.dot(total.force - spring.force + (total.torque - spring.torque) / setup.scale) / force);
    sums.add(RecordedMotion::kDepth, r.penetration / setup.scale);
    motion.count[RecordedMotion::kContacts] += r.contacts;
    motion.count[RecordedMotion::kSubsteps] += r.substeps;
    motion.count[RecordedMotion::kDropped] += r.dropped;
    motion.count[RecordedMotion::kUnconverged] += r.unconverged ? 1 : 0;
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

}  // namespace godobject::test
