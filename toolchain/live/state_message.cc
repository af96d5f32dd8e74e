#include "toolchain/live/state_message.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/device/kinematics.h"
#include "toolchain/live/contact_points.h"

namespace godobject::live {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 8> kPlotNames = {"force",    "torque", "depth", "stretch",
                                                   "contacts", "time",   "late",  "energy"};

/// A number with the digits that a picture needs, so that a message is short. `steps` in 1.
json rounded(double value, double steps) {
  return std::isfinite(value) ? json(std::round(value * steps) / steps) : json();
}

json array_of(const Vector3& v, double steps) {
  return {rounded(v.x(), steps), rounded(v.y(), steps), rounded(v.z(), steps)};
}

json array_of(const Pose& pose) {
  json array = array_of(pose.translation, 1e7);
  const Quaternion& q = pose.rotation;
  for (const double component : {q.w(), q.x(), q.y(), q.z()}) array.push_back(rounded(component, 1e6));
  return array;
}

const char* name(Solver solver) {
  switch (solver) {
    case Solver::kPaper: return "paper";
    case Solver::kCorrected: return "corrected";
    case Solver::kContact: return "contact";
  }
  return "";
}

json settings_entry(const std::optional<LiveSettings>& settings) {
  if (!settings) return nullptr;
  json solvers = json::array();
  for (const Solver solver : settings->solvers) solvers.push_back(name(solver));
  return {{"solver", name(settings->solver)},
          {"friction", settings->friction},
          {"stiffness", settings->stiffness},
          {"damping", settings->damping},
          {"boundary", settings->boundary},
          {"beyond", settings->beyond},
          {"solvers", solvers},
          {"has_friction", settings->has_friction}};
}

json points_entry(const SceneView& scene, const LiveSample& sample, const Wrench& wrench_W) {
  json entry = json::array();
  const bool touches = sample.contacts > 0.0 && sample.H_WS.is_finite();
  if (!touches) return entry;
  for (const ContactPoint& point : contact_points(scene, sample.H_WS * scene.H_MB, wrench_W)) {
    json values = array_of(point.p_W, 1e6);
    values.insert(values.end(), {rounded(point.normal_W.x(), 1e3), rounded(point.normal_W.y(), 1e3),
                                 rounded(point.normal_W.z(), 1e3), rounded(point.load, 1e3)});
    entry.push_back(values);
  }
  return entry;
}

}  // namespace

Wrench wrench_in_scene(const LiveSample& sample, const firmware::Placement* placement) {
  const Quaternion R_WR = placement != nullptr ? placement->mapping.H_WR.rotation : Quaternion::Identity();
  return {R_WR._transformVector(sample.wrench_R.force), R_WR._transformVector(sample.wrench_R.torque)};
}

std::vector<Vector3> arm_points(const LiveSample& sample, const firmware::Placement& placement, const Vector3& p_MB) {
  const ArmKinematics arm = forward_kinematics(placement.device.model, sample.q);
  const double scale = placement.mapping.scale;
  const Vector3 p_RG = arm.H_RM * Vector3(p_MB / scale);
  const Vector3 p_WG = sample.H_WD * p_MB;
  // relative to the grip, because the clutch may have moved the room in the scene, and turned the mesh about the grip
  const auto in_scene = [&](const Vector3& p_R) -> Vector3 {
    return p_WG + scale * placement.mapping.H_WR.rotation._transformVector(p_R - p_RG);
  };
  std::vector<Vector3> points;
  for (int i = 0; i < arm.joint_count; ++i) {
    points.push_back(in_scene(arm.H_RL[static_cast<std::size_t>(i)].translation));
  }
  points.push_back(p_WG);
  return points;
}

StateMessage::StateMessage(const SceneView& scene, const firmware::Placement* placement)
    : scene_(scene), placement_(placement) {}

void StateMessage::add(const LiveSample& sample) {
  const Vector3 p_MB = scene_.H_MB.translation;
  const double stretch = (sample.H_WD * p_MB - sample.H_WS * p_MB).norm();
  const std::array<double, kPlots> values = {sample.wrench_R.force.norm(),
                                             sample.wrench_R.torque.norm(),
                                             sample.depth,
                                             stretch,
                                             sample.contacts,
                                             sample.computed,
                                             sample.late,
                                             sample.absorbed};
  for (std::size_t i = 0; i < kPlots; ++i) {
    Range& range = plots_[i];
    range = fresh_ ? Range{values[i], values[i], values[i]}
                   : Range{values[i], std::min(range.low, values[i]), std::max(range.high, values[i])};
  }
  fresh_ = false;
  last_ = sample;
  ++cycles_;
}

std::string StateMessage::text(const std::optional<LiveSettings>& settings, double speed, std::uint64_t lost) {
  if (!last_) return "";
  const LiveSample& sample = *last_;
  const Wrench wrench_W = wrench_in_scene(sample, placement_);
  json message{{"type", "state"},
               {"t", rounded(sample.t, 1e6)},
               {"speed", rounded(speed, 1e3)},
               {"mode", sample.mode},
               {"fault", sample.fault},
               {"outcome", sample.outcome},
               {"share", rounded(sample.share, 1e4)},
               {"device", array_of(sample.H_WD)},
               {"god", array_of(sample.H_WS)},
               {"force", array_of(wrench_W.force, 1e4)},
               {"torque", array_of(wrench_W.torque, 1e6)},
               {"points", points_entry(scene_, sample, wrench_W)},
               {"arm", json::array()},
               {"settings", settings_entry(settings)},
               {"cycles", cycles_},
               {"lost", lost}};
  if (placement_ != nullptr) {
    for (const Vector3& point : arm_points(sample, *placement_, scene_.H_MB.translation))
      message["arm"].push_back(array_of(point, 1e5));
  }
  for (std::size_t i = 0; i < kPlots; ++i) {
    Range& range = plots_[i];
    if (fresh_) range.low = range.high = range.last;
    message["plots"][kPlotNames[i]] = {rounded(range.last, 1e9), rounded(range.low, 1e9), rounded(range.high, 1e9)};
  }
  fresh_ = true;
  std::string text = message.dump(-1, ' ', true, json::error_handler_t::replace);
  text.pop_back();
  return text;
}

}  // namespace godobject::live
