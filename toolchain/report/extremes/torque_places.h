#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/pipeline/god_object.h"
#include "firmware/configuration/device_file.h"
#include "firmware/cycle/torque_limiter.h"
#include "godobject/pose.h"
#include "toolchain/files/scene_image.h"
#include "toolchain/report/study/case.h"

namespace godobject::report {

/// Where the field says nothing, or something else a little further on.
enum class Place : std::uint8_t {
  kStartInside,
  kStartDeep,    ///< inside, all of the body beyond the narrow band
  kDeep,         ///< pressed to there
  kOutsideGrid,  ///< to and fro
  kGridBorder,   ///< pressed, with half of the body outside
  kMedialAxis,   ///< of a plate of two voxels, and through it
};
extern const char* const kPlaceNames[];
extern const std::size_t kPlaceCount;

/// The scene of a place, compiled in `work`.
command::SceneImage place_scene(Place place, const std::filesystem::path& work);

/// A way to the place and back at less than 0.3 m/s: H_WM, a millisecond apart. Each seed gives another one.
std::vector<Pose> place_path(Place place, const Scene& scene, std::uint32_t seed);

/// What runs at a place have come to.
struct TorqueSteps {
  std::int64_t cycles = 0;
  std::int64_t there = 0;      ///< cycles in which the arm was where it was to be led
  std::int64_t rendered = 0;   ///< in which the controller rendered all
  std::int64_t idle_runs = 0;  ///< without one or the other, or that the controller stopped
  /// Largest change of a joint's torque from a cycle to the next, of the 5 % of its limit that it may change by.
  double sent = 0.0;          ///< by the controller
  double sent_at_once = 0.0;  ///< without its supervisor, from the second cycle on
  double computed = 0.0;      ///< the same before the torque limiter
  double force = 0.0;         ///< largest change of the solver's force, before any limit [N]

  void add(const TorqueSteps& other);
};

/// One run along a way. `used`: what the controller is given; it is judged by the 5 % whatever that is.
TorqueSteps torque_steps(Place place, const Scene& scene, const firmware::Device& device, Solver solver, bool friction,
                         const firmware::TorqueLimits& used, std::uint32_t seed);

/// All solvers, with friction and without, `cycles` or some more.
CaseResult torque_rate(Place place, const std::filesystem::path& device_file, std::int64_t cycles,
                       const std::filesystem::path& work);

}  // namespace godobject::report
