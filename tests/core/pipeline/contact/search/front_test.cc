// The front of the search, compared with a plain table of balls in double precision.

#include "core/pipeline/contact/search/front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <span>
#include <vector>

#include "core/pipeline/contact/search/odometer.h"
#include "tests/support/analytic_worlds.h"
#include "tests/support/random.h"
#include "tests/support/small_scenes.h"

namespace godobject::test::front_test {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
const BoundingSphere kBodySphere{{0.0, 0.0, 0.0}, 0.03};
constexpr auto kGoesOn = [](std::uint32_t) { return true; };
constexpr auto kNothing = [](std::uint32_t) { FAIL() << "no item is due"; };

/// A front with its memory, and the same balls as a table.
class FrontAndTable {
 public:
  explicit FrontAndTable(const Pointshell& shell)
      : shell_(shell), memory_(Front::memory(shell)), items_(static_cast<int>(shell.nodes.size() + shell.size)) {
    front.start(memory_, shell);
    front.remove(0);
    odometer.move_to(pose, kBodySphere);
  }

  struct Entry {
    Vector3 center;  ///< of the ball, in the field's frame [m]
    Front::Ball ball;
  };

  Vector3 position(std::uint32_t item) const {
    const Front::Sphere sphere = front.sphere_of(item);
    return pose * Vector3(static_cast<double>(sphere.x), static_cast<double>(sphere.y), static_cast<double>(sphere.z));
  }
  Front::Place place() const { return front.place(pose.rotation.toRotationMatrix(), pose.translation); }

  void insert(std::uint32_t item, const Front::Ball& ball) {
    front.insert(item, place(), ball, odometer.travelled() + ball.radius * ball.per_pace);
    table[item] = {position(item), ball};
  }
  void insert_some(Random& random, std::size_t wanted) {
    while (table.size() < wanted) {
      const auto item = static_cast<std::uint32_t>(random.integer(0, items_ - 1));
      if (front.has(item)) continue;
      insert(item,
             {std::pow(10.0, random.between(-5.0, -2.0)), random.integer(0, 1) == 0 ? 1.0 : random.between(0.33, 1.0)});
    }
  }
  void move(Random& random, double most) {
    pose.translation += random.in_cube(most);
    pose.rotation = (pose.rotation * exp_rotation(random.in_cube(most / 0.03))).normalized();
    odometer.move_to(pose, kBodySphere);
  }
  /// Returns the distance of the item from the edge of its ball [m].
  double room(std::uint32_t item) const {
    const Entry& entry = table.at(item);
    return entry.ball.radius - (position(item) - entry.center).norm();
  }

  Front front;
  Odometer odometer;
  Pose pose;
  std::map<std::uint32_t, Entry> table;

