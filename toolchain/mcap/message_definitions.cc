#include "toolchain/mcap/message_definitions.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace godobject::mcap {
namespace {

struct Definition {
  std::string_view type;
  std::string_view fields;
};

// The first ones are types of ROS 2: their fields and the order of these are given. The last ones are types of this
// project.
constexpr std::array<Definition, 22> kDefinitions = {{
    {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    {"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"},
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    {"geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    {"geometry_msgs/Transform", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    {"geometry_msgs/Wrench", "geometry_msgs/Vector3 force\ngeometry_msgs/Vector3 torque\n"},
    {"geometry_msgs/WrenchStamped", "std_msgs/Header header\ngeometry_msgs/Wrench wrench\n"},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    {"sensor_msgs/JointState",
     "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n"},
    {"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
    {"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n"},
    {"visualization_msgs/MeshFile", "string filename\nuint8[] data\n"},
    {"visualization_msgs/Marker",
     "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\ngeometry_msgs/Pose pose\n"
     "geometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\nbuiltin_interfaces/Duration lifetime\nbool frame_locked\n"
     "geometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\nstring texture_resource\n"
     "sensor_msgs/CompressedImage texture\nvisualization_msgs/UVCoordinate[] uv_coordinates\nstring text\n"
     "string mesh_resource\nvisualization_msgs/MeshFile mesh_file\nbool mesh_use_embedded_materials\n"},
    {"visualization_msgs/MarkerArray", "visualization_msgs/Marker[] markers\n"},
    {"godobject_msgs/Cycle",
     "std_msgs/Header header\nstring outcome\nfloat64 depth\nfloat64 stretch\nuint32 contacts\n"},
    {"godobject_msgs/SolverTimes", "std_msgs/Header header\nfloat64 look_ups\nfloat64 solver\n"},
    {"godobject_msgs/Controller",
     "std_msgs/Header header\nstring mode\nint32 fault\nfloat64 share\nfloat64 late\nfloat64 compute\n"
     "float64 absorbed\n"},
}};

std::string_view fields_of(std::string_view type) {
  const auto found =
      std::find_if(kDefinitions.begin(), kDefinitions.end(), [&](const Definition& d) { return d.type == type; });
  if (found == kDefinitions.end()) throw std::logic_error(fmt::format("no definition of {}", type));
  return found->fields;
}

/// Appends the types that `fields` use and that `types` does not have yet: those with a package.
void add_used_types(std::string_view fields, std::vector<std::string_view>& types) {
  for (; !fields.empty(); fields.remove_prefix(fields.find('\n') + 1)) {
    const std::string_view type = fields.substr(0, fields.find_first_of(" ["));
    if (type.find('/') != std::string_view::npos && std::find(types.begin(), types.end(), type) == types.end())
      types.push_back(type);
  }
}

}  // namespace

std::string message_definition(std::string_view type) {
  std::vector<std::string_view> types{type};
  std::string text;
  for (std::size_t i = 0; i < types.size(); ++i) {
    const std::string_view fields = fields_of(types[i]);
    if (i > 0) text += fmt::format("{}\nMSG: {}\n", std::string(80, '='), types[i]);
    text += fields;
    add_used_types(fields, types);
  }
  return text;
}

}  // namespace godobject::mcap
