#include "firmware/configuration/device_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/device/dynamics.h"
#include "tests/support/arms.h"
#include "tests/support/fault_record.h"
#include "tests/support/folder_test.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware::device_file_test {
namespace {

using command::ExitCode;
using command::Failure;

class DeviceFileTest : public test::FolderTest {
 protected:
  void SetUp() override {
    std::ifstream stream(GODOBJECT_FIRMWARE_DIR "/devices/desktop6.toml");
    text_.assign(std::istreambuf_iterator<char>(stream), {});
  }

  /// The message with which the file is refused once `from` is `to`; empty if it is not.
  std::string refusal(const std::string& from, const std::string& to) {
    std::string text = text_;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    std::ofstream(file_) << text;
    try {
      read_device_file(file_);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), ExitCode::kBadConfig);
      code_ = static_cast<int>(failure.exit_code());
      EXPECT_NE(std::string(failure.what()).find(file_.string()), std::string::npos) << failure.what();
      return failure.what();
    }
    return {};
  }

  std::string text_;
  const std::filesystem::path file_ = folder_ / "device.toml";
  int code_ = 0;  // of the last refusal
};

TEST_F(DeviceFileTest, MayHaveItsPanelAloneOnABus) {
  const Device device = read_device_file(GODOBJECT_FIRMWARE_DIR "/devices/desktop6.toml");
  const std::string panel = fmt::format("panel_bus = {}", device.bus.panel.bus);
  ASSERT_GE(device.bus.panel.bus, 0);
  EXPECT_EQ(refusal(panel, fmt::format("panel_bus = {}", device.bus.bus_count)), "");
  EXPECT_EQ(read_device_file(file_).bus.bus_count, device.bus.bus_count + 1);
}

TEST_F(DeviceFileTest, CountsItsBusesUpToTheLastOneOfAnyNode) {
  EXPECT_EQ(refusal("panel_bus = 2", "panel_bus = 0"), "");
  EXPECT_EQ(read_device_file(file_).bus.bus_count, 3) << "joints 5 and 6 are on bus 2";
}

/// Buses are counted from 0.
TEST_F(DeviceFileTest, HasANodeOnItsFirstBus) {
  for (std::size_t at = 0; (at = text_.find("\nbus = 0\n", at)) != std::string::npos;) text_[at + 7] = '1';
  EXPECT_NE(refusal("panel_bus = 2", "panel_bus = 2").find("bus 0 has no node"), std::string::npos);
}

/// A node number is one of its bus: another bus may have it again.
TEST_F(DeviceFileTest, MayHaveANodeNumberOnEachBus) {
  EXPECT_EQ(refusal("\nnode = 3\n", "\nnode = 1\n"), "") << "joint 1 is on another bus";
  EXPECT_NE(refusal("\nnode = 2\n", "\nnode = 1\n").find("joint[2].node = 1 is also joint 1's"), std::string::npos);
  EXPECT_EQ(refusal("panel_node = 32", "panel_node = 1"), "");
  EXPECT_NE(refusal("panel_node = 32", "panel_node = 6").find("joint[6].node = 6 is also the panel's"),
            std::string::npos);
}

/// The panel's node number is taken on its bus, also from the first and from the last joint.
TEST_F(DeviceFileTest, RefusesThePanelsNodeForEachJointOnItsBus) {
  const Device device = read_device_file(GODOBJECT_FIRMWARE_DIR "/devices/desktop6.toml");
  for (int i = 0; i < device.bus.joint_count; ++i) {
    const hal::DriveConfig& drive = device.bus.drives[static_cast<std::size_t>(i)];
    const std::string says = refusal("panel_bus = 2\npanel_node = 32",
                                     fmt::format("panel_bus = {}\npanel_node = {}", drive.bus, drive.node));
    EXPECT_NE(says.find(fmt::format("joint[{}].node = {} is also the panel's on the same bus", i + 1, drive.node)),
              std::string::npos)
        << i << says;
  }
}

