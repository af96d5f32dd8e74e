#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/device/velocity_estimator.h"
#include "firmware/configuration/controller_file.h"
#include "firmware/configuration/device_file.h"
#include "tests/support/folder_test.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware::file_bounds_test {
namespace {

using command::ExitCode;
using command::Failure;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A key with one number: its range, both ends included, and the number if the key is absent.
struct Key {
  const char* table;
  const char* name;
  double low, high;
  double fallback;  ///< kNone: there is none
  std::function<double(const ControllerConfig&)> value;
  bool whole = false;
  const char* above = "is out of range";  ///< the message for a number above `high`
};

std::string text_of(double value, bool whole) {
  if (whole) return fmt::format("{:.0f}", value);
  const std::string text = fmt::format("{:.17g}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}
/// The next number outside a range; below zero, one that a file can hold.
double below(double low, bool whole) {
  if (whole) return low - 1.0;
  return low == 0.0 ? -1e-300 : std::nextafter(low, -HUGE_VAL);
}
double above(double high, bool whole) { return whole ? high + 1.0 : std::nextafter(high, HUGE_VAL); }

/// An absent optional number is kNone.
double given(const std::optional<double>& number) { return number.value_or(kNone); }

using C = ControllerConfig;
const char* const kHand = "does not protect the hand of a person";

const std::vector<Key> kControllerKeys = {
    {"workspace", "scale", 1e-3, 1e3, 1.0, [](const C& c) { return c.workspace.scale; }},
    {"loop", "cpu", -1, 1023, -1, [](const C& c) { return double(c.loop.cpu); }, true},
    {"loop", "priority", 1, 98, 80, [](const C& c) { return double(c.loop.priority); }, true},
    {"loop", "velocity_window", 2, VelocityEstimator::kMaxWindow, 4,
     [](const C& c) { return double(c.loop.velocity_window); }, true},
    {"loop", "compute", 1e-6, 0.9e-3, 120e-6, [](const C& c) { return c.loop.compute; }},
    {"loop", "compute", 1e-6, 0.9e-3, 120e-6, [](const C& c) { return c.device.bus.compute; }},
    {"loop", "cycle_budget", 0.0, 0.9e-3, -1.0, [](const C& c) { return c.loop.cycle_budget.value_or(-1.0); }},
    {"limits", "force", 1e-3, 140.0, 30.0, [](const C& c) { return c.limits.force; }, false, kHand},
    {"limits", "torque", 1e-4, 10.0, 3.0, [](const C& c) { return c.limits.torque; }, false, kHand},
    {"limits", "speed", 1e-3, 5.0, 1.0, [](const C& c) { return c.limits.speed; }, false, kHand},
    {"limits", "speed_stop", 1.05, 7.5, 1.5, [](const C& c) { return c.limits.speed_stop; }, false, kHand},
    {"limits", "turn", 1e-2, 30.0, 6.0, [](const C& c) { return c.limits.turn; }, false, kHand},
    {"limits", "turn_stop", 1.05 * 6.0, 45.0, 9.0, [](const C& c) { return c.limits.turn_stop; }, false, kHand},
    {"limits", "joint_speed", 0.05, 1.0, 0.8, [](const C& c) { return c.limits.joint_speed; }},
    {"limits", "joint_speed_stop", 1.05 * 0.8, 1.4, 1.0, [](const C& c) { return c.limits.joint_speed_stop; }},
    {"limits", "torque_rate", 1e-4, 0.05, 0.05, [](const C& c) { return c.limits.torque_rate; }},
    {"limits", "stuck_torque", 1e-4, 0.5, 0.005, [](const C& c) { return c.limits.stuck_torque; }},
    {"engage", "force", 1e-3, 30.0, 0.5, [](const C& c) { return c.engage.force; }},
    {"engage", "ramp", 0.02, 10.0, 0.5, [](const C& c) { return c.engage.ramp; }},
    {"start", "wait", 0.1, 60.0, 5.0, [](const C& c) { return c.start.wait; }},
    {"start", "push", 1e-3, 0.2, 0.05, [](const C& c) { return c.start.push; }},
    {"start", "motion", 1e-5, 0.02, 0.002, [](const C& c) { return c.start.motion; }},
    {"gains", "stiffness", 1e-3, 1e6, kNone, [](const C& c) { return given(c.gains.stiffness); }},
    {"gains", "damping", 0.0, 1e5, kNone, [](const C& c) { return given(c.gains.damping); }},
    {"gains", "rotational", 1e-9, 100.0, kNone, [](const C& c) { return given(c.gains.rotational); }},
    {"gains", "margin", 1.0, 100.0, 1.25, [](const C& c) { return c.gains.margin; }},
    {"passivity", "damping", 0.0, 1e5, 0.0, [](const C& c) { return c.passivity.damping; }},
    {"telemetry", "every", 1, 1000, 1, [](const C& c) { return double(c.telemetry.every); }, true},
    {"simulation", "slower", 1.0, 1e3, 1.0, [](const C& c) { return c.simulation.slower; }},
    {"simulation", "begin", 0.0, 1e5, 8.0, [](const C& c) { return c.simulation.begin; }},
};

class ControllerKeyTest : public test::FolderTest {
 protected:
  /// The device and a posture, with the rest of the table `workspace` last.
  static std::string least() {
    return "[device]\nfile = \"" GODOBJECT_FIRMWARE_DIR
           "/devices/desktop6.toml\"\n[workspace]\nposture = [0.1, 0.6, -0.2, 0.3, 0.2, 0.0]\n";
  }
  static std::string with(const std::string& table, const std::string& line) {
    return least() + (table == "workspace" ? "" : "[" + table + "]\n") + line + "\n";
  }
  static std::string place(const std::string& table) { return table == "workspace" ? ".toml:5: " : ".toml:6: "; }

  C read(const std::string& text) const {
    std::ofstream(file_) << text;
    return read_controller_file(file_);
  }

  /// The message with which the text is refused; empty if it is not.
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), ExitCode::kBadConfig);
      return failure.what();
    }
    return {};
  }

  void expect_refused(const std::string& table, const std::string& line, const std::string& says) const {
    const std::string message = refusal(with(table, line));
    EXPECT_NE(message.find(place(table) + table + "." + says), std::string::npos)
        << table << ' ' << line << ": '" << message << "' should say: " << says;
  }

  const std::filesystem::path file_ = folder_ / "controller.toml";
};