 private:
  const Pointshell& shell_;
  std::vector<std::uint32_t> memory_;
  int items_;
};

/// Each item that comes nearer to the edge of its ball than `reach` is found, and no other. Between scans the blocks'
/// readings hold: nothing leaves its ball before `certain`.
TEST(Front, FindsWhatMayLeaveItsBall) {
  const SampledBody body = ball_body(0.02, 300);
  const Pointshell& shell = body.pointshell();
  for (const double far : {0.0, 0.3}) {
    FrontAndTable at(shell);
    at.pose.translation.x() = far;
    at.odometer.move_to(at.pose, kBodySphere);
    Random random(11);
    const double rounding = 20e-6 * (far + 0.1);  // a few of the front's own bound
    int found_in_all = 0;
    int left_alone = 0;
    for (int step = 0; step < 3000; ++step) {
      at.insert_some(random, 150);
      at.move(random, std::pow(10.0, random.between(-6.0, -3.5)));
      const double travelled = at.odometer.travelled();
      for (const auto& [item, entry] : at.table) {
        if (at.room(item) < 0.0) {
          ASSERT_LE(at.front.certain(), travelled) << step << ": it has left unseen";
        }
      }
      const double reach = random.integer(0, 2) == 0 ? 0.0 : random.between(0.0, 3e-4);
      std::set<std::uint32_t> found;
      ASSERT_TRUE(at.front.scan(
          at.place(), travelled, reach,
          [&](std::uint32_t slot) { ASSERT_TRUE(found.insert(at.front.item_in(slot)).second) << "twice"; }, kGoesOn));
      for (const auto& [item, entry] : at.table) {
        ASSERT_TRUE(at.front.has(item));
        if (found.count(item) == 0) {
          ASSERT_GE(at.room(item), reach) << step << ' ' << item;
          ++left_alone;
        } else {
          ASSERT_LE(at.room(item) * entry.ball.per_pace, reach + rounding) << step << ' ' << item;
        }
      }
      found_in_all += static_cast<int>(found.size());
      for (const std::uint32_t item : found) {
        ASSERT_EQ(at.table.count(item), 1u);
        at.front.remove(item);
        at.table.erase(item);
      }
      for (std::uint32_t slot = 0; slot < at.table.size(); ++slot) {
        const Front::Sphere a = at.front.sphere_in(slot);
        const Front::Sphere b = at.front.sphere_of(at.front.item_in(slot));
        ASSERT_TRUE(a.x == b.x && a.y == b.y && a.z == b.z && a.radius == b.radius) << step << ' ' << slot;
      }
    }
    EXPECT_GT(found_in_all, 500);
    EXPECT_GT(left_alone, 100000);
  }
}

/// An item whose ball is renewed stays in its slot. A ball that is larger than the reach by the roundings is not found
/// again at the same place.
TEST(Front, FindsAnItemAgainOnlyWhenItHasMoved) {
  const SampledBody body = ball_body(0.02, 300);
  FrontAndTable at(body.pointshell());
  Random random(13);
  at.pose.translation = Vector3(0.1, -0.2, 0.3);
  at.insert_some(random, 100);
  const double reach = 1e-4;
  std::size_t renewed = 0;
  for (int step = 0; step < 300; ++step) {
    at.move(random, 2e-4);
    const Front::Place place = at.place();
    const double enough = reach * (1.0 + 1e-5) + 4.0 * static_cast<double>(place.rounding);
    const double travelled = at.odometer.travelled();
    std::vector<std::uint32_t> slots;
    const auto note = [&](std::uint32_t slot) { slots.push_back(slot); };
    at.front.scan(place, travelled, reach, note, kGoesOn);
    renewed += slots.size();
    for (const std::uint32_t slot : slots) {
      const std::uint32_t item = at.front.item_in(slot);
      const double per_pace = random.between(0.5, 1.0);
      const Front::Ball ball{enough * random.between(1.000001, 4.0) / per_pace, per_pace};
      at.front.insert(item, place, ball, travelled + ball.radius * ball.per_pace);
      EXPECT_EQ(at.front.item_in(slot), item);
      at.table[item] = {at.position(item), ball};
    }
    at.front.scan(place, travelled, reach, kNothing, kGoesOn);
    EXPECT_LT(at.front.certain(), kNever);
    EXPECT_GE(at.front.certain(), travelled + reach) << "else a call with room for one look-up would do it again";
  }
  EXPECT_GT(renewed, 1000u);
}

/// Without the items that a scan finds nothing is due before the end of its reach, whatever their pace.
TEST(Front, FindsAllThatIsDueBeforeTheEndOfItsReach) {
  const SampledBody body = ball_body(0.02, 300);
  FrontAndTable at(body.pointshell());
  Random random(15);
  int slow = 0;
  for (int step = 0; step < 500; ++step) {
    at.insert_some(random, 100);
    at.move(random, 1e-4);
    const double travelled = at.odometer.travelled();
    const double reach = random.between(1e-4, 3e-3);
    std::vector<std::uint32_t> found;
    const auto note = [&](std::uint32_t slot) { found.push_back(at.front.item_in(slot)); };
    at.front.scan(at.place(), travelled, reach, note, kGoesOn);
    for (const std::uint32_t item : found) {
      ASSERT_LE(at.room(item) * at.table[item].ball.per_pace, reach + 1e-6);
      if (at.room(item) > reach + 1e-6) ++slow;
      at.front.remove(item);
      at.table.erase(item);
    }
    ASSERT_GE(at.front.certain(), travelled + reach);
  }
  EXPECT_GT(slow, 100);
}

/// Blocks that a stop leaves out stay due, and certain() says so; the next scan goes on with them.
TEST(Front, LosesNothingAtAStop) {
  const SampledBody body = ball_body(0.02, 300);
  FrontAndTable at(body.pointshell());
  Random random(17);
  std::size_t due_in_all = 0;
  int stops = 0;
  for (int step = 0; step < 500; ++step) {
    at.insert_some(random, 100);
    at.move(random, 1e-3);
    const double travelled = at.odometer.travelled();
    std::set<std::uint32_t> due;
    for (const auto& [item, entry] : at.table) {
      if (at.room(item) < 0.0) due.insert(item);
    }
    due_in_all += due.size();
    int calls = 0;
    std::set<std::uint32_t> found;
    for (bool all = false; !all; ++calls) {
      ASSERT_LT(calls, 100);
      int runs = random.integer(0, 2);
      all = at.front.scan(
          at.place(), travelled, 0.0, [&](std::uint32_t slot) { found.insert(at.front.item_in(slot)); },
          [&](std::uint32_t) { return runs-- > 0; });
      for (const std::uint32_t item : found) {
        if (at.front.has(item)) at.front.remove(item);
        at.table.erase(item);
      }
      stops += all ? 0 : 1;
      if (!std::includes(found.begin(), found.end(), due.begin(), due.end())) {
        ASSERT_FALSE(all);
        ASSERT_LE(at.front.certain(), travelled);
      }
    }
    EXPECT_TRUE(std::includes(found.begin(), found.end(), due.begin(), due.end()));
  }
  EXPECT_GT(due_in_all, 500u);
  EXPECT_GT(stops, 500);
}

/// The first of all times counts, to the last bit, in whatever block and order the items come.
TEST(Front, KnowsTheFirstOfItsTimes) {
  const SampledBody body = ball_body(0.02, 300);
  Random random(23);
  for (int trial = 0; trial < 200; ++trial) {
    FrontAndTable at(body.pointshell());
    double first = kNever;
    const auto items = static_cast<std::uint32_t>(random.integer(1, 100));
    for (std::uint32_t item = 1; item <= items; ++item) {
      const double until = 1.0 + std::pow(10.0, random.between(-12.0, 0.0));
      at.front.insert(item, at.place(), {until, 1.0}, until);
      first = std::min(first, until);
      ASSERT_EQ(at.front.certain(), first);
    }
  }
}

TEST(Front, FindsAnItemThatIsDueWhereverItIs) {
  const SampledBody body = ball_body(0.02, 300);
  FrontAndTable at(body.pointshell());
  at.insert(1, {1.0, 1.0});
  at.front.insert_due(2);
  EXPECT_LT(at.front.certain(), -1e9);
  std::vector<std::uint32_t> found;
  const auto note = [&](std::uint32_t slot) { found.push_back(at.front.item_in(slot)); };
  at.front.scan(at.place(), 0.0, 0.0, note, kGoesOn);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{2}));
  at.front.remove(2);
  at.front.scan(at.place(), 0.8, 0.5, kNothing, kGoesOn);
  EXPECT_NEAR(at.front.certain(), 1.8, 1e-5);
}