/// Torques in permille of the rated one, in 16 bits, reach 32 times it; joint 1 has a limit of 1.5 Nm and a gear of 10.
TEST_F(DeviceFileTest, WantsARatedTorqueInProportionToTheLimit) {
  for (const double share : {0.0099, 0.0101, 0.015, 20.0, 31.9, 32.1, 60.0}) {
    const std::string says = refusal("\nrated_torque = 0.15\n", fmt::format("\nrated_torque = {}\n", 0.15 / share));
    EXPECT_EQ(says.empty(), share > 0.01 && share < 32.0) << share << says;
    EXPECT_TRUE(says.empty() || says.find("joint[1].rated_torque times gear is ") != std::string::npos) << says;
  }
}

/// The counter of 32 bits wraps half of 2^32 counts beside the zero. Joint 1 moves from -1.2 to 1.2 rad, 0.5 rad more
/// before the start, and each of its turns is 10 turns of the motor.
TEST_F(DeviceFileTest, WantsPositionsThatTheCounterTellsApart) {
  const std::string before = "counts = 65536\ngear = 10.0\nrated_torque = 0.15\nsign = 1\nzero = 0.0";
  for (const auto& [zero, reach] : {std::pair{0.0, 1.7}, {1.0, 2.7}, {-1.0, 2.7}, {2.0, 3.7}, {-2.0, 3.7}}) {
    for (const double spare : {-0.01, 0.01}) {
      const double counts = M_PI * 4294967296.0 / (10.0 * (reach + spare));
      const std::string says = refusal(
          before, fmt::format("counts = {}\ngear = 10.0\nrated_torque = 0.15\nsign = 1\nzero = {}", counts, zero));
      EXPECT_EQ(says.empty(), spare > 0.0) << zero << says;
      EXPECT_TRUE(says.empty() || says.find(fmt::format("moves {:.3g} rad", reach)) != std::string::npos) << says;
    }
  }
}

TEST_F(DeviceFileTest, ReadsBothArms) {
  const Device lwr = read_device_file(GODOBJECT_FIRMWARE_DIR "/devices/lwr.toml");
  EXPECT_EQ(lwr.name, "lwr");
  EXPECT_EQ(lwr.model.joint_count, 7);
  EXPECT_EQ(lwr.model.joints[0].torque, 176.0);
  EXPECT_EQ(lwr.model.joints[6].link.inertia(2, 2), 2.400e-04);
  EXPECT_EQ(lwr.torque.null_damping[6], 0.02);
  EXPECT_EQ(lwr.model.payload.mass, 0.5);
  const Device desktop = read_device_file(GODOBJECT_FIRMWARE_DIR "/devices/desktop6.toml");
  EXPECT_EQ(desktop.model.joint_count, 6);
  EXPECT_EQ(desktop.torque.singular_full, 0.016);
  EXPECT_EQ(lwr.bus.bus_count, 3);
  EXPECT_EQ(lwr.bus.joint_count, 7);
  EXPECT_EQ(lwr.bus.drives[6].node, 7);
  EXPECT_EQ(lwr.bus.drives[6].rated_torque, 38.0);
  EXPECT_EQ(lwr.bus.drives[6].torque_limit, lwr.model.joints[6].torque);
  EXPECT_EQ(lwr.bus.panel.bus, 2);
  EXPECT_EQ(desktop.bus.drives[2].sign, -1.0);
  EXPECT_EQ(desktop.bus.drives[2].gear, 10.0);
}

TEST_F(DeviceFileTest, RefusesWhatIsNotThere) {
  try {
    read_device_file("nowhere.toml");
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::kNoInput);
  }
}