TEST_F(ControllerKeyTest, AcceptsBothEndsOfEachRangeAndRefusesTheNextNumber) {
  const C defaults = read(least());
  for (const Key& key : kControllerKeys) {
    const std::string name = key.name;
    SCOPED_TRACE(std::string(key.table) + "." + name);
    if (std::isnan(key.fallback)) {
      EXPECT_TRUE(std::isnan(key.value(defaults)));
    } else {
      EXPECT_EQ(key.value(defaults), key.fallback);
    }
    for (const double end : {key.low, key.high}) {
      const std::string text = with(key.table, name + " = " + text_of(end, key.whole));
      ASSERT_EQ(refusal(text), "");
      EXPECT_EQ(key.value(read(text)), end);
    }
    expect_refused(
        key.table, name + " = " + text_of(below(key.low, key.whole), key.whole),
        fmt::format("{} = {:g} is out of range; it must be from {:g} to", name, below(key.low, key.whole), key.low));
    expect_refused(
        key.table, name + " = " + text_of(above(key.high, key.whole), key.whole),
        fmt::format(
            "{} = {:g} {}", name, above(key.high, key.whole),
            key.above == kHand ? "" : fmt::format("{}; it must be from {:g} to {:g}", key.above, key.low, key.high)));
    if (key.above == kHand) {
      const std::string message = refusal(with(key.table, name + " = " + text_of(above(key.high, key.whole), false)));
      EXPECT_NE(message.find(fmt::format("{}; at most {:g} ", key.above, key.high)), std::string::npos) << message;
    }
    const char* type = key.whole ? " must be a whole number" : " must be a number";
    expect_refused(key.table, name + " = \"1\"", name + type);
    expect_refused(key.table, name + " = true", name + type);
    if (key.whole) expect_refused(key.table, name + " = 2.0", name + type);
    if (!key.whole) {
      for (const char* number : {"nan", "inf", "-inf"}) {
        expect_refused(key.table, name + " = " + number, name + " = " + number + " is out of range");
      }
    }
  }
}

TEST_F(ControllerKeyTest, RangesAndDefaultsFollowTheKeysThatTheyDependOn) {
  EXPECT_EQ(read(with("limits", "speed = 2.0")).limits.speed_stop, 3.0);
  EXPECT_EQ(read(with("limits", "turn = 2.0")).limits.turn_stop, 3.0);
  EXPECT_EQ(read(with("limits", "joint_speed = 0.4")).limits.joint_speed_stop, 0.5);
  EXPECT_EQ(refusal(with("limits", "speed = 2.0\nspeed_stop = 2.1")), "");
  EXPECT_NE(refusal(with("limits", "speed = 2.0\nspeed_stop = 2.0999")), "");
  EXPECT_EQ(refusal(with("limits", "turn = 20.0\nturn_stop = 21.0")), "");
  EXPECT_NE(refusal(with("limits", "turn = 20.0\nturn_stop = 20.999")), "");
  EXPECT_EQ(refusal(with("limits", "joint_speed = 0.4\njoint_speed_stop = 0.4201")), "");
  EXPECT_NE(refusal(with("limits", "joint_speed = 0.4\njoint_speed_stop = 0.4199")), "");
  EXPECT_EQ(refusal(with("limits", "force = 5.0\n[engage]\nforce = 5.0")), "");
  EXPECT_NE(refusal(with("limits", "force = 5.0\n[engage]\nforce = 5.001")), "");
}

/// Velocities over 3 ms, and a computing time that leaves room for the frames.
TEST_F(ControllerKeyTest, HasDefaultsThatFollowThePeriodOfTheDevice) {
  std::ifstream stream(GODOBJECT_FIRMWARE_DIR "/devices/desktop6.toml");
  const std::string desktop((std::istreambuf_iterator<char>(stream)), {});
  const std::string bus = "[bus]\n";
  for (const auto& [period, window, compute, longest] : {std::tuple{"0.000125", 25, 20e-6, 112.5e-6},
                                                         {"0.00025", 13, 40e-6, 225e-6},
                                                         {"0.002", 3, 120e-6, 1.8e-3},
                                                         {"0.01", 2, 120e-6, 9e-3}}) {
    std::string device = desktop;
    device.insert(device.find(bus) + bus.size(), fmt::format("period = {}\n", period));
    std::ofstream(folder_ / "other.toml") << device;
    std::string text = least();
    const std::size_t file = text.find("file = \"") + 8;
    text.replace(file, text.find('"', file) - file, (folder_ / "other.toml").string());
    const ControllerConfig config = read(text);
    EXPECT_EQ(config.loop.velocity_window, window) << period;
    EXPECT_DOUBLE_EQ(config.loop.compute, compute) << period;
    EXPECT_EQ(config.device.bus.compute, config.loop.compute);
    for (const double share : {0.999, 1.001}) {
      const std::string loop = fmt::format("[loop]\ncompute = {}\n", share * longest);
      EXPECT_EQ(refusal(text + loop).empty(), share < 1.0) << period;
    }
  }
}

