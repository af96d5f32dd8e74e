#include "toolchain/page/page_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "toolchain/command_line/failure.h"
#include "toolchain/page/column_pack.h"
#include "toolchain/page/scene_header.h"
#include "toolchain/page/thinning.h"
#include "toolchain/viewer/camera.h"

namespace godobject::page {
namespace {

using command::ExitCode;
using command::Failure;
using figures::ReplayLog;
using figures::ReplayRow;
using nlohmann::json;

// Steps of the columns: far below what a plot or a picture shows.
constexpr double kTimeStep = 1e-6;      // [s]
constexpr double kPositionStep = 1e-7;  // [m]
constexpr double kRotationStep = 1e-6;  // of a component of a unit quaternion
constexpr double kForceStep = 1e-4;     // [N]
constexpr double kTorqueStep = 1e-6;    // [Nm]
constexpr double kDistanceStep = 1e-8;  // of depth and stretch [m]
constexpr double kDurationStep = 1e-8;  // [s]

/// Refuses replays of different motions. A row of `bad_input` may have any device pose.
void require_same_motion(const std::vector<NamedReplay>& replays) {
  constexpr double kSame = 1e-6;  // [m] and of a quaternion's components: a replay copies its path
  const NamedReplay& first = replays.front();
  for (const NamedReplay& other : replays) {
    const auto refuse = [&](const std::string& how) {
      throw Failure(ExitCode::kBadData,
                    fmt::format("{} and {}: are not replays of the same motion: {}; make a page for each", first.name,
                                other.name, how));
    };
    if (other.log.size() != first.log.size())
      refuse(fmt::format("{} and {} cycles", first.log.size(), other.log.size()));
    for (std::size_t i = 0; i < first.log.size(); ++i) {
      const ReplayRow &a = first.log[i], &b = other.log[i];
      if (std::abs(a.t - b.t) > kSame) refuse(fmt::format("the times of row {} are {} and {} s", i + 1, a.t, b.t));
      const double moved = (a.H_WD.translation - b.H_WD.translation).cwiseAbs().maxCoeff();
      const double turned = (a.H_WD.rotation.coeffs() - b.H_WD.rotation.coeffs()).cwiseAbs().maxCoeff();
      if (moved > kSame || turned > kSame) refuse(fmt::format("the device poses at {} s differ", a.t));
    }
  }
}

/// Writes the columns of a scene's replays.
class ReplayColumns {
 public:
  ReplayColumns(const std::vector<NamedReplay>& replays, const Vector3& p_M, ColumnPack& pack)
      : replays_(replays),
        p_M_(p_M),
        pack_(pack),
        device_(figures::device_poses(replays.front().log)),
        thinning_(device_.size()) {}

  /// Sets the keys of the header that belong to the replays.
  void write(json& header) {
    const ReplayLog& log = replays_.front().log;
    header["cycles"] = log.size();
    header["bucket"] = thinning_.bucket();
    header["t"] = selected([&](std::size_t i) { return log[i].t; }, kTimeStep);
    header["device"] = pose_columns([&](std::size_t i) -> const Pose& { return device_[i]; });
    for (const NamedReplay& replay : replays_) header["replays"].push_back(replay_entry(replay));
    header["statuses"] = statuses_;
  }

 private:
  using NumberOf = std::function<double(std::size_t)>;  ///< of a cycle

