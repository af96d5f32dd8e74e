// The search calendar, compared with a plain table of due ticks.

#include "core/pipeline/contact/search/due_calendar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <span>
#include <vector>

#include "tests/support/analytic_worlds.h"
#include "tests/support/small_scenes.h"

namespace godobject::test::due_calendar_test {
namespace {

TEST(DueCalendar, TakesWhatIsDueAndNothingElse) {
  const SampledBody body = ball_body();
  const Pointshell& shell = body.pointshell();
  const auto items = static_cast<std::uint32_t>(shell.nodes.size() + shell.size);
  std::vector<std::uint32_t> memory(DueCalendar::memory(shell));
  DueCalendar calendar;
  calendar.start(memory, shell);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::map<std::uint32_t, std::uint64_t> due;  // the due ticks of all filed items
  due[0] = 0;
  std::uint64_t now = 0;
  std::uint64_t farthest = 0;
  for (int step = 0; step < 20000; ++step) {
    // mostly a small step on; at times a step back, a step beyond all listed ticks, or one beyond 32 bits
    const double kind = unit(random);
    if (kind < 0.9)
      now = farthest + static_cast<std::uint64_t>(30.0 * unit(random));
    else if (kind < 0.97)
      now = farthest - std::min(farthest, static_cast<std::uint64_t>(std::pow(10.0, 4.0 * unit(random))));
    else if (kind < 0.999)
      now = farthest + static_cast<std::uint64_t>(5000.0 * unit(random));
    else
      now = farthest + (1ull << 29);
    farthest = std::max(farthest, now);
    std::vector<std::uint32_t> taken;
    calendar.take_due(now, [&](std::uint32_t item) { taken.push_back(item); });
    for (const std::uint32_t item : taken) {
      ASSERT_EQ(due.count(item), 1u) << step;
      ASSERT_LE(due[item], now) << step;
      due.erase(item);
      ASSERT_FALSE(calendar.is_filed(item));
    }
    std::uint64_t least = ~0ull;
    for (const auto& [item, tick] : due) {
      ASSERT_GT(tick, now) << step << ": an item is overdue";
      ASSERT_TRUE(calendar.is_filed(item));
      least = std::min(least, tick);
    }
    ASSERT_LE(calendar.certain(), least) << step;
    while (due.size() < 40) {
      const auto item = static_cast<std::uint32_t>(random() % items);
      if (calendar.is_filed(item)) continue;
      const auto ahead = static_cast<std::uint64_t>(std::pow(10.0, 5.0 * unit(random)));
      calendar.file(item, now + ahead);
      due[item] = now + ahead;
    }
    if (unit(random) < 0.3) {
      const std::uint32_t item = due.begin()->first;
      calendar.take(item);
      due.erase(item);
    }
  }
}

TEST(DueCalendar, FilesTheFarthestWhereItIsSeenInTime) {
  const SampledBody body = ball_body();
  std::vector<std::uint32_t> memory(DueCalendar::memory(body.pointshell()));
  DueCalendar calendar;
  calendar.start(memory, body.pointshell());
  calendar.take(0);
  calendar.file(0, ~0ull);
  int taken = 0;
  for (std::uint64_t now = 0; now < (1ull << 33); now += 1ull << 27) {
    calendar.take_due(now, [&](std::uint32_t item) {
      ++taken;
      calendar.file(item, ~0ull);
    });
  }
  EXPECT_LE(taken, 8) << "32 bits make items due early, but only rarely";
}

/// A stop loses nothing: further calls take the same items as one call without a stop, however the hand moves between.
TEST(DueCalendar, GoesOnWhereItWasStopped) {
  const SampledBody body = ball_body();
  const Pointshell& shell = body.pointshell();
  const auto items = static_cast<std::uint32_t>(shell.nodes.size() + shell.size);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int stops = 0;
  for (int run = 0; run < 300; ++run) {
    std::vector<std::uint32_t> memory(DueCalendar::memory(shell));
    DueCalendar calendar;
    calendar.start(memory, shell);
    calendar.take(0);
    std::map<std::uint32_t, std::uint64_t> due;
    std::uint64_t now = 1000;
    calendar.take_due(now, [](std::uint32_t) {});
    const auto file_some = [&]() {
      for (int k = 0; k < 30; ++k) {
        const auto item = static_cast<std::uint32_t>(random() % items);
        if (calendar.is_filed(item)) continue;
        const auto ahead = static_cast<std::uint64_t>(std::pow(10.0, 4.0 * unit(random)));
        const std::uint64_t tick = unit(random) < 0.2 ? now - std::min(now, ahead) : now + ahead;
        calendar.file(item, tick);
        due[item] = tick;
      }
    };
    for (int call = 0; call < 40; ++call) {
      file_some();
      if (unit(random) < 0.5) now += static_cast<std::uint64_t>(std::pow(10.0, 4.0 * unit(random)));
      const auto most = static_cast<std::size_t>(random() % 20);
      std::vector<std::uint32_t> taken;
      const bool ended = calendar.take_due(
          now, [&](std::uint32_t item) { taken.push_back(item); }, [&] { return taken.size() >= most; });
      for (const std::uint32_t item : taken) {
        ASSERT_EQ(due.count(item), 1u);
        ASSERT_LE(due[item], now);
        due.erase(item);
      }
      ASSERT_LE(taken.size(), most);
      std::uint64_t least = ~0ull;
      for (const auto& [item, tick] : due) {
        ASSERT_TRUE(calendar.is_filed(item)) << "an item is lost";
        ASSERT_TRUE(!ended || tick > now) << "an item is overdue";
        least = std::min(least, tick);
      }
      ASSERT_LE(calendar.certain(), std::max(least, now + 1)) << "a tick before which no item is due";
      stops += ended ? 0 : 1;
    }
    std::size_t left = 0;
    calendar.take_due(~0ull >> 4, [&](std::uint32_t) { ++left; });
    EXPECT_EQ(left, due.size());
  }
  EXPECT_GT(stops, 1000);
}

/// A stop puts the rest of a list behind what the visitor has filed there: nothing of either is lost.
TEST(DueCalendar, KeepsWhatItsVisitorFilesIntoAListThatIsStopped) {
  const SampledBody body = ball_body();
  const Pointshell& shell = body.pointshell();
  for (const std::uint64_t again : {50u, 0u, 50u + 2048u}) {  // due at once, and in the list's next turn
    for (std::size_t most = 0; most <= 8; ++most) {
      std::vector<std::uint32_t> memory(DueCalendar::memory(shell));
      DueCalendar calendar;
      calendar.start(memory, shell);
      calendar.take(0);
      for (std::uint32_t item = 1; item <= 8; ++item) calendar.file(item, 50);
      std::set<std::uint32_t> visited;
      const bool ended = calendar.take_due(
          60,
          [&](std::uint32_t item) {
            EXPECT_TRUE(visited.insert(item).second) << "twice";
            calendar.file(item, again);
          },
          [&] { return visited.size() >= most; });
      EXPECT_EQ(ended, most == 8 && visited.size() == 8);
      EXPECT_EQ(visited.size(), most);
      std::set<std::uint32_t> later;
      calendar.take_due(~0ull >> 4, [&](std::uint32_t item) { EXPECT_TRUE(later.insert(item).second) << "twice"; });
      EXPECT_EQ(later, (std::set<std::uint32_t>{1, 2, 3, 4, 5, 6, 7, 8})) << again << ' ' << most;
    }
  }
}

/// The calendar may jump by any number of ticks. A search then looks at one item too many at worst.
TEST(DueCalendar, LosesNothingInAnyJump) {
  const SampledBody body = ball_body();
  for (int power = 0; power < 60; ++power) {
    std::vector<std::uint32_t> memory(DueCalendar::memory(body.pointshell()));
    DueCalendar calendar;
    calendar.start(memory, body.pointshell());
    calendar.take_due(10, [](std::uint32_t) {});
    calendar.file(0, 5);
    calendar.file(1, 15);
    calendar.file(2, 5000);
    calendar.file(3, 1ull << 29);
    const std::uint64_t now = 10 + (1ull << power);
    int taken = 0;
    calendar.take_due(now, [&](std::uint32_t) { ++taken; });
    EXPECT_EQ(taken, 1 + (now >= 15 ? 1 : 0) + (now >= 5000 ? 1 : 0) + (now >= 1ull << 29 ? 1 : 0)) << power;
  }
}

TEST(DueCalendar, KnowsTheChildrenAndTheirParent) {
  const SampledBody body = ball_body();
  const Pointshell& shell = body.pointshell();
  std::vector<std::uint32_t> memory(DueCalendar::memory(shell));
  DueCalendar calendar;
  calendar.start(memory, shell);
  const auto nodes = static_cast<std::uint32_t>(shell.nodes.size());
  std::vector<int> seen(nodes + shell.size);
  for (std::uint32_t n = 0; n < nodes; ++n) {
    DueCalendar::for_each_child(shell, n, [&](std::uint32_t child) {
      ++seen[child];
      EXPECT_EQ(calendar.parent_of(child), n);
    });
  }
  EXPECT_EQ(seen[0], 0);
  for (std::size_t i = 1; i < seen.size(); ++i) ASSERT_EQ(seen[i], 1) << i;
}

TEST(DueCalendar, KnowsSpheresThatHoldTheirPoints) {
  const SampledBody body = ball_body();
  const Pointshell& shell = body.pointshell();
  std::vector<std::uint32_t> memory(DueCalendar::memory(shell));
  DueCalendar calendar;
  calendar.start(memory, shell);
  const auto nodes = static_cast<std::uint32_t>(shell.nodes.size());
  const auto center = [](const DueCalendar::Sphere& s) {
    return Vector3(static_cast<double>(s.x), static_cast<double>(s.y), static_cast<double>(s.z));
  };
  for (std::uint32_t n = 0; n < nodes; ++n) {
    const DueCalendar::Sphere sphere = calendar.sphere_of(n);
    const format::Node& node = shell.nodes[n];
    ASSERT_GE(static_cast<double>(sphere.radius), radius_of(node));
    ASSERT_LE(static_cast<double>(sphere.radius), 1.0001 * radius_of(node));
    for (std::uint32_t i = node.first_point; i < node.first_point + node.point_count; ++i) {
      ASSERT_LE((shell.point(i) - center(sphere)).norm(), static_cast<double>(sphere.radius)) << n << ' ' << i;
    }
  }
  for (std::uint32_t i = 0; i < shell.size; ++i) {
    const DueCalendar::Sphere sphere = calendar.sphere_of(nodes + i);
    ASSERT_EQ(center(sphere), shell.point(i));
    ASSERT_EQ(sphere.radius, 0.0f);
  }
}

TEST(DueCalendar, GivesMarkedPointsOnceAndInOrder) {
  const SampledBody body = ball_body();
  std::vector<std::uint32_t> memory(DueCalendar::memory(body.pointshell()));
  DueCalendar calendar;
  calendar.start(memory, body.pointshell());
  calendar.take(0);
  calendar.file(0, 100);
  EXPECT_EQ(calendar.certain(), 100u);
  const auto points = static_cast<std::uint32_t>(body.pointshell().size);
  for (const std::uint32_t point : {points - 1, 31u, 0u, 32u, 31u, 63u}) calendar.mark(point);
  EXPECT_EQ(calendar.marked(), 5u);
  EXPECT_EQ(calendar.certain(), 0u) << "marked points are due";
  std::vector<std::uint32_t> given;
  const auto unmark_some = [&](std::uint32_t point) {
    given.push_back(point);
    if (point != 32) calendar.unmark(point);
  };
  calendar.for_each_marked(unmark_some);
  EXPECT_EQ(given, (std::vector<std::uint32_t>{0, 31, 32, 63, points - 1}));
  EXPECT_EQ(calendar.marked(), 1u);
  given.clear();
  calendar.for_each_marked([&](std::uint32_t point) {
    given.push_back(point);
    calendar.unmark(point);
  });
  EXPECT_EQ(given, (std::vector<std::uint32_t>{32}));
  EXPECT_EQ(calendar.certain(), 100u);
  calendar.for_each_marked([](std::uint32_t) { FAIL() << "a point is still marked"; });
}

/// A search that doubles its radius looks farther ahead and then less far again. This must cost nothing later.
TEST(DueCalendar, GoesBackAndVisitsNothingTwice) {
  const SampledBody body = ball_body();
  std::vector<std::uint32_t> memory(DueCalendar::memory(body.pointshell()));
  DueCalendar calendar;
  calendar.start(memory, body.pointshell());
  calendar.take(0);
  calendar.take_due(64, [](std::uint32_t) { FAIL() << "no item is filed"; });
  calendar.file(0, 50);
  EXPECT_EQ(calendar.certain(), 0u) << "the item is due already";
  calendar.take_due(10, [](std::uint32_t) { FAIL() << "the item is not due at this tick"; });
  EXPECT_EQ(calendar.certain(), 50u);
  calendar.take_due(49, [](std::uint32_t) { FAIL() << "the item is not due at this tick"; });
  int taken = 0;
  calendar.take_due(50, [&](std::uint32_t) { ++taken; });
  EXPECT_EQ(taken, 1);
}

/// All items are at most 2000 ticks ahead, so that each is in the list of its own tick.
TEST(DueCalendar, KnowsTheNextDueTick) {
  const SceneImage image = ball_over_plate();
  const Pointshell& shell = open_scene(image).pointshell;
  const auto items = static_cast<std::uint32_t>(shell.nodes.size() + shell.size);
  std::vector<std::uint32_t> memory(DueCalendar::memory(shell));
  DueCalendar calendar;
  calendar.start(memory, shell);
  EXPECT_EQ(calendar.certain(), 0u) << "the root is due at once";
  calendar.take(0);
  EXPECT_EQ(calendar.certain(), 2047u) << "nothing is filed: all ticks that have a list";
  std::mt19937_64 random(5);
  std::map<std::uint32_t, std::uint64_t> due;
  std::uint64_t now = 0;
  for (int step = 0; step < 5000; ++step) {
    const std::uint64_t most = step % 3 == 0 ? 2000 : 20;
    for (std::uint64_t k = random() % 4; k > 0; --k) {
      const auto item = static_cast<std::uint32_t>(random() % items);
      if (calendar.is_filed(item)) continue;
      due[item] = now + 1 + random() % most;
      calendar.file(item, due[item]);
    }
    if (!due.empty() && random() % 4 == 0) {
      auto at = due.begin();
      std::advance(at, static_cast<std::ptrdiff_t>(random() % due.size()));
      calendar.take(at->first);
      ASSERT_FALSE(calendar.is_filed(at->first));
      due.erase(at);
    }
    std::uint64_t least = now + 2047;
    for (const auto& [item, tick] : due) least = std::min(least, tick);
    ASSERT_EQ(calendar.certain(), least) << step;
    now += random() % 60;
    calendar.take_due(now, [&](std::uint32_t item) {
      ASSERT_LE(due.at(item), now);
      due.erase(item);
    });
    for (const auto& [item, tick] : due) ASSERT_GT(tick, now);
  }
}

/// A chain is last in, first out; an item is in it once, and is not filed meanwhile.
TEST(DueCalendar, ChainsItemsOnce) {
  const SampledBody body = ball_body();
  std::vector<std::uint32_t> memory(DueCalendar::memory(body.pointshell()));
  DueCalendar calendar;
  calendar.start(memory, body.pointshell());
  std::uint32_t chain = DueCalendar::kNone;
  for (const std::uint32_t item : {5u, 9u, 5u, 7u, 9u, 7u}) calendar.push(chain, item);
  for (const std::uint32_t expected : {7u, 9u, 5u}) {
    EXPECT_FALSE(calendar.is_filed(expected));
    ASSERT_EQ(calendar.pop(chain), expected);
    EXPECT_FALSE(calendar.is_filed(expected));
  }
  EXPECT_EQ(chain, DueCalendar::kNone);
  calendar.push(chain, 9);
  EXPECT_EQ(calendar.pop(chain), 9u) << "an item that left may come again";
  calendar.file(9, 3);
  EXPECT_TRUE(calendar.is_filed(9));
}

/// The memory may begin at any address. The calendar writes all of it at most, and nothing beside it.
TEST(DueCalendar, WritesOnlyIntoItsMemory) {
  constexpr std::uint32_t kGuard = 0xabad1deau;
  const SceneImage image = ball_over_plate();
  const Pointshell& shell = open_scene(image).pointshell;
  const auto points = static_cast<std::uint32_t>(shell.size);
  const auto nodes = static_cast<std::uint32_t>(shell.nodes.size());
  const std::size_t size = DueCalendar::memory(shell);
  for (std::size_t offset = 0; offset < 16; ++offset) {
    std::vector<std::uint32_t> words(offset + size + 16, kGuard);
    DueCalendar calendar;
    calendar.start(std::span(words).subspan(offset, size), shell);
    calendar.take(0);
    for (std::uint32_t i = 0; i < nodes + points; ++i) calendar.file(i, 1 + i % 100);
    for (std::uint32_t i = 0; i < points; ++i) calendar.mark(i);
    EXPECT_EQ(calendar.marked(), points);
    int taken = 0;
    calendar.take_due(1000, [&](std::uint32_t) { ++taken; });
    EXPECT_EQ(taken, static_cast<int>(nodes + points));
    std::uint32_t next = 0;
    calendar.for_each_marked([&](std::uint32_t point) {
      ASSERT_EQ(point, next++);
      calendar.unmark(point);
    });
    EXPECT_EQ(next, points);
    EXPECT_EQ(calendar.marked(), 0u);
    calendar.for_each_marked([](std::uint32_t) { FAIL() << "all are unmarked"; });
    for (std::size_t i = 0; i < offset; ++i) ASSERT_EQ(words[i], kGuard) << "written in front of it";
    for (std::size_t i = offset + size; i < words.size(); ++i) ASSERT_EQ(words[i], kGuard) << "written behind it";
  }
}

/// The memory of another session does not matter.
TEST(DueCalendar, StartsAnewWithUsedMemory) {
  const SceneImage image = ball_over_plate();
  const Pointshell& shell = open_scene(image).pointshell;
  for (const std::uint32_t old : {0u, 1u, 0xfffffffeu, ~0u}) {
    std::vector<std::uint32_t> memory(DueCalendar::memory(shell), old);
    DueCalendar calendar;
    calendar.start(memory, shell);
    for (int again = 0; again < 2; ++again) {
      EXPECT_EQ(calendar.marked(), 0u);
      calendar.for_each_marked([](std::uint32_t) { FAIL() << "no point is marked yet"; });
      EXPECT_EQ(calendar.parent_of(0), DueCalendar::kNone);
      for (std::uint32_t item = 0; item < shell.nodes.size() + shell.size; ++item) {
        ASSERT_EQ(calendar.is_filed(item), item == 0) << item;
      }
      calendar.take(0);
      EXPECT_EQ(calendar.certain(), 2047u) << "no item of the last session is filed";
      calendar.file(0, 0);
      EXPECT_EQ(calendar.certain(), 0u);
      int taken = 0;
      calendar.take_due(0, [&](std::uint32_t item) {
        EXPECT_EQ(item, 0u);
        ++taken;
      });
      EXPECT_EQ(taken, 1) << "the root is due";
      for (const std::uint32_t item : {0u, 3u, 4u}) calendar.file(item, 100 * item);
      calendar.mark(7);
      calendar.mark(300);
      calendar.take_due(350, [](std::uint32_t) {});
      calendar.start(memory, shell);
    }
  }
}

/// Ticks farther ahead than all lists share the last one.
TEST(DueCalendar, KnowsTheTickOfOneItemUpToTheLastList) {
  const SampledBody body = ball_body();
  std::vector<std::uint32_t> memory(DueCalendar::memory(body.pointshell()));
  DueCalendar calendar;
  for (const std::uint64_t from : {0ull, 1ull, 63ull, 64ull, 2047ull, 5000ull}) {
    for (const std::uint64_t ahead : {1ull, 2ull, 63ull, 64ull, 65ull, 2046ull, 2047ull, 2048ull, 2049ull, 2050ull,
                                      3000ull, 5000ull, 1ull << 20, 1ull << 29, 1ull << 40}) {
      calendar.start(memory, body.pointshell());
      calendar.take(0);
      calendar.take_due(from, [](std::uint32_t) { FAIL() << "no item is filed"; });
      calendar.file(5, from + ahead);
      EXPECT_EQ(calendar.certain(), from + std::min<std::uint64_t>(ahead, 2047)) << from << ' ' << ahead;
      // 32 bits hold up to 2^30 ticks
      const std::uint64_t due = from + std::min<std::uint64_t>(ahead, 1ull << 30);
      calendar.take_due(due - 1, [](std::uint32_t) { FAIL() << "not due yet"; });
      int taken = 0;
      calendar.take_due(due, [&](std::uint32_t) { ++taken; });
      EXPECT_EQ(taken, 1) << from << ' ' << ahead;
    }
  }
}

/// An item in the last list stays there until its turn: the lists in front of it are visited, and no others.
TEST(DueCalendar, LeavesListsAloneThatAreNotDue) {
  const SampledBody body = ball_body();
  std::vector<std::uint32_t> memory(DueCalendar::memory(body.pointshell()));
  DueCalendar calendar;
  calendar.start(memory, body.pointshell());
  calendar.take(0);
  calendar.take_due(1100, [](std::uint32_t) { FAIL() << "no item is filed"; });
  calendar.file(7, 9000);
  const unsigned long long last_list = 1100 + 2047;
  for (const std::uint64_t now : {1100ull, 1200ull, 2000ull, 3000ull, 3120ull, 3140ull, last_list - 1}) {
    calendar.take_due(now, [](std::uint32_t) { FAIL() << "not due yet"; });
    EXPECT_EQ(calendar.certain(), last_list) << now;
  }
  calendar.take_due(last_list, [](std::uint32_t) { FAIL() << "not due yet"; });
  EXPECT_EQ(calendar.certain(), last_list + 2047) << "filed again";
}

/// An item that was filed before the calendar went back may be due later than 32 bits tell from there.
TEST(DueCalendar, TakesNothingEarlyAfterItWentBack) {
  const SampledBody body = ball_body();
  std::vector<std::uint32_t> memory(DueCalendar::memory(body.pointshell()));
  DueCalendar calendar;
  calendar.start(memory, body.pointshell());
  calendar.take(0);
  calendar.take_due(1000, [](std::uint32_t) { FAIL() << "no item is filed"; });
  constexpr std::uint64_t kMostAhead = 1ull << 30;
  calendar.file(3, 1000 + kMostAhead);
  for (const std::uint64_t now : {std::uint64_t{0}, kMostAhead, kMostAhead + 999}) {
    calendar.take_due(now, [](std::uint32_t) { FAIL() << "not due yet"; });
    EXPECT_TRUE(calendar.is_filed(3));
  }
  int taken = 0;
  calendar.take_due(kMostAhead + 1000, [&](std::uint32_t) { ++taken; });
  EXPECT_EQ(taken, 1);
}

/// Marks of many points, which take several words of words, against a set.
TEST(DueCalendar, KeepsTheMarksOfManyPoints) {
  const SampledBody body = ball_body(0.02, 5000);
  const Pointshell& shell = body.pointshell();
  std::vector<std::uint32_t> memory(DueCalendar::memory(shell));
  DueCalendar calendar;
  calendar.start(memory, shell);
  std::mt19937_64 random(7);
  std::set<std::uint32_t> marks;
  for (int step = 0; step < 3000; ++step) {
    // often at the ends of words
    const std::uint64_t word = 32 * (random() % (shell.size / 32));
    const auto point = static_cast<std::uint32_t>(step % 2 == 0 ? word + 31 * (random() % 2) : random() % shell.size);
    if (marks.count(point) != 0 && random() % 8 != 0) {
      calendar.unmark(point);
      marks.erase(point);
    } else {
      calendar.mark(point);
      marks.insert(point);
    }
    if (step % 200 == 199) {
      // leave a few: whole words become empty
      while (marks.size() > 5) {
        calendar.unmark(*marks.begin());
        marks.erase(marks.begin());
      }
    }
    ASSERT_EQ(calendar.marked(), marks.size());
    auto next = marks.begin();
    calendar.for_each_marked([&](std::uint32_t given) {
      ASSERT_NE(next, marks.end()) << step;
      ASSERT_EQ(given, *next++) << step;
    });
    ASSERT_EQ(next, marks.end()) << step;
  }
}

TEST(DueCalendar, StartsWithoutAnItem) {
  DueCalendar calendar;
  calendar.start({}, Pointshell{});
  EXPECT_EQ(calendar.marked(), 0u);
  EXPECT_EQ(calendar.certain(), 2047u);
  calendar.take_due(100, [](std::uint32_t) { FAIL() << "there is no item"; });
}

/// A shell of one point has one node, the root. By hand: the two items take 8 words each, which lie in one cache line
/// if they begin at a multiple of 8 words, so 7 words may stay unused; a bit for the mark of the point, and one for the
/// word of that bit, take a word each.
TEST(DueCalendar, HoldsAShellOfOnePoint) {
  const SampledBody body({{Vector3(0.1, 0.2, 0.3)}, {-Vector3::UnitZ()}}, Vector3::Constant(1e-4));
  const Pointshell shell = body.pointshell();
  ASSERT_EQ(shell.nodes.size(), 1u);
  EXPECT_EQ(DueCalendar::memory(shell), 7u + 2u * 8u + 1u + 1u);
  for (const std::uint32_t old : {0u, 1u, 0xfffffffeu, ~0u}) {
    for (std::size_t offset = 0; offset < 8; ++offset) {
      std::vector<std::uint32_t> words(offset + DueCalendar::memory(shell), old);
      DueCalendar calendar;
      calendar.start(std::span(words).subspan(offset), shell);
      EXPECT_EQ(calendar.parent_of(0), DueCalendar::kNone);
      EXPECT_EQ(calendar.parent_of(1), 0u);
      EXPECT_TRUE(calendar.is_filed(0));
      EXPECT_FALSE(calendar.is_filed(1));
      EXPECT_EQ(calendar.marked(), 0u);
      int taken = 0;
      calendar.take_due(0, [&](std::uint32_t item) { taken += item == 0 ? 1 : 100; });
      EXPECT_EQ(taken, 1);
    }
  }
}

TEST(DueCalendar, NeedsNoMemoryForAnEmptyShell) { EXPECT_EQ(DueCalendar::memory(Pointshell{}), 0u); }

}  // namespace
}  // namespace godobject::test::due_calendar_test
