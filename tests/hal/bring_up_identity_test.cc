// The start compares the identities of the drives before it writes to any of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "hal/cia402/bring_up.h"
#include "tests/hal/bring_up_bench.h"

namespace godobject::hal {
namespace {

constexpr std::uint32_t kVendor = 0x29C;
constexpr std::uint32_t kProduct = 0x1234;
constexpr std::uint32_t kRevision = 0x20001;

/// Three drives of one product with the serial numbers 100, 101 and 102 by joint; the layout names all fields.
class BringUpIdentityTest : public BringUpTest {
 protected:
  BringUpIdentityTest() {
    for (int i = 0; i < 3; ++i) {
      const auto serial = static_cast<std::uint32_t>(100 + i);
      identity(i) = {.vendor = kVendor, .product = kProduct, .revision = kRevision, .serial = serial};
      drive(i).object(0x1018, 0) = {1, 4};
      drive(i).object(0x1018, 1) = {4, kVendor};
      drive(i).object(0x1018, 2) = {4, kProduct};
      drive(i).object(0x1018, 3) = {4, kRevision};
      drive(i).object(0x1018, 4) = {4, serial};
    }
  }

  DriveIdentity& identity(int joint) { return layout_.drives[static_cast<std::size_t>(joint)].identity; }
  ScriptedNode& drive(int joint) { return joint == 0 ? joint_0_ : joint == 1 ? joint_1_ : joint_2_; }
  void tell_serial(int joint, int serial) { drive(joint).object(0x1018, 4).value = static_cast<std::uint32_t>(serial); }

