#pragma once

#include <string>
#include <string_view>

namespace godobject::mcap {

/// Returns the definition of a message type and, after it, those of all types that it uses: the schema encoding
/// `ros2msg` of MCAP. `type`: as `geometry_msgs/WrenchStamped`, one of the types of message_definitions.cc.
std::string message_definition(std::string_view type);

}  // namespace godobject::mcap
