#include <gtest/gtest.h>

#include "hal/canopen/emergency.h"
#include "hal/canopen/little_endian.h"
#include "hal/canopen/network.h"
#include "hal/canopen/pdo.h"
#include "hal/canopen/sdo.h"
#include "tests/hal/frames.h"

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

TEST(Network, FramesOfTheMaster) {
  EXPECT_EQ(nmt_frame(kNmtStart, 0x05), frame(0x000, {0x01, 0x05}));
  EXPECT_EQ(nmt_frame(kNmtResetCommunication, 0), frame(0x000, {0x82, 0x00}));
  EXPECT_EQ(sync_frame(), frame(0x080, {}));
  EXPECT_EQ(heartbeat_frame(127, kNmtOperational), frame(0x77F, {0x05}));
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