/// A force limit below the default of engage.force is a limit of that, too.
TEST_F(ControllerKeyTest, EngagesAtNoMoreThanTheForceLimit) {
  EXPECT_EQ(read(with("limits", "force = 0.2")).engage.force, 0.2);
  EXPECT_EQ(read(with("limits", "force = 0.6")).engage.force, 0.5);
}

TEST_F(ControllerKeyTest, ReadsEveryFlagAndPath) {
  struct Flag {
    const char* table;
    const char* name;
    bool fallback;
    std::function<bool(const C&)> value;
  };
  const C defaults = read(least());
  for (const Flag& flag : {Flag{"loop", "real_time", false, [](const C& c) { return c.loop.real_time; }},
                           {"start", "sign_test", true, [](const C& c) { return c.start.sign_test; }},
                           {"telemetry", "bus", false, [](const C& c) { return c.telemetry.bus; }},
                           {"scene", "friction", false, [](const C& c) { return c.scene.friction.value_or(false); }}}) {
    const std::string name = flag.name;
    EXPECT_EQ(flag.value(defaults), flag.fallback) << name;
    for (const bool value : {false, true}) {
      EXPECT_EQ(flag.value(read(with(flag.table, fmt::format("{} = {}", name, value)))), value) << name;
    }
    expect_refused(flag.table, name + " = 1", name + " must be true or false");
  }
  EXPECT_FALSE(defaults.scene.friction.has_value());
  EXPECT_FALSE(defaults.scene.solver.has_value());
  for (const auto& [name, solver] :
       {std::pair{"contact", Solver::kContact}, {"corrected", Solver::kCorrected}, {"paper", Solver::kPaper}}) {
    EXPECT_EQ(read(with("scene", fmt::format("solver = \"{}\"", name))).scene.solver, solver);
  }
  expect_refused("scene", "solver = \"\"", "solver = \"\" is not known; it must be contact, corrected or paper");
  expect_refused("scene", "solver = 1", "solver must be a text in quotes");
  EXPECT_TRUE(defaults.scene.image.empty() && defaults.telemetry.folder.empty() && defaults.simulation.path.empty());
  EXPECT_EQ(read(with("scene", "image = \"a.scene\"")).scene.image, folder_ / "a.scene");
  EXPECT_EQ(read(with("telemetry", "folder = \"../logs\"")).telemetry.folder, folder_ / "../logs");
  EXPECT_EQ(read(with("simulation", "path = \"/a/b.csv\"")).simulation.path, "/a/b.csv");
  for (const auto& [table, name] : {std::pair{"scene", "image"}, {"telemetry", "folder"}, {"simulation", "path"}}) {
    expect_refused(table, std::string(name) + " = 1", std::string(name) + " must be a text in quotes");
  }
}

TEST_F(ControllerKeyTest, RefusesAKeyThatItDoesNotKnowInEachTable) {
  for (const char* table :
       {"workspace", "scene", "loop", "limits", "engage", "start", "gains", "passivity", "telemetry", "simulation"}) {
    expect_refused(table, "extra = 1", "extra is not a known key; known here: ");
  }
  EXPECT_NE(refusal("[device]\nfiles = \"a\"\n").find(".toml:2: device.files is not a known key"), std::string::npos);
  EXPECT_NE(refusal("[device]\nfile = 7\n").find(".toml:2: device.file must be a text"), std::string::npos);
  EXPECT_NE(refusal(least() + "[more]\na = 1\n").find("more is not a known table"), std::string::npos);
}

TEST_F(ControllerKeyTest, ReadsThePlaceOfTheMesh) {
  const std::string text =
      with("workspace", "start = [0.1, -0.2, 0.3, 0.0, 0.6, 0.8, 0.0]\nturn = [0.8, 0.0, 0.0, -0.6]");
  const C::Workspace workspace = read(text).workspace;
  EXPECT_EQ(workspace.start.translation, Vector3(0.1, -0.2, 0.3));
  EXPECT_LT((workspace.start.rotation.coeffs() - Quaternion(0.0, 0.6, 0.8, 0.0).coeffs()).norm(), 1e-15);
  EXPECT_LT((workspace.turn.coeffs() - Quaternion(0.8, 0.0, 0.0, -0.6).coeffs()).norm(), 1e-15);
  const double posture[] = {0.1, 0.6, -0.2, 0.3, 0.2, 0.0};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(workspace.posture[i], posture[i]);
  EXPECT_EQ(workspace.posture[6], 0.0);
  const C::Workspace defaults = read(least()).workspace;
  EXPECT_EQ(defaults.turn.coeffs(), Quaternion::Identity().coeffs());
  EXPECT_EQ(defaults.start.rotation.coeffs(), Quaternion::Identity().coeffs());
  EXPECT_EQ(defaults.start.translation, Vector3(0, 0, 0));
}

