#include "firmware/machine/can_interfaces.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace godobject::firmware::can_interfaces_test {
namespace {

/// A netlink message put together number by number: rtnetlink(7), and the values of linux/can/netlink.h.
class Message {
 public:
  Message(std::uint16_t type, std::uint16_t hardware, std::uint32_t flags) {
    put32(0);  // length, at the end
    put16(type);
    put16(0);
    put32(0);
    put32(0);
    put16(0);  // family, padding
    put16(hardware);
    put32(7);  // index
    put32(flags);
    put32(0);
  }

  Message& attribute(std::uint16_t type, const std::vector<std::uint8_t>& payload) {
    const auto length = static_cast<std::uint16_t>(4 + payload.size());
    put16(length);
    put16(type);
    for (const std::uint8_t byte : payload) bytes_.push_back(byte);
    while (bytes_.size() % 4 != 0) bytes_.push_back(0);
    return *this;
  }

  std::vector<std::uint8_t> bytes() const {
    std::vector<std::uint8_t> whole = bytes_;
    for (std::size_t i = 0; i < 4; ++i) whole[i] = static_cast<std::uint8_t>(whole.size() >> (8 * i));
    return whole;
  }

  static std::vector<std::uint8_t> number(std::uint32_t value) {
    return {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8),
            static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 24)};
  }

  static std::vector<std::uint8_t> text(const std::string& value) {
    std::vector<std::uint8_t> bytes(value.begin(), value.end());
    bytes.push_back(0);
    return bytes;
  }

  /// The attributes alone, to be nested.
  std::vector<std::uint8_t> nested() const { return {bytes_.begin() + 32, bytes_.end()}; }

 private:
  void put16(std::uint32_t value) {
    bytes_.push_back(static_cast<std::uint8_t>(value));
    bytes_.push_back(static_cast<std::uint8_t>(value >> 8));
  }
  void put32(std::uint32_t value) {
    put16(value);
    put16(value >> 16);
  }

  std::vector<std::uint8_t> bytes_;
};

constexpr std::uint16_t kNewLink = 16;
constexpr std::uint16_t kHardwareCan = 280;

std::vector<std::uint8_t> bit_timing(std::uint32_t rate) {
  std::vector<std::uint8_t> payload = Message::number(rate);
  payload.resize(32);
  return payload;
}

/// can0 with a controller: 1 Mbit/s, 5 Mbit/s, restarts after 100 ms, error-passive, listens only.
Message real_interface() {
  Message data(0, 0, 0);
  data.attribute(1, bit_timing(1'000'000));
  data.attribute(4, Message::number(2));
  data.attribute(5, {0x3F, 0, 0, 0, 0x22, 0, 0, 0});  // mask; flags: listen-only, FD
  data.attribute(6, Message::number(100));
  data.attribute(9, bit_timing(5'000'000));
  Message info(0, 0, 0);
  info.attribute(1, Message::text("can")).attribute(2, data.nested());
  Message message(kNewLink, kHardwareCan, 0x40001);
  message.attribute(3, Message::text("can0")).attribute(4, Message::number(72)).attribute(13, Message::number(10));
  message.attribute(0x8000 | 18, info.nested());
  return message;
}

CanInterface ready() {
  CanInterface interface;
  interface.name = "can0";
  interface.kind = "can";
  interface.can = interface.up = interface.echoes = true;
  interface.mtu = 16;
  interface.transmit_queue = 1000;
  interface.bit_rate = 1'000'000;
  return interface;
}

bool all_good(const std::vector<Finding>& findings) {
  return std::all_of(findings.begin(), findings.end(), [](const Finding& finding) { return finding.good; });
}

TEST(CanInterface, IsReadFromTheKernelsMessage) {
  const std::optional<CanInterface> interface = parse_link(real_interface().bytes());
  ASSERT_TRUE(interface);
  EXPECT_EQ(interface->name, "can0");
  EXPECT_EQ(interface->kind, "can");
  EXPECT_TRUE(interface->can);
  EXPECT_TRUE(interface->up);
  EXPECT_TRUE(interface->echoes);
  EXPECT_EQ(interface->mtu, 72);
  EXPECT_EQ(interface->transmit_queue, 10);
  EXPECT_EQ(interface->bit_rate, 1'000'000u);
  EXPECT_EQ(interface->data_rate, 5'000'000u);
  EXPECT_EQ(interface->restart_ms, 100u);
  EXPECT_TRUE(interface->listen_only);
  EXPECT_TRUE(interface->passive);
  EXPECT_FALSE(interface->bus_off);
}

