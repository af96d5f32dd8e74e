#include "core/pipeline/contact/qp/contact_rows.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "godobject/pose.h"
#include "tests/support/random.h"

namespace godobject::contact_rows_test {
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
        const double violation = static_cast<double>(rows->required_gain[i]) - rows->normal(i).dot(v);
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

/// A batch gives the same rows as the definitions give for each contact alone.
TEST(ContactRows, TakeContactsInBatches) {
  constexpr GapLaw kGap{1e-5, 1e-8, 0.3, 5e-4};
  test::Random random(11);
  for (std::uint32_t count = 0; count <= ContactRows::Batch::kCapacity; ++count) {
    const auto rows = std::make_unique<ContactRows>();
    for (std::uint32_t i = 0; i < count % 7; ++i) rows->push(i, Vector3::UnitZ(), Vector3::Zero(), 0.0);
    const std::uint32_t first = rows->count;
    const Matrix3 R = exp_rotation(3.0 * random.in_cube(1.0)).toRotationMatrix();
    ContactRows::Batch batch;
    batch.count = count;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vector3 point = random.in_cube(0.1);
      const Vector3 gradient = random.between(0.01, 3.0) * random.direction();
      batch.id[i] = 1000 + i;
      batch.point_x[i] = point.x(), batch.point_y[i] = point.y(), batch.point_z[i] = point.z();
      batch.gradient_x[i] = gradient.x(), batch.gradient_y[i] = gradient.y(), batch.gradient_z[i] = gradient.z();
      batch.distance[i] = i % 5 == 0 ? 1e-5 + random.between(-1e-9, 1e-9) : random.between(-2e-3, 2e-3);
    }
    EXPECT_EQ(rows->push(batch, R, kGap), 0u);
    ASSERT_EQ(rows->count, first + count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vector3 gradient_S = R.transpose() * Vector3(batch.gradient_x[i], batch.gradient_y[i], batch.gradient_z[i]);
      const Vector3 point(batch.point_x[i], batch.point_y[i], batch.point_z[i]);
      const double lost = (1e-5 - batch.distance[i]) / gradient_S.norm();
      const double need = std::fabs(lost) <= 1e-8 ? 0.0 : (lost > 0.0 ? std::min(0.3 * lost, 5e-4) : lost);
      const std::uint32_t row = first + i;
      EXPECT_EQ(rows->id[row], 1000 + i);
      EXPECT_LE((rows->normal(row) - gradient_S.normalized()).norm(), 1e-7);
      EXPECT_LE((rows->point(row) - point).norm(), 1e-8);
      const Vector3 torque(static_cast<double>(rows->torque_x[row]), static_cast<double>(rows->torque_y[row]),
                           static_cast<double>(rows->torque_z[row]));
      EXPECT_LE((torque - point.cross(gradient_S.normalized())).norm(), 2e-8);
      EXPECT_NEAR(static_cast<double>(rows->required_gain[row]), need, 1e-7 * std::fabs(need) + 1e-12);
    }
  }
}

TEST(ContactRows, TakeOfABatchWhatTheyHaveRoomFor) {
  const auto rows = std::make_unique<ContactRows>();
  ContactRows::Batch batch;
  batch.count = 50;
  for (std::uint32_t i = 0; i < batch.count; ++i) {
    batch.id[i] = i;
    batch.point_x[i] = batch.point_y[i] = batch.point_z[i] = batch.distance[i] = 0.0;
    batch.gradient_x[i] = batch.gradient_y[i] = 0.0;
    batch.gradient_z[i] = 1.0;
  }
  std::uint32_t left_out = 0;
  for (int i = 0; i < 50; ++i) left_out += rows->push(batch, Matrix3::Identity(), {1e-5, 1e-8, 0.3, 5e-4});
  EXPECT_TRUE(rows->full());
  EXPECT_EQ(left_out, 50u * 50u - ContactRows::kCapacity);
}

TEST(ContactRows, FindTheNextRowOfAPoint) {
  for (const std::uint32_t count : {0u, 1u, 63u, 64u, 65u, 130u, 500u}) {
    const auto rows = std::make_unique<ContactRows>();
    for (std::uint32_t i = 0; i < count; ++i) rows->push(i % 100, Vector3::UnitZ(), Vector3::Zero(), 0.0);
    for (std::uint32_t id = 0; id < 110; ++id) {
      std::uint32_t next = 0;
      for (std::uint32_t i = 0; i <= count; ++i) {
        if (i < count && rows->id[i] != id) continue;
        ASSERT_EQ(rows->find(id, next), i) << "point not found; rows: " << count;
        next = i + 1;
      }
    }
  }
}

/// Rows of an earlier cycle may stand behind the last one, violated by any motion.
TEST(ContactRows, DoNotSeeRowsBehindTheLastOne) {
  for (std::uint32_t count = 1; count < 140; ++count) {
    const auto rows = std::make_unique<ContactRows>();
    for (std::uint32_t i = 0; i < 256; ++i) rows->push(i, Vector3::UnitZ(), Vector3::Zero(), 5.0);
    rows->count = 0;
    for (std::uint32_t most = 0; most < count; most += 7) {
      rows->count = 0;
      for (std::uint32_t i = 0; i < count; ++i) rows->push(i, Vector3::UnitZ(), Vector3::Zero(), i == most ? 2.0 : 1.0);
      const ContactRows::Violated found = rows->most_violated(Motion{}, 1e-8);
      ASSERT_EQ(found.row, most) << "of " << count;
      ASSERT_EQ(found.violation, 2.0);
      ASSERT_EQ(rows->find(200, 0), count) << "a row of an earlier cycle";
    }
  }
}

/// Of rows that are violated alike, the first one of the block counts.
TEST(ContactRows, FindTheFirstOfEqualRows) {
  const auto rows = std::make_unique<ContactRows>();
  for (std::uint32_t i = 0; i < 200; ++i) rows->push(7, Vector3::UnitZ(), Vector3::Zero(), i < 5 ? 0.0 : 1.0);
  EXPECT_EQ(rows->most_violated(Motion{}, 1e-8).row, 5u);
  for (std::uint32_t begin = 0; begin < 200; ++begin) ASSERT_EQ(rows->find(7, begin), begin);
}

/// A gap that differs from the margin by exactly the tolerance counts as the margin.
TEST(ContactRows, TakeAGapAtTheToleranceForTheMargin) {
  const GapLaw gap{0.0, 0.25, 0.5, 10.0};
  const double distances[] = {-0.25, 0.25, -0.375, 0.375, -100.0, -20.0};
  ContactRows::Batch batch;
  EXPECT_EQ(batch.count, 0u);
  batch.count = 6;
  for (std::uint32_t i = 0; i < batch.count; ++i) {
    batch.id[i] = i;
    batch.point_x[i] = batch.point_y[i] = batch.point_z[i] = 0.0;
    batch.gradient_x[i] = batch.gradient_y[i] = 0.0;
    batch.gradient_z[i] = 1.0;
    batch.distance[i] = distances[i];
  }
  const auto rows = std::make_unique<ContactRows>();
  ASSERT_EQ(rows->push(batch, Matrix3::Identity(), gap), 0u);
  for (std::uint32_t i = 0; i < 6; ++i) {
    EXPECT_EQ(static_cast<double>(rows->required_gain[i]), gap.required_gain(-distances[i])) << distances[i];
  }
}

}  // namespace
}  // namespace godobject::contact_rows_test