TEST_F(DeviceFileTest, NamesLineAndKeyOfWhatIsWrong) {
  EXPECT_EQ(refusal("velocity = 8.0", "velocity = 8.0 "), "");
  int refused = 0;
  std::string words;
  for (const auto& [from, to, says] : std::initializer_list<std::array<const char*, 3>>{
           {"velocity = 8.0", "velocity = nan", "joint[1].velocity = nan is out of range"},
           {"velocity = 8.0", "velocity = -1.0", "joint[1].velocity = -1 is out of range"},
           {"velocity = 8.0", "velocity = \"8\"", "joint[1].velocity must be a number"},
           {"velocity = 8.0", "speed = 8.0", "joint[1].speed is not a known key"},
           {"velocity = 8.0\n", "", "joint[1].velocity is missing"},
           {"upper = 1.8", "upper = -0.4", "joint[2].upper = -0.4 is out of range"},
           {"com = [0.06, 0.0, 0.0]", "com = [0.06, 0.0]", "joint[2].com must be an array of 3 numbers"},
           {"2.003e-04, 2.003e-04", "2.003e-04, 9.003e-04", "joint[2].inertia is not possible"},
           {"singular_full = 0.016", "singular_full = 0.004", "torque.singular_full = 0.004 is out of range"},
           {"limit_band = 0.1", "limit_band = 1.06", "torque.limit_band = 1.06 is out of range"},
           {"base = [0.0, 0.0, 0.0, 1.0", "base = [0.0, 0.0, 0.0, 1.1", "arm.base has a quaternion that is not"},
           {"\n[payload]", "\n[cargo]", "cargo is not a known table"},
           {"mass = 0.02\n", "mass = -0.02\n", "payload.mass = -0.02 is out of range"},
           {"1.100e-05, 6.400e-07", "1.100e-05, 6.400e-05", "payload.inertia is not possible"},
           {"name = \"desktop6\"", "name = 6", "arm.name must be a text in quotes"},
           {"\n[tool]", "\n[tool", "not TOML"},
           {"\nnode = 2\n", "\nnode = 1\n", "joint[2].node = 1 is also joint 1's on the same bus"},
           {"\nnode = 5\n", "\nnode = 32\n", "joint[5].node = 32 is also the panel's"},
           {"\nnode = 5\n", "\nnode = 5.5\n", "joint[5].node must be a whole number"},
           {"\nbus = 0\nnode = 1\n", "\nnode = 1\n", "joint[1].bus is missing"},
           {"\nbus = 0\nnode = 1\n", "\nbus = 8\nnode = 1\n", "joint[1].bus = 8 is out of range"},
           {"\nsign = -1\n", "\nsign = 0.5\n", "joint[3].sign must be 1 or -1"},
           {"\nrated_torque = 0.15\n", "\nrated_torque = 15.0\n", "joint[1].rated_torque times gear is 150 Nm"},
           {"serial = 2 }", "serial = 1 }", "joint[2].identity.serial = 1 is also joint 1's"},
           {"serial = 2 }", "serial = -1 }", "joint[2].identity.serial = -1 is out of range"},
           {"serial = 2 }", "serial = 4294967296 }", "joint[2].identity.serial = 4.29497e+09 is out of range"},
           {"serial = 2 }", "serial = 2.5 }", "joint[2].identity.serial must be a whole number"},
           {"serial = 2 }", "number = 2 }", "joint[2].identity.number is not a known key; known here: vendor, product"},
           {"vendor = 0x0", "vendor = \"us\"", "joint[1].identity.vendor must be a whole number"},
           {"\nidentity = {", "\nidentity = 1 # {", "joint[1].identity must be a table: write identity = { ... }"},
           {"drive_delay = 0.0", "drive_delay = 0.0\nlimited_time = 0.0009",
            "bus.limited_time = 0.0009 is out of range"},
           {"drive_delay = 0.0", "drive_delay = 0.0\nlimited_time = 1.1", "bus.limited_time = 1.1 is out of range"},
           {"\nzero = 0.0\n", "\nzero = 0.0\ntemperature = { warn = 70, stop = 85 }\n",
            "joint[1].temperature.object is missing and has no default; in temperature = { ... } write object"},
           {"\nzero = 0.0\n", "\nzero = 0.0\ntemperature = { object = 0x2310, stop = 85 }\n",
            "joint[1].temperature.warn is missing"},
           {"\nzero = 0.0\n", "\nzero = 0.0\ntemperature = { object = 0x2310, warn = 70 }\n",
            "joint[1].temperature.stop is missing"},
           {"\nzero = 0.0\n", "\nzero = 0.0\ntemperature = { object = 0x2310, warn = 70, stop = 70 }\n",
            "joint[1].temperature.stop = 70 must be above warn = 70"},
           {"\nzero = 0.0\n", "\nzero = 0.0\ntemperature = { object = 0x6064, warn = 70, stop = 85 }\n",
            "joint[1].temperature.object = 24676 is out of range"},
           {"\nzero = 0.0\n", "\nzero = 0.0\ntemperature = { object = 0x2310, type = \"i24\", warn = 70, stop = 85 }\n",
            "joint[1].temperature.type = \"i24\" is not known; it must be i8,"},
           {"\nzero = 0.0\n", "\nzero = 0.0\ntemperature = { object = 0x2310, scale = 0.0, warn = 70, stop = 85 }\n",
            "joint[1].temperature.scale = 0 is out of range"},
           {"bit_rate = 1e6", "bit_rate = 2e6", "bus.bit_rate = 2e+06 is out of range"},
           {"drive_delay = 0.0\n", "", "bus.drive_delay is missing"},
           {"drive_delay = 0.0", "drive_delay = -1e-6", "bus.drive_delay = -1e-06 is out of range"},
           {"drive_delay = 0.0", "drive_delay = 0.0051", "bus.drive_delay = 0.0051 is out of range"},
           {"drive_delay = 0.0", "drive_delay = nan", "bus.drive_delay = nan is out of range"},
           {"drive_delay = 0.0", "drive_delay = 0.0\nanswer = 0.0006", "bus.answer = 0.0006 is out of range"},
       }) {
    const std::string message = refusal(from, to);
    EXPECT_NE(message.find(says), std::string::npos) << "'" << message << "' should say: " << says;
    refused += message.find(says) != std::string::npos ? 1 : 0;
    words = message.substr(message.rfind('/') + 1);
  }
  test::record_start(code_, std::to_string(refused) + " cases, the last: " + words);
  EXPECT_NE(refusal("panel_bus = 2", "panel_bus = 2\nheartbeat = 1").find("bus.heartbeat is not a known key"),
            std::string::npos);
  EXPECT_NE(refusal("velocity = 8.0", "velocity = nan").find(".toml:53:"), std::string::npos)
      << refusal("velocity = 8.0", "velocity = nan");
}