/// Single precision finds an item at the edge of its ball, far from the frame's origin and near it, and does not find
/// one that is a few roundings from there.
TEST(Front, AllowsForItsRoundings) {
  const SampledBody body = ball_body(0.02, 300);
  const Pointshell& shell = body.pointshell();
  Random random(19);
  for (const double far : {0.0, 0.3, 10.0}) {
    for (int trial = 0; trial < 2000; ++trial) {
      FrontAndTable at(shell);
      const auto pose = [&] {
        return Pose{exp_rotation(random.in_cube(3.0)), far * random.direction() + random.in_cube(1e-3)};
      };
      const auto item = static_cast<std::uint32_t>(random.integer(1, static_cast<int>(shell.size)));
      const Pose end = trial % 2 == 0 ? pose() : Pose{at.pose.rotation, at.pose.translation + random.in_cube(1e-4)};
      at.pose = trial % 2 == 0 ? pose() : at.pose;
      const Vector3 begin = at.position(item);
      const Front::Place place = at.place();
      at.pose = end;
      const double way = (at.position(item) - begin).norm();
      const double rounding = static_cast<double>(place.rounding + at.place().rounding);
      for (const bool leaves : {true, false}) {
        const double radius = leaves ? way * (1.0 - 1e-9) : way * (1.0 + 1e-5) + 2.0 * rounding;
        at.front.insert(item, place, {radius, 1.0}, -1.0);
        bool found = false;
        at.front.scan(
            at.place(), 0.0, 0.0, [&](std::uint32_t) { found = true; }, kGoesOn);
        ASSERT_EQ(found, leaves) << far << ' ' << trial;
        at.front.remove(item);
      }
    }
  }
}