/// No attribute changes what another one has told, in whatever order they come: not even a queue of 65540 frames, which
/// has the bytes of an empty kind.
TEST(CanInterface, EachAttributeOfALinkIsReadAloneInAnyOrder) {
  Message info(0, 0, 0);
  info.attribute(1, Message::text("vcan"));
  std::vector<std::pair<std::uint16_t, std::vector<std::uint8_t>>> attributes = {
      {3, Message::text("vcan0")}, {4, Message::number(72)}, {13, Message::number(65540)}, {18, info.nested()}};
  do {
    Message message(kNewLink, kHardwareCan, 1);
    for (const auto& [type, payload] : attributes) message.attribute(type, payload);
    const std::optional<CanInterface> interface = parse_link(message.bytes());
    ASSERT_TRUE(interface);
    EXPECT_EQ(interface->name, "vcan0");
    EXPECT_EQ(interface->mtu, 72);
    EXPECT_EQ(interface->transmit_queue, 65540);
    EXPECT_EQ(interface->kind, "vcan");
  } while (std::next_permutation(attributes.begin(), attributes.end()));
}

TEST(CanInterface, NoOtherMessageIsTakenForOne) {
  EXPECT_FALSE(parse_link(Message(2 /* error */, kHardwareCan, 1).bytes()));
  EXPECT_FALSE(parse_link({}));
}

TEST(CanInterface, BrokenMessagesAreSurvived) {
  const std::vector<std::uint8_t> whole = real_interface().bytes();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(parse_link(std::span(whole).first(size)));  // shorter than it says
  }
  std::mt19937 random(5);
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::uint8_t> bent = whole;
    for (int k = 0; k < 3; ++k) bent[32 + random() % (bent.size() - 32)] = static_cast<std::uint8_t>(random());
    (void)parse_link(bent);
  }
}

TEST(CanInterface, LacksNothingWhenItIsAsTheLayoutWants) {
  const std::vector<Finding> findings = examine_can_interface(ready(), {});
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_TRUE(findings[0].good);
  EXPECT_EQ(findings[0].what, "can0: up, 1000 kbit/s, txqueuelen 1000");
}