/// A quaternion of a length within 0.001 of 1 is made one of length 1, any other refused.
TEST_F(ControllerKeyTest, NormalisesAQuaternionThatIsNearlyOfUnitLength) {
  for (const char* key : {"turn", "start"}) {
    for (const double length : {0.9985, 0.9992, 1.0008, 1.0015}) {
      const std::string text =
          with("workspace", fmt::format("{} = [{}{}, 0.0, {}, 0.0]", key,
                                        std::string(key) == "start" ? "1, 2, 3, " : "", 0.6 * length, 0.8 * length));
      if (std::fabs(length - 1.0) > 1e-3) {
        EXPECT_NE(refusal(text).find(fmt::format(".toml:5: workspace.{} has a quaternion that is not of unit", key)),
                  std::string::npos);
      } else {
        const C::Workspace workspace = read(text).workspace;
        const Quaternion& rotation = std::string(key) == "start" ? workspace.start.rotation : workspace.turn;
        EXPECT_LT((rotation.coeffs() - Quaternion(0.6, 0.0, 0.8, 0.0).coeffs()).norm(), 1e-12);
      }
    }
  }
  expect_refused("workspace", "turn = [1.11, 0, 0, 0]", "turn = 1.11 is out of range; it must be from -1.1 to 1.1");
  expect_refused("workspace", "turn = [1, 0, 0, -1.11]", "turn = -1.11 is out of range; it must be from -1.1 to 1.1");
  expect_refused("workspace", "turn = [1, 0, 0]", "turn must be an array of 4 numbers");
  expect_refused("workspace", "start = [1e4, 0, 0, 1, 0, 0, 0]",
                 "start = 10000 is out of range; it must be from -1000");
  expect_refused("workspace", "start = [0, 0, 0, 1, 0, 0]", "start must be an array of 7 numbers");
}

/// Joint 2 of the desktop arm is limited to -0.3 .. 1.8 rad, joint 1 to +-1.2 rad.
TEST_F(ControllerKeyTest, RefusesAPostureBeyondAJointsLimits) {
  const auto refused = [&](const char* posture) {
    return refusal("[device]\nfile = \"" GODOBJECT_FIRMWARE_DIR "/devices/desktop6.toml\"\n[workspace]\nposture = " +
                   std::string(posture) + "\n");
  };
  EXPECT_EQ(refused("[-1.2, -0.3, 0, 0, 0, 0]"), "");
  EXPECT_EQ(refused("[1.2, 1.8, 0, 0, 0, 0]"), "");
  const std::string says = "workspace.posture = ";
  EXPECT_NE(refused("[1.21, 0, 0, 0, 0, 0]").find(says + "1.21 of joint 1 is beyond its limits, -1.2 to 1.2 rad"),
            std::string::npos);
  EXPECT_NE(refused("[-1.21, 0, 0, 0, 0, 0]").find(says + "-1.21 of joint 1 is"), std::string::npos);
  EXPECT_NE(refused("[0, -0.31, 0, 0, 0, 0]").find(says + "-0.31 of joint 2 is beyond its limits, -0.3 to 1.8 rad"),
            std::string::npos);
  EXPECT_NE(refused("[0, 1.81, 0, 0, 0, 0]").find(says + "1.81 of joint 2 is"), std::string::npos);
  EXPECT_NE(refused("[0, 0, 0, 0, 0, 9.0]").find(says + "9 of joint 6 is"), std::string::npos);
  EXPECT_NE(refused("[0, 0, 0, 0, 0, 1e4]").find(says + "10000 is out of range; it must be from -1000 to 1000"),
            std::string::npos);
  EXPECT_NE(refused("[-1e4, 0, 0, 0, 0, 0]").find(says + "-10000 is out of range"), std::string::npos);
}

TEST_F(ControllerKeyTest, SetsOnlyTheGainsThatTheFileHas) {
  SceneView scene;
  const auto reset = [&] {
    scene.settings.stiffness = 1000.0;
    scene.settings.damping = 5.0;
    scene.settings.coupling_rotation = 0.01;
  };
  const auto expect_gains = [&](double stiffness, double damping, double rotation) {
    EXPECT_EQ(scene.settings.stiffness, stiffness);
    EXPECT_EQ(scene.settings.damping, damping);
    EXPECT_EQ(scene.settings.coupling_rotation, rotation);
  };
  reset();
  set_gains({}, scene);
  expect_gains(1000.0, 5.0, 0.01);
  C::Gains gains;
  gains.stiffness = 200.0;
  set_gains(gains, scene);
  expect_gains(200.0, 5.0, 0.01);
  reset();
  gains = {};
  gains.damping = 0.0;
  set_gains(gains, scene);
  expect_gains(1000.0, 0.0, 0.01);
  reset();
  gains = {};
  gains.rotational = 0.5;
  set_gains(gains, scene);
  expect_gains(1000.0, 5.0, 0.5);
  C config;
  config.gains = gains;
  config.device.bus.period = 0.25e-3;
  reset();
  scene = configured(scene, config);
  expect_gains(1000.0, 5.0, 0.5);
  EXPECT_EQ(scene.settings.period, 0.25e-3);
}

