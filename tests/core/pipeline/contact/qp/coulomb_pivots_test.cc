// The changes of state between the steps of Newton's method: each keeps the forces of the contacts, whatever half
// spaces carry them.

#include "core/pipeline/contact/qp/coulomb_pivots.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/pipeline/contact/qp/contact_set.h"
#include "tests/support/random.h"

namespace godobject::test::coulomb_pivots_test {
namespace {

using detail::Contact;
using detail::ContactSet;

const CouplingMetric kPivotMetric;
constexpr double kStatic = 0.5;
constexpr double kKinetic = 0.25;

/// The load of a contact and its friction, over the ratio.
struct Load {
  double load = 0.0;
  Vector3 pull = Vector3::Zero();
  std::vector<Vector3> slips;
  std::vector<double> multipliers;
};

class CoulombPivots : public ::testing::Test {
 protected:
  CoulombPivots() {
    for (int i = 0; i < 6; ++i)
      rows_->push(static_cast<std::uint32_t>(i), random_.direction(), random_.in_cube(0.03), 0.0);
  }

  ContactSet set() { return {*rows_, wanted_, kPivotMetric, &friction_, last_, work_}; }
  /// Returns a unit vector across the normal, at this angle.
  Vector3 across(const Contact& c, double angle) const {
    const Vector3 x = c.normal.unitOrthogonal();
    return std::cos(angle) * x + std::sin(angle) * c.normal.cross(x);
  }
  /// Adds a half space of the contact.
  void push(ContactSet& set, int contact, const Vector3& slip, double multiplier) {
    ASSERT_TRUE(set.active().guess(set.cone_half_space(contact, slip)));
    set.active().at(set.active().size() - 1).multiplier = multiplier;
  }
  static Load load_of(const ContactSet& set, std::uint32_t row) {
    Load sum;
    for (int j = 0; j < set.active().size(); ++j) {
      if (set.contact_of(j).row != row) continue;
      const double multiplier = set.active()[j].multiplier;
      sum.load += multiplier;
      sum.pull += multiplier * set.active()[j].tag.slip;
      sum.slips.push_back(set.active()[j].tag.slip);
      sum.multipliers.push_back(multiplier);
    }
    return sum;
  }
  static int contact_with_row(const ContactSet& set, std::uint32_t row) {
    for (int k = 0; k < set.contact_count(); ++k) {
      if (set.contact(k).row == row) return k;
    }
    return -1;
  }
  /// Three pushes spread evenly around the normal can hold a contact.
  static void expect_spread(const Load& load, const Vector3& normal) {
    ASSERT_EQ(load.slips.size(), 3u);
    Vector3 sum = Vector3::Zero();
    for (const Vector3& slip : load.slips) {
      EXPECT_NEAR(slip.norm(), 1.0, 1e-12);
      EXPECT_NEAR(slip.dot(normal), 0.0, 1e-12);
      sum += slip;
    }
    EXPECT_LT(sum.norm(), 1e-12);
  }

