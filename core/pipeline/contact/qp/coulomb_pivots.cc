#include "core/pipeline/contact/qp/coulomb_pivots.h"

#include <algorithm>
#include <cmath>

namespace godobject::detail {
namespace {

constexpr double kHalfRootThree = 0.8660254037844386;
constexpr double kKnown = 0.1;  // share of the load above which the friction force has a direction
constexpr int kReversals = 2;

/// The half spaces of one contact and their force, load (normal - ratio pull / load).
struct ContactLoad {
  std::array<int, ActiveSet::kCapacity> half_space{};  ///< numbers in the active set
  std::size_t count = 0;
  double load = 0.0;               ///< sum of the multipliers [m]
  Vector3 pull = Vector3::Zero();  ///< sum of multiplier times direction of slip [m]
};

/// Returns the load of a contact.
ContactLoad load_on(const ActiveSet& active, int contact) noexcept {
  ContactLoad carried;
  for (int j = 0; j < active.size(); ++j) {
    if (active[j].tag.contact != contact) continue;
    carried.half_space[carried.count++] = j;
    carried.load += active[j].multiplier;
    carried.pull += active[j].multiplier * active[j].tag.slip;
  }
  return carried;
}

/// Erases the contact's half spaces from number `first` on.
void erase_from(std::size_t first, const ContactLoad& carried, ActiveSet& active) noexcept {
  for (std::size_t i = carried.count; i-- > first;) active.erase(carried.half_space[i]);
}

/// Makes a slipping contact stick by three half spaces, with the same force. False: there is no room.
bool hold(int contact, ContactSet& set) noexcept {
  ActiveSet& active = set.active();
  if (active.size() + 2 > ActiveSet::kCapacity) return false;
  int at = 0;
  while (active[at].tag.contact != contact) ++at;
  Contact& c = set.contact(contact);
  const Vector3 along = active[at].tag.slip;
  const Vector3 across = c.normal.cross(along);
  const double load = active[at].multiplier;
  c.slips = false;
  c.is_held = true;
  c.reversals = 0;
  c.ratio = set.ratio_of(c);
  active.at(at) = set.cone_half_space(contact, along);
  active.at(at).multiplier = load;
  active.guess(set.cone_half_space(contact, -0.5 * along + kHalfRootThree * across));
  active.guess(set.cone_half_space(contact, -0.5 * along - kHalfRootThree * across));
  return true;
}

/// Updates a contact that three half spaces hold. If its force lies in the cone, it is split into three pushes around
/// it. True: the force lies outside, and the contact begins to slip or, if it would pull, loses its half spaces.
bool release(int contact, ContactSet& set) noexcept {
  constexpr std::size_t kHolding = 3;
  constexpr std::array<double, kHolding> kCosine = {1.0, -0.5, -0.5};
  constexpr std::array<double, kHolding> kSine = {0.0, kHalfRootThree, -kHalfRootThree};
  ActiveSet& active = set.active();
  Contact& c = set.contact(contact);
  const ContactLoad carried = load_on(active, contact);
  if (carried.count != kHolding) return false;
  if (!(carried.load > 0.0)) {
    erase_from(0, carried, active);
    return true;
  }
  const double length = carried.pull.norm();
  // rounding has no direction
  const Vector3 along =
      length > 1e-9 * carried.load ? Vector3(carried.pull / length) : Vector3(active[carried.half_space[0]].tag.slip);
  if (length > carried.load) {
    erase_from(1, carried, active);
    c.slips = true;
    c.is_held = false;
    c.speed = set.metric().still;
    c.ratio = set.friction()->kinetic_ratio;
    active.at(carried.half_space[0]).tag.slip = along;
    active.at(carried.half_space[0]).multiplier = carried.load;
    return true;
  }
  const Vector3 across = c.normal.cross(along);
  const double share = length / carried.load;
  for (std::size_t i = 0; i < kHolding; ++i) {
    ActiveSet::Inequality& half_space = active.at(carried.half_space[i]);
    half_space.tag.slip = kCosine[i] * along + kSine[i] * across;
    half_space.multiplier = carried.load * (i == 0 ? 1.0 + 2.0 * share : 1.0 - share) / 3.0;
  }
  return false;
}

}  // namespace

void begin_to_slip(const Motion& m, ContactSet& set) noexcept {
  ActiveSet& active = set.active();
  for (int k = 0; k < set.contact_count(); ++k) {
    Contact& c = set.contact(k);
    const Slip slip = set.slip_of(c, m);
    if (!c.has_friction || c.slips || c.is_held || !(slip.speed > set.metric().still)) {
      c.is_held = !c.slips && load_on(active, k).count == 3;
      continue;
    }
    c.slips = true;
    c.speed = slip.speed;
    c.ratio = set.friction()->kinetic_ratio;
    const ContactLoad carried = load_on(active, k);
    const double length = carried.pull.norm();
    erase_from(1, carried, active);
    ActiveSet::Inequality& half_space = active.at(carried.half_space[0]);
    half_space.multiplier = carried.load;
    half_space.tag.slip = length > kKnown * carried.load ? Vector3(carried.pull / length) : slip.direction;
  }
}

bool drop_first_to_vanish(const double* multiplier, ContactSet& set) noexcept {
  ActiveSet& active = set.active();
  int first = -1;
  double share = 1.0;  // of the change of the multipliers, until the first vanishes
  for (int j = 0; j < active.size(); ++j) {
    double from = active[j].multiplier;
    double to = multiplier[j];
    if (set.contact_of(j).is_held) {
      from = to = 0.0;
      for (int i = 0; i < active.size(); ++i) {
        if (active[i].tag.contact != active[j].tag.contact) continue;
        from += active[i].multiplier;
        to += multiplier[i];
      }
    }
    if (!(to < 0.0)) continue;
    from = std::max(0.0, from);
    const double vanishes = from / (from - to);
    if (first < 0 || vanishes < share) {
      first = j;
      share = vanishes;
    }
  }
  if (first < 0) return false;
  for (int j = 0; j < active.size(); ++j) {
    const double from = std::max(0.0, active[j].multiplier);
    active.at(j).multiplier = std::max(0.0, from + share * (multiplier[j] - from));
  }
  const int contact = active[first].tag.contact;
  const bool whole = set.contact(contact).is_held;
  for (int j = active.size() - 1; j >= 0; --j) {
    if (j == first || (whole && active[j].tag.contact == contact)) active.erase(j);
  }
  set.close_idle();
  return true;
}

bool hold_or_release(ContactSet& set) noexcept {
  bool changed = false;
  for (int k = 0; k < set.contact_count(); ++k) {
    const Contact& c = set.contact(k);
    const bool here = c.slips ? c.reversals >= kReversals && hold(k, set) : release(k, set);
    changed = changed || here;
  }
  if (changed) set.close_idle();
  return changed;
}

}  // namespace godobject::detail