  /// Starts, and checks that a refused start has neither written to a drive nor sent it a command or NMT start.
  BringUpResult start_refused() {
    world_.log.clear();
    for (int i = 0; i < 3; ++i) {
      drive(i).nmt.clear();
      drive(i).writes.clear();
    }
    const BringUpResult result = start();
    EXPECT_NE(result.status, BringUpStatus::kOk);
    EXPECT_TRUE(sent_no_command());
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(drive(i).writes.empty()) << i;
      EXPECT_EQ(drive(i).nmt, std::vector<int>{0x82}) << i << ": it is only reset";
    }
    return result;
  }
};

TEST_F(BringUpIdentityTest, StartsTheDrivesThatTheLayoutNames) {
  EXPECT_EQ(start().status, BringUpStatus::kOk);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(drive(i).nmt.back(), 0x01) << i;
}

/// Each field of each drive, one too large and in its highest bit, also where the layout names this field alone.
TEST_F(BringUpIdentityTest, RefusesEachWrongFieldOfEachDrive) {
  const std::array<int, 3> nodes = {1, 1, 2};
  for (int i = 0; i < 3; ++i) {
    for (const IdentityField& field : kIdentityFields) {
      for (const bool alone : {false, true}) {
        for (const std::uint32_t flip : {1u, 0x80000000u}) {
          const std::array<DriveConfig, kMaxJoints> before = layout_.drives;
          std::uint32_t& told = drive(i).object(0x1018, field.subindex).value;
          const std::uint32_t right = told;
          if (alone) {
            for (int k = 0; k < 3; ++k) identity(k) = {};
            identity(i).*field.value = right;
          }
          // a serial number of the product that no drive has
          told = field.subindex == 4 ? right ^ (flip << 8 | flip) : right ^ flip;
          const BringUpResult result = start_refused();
          EXPECT_EQ(result.status, BringUpStatus::kWrongDrive) << i << field.name;
          EXPECT_EQ(result.joint, i);
          EXPECT_EQ(result.node, nodes.at(static_cast<std::size_t>(i)));
          EXPECT_EQ(result.bus, i == 1 ? 1 : 0);
          EXPECT_EQ(result.index, 0x1018);
          EXPECT_EQ(result.subindex, field.subindex);
          EXPECT_EQ(result.expected, right);
          EXPECT_EQ(result.found, told);
          EXPECT_EQ(result.other_joint, -1);
          told = right;
          layout_.drives = before;
        }
      }
    }
  }
  EXPECT_EQ(start().status, BringUpStatus::kOk) << "all are right again";
}

TEST_F(BringUpIdentityTest, FieldsThatTheLayoutDoesNotNameMayBeAnything) {
  for (int i = 0; i < 3; ++i) identity(i) = {};
  EXPECT_EQ(start().status, BringUpStatus::kOk);
  for (int i = 0; i < 3; ++i) identity(i).product = kProduct;
  tell_serial(0, 101);
  tell_serial(1, 100);
  drive(2).object(0x1018, 3).value = 7;
  EXPECT_EQ(start().status, BringUpStatus::kOk) << "two swapped drives are not found without their serial numbers";
}

/// Each pair, on one bus and on two; either joint is named first by its number.
TEST_F(BringUpIdentityTest, NamesBothJointsOfEachSwappedPair) {
  for (const auto& [i, j] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
    for (const bool only_serials : {false, true}) {
      for (int k = 0; k < 3; ++k) {
        if (only_serials) identity(k) = {.serial = static_cast<std::uint32_t>(100 + k)};
      }
      tell_serial(i, 100 + j);
      tell_serial(j, 100 + i);
      const BringUpResult result = start_refused();
      EXPECT_EQ(result.status, BringUpStatus::kDrivesSwapped) << i << j;
      EXPECT_EQ(result.joint, i);
      EXPECT_EQ(result.other_joint, j);
      EXPECT_EQ(result.subindex, 4);
      EXPECT_EQ(result.expected, static_cast<std::uint32_t>(100 + i));
      EXPECT_EQ(result.found, static_cast<std::uint32_t>(100 + j));
      tell_serial(i, 100 + i);
      tell_serial(j, 100 + j);
    }
  }
}

/// Two drives of different products: the serial numbers tell the swap, although the product differs first.
TEST_F(BringUpIdentityTest, NamesASwapOfDifferentProducts) {
  identity(2).product = 0x77;
  drive(0).object(0x1018, 2).value = 0x77;
  tell_serial(0, 102);
  tell_serial(2, 100);
  const BringUpResult result = start_refused();
  EXPECT_EQ(result.status, BringUpStatus::kDrivesSwapped);
  EXPECT_EQ(result.joint, 0);
  EXPECT_EQ(result.other_joint, 2);
  EXPECT_EQ(result.subindex, 4);
}

/// Three drives that have changed places are no swap of two: no exchange of two puts them right.
TEST_F(BringUpIdentityTest, NamesTheJointOfADriveThatIsElsewhere) {
  tell_serial(0, 101);
  tell_serial(1, 102);
  tell_serial(2, 100);
  const BringUpResult result = start_refused();
  EXPECT_EQ(result.status, BringUpStatus::kDriveElsewhere);
  EXPECT_EQ(result.joint, 0);
  EXPECT_EQ(result.other_joint, 2);
  EXPECT_EQ(result.expected, 100u);
  EXPECT_EQ(result.found, 101u);
}

/// The layout names one serial number only: the swap is found at that joint.
TEST_F(BringUpIdentityTest, FindsASwapOfWhichOneSerialNumberIsNamed) {
  identity(0).serial.reset();
  identity(1).serial.reset();
  tell_serial(1, 102);
  tell_serial(2, 101);
  const BringUpResult result = start_refused();
  EXPECT_EQ(result.status, BringUpStatus::kDriveElsewhere);
  EXPECT_EQ(result.joint, 2);
  EXPECT_EQ(result.other_joint, 1);
}

/// A serial number is one of its product: that of another product is no trace of the expected drive.
TEST_F(BringUpIdentityTest, TheSerialNumberOfAnotherProductIsNoSwap) {
  drive(1).object(0x1018, 2).value = 0x77;
  identity(1) = {};
  tell_serial(0, 55);
  tell_serial(1, 100);
  const BringUpResult result = start_refused();
  EXPECT_EQ(result.status, BringUpStatus::kWrongDrive);
  EXPECT_EQ(result.joint, 0);
  EXPECT_EQ(result.subindex, 4);
  EXPECT_EQ(result.other_joint, -1);
}

/// Revision 4 of 1018 may be missing by CiA 301, with either abort code, and so may the whole object.
TEST_F(BringUpIdentityTest, RefusesAFieldThatIsNamedButThatTheDriveLacks) {
  for (const std::uint32_t absent : {0x06020000u, 0x06090011u}) {
    for (const IdentityField& field : kIdentityFields) {
      joint_1_.absent = absent;
      const ScriptedNode::Object before = joint_1_.object(0x1018, field.subindex);
      joint_1_.objects.erase({0x1018, field.subindex});
      const BringUpResult result = start_refused();
      EXPECT_EQ(result.status, BringUpStatus::kNoIdentity) << field.name;
      EXPECT_EQ(result.joint, 1);
      EXPECT_EQ(result.subindex, field.subindex);
      const std::optional<std::uint32_t> named = identity(1).*field.value;
      EXPECT_EQ(result.expected, named);
      (identity(1).*field.value).reset();
      EXPECT_EQ(start().status, BringUpStatus::kOk) << field.name << " is not named";
      identity(1).*field.value = named;
      joint_1_.object(0x1018, field.subindex) = before;
    }
  }
}

/// Any other abort, and a number of another size, is refused if the layout names the field.
TEST_F(BringUpIdentityTest, RefusesAnAbortAndAnotherSizeOfAFieldThatIsNamed) {
  joint_2_.absent = 0x08000000;
  joint_2_.objects.erase({0x1018, 4});
  BringUpResult result = start_refused();
  EXPECT_EQ(result.status, BringUpStatus::kRefused);
  EXPECT_EQ(result.joint, 2);
  EXPECT_EQ(result.found, 0x08000000u);
  identity(2).serial.reset();
  joint_2_.absent = 0x06020000;
  joint_2_.change_answer = [](const CanFrame& request, CanFrame& answer) {
    if (request.data[1] == 0x18 && request.data[2] == 0x10 && request.data[3] == 4) answer.data[4] = answer.data[7] = 8;
  };
  EXPECT_EQ(start().status, BringUpStatus::kOk) << "the abort is of a field that nobody asks for";
  joint_2_.change_answer = [](const CanFrame&, CanFrame&) {};
  for (const int size : {2, 8}) {
    joint_2_.object(0x1018, 4) = {size, 102};
    identity(2).serial = 102;
    result = start_refused();
    EXPECT_EQ(result.status, BringUpStatus::kWrongSize) << size;
    EXPECT_EQ(result.expected, 4u);
    identity(2).serial.reset();
    EXPECT_EQ(start().status, BringUpStatus::kOk) << size;
  }
}

/// Silence is never taken for a missing field: the next answer could be that of this request.
TEST_F(BringUpIdentityTest, RefusesADriveThatDoesNotAnswerForItsIdentity) {
  for (const bool named : {true, false}) {
    for (int i = 0; !named && i < 3; ++i) identity(i) = {};
    joint_2_.before_answer_to = [&](const CanFrame& request, FakeBus&) {
      joint_2_.answers = !(request.data[1] == 0x18 && request.data[2] == 0x10 && request.data[3] == 3);
    };
    joint_2_.change_answer = [&](const CanFrame&, CanFrame& answer) {
      if (!joint_2_.answers) answer.id = 0x7FF;  // it is lost
    };
    const BringUpResult result = start_refused();
    EXPECT_EQ(result.status, BringUpStatus::kNoAnswer);
    EXPECT_EQ(result.joint, 2);
    EXPECT_EQ(result.index, 0x1018);
    EXPECT_EQ(result.subindex, 3);
    joint_2_.answers = true;
  }
}

/// An answer for another object, or of another node, is not the identity.
TEST_F(BringUpIdentityTest, TakesNoOtherAnswerForTheIdentity) {
  joint_0_.before_answer_to = [&](const CanFrame& request, FakeBus& bus) {
    if (request.data[1] != 0x18 || request.data[2] != 0x10) return;
    bus.receive_next(frame(0x582, {0x43, 0x18, 0x10, request.data[3], 1, 2, 3, 4}));
    bus.receive_next(frame(0x581, {0x43, 0x18, 0x10, request.data[3] + 1, 1, 2, 3, 4}));
  };
  EXPECT_EQ(start().status, BringUpStatus::kOk);
}

/// The temperature that a drive tells at the start, at its limit and a count below it.
TEST_F(BringUpIdentityTest, RefusesADriveThatIsTooHotOrTellsNoTemperature) {
  layout_.drives[2].temperature = {.index = 0x2310, .subindex = 1, .scale = 0.1, .warn = 60.0, .stop = 85.0};
  BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kRefused) << "it has no such object";
  EXPECT_EQ(result.joint, 2);
  EXPECT_EQ(result.index, 0x2310);
  EXPECT_EQ(result.subindex, 1);
  joint_2_.object(0x2310, 1) = {2, 849};
  EXPECT_EQ(start().status, BringUpStatus::kOk);
  joint_2_.object(0x2310, 1).value = 0xFFFF;
  EXPECT_EQ(start().status, BringUpStatus::kOk) << "minus a tenth of a degree";
  joint_2_.object(0x2310, 1).value = 850;
  world_.log.clear();
  result = start();
  EXPECT_EQ(result.status, BringUpStatus::kTooHot);
  EXPECT_EQ(result.joint, 2);
  EXPECT_NEAR(result.celsius, 85.0, 1e-9);
  EXPECT_EQ(result.most_celsius, 85.0);
  EXPECT_TRUE(sent_no_command());
  joint_2_.object(0x2310, 1) = {4, 300};
  EXPECT_EQ(start().status, BringUpStatus::kWrongSize);
}

/// The first wrong field of the first wrong drive is told, and after an ignored abort nothing of it stays.
TEST_F(BringUpIdentityTest, TellsTheFirstWrongFieldOfTheFirstWrongDrive) {
  drive(1).object(0x1018, 2).value = 9;
  drive(1).object(0x1018, 4).value = 9;
  drive(2).object(0x1018, 1).value = 9;
  BringUpResult result = start_refused();
  EXPECT_EQ(result.joint, 1);
  EXPECT_EQ(result.subindex, 2);
  EXPECT_EQ(result.found, 9u);
  identity(1) = {};
  result = start_refused();
  EXPECT_EQ(result.joint, 2);
  EXPECT_EQ(result.subindex, 1);
}

}  // namespace
}  // namespace godobject::hal
