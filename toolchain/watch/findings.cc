#include "toolchain/watch/findings.h"

#include <algorithm>

namespace godobject::watch {

const char* describe(Property property) {
  switch (property) {
    case Property::kFinite: return "poses and forces that are not finite, or rotations not of unit length";
    case Property::kStatus: return "valid inputs refused, or invalid ones accepted";
    case Property::kSpring: return "spring wrenches that are not stiffness times stretch";
    case Property::kDamper: return "damping that adds power, or exceeds b_D times the velocity";
    case Property::kDamping: return "damped forces that are not the stated projection";
    case Property::kNoCrossing: return "contact: chords of points that meet the stored surface";
    case Property::kMesh: return "contact: points deeper in the mesh than the field's accuracy";
    case Property::kWorkspace: return "centres of mass outside of the workspace box";
    case Property::kNotFarther: return "contact: farther from the device than without motion";
    case Property::kNoPull: return "contact: spring wrenches that are no sum of pushes at touching points";
    case Property::kFriction: return "contact: friction of a wrong size or direction";
    case Property::kNoWork: return "contact: contact forces that drive the god object";
    case Property::kArrives: return "contact: not at the device although nothing is between";
    case Property::kOptimum: return "contact: farther from the device than another method ends";
    case Property::kLag: return "contact: behind the device for too many cycles";
    case Property::kReport: return "contact: untrue outcomes, counters or penetrations";
    case Property::kCount: break;
  }
  return "";
}

std::int64_t Findings::violations() const {
  std::int64_t sum = 0;
  for (const Tally& tally : tallies) sum += tally.violated;
  return sum;
}

std::string Findings::first() const {
  for (const Tally& tally : tallies) {
    if (tally.violated > 0) return tally.first;
  }
  return {};
}

void Findings::add(const Findings& other) {
  cycles += other.cycles;
  touching += other.touching;
  not_converged += other.not_converged;
  for (std::size_t i = 0; i < kPropertyCount; ++i) {
    tallies[i].judged += other.tallies[i].judged;
    tallies[i].violated += other.tallies[i].violated;
    tallies[i].worst = std::max(tallies[i].worst, other.tallies[i].worst);
    if (tallies[i].first.empty()) tallies[i].first = other.tallies[i].first;
  }
}

}  // namespace godobject::watch
