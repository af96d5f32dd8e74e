#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "godobject/pose.h"

namespace godobject::path {

/// Where the moving body is to be at a time, at rest.
struct Keyframe {
  double t = 0.0;                                ///< [s]
  Vector3 position = Vector3::Zero();            ///< of the pivot in W [m]
  Quaternion rotation = Quaternion::Identity();  ///< R_WM, M the moving mesh's frame
};

/// A sine laid over the path: a tremor, a rubbing motion; two of them a quarter period apart make a circle.
struct Oscillation {
  double from = 0.0;                      ///< [s]
  double to = 0.0;                        ///< [s]
  double frequency = 0.0;                 ///< [Hz]
  double phase = 0.0;                     ///< at `from` [rad]
  double fade = 0.0;                      ///< grows and shrinks within this at both ends [s]
  Vector3 translation = Vector3::Zero();  ///< amplitude of the pivot in W [m]
  Vector3 rotation = Vector3::Zero();     ///< amplitude as a rotation vector in W, about the pivot [rad]
};

/// A motion as a person writes it down.
struct Keyframes {
  Vector3 pivot = Vector3::Zero();  ///< the point of the moving mesh (scaled, frame M) that positions speak of [m]
  std::vector<Keyframe> keyframes;  ///< two or more, times ascending
  std::vector<Oscillation> oscillations;
};

/// Reads a TOML file: an optional `pivot`, two or more tables [[keyframe]], any number of [[oscillation]].
/// Throws Failure: kNoInput if it cannot be read, kBadData if it is not TOML, kBadConfig naming the key that is
/// unknown, missing or out of its range.
Keyframes read_keyframes(const std::filesystem::path& file);

/// The same from text; `name` is used in messages.
Keyframes parse_keyframes(std::string_view text, std::string_view name);

}  // namespace godobject::path
