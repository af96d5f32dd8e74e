#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <tuple>

#include "hal/canopen/emergency.h"
#include "hal/canopen/little_endian.h"
#include "hal/canopen/network.h"
#include "hal/canopen/pdo.h"
#include "hal/canopen/sdo.h"
#include "tests/hal/frames.h"
#include "tests/support/random.h"

namespace godobject::hal::canopen {
namespace {

TEST(LittleEndian, LeastSignificantByteFirst) {
  std::array<std::uint8_t, 8> bytes{};
  store(bytes, 1, 4, 0x12345678);
  EXPECT_EQ(bytes, (std::array<std::uint8_t, 8>{0, 0x78, 0x56, 0x34, 0x12, 0, 0, 0}));
  EXPECT_EQ(load(bytes, 1, 4), 0x12345678u);
  EXPECT_EQ(load(bytes, 2, 2), 0x3456u);
  store(bytes, 7, 1, 0xABCD);
  EXPECT_EQ(bytes[7], 0xCD);
}

TEST(LittleEndian, LoadsWhatItStoresAndTouchesNothingElse) {
  test::Random random(2);
  for (int k = 0; k < 2000; ++k) {
    std::array<std::uint8_t, 12> bytes{};
    bytes.fill(0xA5);
    const auto size = static_cast<std::size_t>(random.integer(0, 4));
    const auto at = static_cast<std::size_t>(random.integer(0, 8));
    const auto value = static_cast<std::uint32_t>(random.integer(0, 0xFFFF) << 16 | random.integer(0, 0xFFFF));
    store(bytes, at, size, value);
    const std::uint32_t kept = size == 4 ? value : value & ((1u << 8 * size) - 1);
    ASSERT_EQ(load(bytes, at, size), kept);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      if (i < at || i >= at + size) {
        ASSERT_EQ(bytes[i], 0xA5) << i;
      }
    }
  }
}

TEST(Network, FramesOfTheMaster) {
  EXPECT_EQ(nmt_frame(kNmtStart, 0x05), frame(0x000, {0x01, 0x05}));
  EXPECT_EQ(nmt_frame(kNmtResetCommunication, 0), frame(0x000, {0x82, 0x00}));
  EXPECT_EQ(sync_frame(), frame(0x080, {}));
  EXPECT_EQ(heartbeat_frame(127, kNmtOperational), frame(0x77F, {0x05}));
}

TEST(Network, NumbersOfTheStandard) {
  EXPECT_EQ(nmt_frame(kNmtStop, 3), frame(0x000, {0x02, 0x03}));
  EXPECT_EQ(nmt_frame(kNmtPreOperational, 3), frame(0x000, {0x80, 0x03}));
  EXPECT_EQ(nmt_frame(kNmtResetNode, 3), frame(0x000, {0x81, 0x03}));
  EXPECT_EQ(heartbeat_frame(5, kNmtStopped), frame(0x705, {0x04}));
  EXPECT_EQ(heartbeat_frame(5, kNmtPreOperationalState), frame(0x705, {0x7F}));
  EXPECT_EQ(kRpdoTimeout, 0x8250);
  EXPECT_EQ(kAbortTimeout, 0x05040000u);
  EXPECT_EQ(kAbortWriteOnly, 0x06010001u);
  EXPECT_EQ(kAbortReadOnly, 0x06010002u);
  EXPECT_EQ(kAbortNoObject, 0x06020000u);
  EXPECT_EQ(kAbortLength, 0x06070010u);
  EXPECT_EQ(kAbortNoSubindex, 0x06090011u);
}

TEST(Network, HeartbeatOfEachStateAndNothingElse) {
  Heartbeat heartbeat;
  ASSERT_TRUE(parse_heartbeat(frame(0x703, {0x00}), heartbeat));
  EXPECT_EQ(heartbeat.node, 3);
  EXPECT_EQ(heartbeat.state, kNmtBoot);
  int states = 0;
  for (int byte = 0; byte < 256; ++byte) {
    if (!parse_heartbeat(frame(0x77F, {byte}), heartbeat)) continue;
    ++states;
    EXPECT_EQ(heartbeat.state, byte);
    EXPECT_EQ(heartbeat.node, 127);
  }
  EXPECT_EQ(states, 4);  // 00, 04, 05, 7F
  EXPECT_FALSE(parse_heartbeat(frame(0x700, {0x05}), heartbeat));
  EXPECT_FALSE(parse_heartbeat(frame(0x780, {0x05}), heartbeat));
  EXPECT_FALSE(parse_heartbeat(frame(0x703, {}), heartbeat));
  EXPECT_FALSE(parse_heartbeat(frame(0x703, {0x05, 0x00}), heartbeat));
}

TEST(Network, IdentifiersThatOnlyAMasterSends) {
  for (const int id : {0x000, 0x080, 0x100, 0x201, 0x27F, 0x301, 0x401, 0x501, 0x57F, 0x601, 0x67F, 0x77F, 0x7E5}) {
    EXPECT_TRUE(is_of_master(static_cast<std::uint16_t>(id))) << id;
  }
  // EMCY, TPDOs, SDO responses, heartbeats, LSS slave; 580 and 600 have no node
  for (const int id :
       {0x081, 0x0FF, 0x181, 0x1FF, 0x281, 0x381, 0x481, 0x580, 0x581, 0x5FF, 0x600, 0x701, 0x77E, 0x7E4}) {
    EXPECT_FALSE(is_of_master(static_cast<std::uint16_t>(id))) << id;
  }
  int count = 0;
  for (int id = 0; id < 0x800; ++id) count += is_of_master(static_cast<std::uint16_t>(id)) ? 1 : 0;
  EXPECT_EQ(count, 5 + 4 * 127 + 127);
}

TEST(Network, NodeOfAnIdentifier) {
  for (const int base : {0x080, 0x180, 0x580, 0x700}) {
    const auto of = [base](int id) {
      return node_of(static_cast<std::uint16_t>(id), static_cast<std::uint16_t>(base));
    };
    for (int node = 1; node <= 127; ++node) EXPECT_EQ(of(base + node), node);
    EXPECT_EQ(of(base), 0);
    EXPECT_EQ(of(base - 1), 0);
    EXPECT_EQ(of(base + 128), 0);
    EXPECT_EQ(of(0), 0);
  }
}

TEST(Sdo, RequestsByteForByte) {
  EXPECT_EQ(sdo_read(3, 0x6076, 0), frame(0x603, {0x40, 0x76, 0x60, 0x00, 0, 0, 0, 0}));
  EXPECT_EQ(sdo_write(3, 0x6060, 0, 10, 1), frame(0x603, {0x2F, 0x60, 0x60, 0x00, 0x0A, 0, 0, 0}));
  EXPECT_EQ(sdo_write(127, 0x1017, 0, 20, 2), frame(0x67F, {0x2B, 0x17, 0x10, 0x00, 0x14, 0x00, 0, 0}));
  EXPECT_EQ(sdo_write(1, 0x1600, 2, 0x60710010, 4), frame(0x601, {0x23, 0x00, 0x16, 0x02, 0x10, 0x00, 0x71, 0x60}));
  // only the bytes that belong to it
  EXPECT_EQ(sdo_write(1, 0x60C2, 2, 0xFFFFFFFDu, 1), frame(0x601, {0x2F, 0xC2, 0x60, 0x02, 0xFD, 0, 0, 0}));
}

TEST(Sdo, ResponsesByteForByte) {
  using Kind = SdoResponse::Kind;
  SdoResponse response;
  ASSERT_TRUE(parse_sdo_response(frame(0x583, {0x43, 0x76, 0x60, 0x00, 0x20, 0x4E, 0x00, 0x00}), response));
  EXPECT_EQ(response.node, 3);
  EXPECT_EQ(response.kind, Kind::kRead);
  EXPECT_EQ(response.index, 0x6076);
  EXPECT_EQ(response.subindex, 0);
  EXPECT_EQ(response.size, 4);
  EXPECT_EQ(response.value, 20000u);

  ASSERT_TRUE(parse_sdo_response(frame(0x583, {0x4B, 0x05, 0x14, 0x05, 0x04, 0x00, 0xFF, 0xFF}), response));
  EXPECT_EQ(response.size, 2);
  EXPECT_EQ(response.value, 4u);  // the bytes after the first two have no meaning
  EXPECT_EQ(response.subindex, 5);
  ASSERT_TRUE(parse_sdo_response(frame(0x583, {0x4F, 0x61, 0x60, 0x00, 0x0A, 0xAA, 0xAA, 0xAA}), response));
  EXPECT_EQ(response.size, 1);
  EXPECT_EQ(response.value, 10u);
  ASSERT_TRUE(parse_sdo_response(frame(0x583, {0x42, 0x61, 0x60, 0x00, 1, 2, 3, 4}), response));
  EXPECT_EQ(response.size, 0);
  EXPECT_EQ(response.value, 0x04030201u);

  ASSERT_TRUE(parse_sdo_response(frame(0x583, {0x60, 0x17, 0x10, 0x00, 0, 0, 0, 0}), response));
  EXPECT_EQ(response.kind, Kind::kWritten);
  EXPECT_EQ(response.index, 0x1017);
  ASSERT_TRUE(parse_sdo_response(frame(0x583, {0x80, 0xC2, 0x60, 0x01, 0x11, 0x00, 0x09, 0x06}), response));
  EXPECT_EQ(response.kind, Kind::kAborted);
  EXPECT_EQ(response.value, kAbortNoSubindex);
  EXPECT_EQ(response.subindex, 1);
  // segmented upload of 26 bytes
  ASSERT_TRUE(parse_sdo_response(frame(0x583, {0x41, 0x08, 0x10, 0x00, 26, 0, 0, 0}), response));
  EXPECT_EQ(response.kind, Kind::kLong);

  EXPECT_FALSE(parse_sdo_response(frame(0x583, {0x60, 0x17, 0x10}), response));
  EXPECT_FALSE(parse_sdo_response(frame(0x603, {0x60, 0x17, 0x10, 0x00, 0, 0, 0, 0}), response));
  EXPECT_FALSE(parse_sdo_response(frame(0x580, {0x60, 0x17, 0x10, 0x00, 0, 0, 0, 0}), response));
}

/// Upload and download of segments, blocks, and the specifier that has no meaning.
TEST(Sdo, ResponsesOfLongerTransfersHaveNoValue) {
  for (const int command : {0x00, 0x0F, 0x20, 0x30, 0xA0, 0xA4, 0xC0, 0xC6, 0xE0, 0x40, 0x41}) {
    SdoResponse response;
    ASSERT_TRUE(parse_sdo_response(frame(0x583, {command, 0x08, 0x10, 0x02, 1, 2, 3, 4}), response)) << command;
    EXPECT_EQ(response.kind, SdoResponse::Kind::kLong) << command;
    EXPECT_EQ(response.size, 0);
    EXPECT_EQ(response.value, 0u);
    EXPECT_EQ(response.node, 3);
    EXPECT_EQ(response.index, 0x1008);
    EXPECT_EQ(response.subindex, 2);
  }
}

/// The result depends on the eight bytes only: not on those behind them, nor on what `response` held before.
TEST(Sdo, ResponsesDependOnNothingElse) {
  test::Random random(3);
  for (int k = 0; k < 5000; ++k) {
    CanFrame clean{static_cast<std::uint16_t>(0x580 + random.integer(1, 127)), 8};
    for (std::size_t i = 0; i < 8; ++i) clean.data[i] = static_cast<std::uint8_t>(random.integer(0, 255));
    CanFrame dirty = clean;
    for (std::size_t i = 8; i < dirty.data.size(); ++i) dirty.data[i] = 0xFF;
    SdoResponse one;
    SdoResponse two{77, SdoResponse::Kind::kRead, 0x7777, 7, 3, 0x77777777};
    ASSERT_TRUE(parse_sdo_response(clean, one));
    ASSERT_TRUE(parse_sdo_response(dirty, two));
    const auto all = [](const SdoResponse& r) {
      return std::tuple(r.node, r.kind, r.index, r.subindex, r.size, r.value);
    };
    ASSERT_EQ(all(one), all(two)) << clean;
  }
}

TEST(Sdo, TellsWritesFromReads) {
  for (const int command : {0x2F, 0x2B, 0x27, 0x23, 0x22, 0x21, 0x20, 0x00, 0x10, 0x0D, 0xC0, 0xC6}) {
    EXPECT_TRUE(is_sdo_write(frame(0x601, {command, 0, 0, 0, 0, 0, 0, 0}))) << command;
  }
  for (const int command : {0x40, 0x60, 0x70, 0x80, 0xA0, 0xA3}) {
    EXPECT_FALSE(is_sdo_write(frame(0x601, {command, 0, 0, 0, 0, 0, 0, 0}))) << command;
  }
  EXPECT_FALSE(is_sdo_write(frame(0x581, {0x2F, 0, 0, 0, 0, 0, 0, 0})));
  EXPECT_FALSE(is_sdo_write(frame(0x601, {})));
}

TEST(Emergency, CodeAndRegister) {
  Emergency emergency;
  ASSERT_TRUE(parse_emergency(frame(0x085, {0x50, 0x82, 0x11, 1, 2, 3, 4, 5}), emergency));
  EXPECT_EQ(emergency.node, 5);
  EXPECT_EQ(emergency.code, 0x8250);
  EXPECT_EQ(emergency.error_register, 0x11);
  EXPECT_FALSE(parse_emergency(frame(0x080, {}), emergency));  // SYNC
  EXPECT_FALSE(parse_emergency(frame(0x085, {0x50, 0x82}), emergency));
  EXPECT_FALSE(parse_emergency(frame(0x100, {0, 0, 0, 0, 0, 0, 0, 0}), emergency));
}

TEST(Emergency, OnlyThreeCodesAreWarnings) {
  int warnings = 0;
  for (int code = 0; code < 0x10000; ++code) warnings += is_warning(static_cast<std::uint16_t>(code)) ? 1 : 0;
  EXPECT_EQ(warnings, 3);
  EXPECT_TRUE(is_warning(0x0000) && is_warning(0x8110) && is_warning(0x8120));
}

TEST(Pdo, Entries) {
  EXPECT_EQ(pdo_entry(0x6041, 0, 16), 0x60410010u);
  EXPECT_EQ(pdo_entry(0x6064, 0, 32), 0x60640020u);
  EXPECT_EQ(pdo_entry(0x6000, 1, 8), 0x60000108u);
}

}  // namespace
}  // namespace godobject::hal::canopen