/// Each field alone, all, and none; numbers up to the last of 32 bits.
TEST_F(DeviceFileTest, ReadsTheIdentityOfADriveAsFarAsItIsNamed) {
  const std::string all = "identity = { vendor = 0x0, product = 0x1, revision = 0x10000, serial = 1 }";
  for (unsigned fields = 0; fields < 16; ++fields) {
    std::string keys;
    for (std::size_t k = 0; k < 4; ++k) {
      if ((fields >> k & 1) == 0) continue;
      keys += fmt::format("{}{} = {}", keys.empty() ? "" : ", ", hal::kIdentityFields.at(k).name, 4294967295u - k);
    }
    ASSERT_EQ(refusal(all, "identity = { " + keys + " }"), "") << keys;
    const Device device = read_device_file(file_);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::optional<std::uint32_t> value = device.bus.drives[0].identity.*hal::kIdentityFields.at(k).value;
      EXPECT_EQ(value, (fields >> k & 1) == 0 ? std::nullopt : std::optional<std::uint32_t>(4294967295u - k)) << keys;
    }
    EXPECT_EQ(device.bus.drives[1].identity.serial, 2u) << "the others keep theirs";
  }
  ASSERT_EQ(refusal(all, ""), "");
  EXPECT_FALSE(read_device_file(file_).bus.drives[0].identity.serial);
}

