#include "hal/cia402/temperature_watch.h"

#include <gtest/gtest.h>

#include <cmath>

namespace godobject::hal::cia402 {
namespace {

using canopen::SdoResponse;
using Kind = SdoResponse::Kind;

/// Tenths of a degree in 16 bits: a warning from 70 degrees on, a stop from 85 on.
constexpr TemperatureConfig kTenths{.index = 0x2310, .scale = 0.1, .warn = 70.0, .stop = 85.0};

SdoResponse answer(int tenths) {
  return {
      .node = 5, .kind = Kind::kRead, .index = 0x2310, .size = 2, .value = static_cast<std::uint32_t>(tenths) & 0xFFFF};
}

TEST(Temperature, IsTheValueInItsSizeWithItsSign) {
  const auto of = [](int size, bool is_signed, std::uint32_t value) {
    return celsius({.index = 0x2310, .size = size, .is_signed = is_signed, .scale = 0.5}, value);
  };
  EXPECT_EQ(of(1, true, 0x7F), 63.5);
  EXPECT_EQ(of(1, true, 0xFFFFFF80), -64.0);
  EXPECT_EQ(of(1, false, 0xFFFFFF80), 64.0);
  EXPECT_EQ(of(2, true, 0xABCDFFFE), -1.0) << "bytes beyond the size do not count";
  EXPECT_EQ(of(2, false, 0xABCDFFFE), 32767.0);
  EXPECT_EQ(of(4, true, 0xFFFFFFFE), -1.0);
  EXPECT_EQ(of(4, false, 0xFFFFFFFE), 2147483647.0);
}

TEST(TemperatureWatch, KnowsNothingAtFirst) {
  const TemperatureWatch watch(kTenths);
  EXPECT_TRUE(std::isnan(watch.celsius()));
  EXPECT_FALSE(watch.is_warm() || watch.is_lost());
  EXPECT_EQ(watch.alarm(), Alarm::kNone);
  EXPECT_FALSE(TemperatureWatch().config().exists());
}

/// At each limit and a tenth of a degree below it. Both states end when the drive has cooled down.
TEST(TemperatureWatch, WarnsAndStopsAtItsTemperatures) {
  TemperatureWatch watch(kTenths);
  struct Step {
    int tenths;
    bool warm;
    Alarm alarm;
  };
  for (const Step& step : {Step{-100, false, Alarm::kNone},
                           {699, false, Alarm::kNone},
                           {700, true, Alarm::kNone},
                           {849, true, Alarm::kNone},
                           {850, true, Alarm::kTooHot},
                           {1200, true, Alarm::kTooHot},
                           {849, true, Alarm::kNone},
                           {699, false, Alarm::kNone}}) {
    watch.take(answer(step.tenths));
    EXPECT_NEAR(watch.celsius(), 0.1 * step.tenths, 1e-12);
    EXPECT_EQ(watch.is_warm(), step.warm) << step.tenths;
    EXPECT_EQ(watch.alarm(), step.alarm) << step.tenths;
  }
}

/// No answer, an abort, a long transfer, a confirmed write and another size are all missing answers.
TEST(TemperatureWatch, WarnsOfAMissingAnswerAndStopsAtTheThirdInARow) {
  for (int kind = 0; kind < 5; ++kind) {
    TemperatureWatch watch(kTenths);
    watch.take(answer(300));
    SdoResponse bad = answer(300);
    if (kind == 1) bad.kind = Kind::kAborted;
    if (kind == 2) bad.kind = Kind::kLong;
    if (kind == 3) bad.kind = Kind::kWritten;
    if (kind == 4) bad.size = 4;
    const auto miss = [&] { kind == 0 ? watch.miss() : watch.take(bad); };
    for (int k = 1; k <= 5; ++k) {
      miss();
      EXPECT_TRUE(watch.is_lost());
      EXPECT_EQ(watch.alarm(), k < 3 ? Alarm::kNone : Alarm::kTemperatureLost) << kind << ' ' << k;
    }
    watch.take(answer(300));
    EXPECT_FALSE(watch.is_lost());
    EXPECT_EQ(watch.alarm(), Alarm::kNone) << "one answer ends it";
    miss();
    miss();
    watch.take(answer(300));
    miss();
    EXPECT_EQ(watch.alarm(), Alarm::kNone) << "not in a row";
  }
}

TEST(TemperatureWatch, TakesAnAnswerThatDoesNotTellItsSize) {
  TemperatureWatch watch(kTenths);
  SdoResponse response = answer(-50);
  response.size = 0;
  watch.take(response);
  EXPECT_NEAR(watch.celsius(), -5.0, 1e-12);
  EXPECT_FALSE(watch.is_lost());
}

/// Silence is worse than the last temperature: a drive that was warm and falls silent is not taken for a cool one.
TEST(TemperatureWatch, StaysHotWhileItIsSilent) {
  TemperatureWatch watch(kTenths);
  watch.take(answer(860));
  watch.miss();
  EXPECT_EQ(watch.alarm(), Alarm::kTooHot);
  EXPECT_TRUE(watch.is_warm());
}

}  // namespace
}  // namespace godobject::hal::cia402
