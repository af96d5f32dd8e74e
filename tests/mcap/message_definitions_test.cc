#include "toolchain/mcap/message_definitions.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace godobject::mcap {
namespace {

const std::string kBegin = std::string(80, '=') + "\nMSG: ";

TEST(MessageDefinition, IsFollowedByThoseOfTheTypesThatItUses) {
  EXPECT_EQ(message_definition("geometry_msgs/WrenchStamped"),
            "std_msgs/Header header\ngeometry_msgs/Wrench wrench\n" +  //
                kBegin + "std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + kBegin +
                "geometry_msgs/Wrench\ngeometry_msgs/Vector3 force\ngeometry_msgs/Vector3 torque\n" + kBegin +
                "builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + kBegin +
                "geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n");
}

TEST(MessageDefinition, FindsTheElementsOfSequences) {
  const std::string text = message_definition("tf2_msgs/TFMessage");
  EXPECT_EQ(text.find("geometry_msgs/TransformStamped[] transforms\n"), 0u);
  EXPECT_NE(text.find(kBegin + "geometry_msgs/TransformStamped\n"), std::string::npos);
}

TEST(MessageDefinition, HasTheOrderOfTheBytes) {
  EXPECT_EQ(message_definition("geometry_msgs/Quaternion"), "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n");
  const std::string joints = message_definition("sensor_msgs/JointState");
  EXPECT_NE(joints.find("name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n"), std::string::npos);
}

TEST(MessageDefinition, KnowsOnlyItsTypes) { EXPECT_THROW((void)message_definition("a/B"), std::logic_error); }

}  // namespace
}  // namespace godobject::mcap
