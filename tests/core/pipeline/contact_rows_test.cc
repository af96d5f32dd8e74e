#include "core/pipeline/contact_rows.h"

#include <memory>

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace godobject {
namespace {

TEST(ContactRows, FindTheRowThatIsViolatedMost) {
  constexpr double kTolerance = 1e-8;
  test::Random random(7);
  for (const int count : {0, 1, 5, 7, 8, 9, 63, 64, 65, 71, 128, 1000, static_cast<int>(ContactRows::kCapacity)}) {
    for (int trial = 0; trial < 20; ++trial) {
      const auto rows = std::make_unique<ContactRows>();
      for (int i = 0; i < count; ++i) {
        rows->push(static_cast<std::uint32_t>(i), random.direction(), random.in_cube(0.1), random.between(-1.0, 0.1));
      }
      const Motion motion = random.motion(0.1, 1.0);
      double largest = -1e300;
      std::uint32_t row = ContactRows::kNone;
      for (std::uint32_t i = 0; i < rows->count; ++i) {
        const Vector3 v = motion.translation + motion.rotation.cross(rows->point(i));
        const double violation = static_cast<double>(rows->need[i]) - rows->normal(i).dot(v);
        if (violation > largest) {
          largest = violation;
          row = i;
        }
      }
      const ContactRows::Violated found = rows->most_violated(motion, kTolerance);
      if (largest <= kTolerance) {
        EXPECT_EQ(found.row, ContactRows::kNone);
        continue;
      }
      EXPECT_EQ(found.row, row) << count;
      EXPECT_NEAR(found.violation, largest, 1e-6);
    }
  }
}

TEST(ContactRows, HaveNoViolatedRowWithinTheTolerance) {
  const auto rows = std::make_unique<ContactRows>();
  for (std::uint32_t i = 0; i < 100; ++i) rows->push(i, Vector3::UnitZ(), Vector3::Zero(), 1e-9);
  EXPECT_EQ(rows->most_violated(Motion{}, 1e-8).row, ContactRows::kNone);
  EXPECT_EQ(rows->most_violated(Motion{}, 1e-10).row, 0u);
}

}  // namespace
}  // namespace godobject
