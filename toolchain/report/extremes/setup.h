#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "core/scene/format.h"
#include "godobject/scene.h"

namespace godobject::report {

/// Number of the generator below; with another number a seed gives other setups.
inline constexpr int kGenerator = 6;

/// One run of a solver with all numbers, as in a case file. Lengths are multiples of `scale`.
struct Setup {
  std::string row = {};  ///< row of the table of extremes
  /// plane, slot, groove, bore, plate, heap, or compiled: mesh-box, -ball, -turned, -plate, -cavity, -shell
  std::string world = "plane";
  std::string body = "ball";  ///< ball, box, needle, flat, line, point, ell; of compiled worlds ball, box, ell, center
  std::string motion = "press";  ///< press, dash, jump, spin, rest; seek: a closed loop that stays in contact
  std::uint32_t seed = 0;        ///< of world and motion
  int cycles = 500;
  format::Solver solver = format::Solver::kContact;
  bool friction = false;
  int points = 100;
  int bad_every = 0;    ///< cycles from one invalid pose to the next; 0: none
  double scale = 0.02;  ///< size of the moving body [m]
  double far = 0.0;     ///< distance of the scene from the origin
  double width = 1.1;   ///< half width of slot, groove and bore
  double start = 2.0;   ///< start height of the device over z = 0
  double aside = 0.0;   ///< seek: distance of the first pose from the middle of a narrow world, and its turn [rad]
  double depth = 0.5;   ///< depth of the press
  double speed = 5.0;   ///< [1/s]
  double spin = 3.0;    ///< [rad/s]
  double voxel = 0.1;
  double stiffness = 2000.0;       ///< [N/m]
  double damping = 20.0;           ///< [Ns/m]
  double coupling_rotation = 0.4;  ///< k_VC,r over the square of the scale
  double friction_static = 0.2;
  double friction_kinetic = 0.18;
  double friction_viscous = 0.0;  ///< [Ns/m]
  double body_scale = 1.0;        ///< size of the moving body over `scale`
  double workspace = 0.0;         ///< half edge of the box around the start of contact; 0: none
  double period = 1e-3;           ///< [s]
  int point_budget = 0;           ///< 0: none
  double work_budget = 0.0;       ///< of a cycle, as Parameters::work_budget [units]; 0: none
  bool remembers = true;          ///< with the memory of the search
  std::uint32_t session = 0;      ///< number of the motion; a compiled world holds many sessions
  bool returns = true;            ///< seek: leads back a device that has lost the still body, or is stuck inside

  double safety_distance() const { return 1.5 * voxel * scale; }
  double margin() const { return 0.01 * voxel * scale; }
};

/// Returns a random setup, the same for the same numbers from `random`.
Setup any_setup(std::mt19937& random);

/// The rows of the table that are families of setups; setup_of returns a setup of one of them.
extern const char* const kRows[];
extern const std::size_t kRowCount;
Setup setup_of(const std::string& row, std::mt19937& random);

/// Chooses a world from the scene compiler for a setup, and a body for it.
void choose_mesh(Setup& setup);

/// Returns a random session in the compiled world of a setup.
Setup any_session_in(const Setup& world, std::mt19937& random);

/// Returns the case file of a setup as JSON; `found` is its violation.
std::string case_file(const Setup& setup, const std::string& found);

/// Reads a case file. Throws std::exception if the text is not a case file of this generator.
Setup read_case(const std::string& text);

}  // namespace godobject::report
