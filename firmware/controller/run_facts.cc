#include "firmware/controller/run_facts.h"

#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "firmware/machine/rt_setup.h"

namespace godobject::firmware {
namespace {

toml::array joint_tables(const Device& device) {
  toml::array joints;
  for (int i = 0; i < device.model.joint_count; ++i) {
    const ArmJoint& joint = device.model.joints[static_cast<std::size_t>(i)];
    const hal::DriveConfig& drive = device.bus.drives[static_cast<std::size_t>(i)];
    joints.push_back(toml::table{{"lower", joint.lower},
                                 {"upper", joint.upper},
                                 {"velocity", joint.velocity},
                                 {"torque", joint.torque},
                                 {"bus", drive.bus},
                                 {"node", drive.node}});
  }
  return joints;
}

std::string run_file(const ControllerConfig& config, const SceneFile& image, const std::string& began,
                     const std::vector<std::string>& buses) {
  toml::array names;
  for (const std::string& bus : buses) names.push_back(bus);
  const ControllerConfig::Limits& limits = config.limits;
  std::ostringstream text;
  text << "# What ran, in SI units. Written by godobject-controller, read by godobject-controller explain.\n"
       << toml::table{{"program", config.telemetry.program},
                      {"machine", describe_machine()},
                      {"began", began},
                      {"device", config.device.name},
                      {"image", std::filesystem::absolute(config.scene.image).string()},
                      {"image_bytes", static_cast<std::int64_t>(image.size())},
                      {"image_checksum", fmt::format("{:016x}", image.checksum())},
                      {"buses", names},
                      {"loop", toml::table{{"period", config.device.bus.period},
                                           {"compute", config.loop.compute},
                                           {"velocity_window", config.loop.velocity_window},
                                           {"scale", config.workspace.scale}}},
                      {"limits", toml::table{{"force", limits.force},
                                             {"torque", limits.torque},
                                             {"speed_stop", limits.speed_stop},
                                             {"turn_stop", limits.turn_stop},
                                             {"joint_speed_stop", limits.joint_speed_stop}}},
                      {"joint", joint_tables(config.device)}}
       << '\n';
  return text.str();
}

}  // namespace

std::vector<RecordFile> run_facts(const ControllerConfig& config, const SceneFile& image, const std::string& began,
                                  const std::vector<std::string>& buses) {
  std::vector<RecordFile> files{{kRunFile, run_file(config, image, began, buses)}};
  const std::span<const std::byte> provenance = image.scene().provenance;
  if (!config.text.empty()) files.push_back({"controller.toml", config.text});
  if (!config.device.text.empty()) files.push_back({"device.toml", config.device.text});
  if (!provenance.empty()) {
    files.push_back({"image.json", std::string(reinterpret_cast<const char*>(provenance.data()), provenance.size())});
  }
  return files;
}

}  // namespace godobject::firmware
