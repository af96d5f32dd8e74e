// The EDS files against the nodes that they describe, both ways.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "sim/cia401_panel.h"
#include "sim/cia402_slave.h"
#include "tests/sim/canopen_bench.h"

namespace godobject::sim {
namespace {

constexpr int kDescribedNode = 5;

using Section = std::map<std::string, std::string>;

/// Sections of an INI file in the form that CiA 306 wants.
std::map<std::string, Section> read_eds(const std::string& name) {
  std::map<std::string, Section> sections;
  std::ifstream file(std::string(GODOBJECT_EDS_DIR "/") + name);
  std::string section;
  for (std::string line; std::getline(file, line);) {
    if (line.empty()) continue;
    if (line.front() == '[') {
      section = line.substr(1, line.find(']') - 1);
      EXPECT_FALSE(sections.contains(section)) << section << " is there twice";
      continue;
    }
    const std::size_t equals = line.find('=');
    EXPECT_NE(equals, std::string::npos) << line;
    EXPECT_TRUE(sections[section].emplace(line.substr(0, equals), line.substr(equals + 1)).second) << line;
  }
  return sections;
}

/// 0x80, -3, $NODEID, $NODEID+0x80.
std::uint32_t number(const std::string& text) {
  constexpr std::string_view kOfNode = "$NODEID";
  const bool of_node = text.starts_with(kOfNode);
  std::string rest = of_node ? text.substr(kOfNode.size()) : text;
  if (rest.starts_with('+')) rest.erase(0, 1);
  const auto value = rest.empty() ? 0 : static_cast<std::uint32_t>(std::stoll(rest, nullptr, 0));
  return value + (of_node ? kDescribedNode : 0);
}

std::string section_of(const ObjectDictionary& objects, const ObjectEntry& entry) {
  std::array<char, 5> hex{};
  std::snprintf(hex.data(), hex.size(), "%04X", entry.index);
  std::string name = hex.data();
  const auto all = objects.entries();
  const auto subs = std::ranges::count_if(all, [&](const ObjectEntry& e) { return e.index == entry.index; });
  if (subs == 1) return name;
  std::snprintf(hex.data(), hex.size(), "%X", entry.sub);
  return name + "sub" + hex.data();
}

std::string access_of(const ObjectEntry& entry) {
  switch (entry.access) {
    case ObjectAccess::kConst: return "const";
    case ObjectAccess::kReadOnly: return "ro";
    case ObjectAccess::kWriteOnly: return "wo";
    case ObjectAccess::kReadWrite: break;
  }
  return entry.mapping == Mapping::kFromNetwork ? "rww" : "rw";
}

std::uint32_t within(std::uint32_t value, ObjectType type) {
  return size_of(type) == 4 ? value : value & ((1u << 8 * size_of(type)) - 1u);
}

/// `of_the_device`: objects whose default is the device file's.
template <class Node>
void compare(const std::string& file, Node& node, const std::set<int>& of_the_device) {
  auto sections = read_eds(file);
  ASSERT_TRUE(sections.contains("DeviceInfo"));
  test::NodeBench<Node> bench{node};
  bench.boot();
  std::set<std::string> described;
  for (const ObjectEntry& entry : node.objects().entries()) {
    const std::string name = section_of(node.objects(), entry);
    SCOPED_TRACE(file + ' ' + name);
    ASSERT_TRUE(sections.contains(name));
    const Section& section = sections[name];
    described.insert(name);
    EXPECT_FALSE(section.at("ParameterName").empty());
    EXPECT_EQ(section.at("ObjectType"), "0x7");
    EXPECT_EQ(number(section.at("DataType")), static_cast<std::uint32_t>(entry.type));
    EXPECT_EQ(section.at("AccessType"), access_of(entry));
    EXPECT_EQ(section.at("PDOMapping"), entry.mapping == Mapping::kNo ? "0" : "1");
    const bool has_default = section.contains("DefaultValue");
    EXPECT_EQ(has_default, !(of_the_device.contains(entry.index) && entry.sub <= 1 && entry.type != ObjectType::kU8));
    if (has_default) {
      EXPECT_EQ(within(number(section.at("DefaultValue")), entry.type), entry.initial);
    }
  }
  // and everything that it describes answers
  std::map<int, int> subs;
  for (const auto& [name, section] : sections) {
    if (!section.contains("ParameterName") || section.contains("SubNumber")) continue;
    SCOPED_TRACE(file + ' ' + name);
    EXPECT_TRUE(described.contains(name));
    const int index = std::stoi(name.substr(0, 4), nullptr, 16);
    const int sub = name.size() > 4 ? std::stoi(name.substr(7), nullptr, 16) : 0;
    ++subs[index];
    const hal::CanFrame answer = bench.sdo(index, sub);
    EXPECT_EQ(answer.data[0] == 0x80, section.at("AccessType") == "wo");
  }
  std::set<int> listed;
  for (const char* group : {"MandatoryObjects", "OptionalObjects", "ManufacturerObjects"}) {
    const Section& list = sections.at(group);
    EXPECT_EQ(number(list.at("SupportedObjects")), list.size() - 1);
    for (const auto& [key, value] : list) {
      if (key == "SupportedObjects") continue;
      EXPECT_TRUE(listed.insert(static_cast<int>(number(value))).second) << value;
    }
  }
  EXPECT_EQ(listed.size(), subs.size());
  for (const auto& [index, count] : subs) {
    EXPECT_TRUE(listed.contains(index)) << std::hex << index;
    if (count == 1) continue;
    std::array<char, 5> hex{};
    std::snprintf(hex.data(), hex.size(), "%04X", static_cast<unsigned>(index));
    EXPECT_EQ(number(sections.at(hex.data()).at("SubNumber")), static_cast<unsigned>(count)) << hex.data();
  }
  for (int i = 1; i <= 7; ++i) EXPECT_TRUE(sections.at("DummyUsage").contains("Dummy000" + std::to_string(i)));
}

TEST(Eds, DescribesTheDrive) {
  const hal::DriveConfig config{.node = kDescribedNode, .counts = 1000.0, .gear = 10.0, .rated_torque = 2.0};
  Cia402Slave drive(config, {.torque_limit = 20.0}, false);
  compare("godobject-drive.eds", drive, {0x6072, 0x6076, 0x608F, 0x6091, 0x60E0, 0x60E1});
}

TEST(Eds, DescribesThePanel) {
  Cia401Panel panel({.bus = 0, .node = kDescribedNode}, false);
  compare("godobject-panel.eds", panel, {});
}

}  // namespace
}  // namespace godobject::sim
