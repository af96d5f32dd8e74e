#include "hal/cia402/parameters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/support/random.h"

namespace godobject::hal::cia402 {
namespace {

using enum ParameterStep::Kind;

constexpr std::uint32_t kAll = 0xFFFFFFFF;

bool operator==(const ParameterStep& a, const ParameterStep& b) {
  const auto all = [](const ParameterStep& s) {
    return std::tuple(s.kind, s.index, s.subindex, s.size, s.value, s.mask, s.tolerance, s.or_more);
  };
  return all(a) == all(b);
}

std::string text(const ParameterStep& step) {
  constexpr std::array<const char*, 4> kNames = {"expect", "write", "expect if there", "write if there"};
  std::ostringstream out;
  out << kNames.at(static_cast<std::size_t>(step.kind)) << ' ' << std::hex << step.index << ':' << int{step.subindex}
      << std::dec << ' ' << step.size << " bytes " << std::hex << step.value << " mask " << step.mask << std::dec
      << " tolerance " << step.tolerance << (step.or_more ? " or more" : "");
  return out.str();
}

bool is_write(const ParameterStep& step) { return step.kind == kWrite || step.kind == kWriteIfThere; }

/// Node 5 with a motor of 32.1 Nm rated, at a gear of -20 with a joint limit of 963 Nm: 642 Nm are 1000 permille.
BusLayout layout_of_drive() {
  BusLayout layout;
  layout.joint_count = 1;
  layout.drives[0] = {.bus = 0, .node = 5, .gear = -20.0, .rated_torque = 32.1, .torque_limit = 963.0};
  layout.command_deadline = 1e-3;
  layout.drive_heartbeat = 25e-3;
  layout.heartbeat_timeout = 70e-3;
  layout.mode_refresh = 0.5;
  layout.panel = {.bus = 0, .node = 0x21};
  return layout;
}

/// Objects, sizes and bits by CiA 301 and CiA 402; their order by CiA 301: a PDO is mapped while it is invalid and its
/// mapping is empty.
std::vector<ParameterStep> steps_of_drive() {
  return {
      {kExpect, 0x1000, 0, 4, 402, 0xFFFF},                 // profile
      {kExpect, 0x6502, 0, 4, 1u << 9, 1u << 9},            // cyclic synchronous torque mode
      {kExpect, 0x6076, 0, 4, 32100, kAll, 321},            // mNm, within a hundredth
      {kExpect, 0x6071, 0, 2, 0, 0},                        // any value of this size
      {kExpect, 0x6077, 0, 2, 0, 0},                        //
      {kExpect, 0x6064, 0, 4, 0, 0},                        //
      {kExpect, 0x1005, 0, 4, 0x80, 0x400007FF},            // SYNC's identifier; bit 30: makes SYNC
      {kWriteIfThere, 0x1006, 0, 4, 1000},                  // us
      {kExpectIfThere, 0x1014, 0, 4, 0x85, 0x800007FF},     // EMCY, valid
      {kExpectIfThere, 0x1019, 0, 1, 0},                    //
      {kExpectIfThere, 0x607E, 0, 1, 0},                    //
      {kExpectIfThere, 0x6072, 0, 2, 1500, kAll, 0, true},  // permille
      {kExpectIfThere, 0x60E0, 0, 2, 1500, kAll, 0, true},
      {kExpectIfThere, 0x60E1, 0, 2, 1500, kAll, 0, true},
      {kExpect, 0x6085, 0, 4, 1, kAll, 0, true},
      {kWriteIfThere, 0x1401, 1, 4, 0x80000305},  // bit 31: no such PDO
      {kWriteIfThere, 0x1402, 1, 4, 0x80000405},
      {kWriteIfThere, 0x1403, 1, 4, 0x80000505},
      {kWriteIfThere, 0x1802, 1, 4, 0x80000385},
      {kWriteIfThere, 0x1803, 1, 4, 0x80000485},
      {kWrite, 0x1400, 1, 4, 0x80000205},
      {kWrite, 0x1600, 0, 1, 0},
      {kWrite, 0x1600, 1, 4, 0x60400010},  // index, subindex, bits
      {kWrite, 0x1600, 2, 4, 0x60710010},
      {kWrite, 0x1600, 0, 1, 2},
      {kWrite, 0x1400, 2, 1, 255},
      {kWrite, 0x1400, 5, 2, 1},  // ms
      {kWrite, 0x1400, 1, 4, 0x205},
      {kWrite, 0x1800, 1, 4, 0x80000185},
      {kWrite, 0x1A00, 0, 1, 0},
      {kWrite, 0x1A00, 1, 4, 0x60410010},
      {kWrite, 0x1A00, 2, 4, 0x60640020},
      {kWrite, 0x1A00, 3, 4, 0x60770010},
      {kWrite, 0x1A00, 0, 1, 3},
      {kWrite, 0x1800, 2, 1, 1},  // with each SYNC
      {kWrite, 0x1800, 1, 4, 0x185},
      {kWrite, 0x1801, 1, 4, 0x80000285},
      {kWrite, 0x1A01, 0, 1, 0},
      {kWrite, 0x1A01, 1, 4, 0x60610008},
      {kWrite, 0x1A01, 0, 1, 1},
      {kWrite, 0x1801, 2, 1, 255},
      {kWriteIfThere, 0x1801, 3, 2, 0},  // no inhibit time
      {kWrite, 0x1801, 5, 2, 500},       // ms
      {kWrite, 0x1801, 1, 4, 0x285},
      {kWrite, 0x1016, 1, 4, 0x007F0046},  // node 127, 70 ms
      {kWrite, 0x1017, 0, 2, 25},          // ms
      {kWrite, 0x1029, 1, 1, 1},           // no change of the NMT state
      {kWrite, 0x6007, 0, 2, 3},           // quick stop
      {kWrite, 0x605A, 0, 2, 2},           // quick-stop ramp, then switch-on disabled
      {kWrite, 0x605E, 0, 2, 2},           // quick-stop ramp
      {kWriteIfThere, 0x60C2, 1, 1, 1},
      {kWriteIfThere, 0x60C2, 2, 1, 0xFD},  // -3
      {kWrite, 0x6060, 0, 1, 10},
  };
}

std::vector<ParameterStep> steps_of_panel() {
  return {
      {kExpect, 0x1000, 0, 4, 0x10191, 0x1FFFF},  // CiA 401 with digital inputs
      {kExpect, 0x6000, 1, 1, 0, 0},
      {kExpect, 0x1005, 0, 4, 0x80, 0x400007FF},
      {kExpectIfThere, 0x1019, 0, 1, 0},
      {kExpectIfThere, 0x6002, 1, 1, 0},
      {kWrite, 0x1800, 1, 4, 0x800001A1},
      {kWrite, 0x1A00, 0, 1, 0},
      {kWrite, 0x1A00, 1, 4, 0x60000108},
      {kWrite, 0x1A00, 0, 1, 1},
      {kWrite, 0x1800, 2, 1, 1},
      {kWrite, 0x1800, 1, 4, 0x1A1},
      {kWriteIfThere, 0x1016, 1, 4, 0x007F0046},
      {kWrite, 0x1017, 0, 2, 25},
  };
}

/// Bits of a written object that its node must keep. Of a PDO's COB-ID: the identifier and bit 31, no such PDO; of one
/// that does not exist only bit 31.
std::uint32_t bits_to_keep(const ParameterStep& write) {
  const bool is_cob = write.subindex == 1 && (write.index >> 8 == 0x14 || write.index >> 8 == 0x18);
  if (is_cob) return write.value >= 0x80000000 ? 0x80000000 : 0x800007FF;
  return write.size == 4 ? kAll : (1u << 8 * write.size) - 1;
}

/// The steps that must follow: each written object once, with its last value, in the order of these last writes.
std::vector<ParameterStep> read_backs_of(const std::vector<ParameterStep>& steps) {
  std::vector<ParameterStep> all;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const ParameterStep& write = steps[i];
    bool last = is_write(write);
    for (std::size_t later = i + 1; later < steps.size(); ++later) {
      last = last && std::pair(steps[later].index, steps[later].subindex) != std::pair(write.index, write.subindex);
    }
    if (!last) continue;
    ParameterStep read = write;
    read.kind = write.kind == kWrite ? kExpect : kExpectIfThere;
    read.mask = bits_to_keep(write);
    read.value &= read.mask;
    if (read.index == 0x6060) read.index = 0x6061;  // the mode requested, and the mode of the drive
    all.push_back(read);
  }
  return all;
}

void expect_steps(const ParameterSteps& found, std::vector<ParameterStep> expected) {
  const std::vector<ParameterStep> after = read_backs_of(expected);
  expected.insert(expected.end(), after.begin(), after.end());
  ASSERT_EQ(found.all().size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_TRUE(found.all()[i] == expected[i])
        << i << ": " << text(found.all()[i]) << "\nin place of " << text(expected[i]);
  }
}

TEST(Parameters, OfADriveAreThoseOfTheStandards) {
  const BusLayout layout = layout_of_drive();
  ParameterSteps steps;
  drive_steps(layout, layout.drives[0], steps);
  expect_steps(steps, steps_of_drive());
}

TEST(Parameters, OfThePanelAreThoseOfTheStandards) {
  ParameterSteps steps;
  panel_steps(layout_of_drive(), steps);
  expect_steps(steps, steps_of_panel());
}

TEST(Parameters, OfADriveFitIntoTheirCapacity) {
  ParameterSteps steps;
  drive_steps(BusLayout(), {.rated_torque = 1.0}, steps);
  EXPECT_EQ(steps.all().size(), 86u);
  EXPECT_LT(steps.all().size(), ParameterSteps::kCapacity);
}

/// The watch expects the values that the start has written.
TEST(Parameters, WatchedOnesReadAsTheStartLeftThem) {
  const BusLayout layout = layout_of_drive();
  const std::array<ParameterStep, kWatchedCount> watched = watched_parameters(layout);
  const std::vector<ParameterStep> expected = {{kExpect, 0x1400, 5, 2, 1},          {kExpect, 0x1400, 2, 1, 255},
                                               {kExpect, 0x1016, 1, 4, 0x007F0046}, {kExpect, 0x6007, 0, 2, 3},
                                               {kExpect, 0x605A, 0, 2, 2},          {kExpect, 0x6061, 0, 1, 10}};
  ASSERT_EQ(watched.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_TRUE(watched[i] == expected[i]) << i << ": " << text(watched[i]);
  const std::vector<ParameterStep> written = read_backs_of(steps_of_drive());
  for (const ParameterStep& step : watched) {
    const auto same = [&](const ParameterStep& other) {
      return other.index == step.index && other.subindex == step.subindex && other.size == step.size &&
             other.value == step.value;
    };
    EXPECT_EQ(std::ranges::count_if(written, same), 1) << text(step);
  }
}

/// 60C2: sub-index 1 times ten to the power of sub-index 2, in seconds; both are one byte.
std::pair<std::uint32_t, int> interpolation_period(double period) {
  BusLayout layout;
  layout.period = period;
  ParameterSteps steps;
  drive_steps(layout, {.rated_torque = 1.0}, steps);
  std::array<std::uint32_t, 2> written{};
  for (const ParameterStep& step : steps.all()) {
    if (step.index == 0x60C2 && step.kind == kWriteIfThere) written.at(step.subindex - 1u) = step.value;
  }
  return {written[0], static_cast<std::int8_t>(written[1])};
}

TEST(Parameters, PeriodOf60C2) {
  EXPECT_EQ(interpolation_period(1e-3), std::pair(1u, -3));
  EXPECT_EQ(interpolation_period(2e-3), std::pair(2u, -3));
  EXPECT_EQ(interpolation_period(0.1), std::pair(100u, -3));
  EXPECT_EQ(interpolation_period(0.255), std::pair(255u, -3));
  EXPECT_EQ(interpolation_period(0.5e-3), std::pair(5u, -4));
  EXPECT_EQ(interpolation_period(0.25e-3), std::pair(25u, -5));
  EXPECT_EQ(interpolation_period(0.125e-3), std::pair(125u, -6));
  EXPECT_EQ(interpolation_period(25.5e-3), std::pair(255u, -4));
  EXPECT_EQ(interpolation_period(1.0005e-3), std::pair(100u, -5)) << "as many digits as a byte holds";
}

TEST(Parameters, PeriodOf60C2IsTheNearestThatItsByteHolds) {
  test::Random random(5);
  for (int k = 0; k < 2000; ++k) {
    const double period = std::pow(10.0, random.between(-4.0, std::log10(0.255)));
    const auto [count, exponent] = interpolation_period(period);
    ASSERT_LE(count, 255u) << period;
    // at least 25.5 counts, unless it is exact before: half a count is 2 %
    ASSERT_NEAR(count * std::pow(10.0, exponent), period, 0.0197 * period) << count << ' ' << exponent;
  }
}

TEST(ParameterStep, AcceptsAValueWithinItsToleranceOnBothSides) {
  const ParameterStep step{kExpect, 0x6076, 0, 4, 1000, kAll, 10};
  EXPECT_FALSE(step.accepts(989));
  EXPECT_TRUE(step.accepts(990));
  EXPECT_TRUE(step.accepts(1000));
  EXPECT_TRUE(step.accepts(1010));
  EXPECT_FALSE(step.accepts(1011));
  EXPECT_FALSE(step.accepts(0));
  EXPECT_FALSE(step.accepts(kAll));
}

TEST(ParameterStep, AcceptsMoreOnlyWhereItMayBeMore) {
  const ParameterStep least{.size = 2, .value = 1500, .or_more = true};
  EXPECT_FALSE(least.accepts(1499));
  EXPECT_TRUE(least.accepts(1500));
  EXPECT_TRUE(least.accepts(1501));
  EXPECT_TRUE(least.accepts(kAll));
  EXPECT_FALSE(least.accepts(0));
}

TEST(ParameterStep, ComparesOnlyTheBitsOfItsMask) {
  const ParameterStep step{kExpect, 0x1005, 0, 4, 0x80, 0x400007FF};
  EXPECT_TRUE(step.accepts(0x00000080));
  EXPECT_TRUE(step.accepts(0xBFFFF880));  // all other bits
  EXPECT_FALSE(step.accepts(0x40000080));
  EXPECT_FALSE(step.accepts(0x00000081));
  EXPECT_FALSE(step.accepts(0x00000000));
  const ParameterStep any{kExpect, 0x6064, 0, 4, 0, 0};
  EXPECT_TRUE(any.accepts(0) && any.accepts(1) && any.accepts(kAll));
}

TEST(ParameterStep, IsOfTheSameObjectOnlyIfBothNumbersAgree) {
  const ParameterStep step{kWrite, 0x1400, 1, 4, 5};
  EXPECT_TRUE(step.is_of_same_object({kExpect, 0x1400, 1, 2, 6}));
  EXPECT_FALSE(step.is_of_same_object({kWrite, 0x1400, 2, 4, 5}));
  EXPECT_FALSE(step.is_of_same_object({kWrite, 0x1401, 1, 4, 5}));
}

}  // namespace
}  // namespace godobject::hal::cia402
