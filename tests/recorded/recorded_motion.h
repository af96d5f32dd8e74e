#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "godobject/report.h"
#include "toolchain/report/extremes/rig.h"
#include "toolchain/report/extremes/setup.h"

namespace godobject::test {

/// The cycles of a session as a few numbers. The sums weigh each cycle differently, and each direction
/// of space, so that a change of any cycle, direction or frame by more than rounding changes them.
struct RecordedMotion {
  enum Sum : std::uint8_t {
    kPosition,  ///< of the god object from the world's place, over the scale
    kRotation,  ///< of the god object from the device, as a rotation vector
    kSpring,    ///< force and torque, over stiffness and scale
    kDamping,   ///< the same of the part that damps
    kDepth,     ///< CycleReport::penetration over the scale
    kWork,      ///< CycleReport::work [units]
    kSums
  };
  enum Count : std::uint8_t {
    kRefused,
    kContacts,
    kSubsteps,
    kDropped,
    kUnconverged,
    kOutOfWork,
    kFree,
    kCounts = kFree + 7
  };
  static_assert(static_cast<int>(Outcome::kInfeasible) + 1 == kCounts - kFree);
  static constexpr std::array<const char*, kSums> kSumNames = {"position", "rotation", "spring",
                                                               "damping",  "depth",    "work"};
  static constexpr std::array<const char*, kFree> kCountNames = {"refused", "contacts",    "substeps",
                                                                 "dropped", "unconverged", "out_of_work"};

  std::array<double, kSums> sum{};
  std::array<double, kSums> size{};           ///< sum of the terms' sizes: what rounding is relative to
  std::array<std::int64_t, kCounts> count{};  ///< over the cycles; from kFree on the cycles of each Outcome
};

/// A session that is recorded.
struct RecordedSession {
  std::string name;
  report::Setup setup;
};

/// Random worlds, bodies and parameters, and motions that do not depend on the answers. Those that are recorded are
/// among them: sessions whose line stays the same if a disturbance far below any encoder's step moves the device.
std::vector<RecordedSession> recorded_sessions();

/// Runs sessions; keeps the last world that the scene compiler made for the next session in it.
class RecordedWorlds {
 public:
  /// `work`: a folder for scene images.
  explicit RecordedWorlds(std::filesystem::path work) : work_(std::move(work)) {}

  /// `disturbance`: moves the device back and forth by this share of the scale.
  RecordedMotion run(const report::Setup& setup, double disturbance = 0.0);

 private:
  std::unique_ptr<report::Rig> rig(const report::Setup& setup);

  std::filesystem::path work_;
  std::shared_ptr<const report::CompiledWorld> world_;
  report::Setup world_of_;
};

/// The lines of recorded_motions.csv, without their ends.
std::string record_header();
std::string record_line(const std::string& session, const RecordedMotion& motion);

/// Returns a line without its work, which `difference` then does not compare.
std::string without_work(const std::string& line);

/// Returns the first column in which two lines differ by more than rounding may explain, with both values. Nothing if
/// there is none.
std::string difference(const std::string& was, const std::string& is);

}  // namespace godobject::test
