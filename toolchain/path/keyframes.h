#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "godobject/pose.h"

namespace godobject::path {

/// A place of rest of the moving body at a time.
struct Keyframe {
  double t = 0.0;                                ///< [s]
  Vector3 position = Vector3::Zero();            ///< of the pivot in W [m]
  Quaternion rotation = Quaternion::Identity();  ///< R_WM, M the moving mesh's frame
};

/// A sine added to the path: a tremor or a rubbing motion. Two of them, a quarter period apart, make a circle.
struct Oscillation {
  double from = 0.0;                      ///< [s]
  double to = 0.0;                        ///< [s]
  double frequency = 0.0;                 ///< [Hz]
  double phase = 0.0;                     ///< at `from` [rad]
  double fade = 0.0;                      ///< time of growth and decay at both ends [s]
  Vector3 translation = Vector3::Zero();  ///< amplitude of the pivot in W [m]
  Vector3 rotation = Vector3::Zero();     ///< amplitude as a rotation vector in W, about the pivot [rad]
};

/// A motion as a person describes it.
struct Keyframes {
  double period = 1e-3;             ///< time between two poses of the sampled motion [s]
  Vector3 pivot = Vector3::Zero();  ///< point of the moving mesh (scaled, frame M) to which positions refer [m]
  std::vector<Keyframe> keyframes;  ///< at least two, times ascending
  std::vector<Oscillation> oscillations;
};

/// Reads a TOML file: an optional `period` and `pivot`, at least two tables [[keyframe]], any number of
/// [[oscillation]]. Throws Failure: kNoInput if it cannot be read, kBadConfig if it is not TOML or naming a key that is
/// unknown, missing or out of range.
Keyframes read_keyframes(const std::filesystem::path& file);

/// The same from text. `name` stands for the file in messages.
Keyframes parse_keyframes(std::string_view text, std::string_view name);

}  // namespace godobject::path