TEST(CanInterface, EachLackHasItsCure) {
  struct Case {
    void (*spoil)(CanInterface&);
    const char* what;
    const char* cure;
    bool needed;
  };
  const Case cases[] = {
      {[](CanInterface& i) { i.up = false; }, "can0: down",
       "ip link set can0 down; ip link set can0 up txqueuelen 1000 type can bitrate 1000000 restart-ms 0", true},
      {[](CanInterface& i) { i.bit_rate = 500'000; }, "can0: 500 kbit/s; the device file has 1000",
       "ip link set can0 down; ip link set can0 up txqueuelen 1000 type can bitrate 1000000 restart-ms 0", true},
      {[](CanInterface& i) { i.transmit_queue = 10; }, "can0: txqueuelen 10 is short; a burst may fill it",
       "ip link set can0 txqueuelen 1000", false},
      {[](CanInterface& i) { i.restart_ms = 100; }, "can0: restarts by itself 100 ms after bus-off",
       "ip link set can0 down; ip link set can0 up txqueuelen 1000 type can bitrate 1000000 restart-ms 0", true},
      {[](CanInterface& i) { i.echoes = false; }, "can0: its driver does not report when a frame was on the wire",
       "use an adapter whose driver has IFF_ECHO; slcan of old kernels does not", true},
      {[](CanInterface& i) { i.listen_only = true; }, "can0: listens only",
       "ip link set can0 down; ip link set can0 up type can listen-only off", true},
      {[](CanInterface& i) { i.can = false; }, "can0: not a CAN interface",
       "ip link show type can lists CAN interfaces", true},
  };
  for (const Case& test : cases) {
    CanInterface interface = ready();
    test.spoil(interface);
    const std::vector<Finding> findings = examine_can_interface(interface, {});
    ASSERT_EQ(findings.size(), 1u) << test.what;
    EXPECT_FALSE(findings[0].good);
    EXPECT_EQ(findings[0].needed, test.needed) << test.what;
    EXPECT_EQ(findings[0].what, test.what);
    EXPECT_EQ(findings[0].cure, test.cure);
  }
  CanInterface off = ready();
  off.bus_off = true;
  EXPECT_FALSE(all_good(examine_can_interface(off, {})));
  CanInterface passive = ready();
  passive.passive = true;
  EXPECT_FALSE(all_good(examine_can_interface(passive, {})));
}

TEST(CanInterface, FdFramesNeedMtuAndDataRate) {
  hal::BusLayout layout;
  layout.fd = true;
  EXPECT_EQ(examine_can_interface(ready(), layout).size(), 2u);
  CanInterface interface = ready();
  interface.mtu = 72;
  interface.data_rate = 5'000'000;
  EXPECT_TRUE(all_good(examine_can_interface(interface, layout)));
}

TEST(CanInterface, ASimulatedOneHasNoBitTiming) {
  CanInterface interface;
  interface.name = "vcan0";
  interface.kind = "vcan";
  interface.can = interface.up = interface.echoes = true;
  interface.mtu = 72;
  const std::vector<Finding> findings = examine_can_interface(interface, {});
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_TRUE(findings[0].good);
  EXPECT_EQ(findings[0].what, "vcan0: up, simulated (vcan)");
}

TEST(CanInterface, TheKernelIsAsked) {
  const std::vector<std::string> names = {"lo", "no-such-can", "a-name-longer-than-any-interface"};
  const std::vector<Finding> findings = examine_can_interfaces(names, {});
  ASSERT_EQ(findings.size(), 3u);
  EXPECT_EQ(findings[0].what, "lo: not a CAN interface");
  EXPECT_EQ(findings[1].what, "no-such-can: no such interface");
  EXPECT_FALSE(findings[2].good);
  const std::optional<CanInterface> loopback = read_can_interface("lo");
  ASSERT_TRUE(loopback);
  EXPECT_EQ(loopback->name, "lo");
  EXPECT_GT(loopback->mtu, 1000);
}

TEST(CanInterface, TheKernelsOwnSimulatedOneIsReady) {
  const std::optional<CanInterface> interface = read_can_interface("vcan0");
  if (!interface) GTEST_SKIP() << "not run: no interface vcan0; ip link add dev vcan0 type vcan";
  EXPECT_EQ(interface->kind, "vcan");
  EXPECT_TRUE(interface->can);
  EXPECT_EQ(interface->mtu, 72);
  EXPECT_TRUE(all_good(examine_can_interface(*interface, {})));
}

/// One finding, as one line.
std::string told(const Finding& finding) {
  return std::string(finding.good ? "ok " : "LACK ") + (finding.needed ? "needed " : "") + finding.what + " -> " +
         finding.cure;
}
std::vector<std::string> told(const std::vector<Finding>& findings) {
  std::vector<std::string> lines;
  for (const Finding& finding : findings) lines.push_back(told(finding));
  return lines;
}
using Lines = std::vector<std::string>;

const std::string kSetUp =
    "ip link set can0 down; ip link set can0 up txqueuelen 1000 type can bitrate 1000000 restart-ms 0";
const std::string kSetUpFd =
    "ip link set can0 down; ip link set can0 up txqueuelen 1000 type can bitrate 1000000 dbitrate 5000000 fd on "
    "restart-ms 0";

TEST(CanInterface, FindingsOfTheControllerHaveTheirCures) {
  CanInterface off = ready();
  off.bus_off = true;
  EXPECT_EQ(told(examine_can_interface(off, {})),
            Lines{"LACK needed can0: its controller is bus-off after errors -> check wires, termination (120 ohm at "
                  "both ends) and bit rate; then " +
                  kSetUp});
  CanInterface passive = ready();
  passive.passive = true;
  EXPECT_EQ(told(examine_can_interface(passive, {})),
            Lines{"LACK can0: its controller is error-passive -> check wires, termination (120 ohm at both ends) and "
                  "bit rate, and that a drive is switched on"});
  EXPECT_EQ(told(examine_can_interface(ready(), {})), Lines{"ok can0: up, 1000 kbit/s, txqueuelen 1000 -> "});
  CanInterface longer = ready();
  longer.transmit_queue = 999;
  EXPECT_FALSE(all_good(examine_can_interface(longer, {})));
  longer.transmit_queue = 1001;
  EXPECT_TRUE(all_good(examine_can_interface(longer, {})));
  longer.restart_ms = 1;
  EXPECT_FALSE(all_good(examine_can_interface(longer, {})));
}

TEST(CanInterface, FdFindingsHaveTheirCures) {
  hal::BusLayout layout;
  layout.fd = true;
  EXPECT_EQ(told(examine_can_interface(ready(), layout)),
            (Lines{"LACK needed can0: has no FD frames -> " + kSetUpFd,
                   "LACK needed can0: 0 kbit/s for the data of FD frames; the device file has 5000 -> " + kSetUpFd}));
  CanInterface slow = ready();
  slow.mtu = 72;
  slow.data_rate = 2'000'000;
  EXPECT_EQ(told(examine_can_interface(slow, layout)),
            Lines{"LACK needed can0: 2000 kbit/s for the data of FD frames; the device file has 5000 -> " + kSetUpFd});
  slow.data_rate = 0;
  slow.bit_rate = 250'000;
  layout.fd = false;
  EXPECT_EQ(told(examine_can_interface(slow, layout)),
            Lines{"LACK needed can0: 250 kbit/s; the device file has 1000 -> " + kSetUp});
  layout.fd = true;
  CanInterface simulated;
  simulated.name = "vcan0";
  simulated.kind = "vcan";
  simulated.can = true;
  simulated.mtu = 71;
  EXPECT_EQ(told(examine_can_interface(simulated, layout)),
            (Lines{"LACK needed vcan0: down -> ip link set vcan0 up",
                   "LACK needed vcan0: has no FD frames -> ip link set vcan0 down; ip link set vcan0 mtu 72 up"}));
  simulated.mtu = 72;
  simulated.up = true;
  EXPECT_EQ(told(examine_can_interface(simulated, layout)), Lines{"ok vcan0: up, simulated (vcan) -> "});
}

/// A controller divides its clock: its rate may be off by a thousandth.
TEST(CanInterface, ARateMayBeOffByAThousandth) {
  hal::BusLayout layout;
  layout.fd = true;
  for (const auto& [rate, good] : std::initializer_list<std::pair<std::uint32_t, bool>>{
           {1'000'000, true}, {1'001'000, true}, {999'000, true}, {1'001'001, false}, {998'999, false}}) {
    CanInterface interface = ready();
    interface.mtu = 72;
    interface.data_rate = 5'000'000;
    interface.bit_rate = rate;
    EXPECT_EQ(all_good(examine_can_interface(interface, layout)), good) << rate;
    interface.bit_rate = 1'000'000;
    interface.data_rate = 5 * rate;
    EXPECT_EQ(all_good(examine_can_interface(interface, layout)), good) << rate;
  }
}

/// can0 with one attribute of its controller.
std::optional<CanInterface> with_controller(std::uint16_t type, const std::vector<std::uint8_t>& payload,
                                            const std::string& kind = "can") {
  Message data(0, 0, 0);
  data.attribute(type, payload);
  Message info(0, 0, 0);
  info.attribute(2, data.nested()).attribute(1, Message::text(kind));  // in the other order
  Message message(kNewLink, kHardwareCan, 1);
  message.attribute(99, {1, 2, 3, 4, 5}).attribute(3, Message::text("can0")).attribute(18, info.nested());
  return parse_link(message.bytes());
}

TEST(CanInterface, EachAttributeOfAControllerIsReadAlone) {
  const auto expect = [](const std::optional<CanInterface>& read, auto&& set) {
    CanInterface expected;
    set(expected);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->name, "can0");
    EXPECT_EQ(read->bit_rate, expected.bit_rate);
    EXPECT_EQ(read->data_rate, expected.data_rate);
    EXPECT_EQ(read->restart_ms, expected.restart_ms);
    EXPECT_EQ(read->listen_only, expected.listen_only);
    EXPECT_EQ(read->passive, expected.passive);
    EXPECT_EQ(read->bus_off, expected.bus_off);
    EXPECT_EQ(read->mtu, 0);
    EXPECT_EQ(read->transmit_queue, 0);
    EXPECT_TRUE(read->up);
    EXPECT_FALSE(read->echoes);
  };
  const auto nothing = [](CanInterface&) {};
  expect(with_controller(1, bit_timing(7)), [](CanInterface& i) { i.bit_rate = 7; });
  expect(with_controller(9, bit_timing(8)), [](CanInterface& i) { i.data_rate = 8; });
  expect(with_controller(6, Message::number(9)), [](CanInterface& i) { i.restart_ms = 9; });
  expect(with_controller(5, {0xFF, 0, 0, 0, 2, 0, 0, 0}), [](CanInterface& i) { i.listen_only = true; });
  expect(with_controller(5, {0xFF, 0, 0, 0, 0xFD, 0, 0, 0}), nothing);
  for (std::uint32_t state = 0; state <= 5; ++state) {
    expect(with_controller(4, Message::number(state)), [state](CanInterface& i) {
      i.passive = state == 2;
      i.bus_off = state == 3;
    });
  }
  expect(with_controller(7, Message::number(9)), nothing);          // another attribute
  expect(with_controller(6, {1, 2, 3}), nothing);                   // too short for its number
  expect(with_controller(6, Message::number(9), "vcan"), nothing);  // no controller
}