/// A key of the device file with `count` numbers, 0: a single one.
struct DeviceKey {
  const char* section;
  const char* name;
  double low, high;
  std::size_t count = 0;
  bool whole = false;
  bool optional = false;
};

constexpr double kTurns = 4.0 * std::numbers::pi;

const std::vector<DeviceKey> kDeviceKeys = {
    {"[arm]", "base", -1e3, 1e3, 7},
    {"[arm]", "gravity", -100.0, 100.0, 3},
    {"[torque]", "rotation_length", 1e-9, 1e3},
    {"[torque]", "singular_none", 1e-9, 1e3},
    {"[torque]", "singular_full", 0.004 * 1.001, 1e3},
    {"[torque]", "limit_band", 1e-6, 0.5 * (1.8 + 0.3)},
    {"[bus]", "period", 1.25e-4, 1e-2, 0, false, true},
    {"[bus]", "bit_rate", 1e4, 1e6},
    {"[bus]", "data_rate", 1e6, 8e6, 0, false, true},
    {"[bus]", "answer", 0.0, 5e-4, 0, false, true},
    {"[bus]", "drive_delay", 0.0, 5e-3},
    {"[bus]", "command_deadline", 2e-3, 0.01, 0, false, true},
    {"[bus]", "drive_heartbeat", 5e-3, 0.1, 0, false, true},
    {"[bus]", "heartbeat_timeout", 0.04, 0.5, 0, false, true},
    {"[bus]", "boot_timeout", 0.1, 60.0, 0, false, true},
    {"[bus]", "panel_bus", -1, 7, 0, true, true},
    {"[bus]", "panel_node", 1, 126, 0, true, true},
    {"[[joint]]", "a", -1e3, 1e3},
    {"[[joint]]", "alpha", -kTurns, kTurns},
    {"[[joint]]", "d", -1e3, 1e3},
    {"[[joint]]", "offset", -kTurns, kTurns},
    {"[[joint]]", "lower", -kTurns, kTurns},
    {"[[joint]]", "upper", -1.2 + 1e-3, kTurns},
    {"[[joint]]", "velocity", 1e-9, 1e6},
    {"[[joint]]", "torque", 1e-9, 1e6},
    {"[[joint]]", "rotor", 0.0, 1e6},
    {"[[joint]]", "damping", 0.0, 1e6},
    {"[[joint]]", "mass", 1e-9, 1e6},
    {"[[joint]]", "com", -1e3, 1e3, 3},
    {"[[joint]]", "inertia", -1e6, 1e6, 6},
    {"[[joint]]", "null_damping", 0.0, 1e6},
    {"[[joint]]", "limit_stiffness", 0.0, 1e6},
    {"[[joint]]", "limit_damping", 0.0, 1e6},
    {"[[joint]]", "bus", 0, 7, 0, true},
    {"[[joint]]", "node", 1, 126, 0, true},
    {"[[joint]]", "counts", 16.0, 1e9},
    {"[[joint]]", "gear", 1e-3, 1e4},
    {"[[joint]]", "rated_torque", 1e-9, 1e6},
    {"[[joint]]", "sign", -1.0, 1.0},
    {"[[joint]]", "zero", -kTurns, kTurns},
    {"[tool]", "pose", -1e3, 1e3, 7},
    {"[payload]", "mass", 0.0, 1e6},
    {"[payload]", "com", -1e3, 1e3, 3},
    {"[payload]", "inertia", -1e6, 1e6, 6},
};

class DeviceKeyTest : public test::FolderTest {
 protected:
  void SetUp() override {
    std::ifstream stream(GODOBJECT_FIRMWARE_DIR "/devices/desktop6.toml");
    text_.assign(std::istreambuf_iterator<char>(stream), {});
  }

  /// The text with another line for `key` in the first such section; an empty line removes the key.
  std::string with(const DeviceKey& key, const std::string& line) const {
    std::string text = text_;
    const std::size_t begin = text.find(std::string("\n") + key.section) + 1;
    const std::size_t header = text.find('\n', begin);
    const std::size_t end = text.find("\n[", header);
    const std::size_t at = text.find(std::string("\n") + key.name + " = ", begin);
    if (at == std::string::npos || at > end) return text.insert(header, "\n" + line);
    return text.replace(at + 1, text.find('\n', at + 1) - at - 1, line);
  }

  std::string refusal(const std::string& text) const {
    std::ofstream(file_) << text;
    try {
      read_device_file(file_);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), ExitCode::kBadConfig);
      return failure.what();
    }
    return {};
  }

  static std::string table(const DeviceKey& key) {
    const std::string section = key.section;
    return section == "[[joint]]" ? "joint[1]" : section.substr(1, section.size() - 2);
  }

  /// The value as the line has it: alone, or at place `at` of an array of zeros.
  static std::string line(const DeviceKey& key, double value, std::size_t at = 0) {
    const std::string number = text_of(value, key.whole);
    if (key.count == 0) return std::string(key.name) + " = " + number;
    std::string array;
    for (std::size_t i = 0; i < key.count; ++i) array += (i > 0 ? ", " : "") + (i == at ? number : std::string("0.0"));
    return std::string(key.name) + " = [" + array + "]";
  }

  /// Refused at the key's line, with these words.
  void expect_refused(const DeviceKey& key, const std::string& line, const std::string& says) const {
    const std::string text = with(key, line);
    const std::string message = refusal(text);
    EXPECT_NE(message.find(table(key) + "." + key.name + says), std::string::npos)
        << line << ": '" << message << "' should say: " << says;
    if (line.empty()) return;
    const std::size_t at = text.find("\n" + line + "\n", text.find(std::string("\n") + key.section));
    const auto number = 2 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    EXPECT_NE(message.find(fmt::format(".toml:{}: ", number)), std::string::npos) << message;
  }

  std::string text_;
  const std::filesystem::path file_ = folder_ / "device.toml";
};