  std::vector<double> all(const NumberOf& number_of) const {
    std::vector<double> numbers(device_.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = number_of(i);
    return numbers;
  }

  json selected(const NumberOf& number_of, double step) { return pack_.add(thinning_.select(all(number_of)), step); }

  json pose_columns(const std::function<const Pose&(std::size_t)>& pose_of) {
    json columns = json::array();
    for (int axis = 0; axis < 3; ++axis)
      columns.push_back(selected([&](std::size_t i) { return pose_of(i).translation[axis]; }, kPositionStep));
    for (const int component : {3, 0, 1, 2})  // Eigen stores x, y, z, w
      columns.push_back(
          selected([&](std::size_t i) { return pose_of(i).rotation.coeffs()[component]; }, kRotationStep));
    return columns;
  }

  json replay_entry(const NamedReplay& replay) {
    const ReplayLog& log = replay.log;
    json entry{{"name", replay.name}};
    entry["pose"] = pose_columns([&](std::size_t i) -> const Pose& { return log[i].H_WS; });
    for (int axis = 0; axis < 3; ++axis) {
      entry["force"].push_back(selected([&](std::size_t i) { return log[i].wrench.force[axis]; }, kForceStep));
      entry["torque"].push_back(selected([&](std::size_t i) { return log[i].wrench.torque[axis]; }, kTorqueStep));
    }
    entry["status"] = selected([&](std::size_t i) { return static_cast<double>(status_number(log[i].status)); }, 1.0);
    plot(
        entry, "force", [&](std::size_t i) { return log[i].wrench.force.norm(); }, kForceStep);
    plot(
        entry, "torque", [&](std::size_t i) { return log[i].wrench.torque.norm(); }, kTorqueStep);
    plot(
        entry, "depth", [&](std::size_t i) { return log[i].depth; }, kDistanceStep);
    plot(
        entry, "stretch", [&](std::size_t i) { return (device_[i] * p_M_ - log[i].H_WS * p_M_).norm(); },
        kDistanceStep);
    plot(
        entry, "contacts", [&](std::size_t i) { return log[i].contacts; }, 1.0);
    plot(
        entry, "time", [&](std::size_t i) { return 1e-9 * (log[i].step1_ns + log[i].solve_ns); }, kDurationStep);
    return entry;
  }

  /// Adds a plotted quantity: its value at each sample, and if cycles are left out, the extremes of each bucket.
  void plot(json& entry, const char* name, const NumberOf& number_of, double step) {
    const std::vector<double> numbers = all(number_of);
    entry["plots"][name]["values"] = pack_.add(thinning_.select(numbers), step);
    if (thinning_.bucket() > 1) entry["plots"][name]["extremes"] = pack_.add(thinning_.extremes(numbers), step);
  }

  std::size_t status_number(const std::string& status) {
    const auto found = std::find(statuses_.begin(), statuses_.end(), status);
    const auto number = static_cast<std::size_t>(found - statuses_.begin());
    if (found == statuses_.end()) statuses_.push_back(status);
    return number;
  }

  const std::vector<NamedReplay>& replays_;
  const Vector3 p_M_;  ///< the moving body's centre of mass
  ColumnPack& pack_;
  const std::vector<Pose> device_;
  const Thinning thinning_;
  std::vector<std::string> statuses_;  ///< as they first appear
};

/// Returns the cycles of a log in which something holds the god object; all if there is none.
std::vector<std::size_t> held_cycles(const ReplayLog& log) {
  std::vector<std::size_t> held;
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < log.size(); ++i) {
    all.push_back(i);
    if (log[i].status != "free") held.push_back(i);
  }
  return held.empty() ? all : held;
}

/// Returns placements for the camera: first that of the largest force of the first replay, then some of each replay.
std::vector<viewer::Placement> shown_placements(const std::vector<NamedReplay>& replays) {
  constexpr std::size_t kOfEach = 12;
  const ReplayLog& first = replays.front().log;
  const std::vector<Pose> device = figures::device_poses(first);
  const auto weaker = [](const ReplayRow& a, const ReplayRow& b) {
    return a.wrench.force.squaredNorm() < b.wrench.force.squaredNorm();
  };
  const auto strongest = std::max_element(first.begin(), first.end(), weaker);
  std::vector<viewer::Placement> placements{
      {device[static_cast<std::size_t>(strongest - first.begin())], strongest->H_WS}};
  for (const NamedReplay& replay : replays) {
    const std::vector<std::size_t> cycles = held_cycles(replay.log);
    for (std::size_t k = 0; k < kOfEach; ++k) {
      const std::size_t i = cycles[k * cycles.size() / kOfEach];
      placements.push_back({device[i], replay.log[i].H_WS});
    }
  }
  return placements;
}

}  // namespace

std::string page_data(const PageScene& scene) {
  require_same_motion(scene.replays);
  ColumnPack pack;
  nlohmann::json header = scene_header(scene, shown_placements(scene.replays), pack);
  const auto& centre = header["moving"]["centre"];
  ReplayColumns(scene.replays, Vector3(centre[0], centre[1], centre[2]), pack).write(header);
  return packed(header, pack);
}

}  // namespace godobject::page
