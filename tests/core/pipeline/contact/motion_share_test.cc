// The share of a sub-step's motion that the next attempt tries.
#include "core/pipeline/contact/motion_share.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/pipeline/contact/second_look.h"

namespace godobject::detail::motion_share_test {
namespace {

TEST(MotionShare, OfAWholeMotionIsNotCut) {
  const MotionShare share(1.0);
  EXPECT_TRUE(share.is_whole());
  EXPECT_FALSE(share.is_cut());
  EXPECT_FALSE(share.is_stopped());
  EXPECT_EQ(share.looks_left(), kMostSecondLooks);
}

TEST(MotionShare, ThatStopsAFreeMotionIsNotCut) {
  MotionShare share(1.0);
  share.stop_at(0.25);
  EXPECT_EQ(share.value(), 0.25);
  EXPECT_TRUE(share.is_stopped());
  EXPECT_FALSE(share.is_cut());
}

/// The rest of a motion that an obstacle shortened is still to be done.
TEST(MotionShare, ThatStopsAShortenedMotionIsCut) {
  MotionShare share(1.0);
  ASSERT_TRUE(share.next());
  share.halve();
  share.stop_at(0.25);
  EXPECT_TRUE(share.is_stopped());
  EXPECT_TRUE(share.is_cut());
}

TEST(MotionShare, ForgetsTheStopAfterASecondLookAndWhenShortened) {
  MotionShare share(1.0);
  share.stop_at(0.5);
  share.look_again(1.0);
  EXPECT_FALSE(share.is_stopped());
  EXPECT_FALSE(share.is_cut());
  EXPECT_EQ(share.looks_left(), kMostSecondLooks - 1);
  share.stop_at(0.5);
  share.halve();
  EXPECT_EQ(share.value(), 0.25);
  EXPECT_FALSE(share.is_stopped());
  EXPECT_TRUE(share.is_cut());
}

TEST(MotionShare, IsLimitedOnlyDownwards) {
  MotionShare share(0.5);
  share.limit_to(0.75);
  EXPECT_EQ(share.value(), 0.5);
  share.limit_to(0.125);
  EXPECT_DOUBLE_EQ(share.value(), 0.125);
}

/// While second looks remain the wanted margin holds, then the least one.
TEST(MotionShare, GivesUpTheWantedMarginWithTheLastLook) {
  ContactLengths lengths{};
  lengths.wanted_margin = 3.0;
  lengths.least_margin = 1.0;
  MotionShare share(1.0);
  for (int look = 0; look < kMostSecondLooks; ++look) {
    EXPECT_EQ(share.least_gap(lengths), 3.0);
    share.look_again(1.0);
  }
  EXPECT_EQ(share.least_gap(lengths), 1.0);
  MotionShare other(1.0);
  other.shrink_at_obstacle();
  EXPECT_EQ(other.looks_left(), 0);
  EXPECT_EQ(other.least_gap(lengths), 1.0);
}

TEST(MotionShare, EndsAfterTheMostAttempts) {
  MotionShare share(1.0);
  int attempts = 0;
  while (share.next()) {
    ++attempts;
    EXPECT_EQ(share.has_next(), attempts < kMostAttempts);
  }
  EXPECT_EQ(attempts, kMostAttempts);
}

/// Early attempts at an obstacle halve the motion, later ones leave a quarter.
TEST(MotionShare, ShortensFasterInLaterAttempts) {
  MotionShare share(1.0);
  for (int attempt = 1; attempt <= kMostSecondLooks; ++attempt) ASSERT_TRUE(share.next());
  share.shrink_at_obstacle();
  EXPECT_EQ(share.value(), 0.5);
  ASSERT_TRUE(share.next());
  share.shrink_at_obstacle();
  EXPECT_EQ(share.value(), 0.125);
  share.shrink_to(0.9);
  EXPECT_DOUBLE_EQ(share.value(), 0.25 * 0.125);
}

/// By hand, with a margin of 10 mm.
TEST(ExpectedDistance, ByHand) {
  ContactLengths lengths{};
  lengths.margin = 0.01;
  // the row of the nearest surface: the gap closes to the margin, or a lost one recovers by 0.3 of 6 mm
  EXPECT_NEAR(expected_distance(lengths, 0.02, -0.01), 0.01, 1e-15);
  EXPECT_NEAR(expected_distance(lengths, 0.004, 0.0018), 0.0058, 1e-15);
  // a row without its required gain: the gap stays
  EXPECT_NEAR(expected_distance(lengths, 0.004, 0.0), 0.004, 1e-15);
  // rows of another face: the gap of that face was larger
  EXPECT_NEAR(expected_distance(lengths, 0.02, -0.05), 0.01, 1e-15);
  EXPECT_NEAR(expected_distance(lengths, 0.004, -0.05), 0.004, 1e-15);
  // a row that makes up for an arc
  EXPECT_NEAR(expected_distance(lengths, 0.02, 0.003), 0.01, 1e-15);
  EXPECT_NEAR(expected_distance(lengths, 0.004, 0.003), 0.0058, 1e-15);
}

/// By hand, in m^2. The aim is 5 m away and the motion leads 3 m towards it, from 25 m^2 to 4 m^2: by -21. A third of
/// it leads to 16 m^2: by -9, of which a quarter counts.
TEST(MostArcGain, IsAQuarterOfWhatTheTriedShareGains) {
  EXPECT_NEAR(most_arc_gain(-21.0, 9.0, 1.0), -21.0 / 4.0, 1e-14);
  EXPECT_NEAR(most_arc_gain(-21.0, 9.0, 1.0 / 3.0), -9.0 / 4.0, 1e-14);
  // across the aim's direction, and away from it
  EXPECT_EQ(most_arc_gain(9.0, 9.0, 1.0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(most_arc_gain(39.0, 9.0, 0.5), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace godobject::detail::motion_share_test