TEST(CanInterface, FlagsAndHardwareAreReadBitByBit) {
  for (int bit = 0; bit < 20; ++bit) {
    const std::optional<CanInterface> read = parse_link(Message(kNewLink, kHardwareCan, 1u << bit).bytes());
    ASSERT_TRUE(read);
    EXPECT_TRUE(read->can);
    EXPECT_EQ(read->up, bit == 0) << bit;
    EXPECT_EQ(read->echoes, bit == 18) << bit;
  }
  for (const std::uint16_t hardware : std::initializer_list<std::uint16_t>{1, 279, 281, 772})
    EXPECT_FALSE(parse_link(Message(kNewLink, hardware, 1).bytes())->can);
}

/// The length in the header bounds the message; a broken attribute ends its list and keeps those before it.
TEST(CanInterface, LengthsBoundWhatIsRead) {
  Message message(kNewLink, kHardwareCan, 1);
  message.attribute(3, Message::text("can0"));
  std::vector<std::uint8_t> longer = message.bytes();
  const std::size_t whole = longer.size();
  for (const std::uint8_t byte : Message(0, 0, 0).attribute(4, Message::number(72)).nested()) longer.push_back(byte);
  ASSERT_TRUE(parse_link(longer));
  EXPECT_EQ(parse_link(longer)->mtu, 0) << "behind the message";
  longer[0] = static_cast<std::uint8_t>(longer.size());
  EXPECT_EQ(parse_link(longer)->mtu, 72);
  for (const std::uint8_t length : std::initializer_list<std::uint8_t>{0, 3, 9, 200}) {
    longer[whole] = length;  // of the second attribute, of 8 bytes
    ASSERT_TRUE(parse_link(longer));
    EXPECT_EQ(parse_link(longer)->name, "can0");
    EXPECT_EQ(parse_link(longer)->mtu, 0) << static_cast<int>(length);
  }
  std::vector<std::uint8_t> bare = Message(kNewLink, kHardwareCan, 1).bytes();
  EXPECT_TRUE(parse_link(bare)) << "without an attribute";
  bare[0] = static_cast<std::uint8_t>(bare.size() - 1);
  EXPECT_FALSE(parse_link(bare));
}