/// Far from all surfaces a ball is much larger than the body and its place. The reading until which its item stays in
/// it is rounded down.
TEST(Front, RoundsTheTimesOfLargeBallsDown) {
  const SampledBody body = ball_body(0.02, 300);
  Random random(21);
  for (int trial = 0; trial < 1000; ++trial) {
    FrontAndTable at(body.pointshell());
    const Front::Ball ball{random.between(10.0, 1000.0), random.between(0.3, 1.0)};
    at.front.insert(3, at.place(), ball, -1.0);
    at.front.scan(at.place(), 0.0, 0.0, kNothing, kGoesOn);
    ASSERT_LE(at.front.certain(), ball.radius * ball.per_pace) << trial;
    ASSERT_GE(at.front.certain(), ball.radius * ball.per_pace * (1.0 - 1e-5)) << trial;
  }
}

/// A pose or a reading that is no number proves nothing.
TEST(Front, FindsAllAtAPoseThatIsNoNumber) {
  const SampledBody body = ball_body(0.02, 300);
  FrontAndTable at(body.pointshell());
  for (std::uint32_t item = 1; item <= 20; ++item) at.insert(item, {1.0, 1.0});
  at.pose.translation.y() = std::numeric_limits<double>::quiet_NaN();
  int found = 0;
  at.front.scan(
      at.place(), 5.0, 0.0, [&](std::uint32_t) { ++found; }, kGoesOn);
  EXPECT_EQ(found, 20);
  found = 0;
  at.front.scan(
      at.place(), std::numeric_limits<double>::quiet_NaN(), 0.0, [&](std::uint32_t) { ++found; }, kGoesOn);
  EXPECT_EQ(found, 20);
}

TEST(Front, GivesMarkedPointsOnceAndInOrder) {
  const SampledBody body = ball_body();
  FrontAndTable at(body.pointshell());
  Front& front = at.front;
  at.insert(0, {0.25, 1.0});
  EXPECT_EQ(front.certain(), 0.25);
  const auto points = static_cast<std::uint32_t>(body.pointshell().size);
  for (const std::uint32_t point : {points - 1, 31u, 0u, 32u, 31u, 63u}) front.mark(point);
  EXPECT_EQ(front.marked(), 5u);
  EXPECT_EQ(front.certain(), 0.0) << "marked points are due";
  std::vector<std::uint32_t> given;
  const auto unmark_some = [&](std::uint32_t point) {
    given.push_back(point);
    if (point != 32) front.unmark(point);
  };
  front.for_each_marked(unmark_some);
  EXPECT_EQ(given, (std::vector<std::uint32_t>{0, 31, 32, 63, points - 1}));
  EXPECT_EQ(front.marked(), 1u);
  given.clear();
  front.for_each_marked([&](std::uint32_t point) {
    given.push_back(point);
    front.unmark(point);
  });
  EXPECT_EQ(given, (std::vector<std::uint32_t>{32}));
  EXPECT_EQ(front.certain(), 0.25);
  front.for_each_marked([](std::uint32_t) { FAIL() << "a point is still marked"; });
}

/// A chain is last in, first out, and has an item once, whether or not the item is in the front.
TEST(Front, ChainsItemsOnce) {
  const SampledBody body = ball_body();
  FrontAndTable at(body.pointshell());
  at.insert(9, {1.0, 1.0});
  std::uint32_t chain = Front::kNone;
  for (const std::uint32_t item : {5u, 9u, 5u, 7u, 9u, 7u}) at.front.push(chain, item);
  EXPECT_TRUE(at.front.has(9));
  for (const std::uint32_t expected : {7u, 9u, 5u}) ASSERT_EQ(at.front.pop(chain), expected);
  EXPECT_EQ(chain, Front::kNone);
  at.front.push(chain, 9);
  EXPECT_EQ(at.front.pop(chain), 9u) << "an item that left may come again";
  EXPECT_TRUE(at.front.has(9));
}