/// A serial number is one of its product: drives of another product or vendor may have it again.
TEST_F(DeviceFileTest, MayHaveASerialNumberOnceForEachProduct) {
  const std::string second = "product = 0x1, revision = 0x10000, serial = 2 }";
  EXPECT_EQ(refusal(second, "product = 0x2, revision = 0x10000, serial = 1 }"), "");
  EXPECT_NE(refusal(second, "serial = 1 }").find("joint[2].identity.serial = 1 is also joint 1's"), std::string::npos)
      << "without a product it may be the same drive";
  EXPECT_EQ(refusal(second, "product = 0x1, revision = 0x10000 }"), "")
      << "drives without a serial number are not compared";
}

TEST_F(DeviceFileTest, ShippedFilesNameTheSimulatedDrives) {
  for (const char* name : {"desktop6", "lwr"}) {
    const Device device = read_device_file(fmt::format("{}/devices/{}.toml", GODOBJECT_FIRMWARE_DIR, name));
    for (int i = 0; i < device.bus.joint_count; ++i) {
      const hal::DriveConfig& drive = device.bus.drives[static_cast<std::size_t>(i)];
      EXPECT_EQ(drive.identity.vendor, 0u) << name << i;
      EXPECT_EQ(drive.identity.product, 1u) << name << i;
      EXPECT_EQ(drive.identity.revision, 0x10000u) << name << i;
      EXPECT_EQ(drive.identity.serial, static_cast<std::uint32_t>(drive.node)) << name << i;
    }
  }
}

TEST_F(DeviceFileTest, ReadsTheTemperatureOfADrive) {
  const std::string zero = "\nzero = 0.0\n";
  EXPECT_FALSE(read_device_file(GODOBJECT_FIRMWARE_DIR "/devices/desktop6.toml").bus.drives[0].temperature.exists());
  ASSERT_EQ(refusal(zero, zero + "temperature = { object = 0x2310, warn = 70, stop = 85.5 }\n"), "");
  hal::TemperatureConfig temperature = read_device_file(file_).bus.drives[0].temperature;
  EXPECT_EQ(temperature.index, 0x2310);
  EXPECT_EQ(temperature.subindex, 0);
  EXPECT_EQ(temperature.size, 2);
  EXPECT_TRUE(temperature.is_signed);
  EXPECT_EQ(temperature.scale, 1.0);
  EXPECT_EQ(temperature.warn, 70.0);
  EXPECT_EQ(temperature.stop, 85.5);
  EXPECT_FALSE(read_device_file(file_).bus.drives[1].temperature.exists());
  for (const auto& [type, size, is_signed] :
       {std::tuple{"i8", 1, true}, {"u8", 1, false}, {"u16", 2, false}, {"i32", 4, true}, {"u32", 4, false}}) {
    const std::string key = fmt::format(
        "temperature = {{ object = 0x5FFF, sub = 7, type = \"{}\", scale = 0.1, warn = -40, stop = 300 }}\n", type);
    ASSERT_EQ(refusal(zero, zero + key), "") << type;
    temperature = read_device_file(file_).bus.drives[0].temperature;
    EXPECT_EQ(temperature.index, 0x5FFF);
    EXPECT_EQ(temperature.subindex, 7);
    EXPECT_EQ(temperature.size, size);
    EXPECT_EQ(temperature.is_signed, is_signed);
    EXPECT_EQ(temperature.scale, 0.1);
  }
}

TEST_F(DeviceFileTest, ReadsForHowLongADriveMayLimitItsTorque) {
  EXPECT_EQ(read_device_file(GODOBJECT_FIRMWARE_DIR "/devices/desktop6.toml").bus.limited_time, 0.05);
  ASSERT_EQ(refusal("drive_delay = 0.0", "drive_delay = 0.0\nlimited_time = 0.2"), "");
  EXPECT_EQ(read_device_file(file_).bus.limited_time, 0.2);
}

