#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace godobject::watch {

/// A property that cycles must have. The comment tells in which cycles it is judged.
enum class Property : std::uint8_t {
  kFinite,      ///< all: pose and force are finite, the rotation is of unit length
  kStatus,      ///< all: a valid input is accepted; an invalid one is refused, without force
  kSpring,      ///< all: the spring wrench is the coupling's stretch times its stiffness, in W
  kDamper,      ///< all: the damping takes power from the device and is at most b_D times its velocity
  kDamping,     ///< one contact: its size; several between planes, without friction: what a projection may take off
  kNoCrossing,  ///< `contact`: no chord of any point, in any sub-step, meets the stored surface
  kMesh,        ///< `contact`, with a mesh: no point is deeper in it than the field's accuracy, nor jumps through it
  kWorkspace,   ///< with a box: the centre of mass stays in it
  kNotFarther,  ///< `contact`: not farther from the device than if it had stayed, or by the shortest way out
  kNoPull,      ///< `contact`: the spring wrench is a sum of pushes and friction at touching points
  kFriction,    ///< `contact`, one direction of touch: size and direction of friction are Coulomb's
  kNoWork,      ///< `contact`: the contact force does no work on the god object beyond pushing it out
  kArrives,     ///< `contact`: the god object is at the device if nothing is between them
  kOptimum,     ///< `contact` without friction: as near to the device as another method comes
  kLag,         ///< `contact`: the god object does not stay behind the device for long
  kReport,      ///< `contact`: outcome, counters and penetration of the report are true
  kCount
};
inline constexpr std::size_t kPropertyCount = static_cast<std::size_t>(Property::kCount);

/// Returns the property in words, as a sentence of a report. Never null.
const char* describe(Property property);

/// The results of one property in a run.
struct Tally {
  std::int64_t judged = 0;    ///< times that it was judged
  std::int64_t violated = 0;  ///< of them
  double worst = 0.0;         ///< largest value over its bound
  std::string first = {};     ///< the first violation in words
};

/// The results of a run.
struct Findings {
  std::int64_t cycles = 0;
  std::int64_t touching = 0;       ///< cycles in which a contact carried force
  std::int64_t not_converged = 0;  ///< times that the watch's own reference method did not converge
  std::array<Tally, kPropertyCount> tallies;

  Tally& operator[](Property property) { return tallies[static_cast<std::size_t>(property)]; }
  const Tally& operator[](Property property) const { return tallies[static_cast<std::size_t>(property)]; }
  std::int64_t violations() const;
  std::string first() const;  ///< the first violation of the first violated property; empty: none
  void add(const Findings& other);
};

}  // namespace godobject::watch