/// The memory may begin at any address. The front writes into all of it at most, and nothing beside it. All points may
/// be in the front at once.
TEST(Front, WritesOnlyIntoItsMemory) {
  constexpr std::uint32_t kGuard = 0xabad1deau;
  const SceneImage image = ball_over_plate();
  const Pointshell& shell = open_scene(image).pointshell;
  const auto points = static_cast<std::uint32_t>(shell.size);
  const auto nodes = static_cast<std::uint32_t>(shell.nodes.size());
  const std::size_t size = Front::memory(shell);
  for (std::size_t offset = 0; offset < 32; ++offset) {
    std::vector<std::uint32_t> words(offset + size + 32, kGuard);
    Front front;
    front.start(std::span(words).subspan(offset, size), shell);
    EXPECT_TRUE(front.has(0));
    front.remove(0);
    const Front::Place place = front.place(Matrix3::Identity(), Vector3::Zero());
    for (std::uint32_t i = 0; i < points; ++i) {
      front.insert(nodes + i, place, {1e-3, 1.0}, 1e-3);
    }
    for (int again = 0; again < 2; ++again) {
      std::set<std::uint32_t> found;
      const auto note = [&](std::uint32_t slot) { found.insert(front.item_in(slot)); };
      front.scan(place, 0.0, 2e-3, note, kGoesOn);
      EXPECT_EQ(found.size(), points);
      for (std::uint32_t i = 0; i < points; ++i) front.mark(i);
      EXPECT_EQ(front.marked(), points);
      front.scan(place, 1.0, 2e-3, kNothing, kGoesOn);
      std::uint32_t next = 0;
      front.for_each_marked([&](std::uint32_t point) {
        ASSERT_EQ(point, next++);
        ASSERT_FALSE(front.has(nodes + point));
        front.unmark(point);
        front.insert(nodes + point, place, {1e-3, 1.0}, 1e-3);
        ASSERT_TRUE(front.has(nodes + point));
      });
      EXPECT_EQ(next, points);
      EXPECT_EQ(front.block_count(), (points + 15) / 16) << "marked points keep their slots";
    }
    for (std::uint32_t i = 0; i < points; ++i) front.remove(nodes + i);
    EXPECT_EQ(front.certain(), kNever) << "nothing is left";
    for (std::size_t i = 0; i < offset; ++i) ASSERT_EQ(words[i], kGuard) << "written in front of it";
    for (std::size_t i = offset + size; i < words.size(); ++i) ASSERT_EQ(words[i], kGuard) << "written behind it";
  }
}

/// The memory of another session does not matter.
TEST(Front, StartsAnewWithUsedMemory) {
  const SceneImage image = ball_over_plate();
  const Pointshell& shell = open_scene(image).pointshell;
  for (const std::uint32_t old : {0u, 1u, 0xfffffffeu, ~0u, 0x7fc00000u}) {
    std::vector<std::uint32_t> memory(Front::memory(shell), old);
    Front front;
    front.start(memory, shell);
    for (int again = 0; again < 2; ++again) {
      EXPECT_EQ(front.marked(), 0u);
      front.for_each_marked([](std::uint32_t) { FAIL() << "no point is marked yet"; });
      EXPECT_EQ(front.parent_of(0), Front::kNone);
      for (std::uint32_t item = 0; item < shell.nodes.size() + shell.size; ++item) {
        ASSERT_EQ(front.has(item), item == 0) << item;
      }
      const Front::Place place = front.place(Matrix3::Identity(), Vector3(0.1, 0.2, 0.3));
      std::vector<std::uint32_t> found;
      const auto note = [&](std::uint32_t slot) { found.push_back(front.item_in(slot)); };
      front.scan(place, 5.0, 0.0, note, kGoesOn);
      EXPECT_EQ(found, (std::vector<std::uint32_t>{0})) << "the root is due";
      front.remove(0);
      std::uint32_t chain = Front::kNone;
      for (const std::uint32_t item : {0u, 3u, 4u}) {
        front.insert(item, place, {1e-3, 1.0}, 5.0);
        front.push(chain, item);
      }
      front.mark(7);
      front.mark(300);
      front.start(memory, shell);
      front.push(chain = Front::kNone, 3);
      EXPECT_EQ(front.pop(chain), 3u);
    }
  }
}

