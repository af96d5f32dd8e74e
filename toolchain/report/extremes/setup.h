#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "core/scene/format.h"
#include "godobject/scene.h"

namespace godobject::report {

/// Number of the generator below: what a seed means.
inline constexpr int kGenerator = 1;

/// One run of a solver, down to the last number, as a case file holds it. Lengths are multiples of `scale`.
struct Setup {
  std::string row = {};          ///< of the table of extremes
  std::string world = "plane";   ///< plane, slot, groove, bore, plate, heap, or compiled: box, ball, turned
  std::string body = "ball";     ///< ball, box, needle, flat, line, point
  std::string motion = "press";  ///< press, dash, jump, spin, rest
  std::uint32_t seed = 0;        ///< of world and motion
  int cycles = 500;
  format::Solver solver = format::Solver::kContact;
  bool friction = false;
  int points = 100;
  int bad_every = 0;    ///< cycles from one input that is no pose to the next; 0: none
  double scale = 0.02;  ///< size of the moving body [m]
  double far = 0.0;     ///< of the scene from the origin
  double width = 1.1;   ///< of slot, groove and bore, half
  double start = 2.0;   ///< height over z = 0 that the device starts at
  double depth = 0.5;   ///< that it presses
  double speed = 5.0;   ///< [1/s]
  double spin = 3.0;    ///< [rad/s]
  double voxel = 0.1;
  double stiffness = 2000.0;       ///< [N/m]
  double damping = 20.0;           ///< [Ns/m]
  double coupling_rotation = 0.4;  ///< k_VC,r over the square of the scale
  double friction_static = 0.2;
  double friction_kinetic = 0.18;

  double safety_distance() const { return 1.5 * voxel * scale; }
  double margin() const { return 0.01 * voxel * scale; }
};

/// Any setup; the same for the same numbers from `random`.
Setup any_setup(std::mt19937& random);

/// One of a row of the table. The rows that are families of setups:
extern const char* const kRows[];
extern const std::size_t kRowCount;
Setup setup_of(const std::string& row, std::mt19937& random);

/// JSON; `found` is what it violates.
std::string case_file(const Setup& setup, const std::string& found);

/// Throws std::exception where the text is no case file of this generator.
Setup read_case(const std::string& text);

}  // namespace godobject::report