TEST_F(DeviceKeyTest, RefusesTheNextNumberBeyondEachEndOfEachRange) {
  for (const DeviceKey& key : kDeviceKeys) {
    SCOPED_TRACE(table(key) + "." + key.name);
    const std::string range = fmt::format(" is out of range; it must be from {:g} to {:g}", key.low, key.high);
    for (std::size_t at = 0; at < std::max<std::size_t>(1, key.count); ++at) {
      const double low = below(key.low, key.whole);
      const double high = above(key.high, key.whole);
      expect_refused(key, line(key, low, at), fmt::format(" = {:g}{}", low, range));
      expect_refused(key, line(key, high, at), fmt::format(" = {:g}{}", high, range));
      for (const double end : {key.low, key.high}) {  // another check may refuse it
        const std::string message = refusal(with(key, line(key, end, at)));
        EXPECT_EQ(message.find(fmt::format("{}.{} = {:g} is out of range", table(key), key.name, end)),
                  std::string::npos)
            << message;
      }
    }
  }
}

TEST_F(DeviceKeyTest, RefusesAKeyThatIsMissingOrOfAnotherType) {
  for (const DeviceKey& key : kDeviceKeys) {
    const std::string name = key.name;
    SCOPED_TRACE(table(key) + "." + name);
    if (key.optional) {
      EXPECT_EQ(refusal(text_), "");
    } else {
      expect_refused(key, "", " is missing and has no default");
    }
    const std::string type = key.count > 0 ? fmt::format(" must be an array of {} numbers", key.count)
                             : key.whole   ? " must be a whole number"
                                           : " must be a number";
    expect_refused(key, name + " = \"1\"", type);
    if (key.count == 0) {
      expect_refused(key, name + " = [1.0]", type);
      if (key.whole) expect_refused(key, name + " = 1.5", type);
      continue;
    }
    expect_refused(key, name + " = 1.0", type);
    DeviceKey other = key;
    for (const std::size_t count : {key.count - 1, key.count + 1}) {
      other.count = count;
      expect_refused(key, line(other, 0.0), type);
    }
  }
}

TEST_F(DeviceKeyTest, RefusesAKeyOrATableThatItDoesNotKnow) {
  for (const char* section : {"[arm]", "[torque]", "[bus]", "[[joint]]", "[tool]", "[payload]"}) {
    expect_refused({section, "extra", 0.0, 0.0}, "extra = 1", " is not a known key; known here: ");
  }
  EXPECT_NE(refusal(text_ + "\n[more]\na = 1\n").find("more is not a known table"), std::string::npos);
}

struct Value {
  const char* section;
  const char* line;
};

/// A value of each key that is not the default.
constexpr Value kOtherValues[] = {
    {"[[joint]]", "a = 0.01"},
    {"[[joint]]", "alpha = 0.02"},
    {"[[joint]]", "d = 0.03"},
    {"[[joint]]", "offset = 0.04"},
    {"[[joint]]", "lower = -1.3"},
    {"[[joint]]", "upper = 1.4"},
    {"[[joint]]", "velocity = 7.0"},
    {"[[joint]]", "torque = 1.6"},
    {"[[joint]]", "rotor = 0.0006"},
    {"[[joint]]", "damping = 0.007"},
    {"[[joint]]", "mass = 0.4"},
    {"[[joint]]", "com = [0.05, 0.06, 0.07]"},
    {"[[joint]]", "inertia = [0.0011, 0.0012, 0.0013, 0.0001, 0.0002, 0.0003]"},
    {"[[joint]]", "null_damping = 0.08"},
    {"[[joint]]", "limit_stiffness = 5.5"},
    {"[[joint]]", "limit_damping = 0.09"},
    {"[[joint]]", "bus = 1"},
    {"[[joint]]", "node = 77"},
    {"[[joint]]", "counts = 4096"},
    {"[[joint]]", "gear = 12.0"},
    {"[[joint]]", "rated_torque = 0.25"},
    {"[[joint]]", "sign = -1"},
    {"[[joint]]", "zero = 0.11"},
    {"[arm]", "base = [0.1, 0.2, 0.3, 0.0, 0.6, 0.0, 0.8]"},
    {"[arm]", "gravity = [1.0, 2.0, -9.0]"},
    {"[torque]", "rotation_length = 0.06"},
    {"[torque]", "singular_none = 0.005"},
    {"[torque]", "singular_full = 0.017"},
    {"[torque]", "limit_band = 0.12"},
    {"[bus]", "bit_rate = 5e5"},
    {"[bus]", "fd = true"},
    {"[bus]", "data_rate = 2e6"},
    {"[bus]", "answer = 0.0001"},
    {"[bus]", "drive_delay = 0.0002"},
    {"[bus]", "command_deadline = 0.005"},
    {"[bus]", "drive_heartbeat = 0.03"},
    {"[bus]", "heartbeat_timeout = 0.07"},
    {"[bus]", "boot_timeout = 6.0"},
    {"[bus]", "panel_bus = 0"},
    {"[bus]", "panel_node = 99"},
    {"[tool]", "pose = [0.4, 0.5, 0.6, 0.8, 0.0, 0.6, 0.0]"},
    {"[payload]", "mass = 0.5"},
    {"[payload]", "com = [0.01, 0.02, 0.03]"},
    {"[payload]", "inertia = [0.0021, 0.0022, 0.0023, 0.0001, 0.0002, 0.0003]"},
};