  Random random_{1};
  std::unique_ptr<ContactRows> rows_ = std::make_unique<ContactRows>();
  Motion wanted_, last_;
  WorkMeter work_;
  ContactFriction friction_{kStatic, kKinetic, 0.0};
};

// -- a slipping contact is held

TEST_F(CoulombPivots, HoldAContactWhoseSlipHadTheDirectionOfItsForceTwice) {
  for (int reversals = 0; reversals <= 3; ++reversals) {
    ContactSet set = this->set();
    push(set, set.open(2), Vector3::Zero(), 0.5);
    const int k = set.open(4);
    Contact& c = set.contact(k);
    const Vector3 slip = across(c, 0.7);
    push(set, k, slip, 2.0);
    c.slips = true;
    c.ratio = kKinetic;
    c.reversals = reversals;
    EXPECT_EQ(detail::hold_or_release(set), reversals >= 2) << reversals;
    const Contact& now = set.contact(contact_with_row(set, 4));
    const Load load = load_of(set, 4);
    EXPECT_NEAR(load.load, 2.0, 1e-15);
    EXPECT_LT((load.pull - 2.0 * slip).norm(), 1e-15) << "the force stays";
    EXPECT_EQ(load_of(set, 2).load, 0.5) << "the other contact stays";
    EXPECT_EQ(now.slips, reversals < 2);
    EXPECT_EQ(now.is_held, reversals >= 2);
    if (reversals >= 2) {
      expect_spread(load, now.normal);
      EXPECT_EQ(now.reversals, 0);
      EXPECT_EQ(now.ratio, kStatic) << "the point rested in the last motion";
    } else {
      EXPECT_EQ(load.slips.size(), 1u);
    }
    set.close_all();
  }
}

TEST_F(CoulombPivots, HoldOnlyWithRoomForTwoMoreHalfSpaces) {
  for (int others = 3; others <= 5; ++others) {
    ContactSet set = this->set();
    const int k = set.open(0);
    push(set, k, across(set.contact(k), 0.0), 1.0);
    set.contact(k).slips = true;
    set.contact(k).reversals = 2;
    for (int i = 0; i < others; ++i) push(set, set.open(static_cast<std::uint32_t>(1 + i)), Vector3::Zero(), 1.0);
    EXPECT_EQ(detail::hold_or_release(set), others == 3);
    EXPECT_EQ(set.active().size(), others == 3 ? 6 : 1 + others);
    EXPECT_EQ(set.contact(contact_with_row(set, 0)).slips, others > 3);
    EXPECT_EQ(set.contact_count(), 1 + others);
    set.close_all();
  }
}

// -- a held contact slips or opens

/// Loads are lengths, from a micrometre to a metre: the size of the force does not matter.
TEST_F(CoulombPivots, SpreadAForceInsideOfTheConeOverThreePushes) {
  for (int trial = 0; trial < 200; ++trial) {
    const double size = std::pow(10.0, -(trial % 7));
    ContactSet set = this->set();
    const int k = set.open(3);
    const Contact& c = set.contact(k);
    const double angle = random_.between(0.0, 6.0);
    push(set, set.open(5), Vector3::Zero(), 0.25);
    for (int i = 0; i < 3; ++i) {
      push(set, k, across(c, angle + 2.0 * M_PI / 3.0 * i), size * random_.between(-0.5, 1.0));
    }
    set.contact(k).is_held = true;
    set.contact(k).ratio = kStatic;
    const Load before = load_of(set, 3);
    const bool is_pull = !(before.load > 0.0);
    const bool is_inside = before.pull.norm() <= before.load;
    EXPECT_EQ(detail::hold_or_release(set), is_pull || !is_inside) << trial;
    const int now = contact_with_row(set, 3);
    const Load after = load_of(set, 3);
    EXPECT_EQ(load_of(set, 5).load, 0.25);
    if (is_pull) {
      EXPECT_EQ(now, -1) << "the contact opened";
      EXPECT_EQ(rows_->required_gain[3], 0.0f) << "and is a row again";
      EXPECT_TRUE(after.slips.empty());
    } else if (is_inside) {
      EXPECT_NEAR(after.load, before.load, 1e-14 * size);
      EXPECT_LT((after.pull - before.pull).norm(), 1e-14 * size) << "the force stays";
      expect_spread(after, set.contact(now).normal);
      for (const double multiplier : after.multipliers) EXPECT_GE(multiplier, -1e-15);
      EXPECT_TRUE(set.contact(now).is_held);
      EXPECT_FALSE(set.contact(now).slips);
      EXPECT_EQ(set.contact(now).ratio, kStatic);
    } else {
      ASSERT_EQ(after.slips.size(), 1u);
      EXPECT_NEAR(after.load, before.load, 1e-14 * size) << "the normal force stays";
      EXPECT_LT((after.slips[0] - before.pull.normalized()).norm(), 1e-12) << "the friction keeps its direction";
      EXPECT_TRUE(set.contact(now).slips);
      EXPECT_FALSE(set.contact(now).is_held);
      EXPECT_EQ(set.contact(now).ratio, kKinetic);
      EXPECT_EQ(set.contact(now).speed, kPivotMetric.still);
    }
    set.close_all();
  }
}

TEST_F(CoulombPivots, HoldAForceOnTheConeAndOneWithoutFriction) {
  for (const bool on_cone : {true, false}) {
    ContactSet set = this->set();
    const int k = set.open(1);
    const Vector3 first = across(set.contact(k), 0.4);
    for (int i = 0; i < 3; ++i) {
      push(set, k, across(set.contact(k), 0.4 + 2.0 * M_PI / 3.0 * i), on_cone ? (i == 0 ? 1.0 : 0.0) : 1.0);
    }
    EXPECT_FALSE(detail::hold_or_release(set));
    const Load load = load_of(set, 1);
    expect_spread(load, set.contact(k).normal);
    EXPECT_LT((load.slips[0] - first).norm(), 1e-7);
    EXPECT_NEAR(load.multipliers[0], 1.0, 1e-12);
    EXPECT_NEAR(load.multipliers[1], on_cone ? 0.0 : 1.0, 1e-12);
    set.close_all();
  }
}

TEST_F(CoulombPivots, OpenAHeldContactWithoutLoad) {
  ContactSet set = this->set();
  const int k = set.open(1);
  for (int i = 0; i < 3; ++i) push(set, k, across(set.contact(k), 2.0 * M_PI / 3.0 * i), 0.0);
  EXPECT_TRUE(detail::hold_or_release(set));
  EXPECT_EQ(set.active().size(), 0);
  EXPECT_EQ(set.contact_count(), 0);
}

TEST_F(CoulombPivots, LeaveAContactWithOneOrTwoHalfSpacesAsItIs) {
  for (int count = 1; count <= 2; ++count) {
    ContactSet set = this->set();
    const int k = set.open(1);
    for (int i = 0; i < count; ++i) push(set, k, across(set.contact(k), 2.0 * i), -1.0);
    EXPECT_FALSE(detail::hold_or_release(set));
    const Load load = load_of(set, 1);
    EXPECT_EQ(load.slips.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(load.load, -1.0 * count);
    set.close_all();
  }
}

TEST_F(CoulombPivots, ChangeSeveralContactsAtOnce) {
  ContactSet set = this->set();
  const int opens = set.open(0), slips = set.open(1);
  for (int i = 0; i < 3; ++i) push(set, opens, across(set.contact(opens), 2.0 * M_PI / 3.0 * i), -1.0);
  for (int i = 0; i < 3; ++i) push(set, slips, across(set.contact(slips), 2.0 * M_PI / 3.0 * i), i == 0 ? 4.0 : -1.0);
  EXPECT_TRUE(detail::hold_or_release(set));
  ASSERT_EQ(set.contact_count(), 1);
  EXPECT_EQ(set.contact(0).row, 1u);
  EXPECT_TRUE(set.contact(0).slips);
  ASSERT_EQ(set.active().size(), 1);
  EXPECT_EQ(set.active()[0].multiplier, 2.0);
  set.close_all();
}

// -- a sticking contact begins to slip

TEST_F(CoulombPivots, LetAContactSlipAgainstTheForceThatItHad) {
  for (int trial = 0; trial < 100; ++trial) {
    ContactSet set = this->set();
    const int rests = set.open(5), k = set.open(2);
    push(set, rests, Vector3::Zero(), 0.125);
    const int count = 1 + trial % 2;
    for (int i = 0; i < count; ++i)
      push(set, k, across(set.contact(k), random_.between(0.0, 6.0)), random_.between(0.1, 1.0));
    set.contact(k).ratio = kStatic;
    const Load before = load_of(set, 2);
    Motion m;  // the point of contact k slips, the other one rests
    const Vector3 slip =
        random_.between(1.1, 1e5) * kPivotMetric.still * across(set.contact(k), random_.between(0.0, 6.0));
    const Vector3 arm = set.contact(k).point - set.contact(rests).point;
    m.rotation = arm.cross(slip) / arm.squaredNorm();
    m.translation = -m.rotation.cross(set.contact(rests).point);
    const detail::Slip seen = set.slip_of(set.contact(k), m);
    const bool slips = seen.speed > kPivotMetric.still;
    detail::begin_to_slip(m, set);
    const Contact& c = set.contact(contact_with_row(set, 2));
    const Load after = load_of(set, 2);
    EXPECT_FALSE(set.contact(contact_with_row(set, 5)).slips);
    EXPECT_EQ(load_of(set, 5).load, 0.125);
    EXPECT_NEAR(after.load, before.load, 1e-15);
    ASSERT_EQ(c.slips, slips);
    if (!slips) continue;
    EXPECT_EQ(c.speed, seen.speed);
    EXPECT_EQ(c.ratio, kKinetic);
    ASSERT_EQ(after.slips.size(), 1u);
    const bool has_direction = before.pull.norm() > 0.1 * before.load;
    EXPECT_LT((after.slips[0] - (has_direction ? before.pull.normalized() : seen.direction)).norm(), 1e-9) << trial;
    set.close_all();
  }
}

/// The friction so far has a direction from a tenth of its most on.
TEST_F(CoulombPivots, TakeTheDirectionOfTheSlipWhereTheForceHasNone) {
  for (const double pull : {0.0, 0.09, 0.11, 1.0}) {
    ContactSet set = this->set();
    const int k = set.open(2);
    const Vector3 d = across(set.contact(k), 0.3), slip = across(set.contact(k), 2.3);
    // two opposed pushes with the sum 1
    push(set, k, d, 0.5 * (1.0 + pull));
    push(set, k, -d, 0.5 * (1.0 - pull));
    detail::begin_to_slip({1e-4 * slip, Vector3::Zero()}, set);
    ASSERT_EQ(set.active().size(), 1);
    EXPECT_LT((set.active()[0].tag.slip - (pull > 0.1 ? d : slip)).norm(), 1e-9) << pull;
    EXPECT_NEAR(set.active()[0].multiplier, 1.0, 1e-15);
    set.close_all();
  }
}

TEST_F(CoulombPivots, LeaveContactsThatAreHeldOrSlipOrRest) {
  const Motion slides{Vector3(1e-3, 2e-3, 3e-3), Vector3::Zero()};
  for (int half_spaces = 1; half_spaces <= 3; ++half_spaces) {
    for (const bool rests : {true, false}) {
      ContactSet set = this->set();
      const int k = set.open(0);
      for (int i = 0; i < half_spaces; ++i) push(set, k, across(set.contact(k), 2.0 * M_PI / 3.0 * i), 1.0);
      set.contact(k).is_held = half_spaces == 3;
      detail::begin_to_slip(rests ? Motion{} : slides, set);
      const Contact& c = set.contact(0);
      EXPECT_EQ(c.slips, !rests && half_spaces < 3);
      EXPECT_EQ(c.is_held, half_spaces == 3) << "three half spaces hold a contact";
      EXPECT_EQ(set.active().size(), c.slips ? 1 : half_spaces);
      set.close_all();
    }
  }
  ContactSet set = this->set();
  const int k = set.open(0);
  push(set, k, across(set.contact(k), 1.0), 1.0);
  set.contact(k).slips = true;
  set.contact(k).speed = 0.5;
  detail::begin_to_slip(slides, set);
  EXPECT_EQ(set.contact(0).speed, 0.5) << "it slips already";
  EXPECT_FALSE(set.contact(0).is_held);
  // a contact that came to stick with three half spaces is held from then on
  set.close_all();
}

TEST_F(CoulombPivots, HoldAContactThatSticksWithThreeHalfSpaces) {
  ContactSet set = this->set();
  const int k = set.open(0);
  for (int i = 0; i < 3; ++i) push(set, k, across(set.contact(k), 2.0 * M_PI / 3.0 * i), 1.0);
  detail::begin_to_slip(Motion{}, set);
  EXPECT_TRUE(set.contact(k).is_held);
  EXPECT_EQ(set.active().size(), 3);
  set.close_all();
}

// -- the first force that vanishes

/// A unit that may vanish: a half space, or the three of a held contact.
struct Unit {
  std::uint32_t row;
  std::vector<int> half_spaces;
};

TEST_F(CoulombPivots, DropTheFirstForceThatVanishesOnTheWayToTheNewOnes) {
  int dropped = 0, held_dropped = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    ContactSet set = this->set();
    std::vector<Unit> units;
    for (std::uint32_t row = 0; row < 6; ++row) {
      const int count = random_.integer(1, 3);  // three hold the contact: they count as one
      if (set.active().size() + count > 6) continue;
      const int k = set.open(row);
      set.contact(k).is_held = count == 3;
      for (int i = 0; i < count; ++i) {
        if (i == 0 || count < 3) units.push_back({row, {}});
        units.back().half_spaces.push_back(set.active().size());
        push(set, k, across(set.contact(k), 2.0 * i), random_.between(0.0, 1.0));
      }
    }
    const int size = set.active().size();
    std::vector<double> from, to;
    for (int j = 0; j < size; ++j) {
      from.push_back(set.active()[j].multiplier);
      to.push_back(random_.between(trial % 3 == 0 ? 0.0 : -1.0, 1.5));
    }
    const auto sum = [](const Unit& unit, const std::vector<double>& values) {
      double all = 0.0;
      for (const int j : unit.half_spaces) all += values[static_cast<std::size_t>(j)];
      return all;
    };
    double share = 2.0;
    const Unit* first = nullptr;
    for (const Unit& unit : units) {
      if (!(sum(unit, to) < 0.0)) continue;
      const double here = sum(unit, from) / (sum(unit, from) - sum(unit, to));
      if (here < share) {
        share = here;
        first = &unit;
      }
    }
    ASSERT_EQ(detail::drop_first_to_vanish(to.data(), set), first != nullptr) << trial;
    if (first == nullptr) {
      ASSERT_EQ(set.active().size(), size);
      for (int j = 0; j < size; ++j) EXPECT_EQ(set.active()[j].multiplier, from[static_cast<std::size_t>(j)]);
      set.close_all();
      continue;
    }
    ++dropped;
    held_dropped += first->half_spaces.size() == 3 ? 1 : 0;
    ASSERT_EQ(set.active().size(), size - static_cast<int>(first->half_spaces.size())) << trial;
    const auto of_row = [&](const Unit& unit) { return unit.row == first->row; };
    const bool closes = std::count_if(units.begin(), units.end(), of_row) == 1;
    EXPECT_EQ(contact_with_row(set, first->row) < 0, closes) << "a contact without half spaces is a row again";
    EXPECT_EQ(rows_->required_gain[first->row] == 0.0f, closes);
    int at = 0;
    for (const Unit& unit : units) {
      for (const int j : unit.half_spaces) {
        if (&unit == first) continue;
        const auto i = static_cast<std::size_t>(j);
        const double expected = std::max(0.0, from[i] + share * (to[i] - from[i]));
        EXPECT_NEAR(set.active()[at].multiplier, expected, 1e-12) << trial;
        EXPECT_EQ(set.contact_of(at).row, unit.row);
        ++at;
      }
    }
    set.close_all();
  }
  EXPECT_GT(dropped, 500);
  EXPECT_GT(held_dropped, 100);
}

/// A force that pulls already vanishes at once, and the others stay.
TEST_F(CoulombPivots, DropAForceThatPullsBeforeTheOthersChange) {
  ContactSet set = this->set();
  push(set, set.open(0), Vector3::Zero(), 1.0);
  push(set, set.open(1), Vector3::Zero(), -0.5);
  push(set, set.open(2), Vector3::Zero(), 2.0);
  const double to[] = {0.5, -1.0, -1.0};
  ASSERT_TRUE(detail::drop_first_to_vanish(to, set));
  ASSERT_EQ(set.active().size(), 2);
  EXPECT_EQ(set.contact_of(0).row, 0u);
  EXPECT_EQ(set.active()[0].multiplier, 1.0);
  EXPECT_EQ(set.contact_of(1).row, 2u);
  EXPECT_EQ(set.active()[1].multiplier, 2.0);
  set.close_all();
}

TEST_F(CoulombPivots, DropNoForceThatEndsAtZero) {
  ContactSet set = this->set();
  push(set, set.open(0), Vector3::Zero(), 1.0);
  const double to[] = {0.0};
  EXPECT_FALSE(detail::drop_first_to_vanish(to, set));
  EXPECT_EQ(set.active()[0].multiplier, 1.0);
  set.close_all();
}

}  // namespace
}  // namespace godobject::test::coulomb_pivots_test