/// A shell of one point has one node, the root. By hand: a block of sixteen items has ten words for each, and a time
/// of two words; it begins at a multiple of 16 words, so 15 words may stay unused; each of the two items has three
/// words; a bit for the mark of the point, and one for the word of that bit, take a word each.
TEST(Front, HoldsAShellOfOnePoint) {
  const SampledBody body({{Vector3(0.1, 0.2, 0.3)}, {-Vector3::UnitZ()}}, Vector3::Constant(1e-4));
  const Pointshell shell = body.pointshell();
  ASSERT_EQ(shell.nodes.size(), 1u);
  EXPECT_EQ(Front::memory(shell), 15u + 16u * 10u + 2u + 2u * 3u + 1u + 1u);
  for (std::size_t offset = 0; offset < 16; ++offset) {
    std::vector<std::uint32_t> words(offset + Front::memory(shell), ~0u);
    Front front;
    front.start(std::span(words).subspan(offset), shell);
    EXPECT_EQ(front.parent_of(0), Front::kNone);
    EXPECT_EQ(front.parent_of(1), 0u);
    EXPECT_TRUE(front.has(0));
    EXPECT_FALSE(front.has(1));
    EXPECT_EQ(front.block_count(), 1u);
    front.remove(0);
    EXPECT_EQ(front.block_count(), 0u);
  }
}

TEST(Front, KnowsTheChildrenAndTheirParent) {
  const SampledBody body = ball_body();
  const Pointshell& shell = body.pointshell();
  FrontAndTable at(shell);
  Front& front = at.front;
  const auto nodes = static_cast<std::uint32_t>(shell.nodes.size());
  std::vector<int> seen(nodes + shell.size);
  for (std::uint32_t n = 0; n < nodes; ++n) {
    Front::for_each_child(shell, n, [&](std::uint32_t child) {
      ++seen[child];
      EXPECT_EQ(front.parent_of(child), n);
    });
  }
  EXPECT_EQ(seen[0], 0);
  for (std::size_t i = 1; i < seen.size(); ++i) ASSERT_EQ(seen[i], 1) << i;
}

TEST(Front, KnowsSpheresThatHoldTheirPoints) {
  const SampledBody body = ball_body();
  const Pointshell& shell = body.pointshell();
  FrontAndTable at(shell);
  Front& front = at.front;
  const auto nodes = static_cast<std::uint32_t>(shell.nodes.size());
  const auto center = [](const Front::Sphere& s) {
    return Vector3(static_cast<double>(s.x), static_cast<double>(s.y), static_cast<double>(s.z));
  };
  for (std::uint32_t n = 0; n < nodes; ++n) {
    const Front::Sphere sphere = front.sphere_of(n);
    const format::Node& node = shell.nodes[n];
    ASSERT_GE(static_cast<double>(sphere.radius), radius_of(node));
    ASSERT_LE(static_cast<double>(sphere.radius), 1.0001 * radius_of(node));
    for (std::uint32_t i = node.first_point; i < node.first_point + node.point_count; ++i) {
      ASSERT_LE((shell.point(i) - center(sphere)).norm(), static_cast<double>(sphere.radius)) << n << ' ' << i;
    }
  }
  for (std::uint32_t i = 0; i < shell.size; ++i) {
    const Front::Sphere sphere = front.sphere_of(nodes + i);
    ASSERT_EQ(center(sphere), shell.point(i));
    ASSERT_EQ(sphere.radius, 0.0f);
  }
}

/// Marks of many points, which take several words of words, against a set.
TEST(Front, KeepsTheMarksOfManyPoints) {
  const SampledBody body = ball_body(0.02, 5000);
  const Pointshell& shell = body.pointshell();
  FrontAndTable at(shell);
  Front& front = at.front;
  std::mt19937_64 random(7);
  std::set<std::uint32_t> marks;
  for (int step = 0; step < 3000; ++step) {
    // often at the ends of words
    const std::uint64_t word = 32 * (random() % (shell.size / 32));
    const auto point = static_cast<std::uint32_t>(step % 2 == 0 ? word + 31 * (random() % 2) : random() % shell.size);
    if (marks.count(point) != 0 && random() % 8 != 0) {
      front.unmark(point);
      marks.erase(point);
    } else {
      front.mark(point);
      marks.insert(point);
    }
    if (step % 200 == 199) {
      // leave a few: whole words become empty
      while (marks.size() > 5) {
        front.unmark(*marks.begin());
        marks.erase(marks.begin());
      }
    }
    ASSERT_EQ(front.marked(), marks.size());
    auto next = marks.begin();
    front.for_each_marked([&](std::uint32_t given) {
      ASSERT_NE(next, marks.end()) << step;
      ASSERT_EQ(given, *next++) << step;
    });
    ASSERT_EQ(next, marks.end()) << step;
  }
}

TEST(Front, NeedsNoMemoryForAnEmptyShell) { EXPECT_EQ(Front::memory(Pointshell{}), 0u); }

}  // namespace
}  // namespace godobject::test::front_test