/// Returns the numbers of a device, each with the one of kOtherValues.
std::vector<std::pair<double, double>> other_numbers(const Device& device) {
  const ArmJoint& joint = device.model.joints[0];
  return {
      {joint.a, 0.01},
      {joint.alpha, 0.02},
      {joint.d, 0.03},
      {joint.offset, 0.04},
      {joint.lower, -1.3},
      {joint.upper, 1.4},
      {joint.velocity, 7.0},
      {joint.torque, 1.6},
      {joint.rotor, 0.0006},
      {joint.damping, 0.007},
      {joint.link.mass, 0.4},
      {device.torque.null_damping[0], 0.08},
      {device.torque.limit_stiffness[0], 5.5},
      {device.torque.limit_damping[0], 0.09},
      {device.torque.rotation_length, 0.06},
      {device.torque.singular_none, 0.005},
      {device.torque.singular_full, 0.017},
      {device.torque.limit_band, 0.12},
      {device.bus.bit_rate, 5e5},
      {device.bus.data_rate, 2e6},
      {device.bus.answer, 0.0001},
      {device.bus.drive_delay, 0.0002},
      {device.bus.command_deadline, 0.005},
      {device.bus.drive_heartbeat, 0.03},
      {device.bus.heartbeat_timeout, 0.07},
      {device.bus.boot_timeout, 6.0},
      {device.model.payload.mass, 0.5},
  };
}

/// Every number of the first joint is another one and comes out where it belongs.
TEST_F(DeviceKeyTest, ReadsEveryKeyOfAJointAndOfTheTables) {
  for (const Value& value : kOtherValues) {
    const std::string text = value.line;
    const std::string name = text.substr(0, text.find(' '));
    text_ = with({value.section, name.c_str(), 0.0, 0.0}, text);
  }
  ASSERT_EQ(refusal(text_), "");
  const Device device = read_device_file(file_);
  const ArmJoint& joint = device.model.joints[0];
  const auto numbers = other_numbers(device);
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i].first, numbers[i].second) << i;
  const auto inertia = [](double first) {
    Matrix3 matrix;
    matrix << first, 0.0001, 0.0002, 0.0001, first + 0.0001, 0.0003, 0.0002, 0.0003, first + 0.0002;
    return matrix;
  };
  EXPECT_EQ(joint.link.com, Vector3(0.05, 0.06, 0.07));
  EXPECT_LT((joint.link.inertia - inertia(0.0011)).norm(), 1e-15);
  EXPECT_LT((device.model.payload.inertia - inertia(0.0021)).norm(), 1e-15);
  EXPECT_EQ(device.model.payload.com, Vector3(0.01, 0.02, 0.03));
  EXPECT_EQ(device.model.gravity_R, Vector3(1.0, 2.0, -9.0));
  EXPECT_EQ(device.model.H_RA.translation, Vector3(0.1, 0.2, 0.3));
  EXPECT_LT((device.model.H_RA.rotation.coeffs() - Quaternion(0.0, 0.6, 0.0, 0.8).coeffs()).norm(), 1e-15);
  EXPECT_EQ(device.model.H_FM.translation, Vector3(0.4, 0.5, 0.6));
  EXPECT_LT((device.model.H_FM.rotation.coeffs() - Quaternion(0.8, 0.0, 0.6, 0.0).coeffs()).norm(), 1e-15);
  const hal::DriveConfig& drive = device.bus.drives[0];
  EXPECT_EQ(drive.bus, 1);
  EXPECT_EQ(drive.node, 77);
  EXPECT_EQ(drive.counts, 4096.0);
  EXPECT_EQ(drive.gear, 12.0);
  EXPECT_EQ(drive.rated_torque, 0.25);
  EXPECT_EQ(drive.torque_limit, 1.6);
  EXPECT_EQ(drive.sign, -1.0);
  EXPECT_EQ(drive.zero, 0.11);
  EXPECT_TRUE(device.bus.fd);
  EXPECT_EQ(device.bus.panel.bus, 0);
  EXPECT_EQ(device.bus.panel.node, 99);
}

TEST_F(DeviceKeyTest, HasTheDefaultsOfTheBusThatAreDocumented) {
  const hal::BusLayout bus = read_device_file(GODOBJECT_FIRMWARE_DIR "/devices/desktop6.toml").bus;
  EXPECT_EQ(bus.period, 1e-3);
  EXPECT_FALSE(bus.fd);
  EXPECT_FALSE(bus.fd_services);
  EXPECT_EQ(bus.data_rate, 5e6);
  EXPECT_EQ(bus.answer, 0.0);
  EXPECT_EQ(bus.command_deadline, 0.004);
  EXPECT_EQ(bus.drive_heartbeat, 0.02);
  EXPECT_EQ(bus.heartbeat_timeout, 0.05);
  EXPECT_EQ(bus.boot_timeout, 5.0);
}