/// The lowest descriptor that is free.
int free_descriptor() {
  const int descriptor = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  ::close(descriptor);
  return descriptor;
}

/// Also in a process whose standard input is closed, which gets its descriptor, 0, for the socket.
TEST(CanInterface, AQuestionLeavesNoDescriptorOpen) {
  for (const bool without_input : {false, true}) {
    const int input = without_input ? ::fcntl(0, F_DUPFD_CLOEXEC, 100) : -1;
    if (without_input) ::close(0);
    const int before = free_descriptor();
    static_cast<void>(read_can_interface("lo"));
    EXPECT_EQ(free_descriptor(), before) << without_input;
    if (input < 0) continue;
    ::dup2(input, 0);
    ::close(input);
  }
}

TEST(CanInterface, NamesThatNoInterfaceCanHaveAreNotAskedFor) {
  EXPECT_FALSE(read_can_interface(""));
  EXPECT_FALSE(read_can_interface("sixteen-letters-"));
  EXPECT_FALSE(read_can_interface(std::string(100, 'x')));
  EXPECT_EQ(told(examine_can_interfaces(Lines{"can77"}, {})),
            Lines{"LACK needed can77: no such interface -> ip link show type can lists the existing ones; for a "
                  "simulated one: ip link add dev can77 type vcan"});
  EXPECT_TRUE(examine_can_interfaces({}, {}).empty());
}

}  // namespace
}  // namespace godobject::firmware::can_interfaces_test
