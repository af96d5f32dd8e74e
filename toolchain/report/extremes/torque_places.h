#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "firmware/configuration/device_file.h"
#include "godobject/god_object.h"
#include "godobject/pose.h"
#include "toolchain/files/scene_image.h"
#include "toolchain/report/extremes/rows.h"
#include "toolchain/report/study/case.h"

namespace godobject::report {

/// Places where the field has no information, or jumps.
enum class Place : std::uint8_t {
  kStartInside,
  kStartDeep,    ///< inside, all of the body beyond the narrow band
  kDeep,         ///< pressed beyond the narrow band
  kOutsideGrid,  ///< out and back
  kGridBorder,   ///< pressed, with half of the body outside
  kMedialAxis,   ///< of a plate of two voxels, and through it
};
extern const char* const kPlaceNames[];
extern const std::size_t kPlaceCount;

/// Compiles the scene of a place in `work`.
files::SceneImage place_scene(Place place, const std::filesystem::path& work);

/// Returns a path to the place and back at less than 0.3 m/s: H_WM, one pose per millisecond. It depends on the seed.
std::vector<Pose> place_path(Place place, const SceneView& scene, std::uint32_t seed);

/// Results of runs at a place.
struct TorqueSteps {
  std::int64_t cycles = 0;
  std::int64_t there = 0;      ///< cycles in which the arm was at the place
  std::int64_t rendered = 0;   ///< cycles in which the controller rendered fully
  std::int64_t idle_runs = 0;  ///< runs without one of these, or that the controller stopped
  /// Largest change of a joint's torque from a cycle to the next, over the allowed 5 % of its limit.
  double sent = 0.0;          ///< by the controller
  double sent_at_once = 0.0;  ///< without its supervisor, from the second cycle on
  double computed = 0.0;      ///< without its supervisor, before the torque limiter
  double force = 0.0;         ///< largest change of the solver's force, before any limit [N]

  void add(const TorqueSteps& other);
};

/// Runs one path. The judgement always uses 5 %, whatever limits the controller has by a planted fault.
TorqueSteps torque_steps(Place place, const SceneView& scene, const firmware::Device& device, Solver solver,
                         bool friction, const ExtremesFault& fault, std::uint32_t seed);

/// Runs all solvers, with and without friction, for `cycles` or a little more.
CaseResult torque_rate(Place place, const std::filesystem::path& device_file, std::int64_t cycles,
                       const RowRequest& request, const std::filesystem::path& work);

}  // namespace godobject::report