/// A drive waits for torques for 4 ms or four periods, less where three of them take over 10 ms; in whole milliseconds.
TEST_F(DeviceKeyTest, WaitsForTorquesLongerWhereThePeriodIsLong) {
  const DeviceKey period{"[bus]", "period", 0.0, 0.0};
  for (const auto& [T, deadline, least, most] : {std::tuple{"0.00025", 0.004, 0.002, 0.01},
                                                 {"0.0012", 0.005, 0.003, 0.01},
                                                 {"0.002", 0.008, 0.004, 0.01},
                                                 {"0.004", 0.012, 0.008, 0.012},
                                                 {"0.01", 0.02, 0.02, 0.02}}) {
    const std::string line = fmt::format("period = {}", T);
    ASSERT_EQ(refusal(with(period, line)), "");
    EXPECT_DOUBLE_EQ(read_device_file(file_).bus.command_deadline, deadline) << T;
    for (const double fine : {1.0001 * least, 0.9999 * most}) {
      if (!(least < most)) continue;
      EXPECT_EQ(refusal(with(period, fmt::format("{}\ncommand_deadline = {}", line, fine))), "") << T << fine;
    }
    for (const double bad : {0.99 * least, 1.01 * most}) {
      EXPECT_NE(refusal(with(period, fmt::format("{}\ncommand_deadline = {}", line, bad))), "") << T << bad;
    }
  }
}

/// Between two heartbeats SDO exchanges read the parameters on which safety depends: some cycles are needed for them.
TEST_F(DeviceKeyTest, BeatsOnceInFiveCyclesAtMost) {
  const DeviceKey period{"[bus]", "period", 0.0, 0.0};
  ASSERT_EQ(refusal(with(period, "period = 0.01")), "");
  EXPECT_EQ(read_device_file(file_).bus.drive_heartbeat, 0.05);
  EXPECT_EQ(read_device_file(file_).bus.heartbeat_timeout, 0.1);
  EXPECT_NE(refusal(with(period, "period = 0.01\ndrive_heartbeat = 0.049")), "");
  EXPECT_NE(refusal(with(period, "period = 0.002\ndrive_heartbeat = 0.009")), "");
  EXPECT_EQ(refusal(with(period, "period = 0.002\ndrive_heartbeat = 0.01")), "");
}

TEST_F(DeviceKeyTest, HasAPeriodThatTheDrivesCanBeTold) {
  const DeviceKey period{"[bus]", "period", 0.0, 0.0};
  for (const char* fine : {"0.000125", "0.00025", "0.0003", "0.0005", "0.00125", "0.0025", "0.01"}) {
    EXPECT_EQ(refusal(with(period, fmt::format("period = {}", fine))), "") << fine;
  }
  for (const char* bad : {"0.0003333", "0.00026125", "0.001001", "0.00257"}) {
    EXPECT_NE(refusal(with(period, fmt::format("period = {}", bad))).find("cannot be told to the drives"),
              std::string::npos)
        << bad;
  }
}

/// Joint 1 of 8 rad/s moves 2 mrad in 0.25 ms: at least two counts.
TEST_F(DeviceKeyTest, WantsAnEncoderThatIsFineForItsPeriod) {
  const DeviceKey counts{"[[joint]]", "counts", 0.0, 0.0};
  for (const double share : {0.49, 0.51}) {
    const double number = 2.0 * std::numbers::pi / (10.0 * share * 8.0 * 1e-3);
    const std::string says = refusal(with(counts, fmt::format("counts = {}", number)));
    EXPECT_EQ(says.empty(), share < 0.5) << says;
    EXPECT_TRUE(says.empty() || says.find("joint[1].counts times gear makes a count") != std::string::npos) << says;
  }
}

TEST_F(DeviceKeyTest, SendsServicesAsFdFramesOnlyWithFd) {
  const DeviceKey services{"[bus]", "fd_services", 0.0, 0.0};
  EXPECT_NE(refusal(with(services, "fd_services = true")).find("bus.fd_services = true needs fd = true"),
            std::string::npos);
  ASSERT_EQ(refusal(with(services, "fd = true\nfd_services = true")), "");
  EXPECT_TRUE(read_device_file(file_).bus.fd_services);
}

/// The timeout is at least two heartbeats, also where the file names the heartbeat alone.
TEST_F(DeviceKeyTest, NeverTimesOutBeforeTheSecondHeartbeat) {
  const DeviceKey heartbeat{"[bus]", "drive_heartbeat", 0.0, 0.0};
  ASSERT_EQ(refusal(with(heartbeat, "drive_heartbeat = 0.1")), "");
  EXPECT_EQ(read_device_file(file_).bus.heartbeat_timeout, 0.2);
  ASSERT_EQ(refusal(with(heartbeat, "drive_heartbeat = 0.01")), "");
  EXPECT_EQ(read_device_file(file_).bus.heartbeat_timeout, 0.05);
  EXPECT_NE(refusal(with(heartbeat, "drive_heartbeat = 0.1\nheartbeat_timeout = 0.19")), "");
}

}  // namespace
}  // namespace godobject::firmware::file_bounds_test