TEST_F(DeviceFileTest, ReadsTheDrivesDelay) {
  EXPECT_EQ(read_device_file(GODOBJECT_FIRMWARE_DIR "/devices/desktop6.toml").bus.drive_delay, 0.0);
  ASSERT_EQ(refusal("drive_delay = 0.0", "drive_delay = 0.005"), "");
  EXPECT_EQ(read_device_file(file_).bus.drive_delay, 0.005);
  EXPECT_EQ(read_device_file(file_).bus.answer, 0.0);
  ASSERT_EQ(refusal("drive_delay = 0.0", "drive_delay = 0.0\nanswer = 120e-6"), "");
  EXPECT_EQ(read_device_file(file_).bus.answer, 120e-6);
}

/// Joint 1: limits of +-1.2 rad about a zero of 0, gear 10. With 0.5 rad more, half a turn of 2^32 counts is at
/// pi * 2^32 / (counts * 10) = 1.7 rad, that is 793'708'100.3 counts.
TEST_F(DeviceFileTest, RefusesACounterWhosePositionWouldBeAmbiguous) {
  const std::string_view says = "joint[1].counts times gear";
  EXPECT_EQ(refusal("counts = 65536", "counts = 793708100"), "");
  EXPECT_NE(refusal("counts = 65536", "counts = 793708101").find(says), std::string::npos);
  EXPECT_NE(refusal("counts = 65536", "counts = 1e9").find(says), std::string::npos);
  // from a zero 0.4 rad off the limit on the other side is 1.6 rad away: 642'525'604.98 counts
  for (const char* zero : {"zero = 0.4", "zero = -0.4"}) {
    text_.replace(text_.find("zero = "), text_.find('\n', text_.find("zero = ")) - text_.find("zero = "), zero);
    EXPECT_EQ(refusal("counts = 65536", "counts = 642525604"), "") << zero;
    EXPECT_NE(refusal("counts = 65536", "counts = 642525605").find(says), std::string::npos) << zero;
  }
}

TEST_F(DeviceFileTest, RefusesTooManyJointsAndNone) {
  const std::size_t first = text_.find("\n[[joint]]");
  const std::string joint = text_.substr(first, text_.find("\n[[joint]]", first + 1) - first);
  EXPECT_NE(refusal("\n[[joint]]", joint + joint + "\n[[joint]]").find("has 8 [[joint]] tables"), std::string::npos);
  text_.erase(first, text_.find("\n[tool]") - first);
  EXPECT_NE(refusal("\n[tool]", "\n[tool]").find("has 0 [[joint]] tables"), std::string::npos);
}

TEST_F(DeviceFileTest, HoldsAnotherMeshFrameWithTheSameMechanics) {
  test::Random random(3);
  Device device = read_device_file(GODOBJECT_FIRMWARE_DIR "/devices/desktop6.toml");
  device.model.payload.com = Vector3(0.01, 0.02, -0.03);
  const Device before = device;
  const Pose H_TM = set_matrix(random.motion(0.1, 3.0));
  regrip(H_TM, device);
  const JointVector q = test::random_positions(random, device.model);
  const ArmKinematics kinematics = forward_kinematics(device.model, q);
  const ArmKinematics kinematics_before = forward_kinematics(before.model, q);
  const Pose H_RM = kinematics_before.H_RM * H_TM;  // the M before is T
  EXPECT_LT((kinematics.H_RM.translation - H_RM.translation).norm(), 1e-12);
  EXPECT_LT((gravity_torque(device.model, kinematics) - gravity_torque(before.model, kinematics_before)).norm(), 1e-12);
  EXPECT_LT((mass_matrix(device.model, kinematics) - mass_matrix(before.model, kinematics_before)).norm(), 1e-12);
}

}  // namespace
}  // namespace godobject::firmware::device_file_test
