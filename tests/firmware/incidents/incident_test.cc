#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "firmware/incidents/explanation.h"
#include "firmware/incidents/hand_motion.h"
#include "firmware/incidents/incident_plot.h"
#include "firmware/incidents/incident_reader.h"
#include "firmware/records/telemetry_rows.h"
#include "tests/support/folder_test.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware::incident_test {
namespace {

namespace fs = std::filesystem;

constexpr int kJoints = 3;
constexpr int kStop_ms = 3000;  // cycle of the stop
constexpr int kEnd_ms = 4000;

const char* const kRun = R"(program = "godobject-controller 1.2.3, commit abc"
machine = "Linux 6.1"
began = "20261130T143055Z"
image = "/scenes/a.scene"
buses = ["can0", "can1"]
[loop]
period = 0.001
compute = 0.00012
velocity_window = 4
scale = 1.0
[limits]
force = 30.0
torque = 3.0
speed_stop = 1.5
turn_stop = 9.0
joint_speed_stop = 1.0
[[joint]]
lower = -1.0
upper = 1.0
velocity = 2.0
torque = 10.0
bus = 0
node = 1
[[joint]]
lower = -1.0
upper = 1.0
velocity = 2.0
torque = 10.0
bus = 1
node = 2
[[joint]]
lower = -1.0
upper = 1.0
velocity = 2.0
torque = 20.0
bus = 1
node = 3
[stop]
utc = "20261130T143102Z"
t_s = 3.0
fault = 1
)";

class IncidentTest : public test::FolderTest {
 protected:
  using Change = std::function<void(int ms, TelemetryRecord& record)>;

  IncidentTest() { std::ofstream(folder_ / "run.toml") << kRun; }

  /// A record of a run that stops by `fault`; `change` sees each record.
  void write(
      Fault fault, const Change& change = [](int, TelemetryRecord&) {}) const {
    std::ofstream(folder_ / "telemetry.csv") << telemetry(fault, change);
  }

  static std::string telemetry(Fault fault, const Change& change) {
    std::string text = telemetry_header(kJoints);
    for (int ms = 0; ms < kEnd_ms; ++ms) {
      TelemetryRecord record;
      record.times.deadline_ns = ms * 1'000'000LL;
      record.cycle.mode = ms < 1000 ? Mode::kArmed : ms < kStop_ms ? Mode::kRunning : Mode::kStopping;
      if (ms >= kStop_ms) record.cycle.fault = fault;
      change(ms, record);
      append_telemetry_row(record, {kJoints}, text);
    }
    return text;
  }

  std::string words() const { return explain(read_incident(folder_)); }

  std::string refusal(command::ExitCode code) const {
    try {
      read_incident(folder_);
    } catch (const command::Failure& failure) {
      EXPECT_EQ(failure.exit_code(), code) << failure.what();
      return failure.what();
    }
    return "not refused";
  }

  static bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }
};

/// Of every fault: number, words and advice.
TEST_F(IncidentTest, NamesEveryFaultAndWhatToLookAt) {
  std::vector<std::string> advices;
  for (int number = 1; number <= static_cast<int>(kLastFault); ++number) {
    const auto fault = static_cast<Fault>(number);
    write(fault);
    const std::string text = words();
    EXPECT_TRUE(has(text, fmt::format("\nfault {}: {}\n", number, describe(fault)))) << text;
    const std::size_t begin = text.find("\nlook at: ");
    ASSERT_NE(begin, std::string::npos) << text;
    const std::string advice = text.substr(begin + 10, text.find('\n', begin + 10) - begin - 10);
    EXPECT_GT(advice.size(), 20u) << number;
    EXPECT_EQ(std::ranges::find(advices, advice), advices.end()) << advice << " is that of another fault";
    advices.push_back(advice);
  }
}

TEST_F(IncidentTest, NamesTheJointAndItsDrive) {
  for (const Fault fault : {Fault::kPositionLost, Fault::kPositionJump, Fault::kNotFinite, Fault::kEncoderStuck,
                            Fault::kDriveLeft, Fault::kAlarm, Fault::kJointLimit, Fault::kTooFast}) {
    for (int joint = 0; joint < kJoints; ++joint) {
      write(fault, [&](int ms, TelemetryRecord& record) {
        if (ms >= kStop_ms) record.cycle.fault_joint = joint;
      });
      const char* const drives[] = {"node 1 on can0", "node 2 on can1", "node 3 on can1"};
      EXPECT_TRUE(has(words(), fmt::format("\njoint: {}, drive: {}\n", joint + 1, drives[joint]))) << words();
    }
  }
  write(Fault::kEmergencyStop);
  EXPECT_TRUE(has(words(), "\njoint: no single joint is known\n")) << words();
}

/// A telemetry of an older version has no column of the joint.
TEST_F(IncidentTest, FindsTheJointByItsBoundsInAnOlderTelemetry) {
  const auto write_older = [&](Fault fault, const Change& change) {
    std::string text = telemetry(fault, change);
    std::string older;
    for (std::size_t begin = 0, end; begin < text.size(); begin = end + 1) {
      end = text.find('\n', begin);
      std::size_t cut = end;
      for (int k = 0; k < 3; ++k) cut = text.rfind(',', cut - 1);
      older += text.substr(begin, cut - begin) + '\n';
    }
    std::ofstream(folder_ / "telemetry.csv") << older;
  };
  write_older(Fault::kJointLimit, [](int ms, TelemetryRecord& record) {
    if (ms >= kStop_ms - 5) record.cycle.q[1] = -1.25;
  });
  std::string text = words();
  EXPECT_TRUE(has(text, "\njoint: 2, drive: node 2 on can1\n")) << text;
  EXPECT_TRUE(has(text, "joint 2 is 0.25 rad beyond its position limit  <- beyond")) << text;
  write_older(Fault::kTooFast, [](int ms, TelemetryRecord& record) {
    if (ms >= kStop_ms - 5) record.cycle.qd[2] = -2.5;
  });
  text = words();
  EXPECT_TRUE(has(text, "\njoint: 3, drive: node 3 on can1\n")) << text;
  EXPECT_TRUE(has(text, "fastest: speed of joint 3, 125 % of its stop speed")) << text;
}

/// The largest value of the last 100 ms, and no earlier one, beside its bound.
TEST_F(IncidentTest, ComparesTheLastMomentWithItsBounds) {
  write(Fault::kOverruns, [](int ms, TelemetryRecord& record) {
    CycleRecord& cycle = record.cycle;
    const bool now = ms >= kStop_ms - 50 && ms < kStop_ms;
    record.times.late_ns = now ? 2'345'000 : 7'000;
    record.times.compute_ns = now ? 150'000 : 20'000;
    cycle.F_G_R.force = Vector3(0.0, 0.0, ms < 2000 ? 99.0 : now ? 12.5 : 1.0);
    cycle.torque[2] = now ? -15.0 : 1.0;
    cycle.lost = now ? 2 : 0;
    cycle.H_WM.translation = Vector3(1e-3 * 0.75 * ms, 0.0, 0.0);
    cycle.H_WM.rotation = Quaternion(Eigen::AngleAxisd(1e-3 * 0.5 * ms, Vector3::UnitY()));
  });
  const std::string text = words();
  const auto line = [&](const std::string& name) {
    const std::size_t begin = text.find("  " + name);
    return begin == std::string::npos ? "no line " + name : text.substr(begin, text.find('\n', begin) - begin);
  };
  EXPECT_EQ(line("force"), "  force at the hand                12.5 N              30 N      limits.force");
  EXPECT_EQ(line("speed of the"), "  speed of the hand                0.75 m/s           1.5 m/s    limits.speed_stop");
  EXPECT_EQ(line("turning"), "  turning of the hand               0.5 rad/s           9 rad/s  limits.turn_stop");
  EXPECT_EQ(line("torque of a"),
            "  torque of a joint, joint 3         75 %             100 %      of its torque limit");
  EXPECT_EQ(line("waking"), "  waking late                      2345 us");
  EXPECT_EQ(line("computing"),
            "  computing                         150 us            120 us     loop.compute  <- beyond");
  EXPECT_EQ(line("cycles without"), "  cycles without position             2");
  EXPECT_TRUE(has(text, "modes, in seconds from the stop: armed -3.000, running -2.000, stopping +0.000\n")) << text;
  EXPECT_TRUE(has(text, "record: 4000 rows, from 3.000 s before the stop to 0.999 s after it\n")) << text;
  EXPECT_TRUE(has(text, "when: 20261130T143102Z, 3.000000 s by the controller's clock")) << text;
  EXPECT_TRUE(has(text, "program: godobject-controller 1.2.3, commit abc\n")) << text;
}

TEST_F(IncidentTest, CountsRowsThatAreMissing) {
  std::string text = telemetry(Fault::kOverruns, [](int, TelemetryRecord&) {});
  const std::size_t begin = text.find("\n2.990000,") + 1;
  text.erase(begin, text.find("\n2.997000,") + 1 - begin);
  std::ofstream(folder_ / "telemetry.csv") << text;
  EXPECT_TRUE(has(words(), "  7 cycles in a row have no row\n")) << words();
}

TEST_F(IncidentTest, HasTheAlarmAndTheEmergencyMessages) {
  write(Fault::kAlarm, [](int ms, TelemetryRecord& record) {
    if (ms < kStop_ms) return;
    record.cycle.alarm = hal::Alarm::kHeartbeatLost;
    record.cycle.alarm_joint = record.cycle.fault_joint = 1;
  });
  std::ofstream(folder_ / "can.log") << "(0000000001.000000) can1 082#5082010000000000\n"
                                        "(0000000001.000000) can1 082##15082010000000000\n"
                                        "(0000000001.000001) can0 080#\n"
                                        "(0000000001.000002) can0 081#0000000000000000\n"
                                        "(0000000001.000003) can0 182#5082010000000000\n"
                                        "(0000000001.000004) can0 0A0#10\n"
                                        "(0000000001.000005) can0 0A0#1020\n"
                                        "rubbish\n(000";
  const std::string text = words();
  EXPECT_TRUE(has(text, fmt::format("alarm 4: {}\n", describe(hal::Alarm::kHeartbeatLost)))) << text;
  EXPECT_TRUE(has(text,
                  "emergency message 8250 of node 2 on can1, joint 2\n"
                  "emergency message 8250 of node 2 on can1, joint 2\n"
                  "emergency message 2010 of node 32 on can0\n"))
      << text;
  EXPECT_EQ(text.find("of node 1 on"), std::string::npos) << "a reset of an error is not shown: " << text;
}

TEST_F(IncidentTest, LeavesOutARowThatIsCutOff) {
  const std::string whole = telemetry(Fault::kAlarm, [](int, TelemetryRecord&) {});
  for (const std::size_t cut : {1u, 2u, 10u, 40u, 60u}) {
    std::ofstream(folder_ / "telemetry.csv") << whole.substr(0, whole.size() - cut);
    const Incident incident = read_incident(folder_);
    ASSERT_TRUE(incident.stop);
    EXPECT_EQ(incident.rows.size(), 3999u) << cut << ": without its line feed a number may be cut off";
    EXPECT_TRUE(has(explain(incident), "note: the last row of telemetry.csv is cut off and left out")) << cut;
  }
}

TEST_F(IncidentTest, RefusesWhatIsNoTelemetry) {
  EXPECT_TRUE(has(refusal(command::ExitCode::kNoInput), "has no telemetry.csv"));
  std::ofstream(folder_ / "telemetry.csv") << "";
  EXPECT_TRUE(has(refusal(command::ExitCode::kBadData), "telemetry.csv: is empty"));
  std::ofstream(folder_ / "telemetry.csv") << "t,px,py,pz,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n";
  EXPECT_TRUE(has(refusal(command::ExitCode::kBadData), "telemetry.csv:1: has no column t_s"));
  std::ofstream(folder_ / "telemetry.csv") << telemetry_header(kJoints);
  EXPECT_TRUE(has(refusal(command::ExitCode::kBadData), "has no whole row"));
  std::ofstream(folder_ / "telemetry.csv") << telemetry_header(kJoints) << "0.001,1\n";
  EXPECT_TRUE(has(refusal(command::ExitCode::kBadData), "has no whole row"));
  const std::string whole = telemetry(Fault::kAlarm, [](int, TelemetryRecord&) {});
  const std::size_t middle = whole.find("\n1.000000,") + 1;
  std::ofstream(folder_ / "telemetry.csv") << whole.substr(0, middle) << "rubbish\n" << whole.substr(middle);
  EXPECT_TRUE(has(refusal(command::ExitCode::kBadData), "telemetry.csv:1002: is no row of this telemetry"))
      << refusal(command::ExitCode::kBadData);
}

/// Rows whose time or numbers are impossible are no rows.
TEST_F(IncidentTest, RefusesImpossibleNumbers) {
  const std::string whole = telemetry(Fault::kAlarm, [](int, TelemetryRecord&) {});
  const std::size_t middle = whole.find("\n1.000000,") + 1;
  const std::size_t after = whole.find('\n', middle) + 1;
  const std::string row = whole.substr(middle, after - middle);
  const auto with = [&](const std::string& what, const std::string& other) {
    std::string changed = row;
    changed.replace(changed.find(what), what.size(), other);
    return changed;
  };
  for (const std::string& changed :
       {with("1.000000", "nan"), with("1.000000", "inf"), with(",running,0,", ",running,256,"),
        with(",running,0,", ",running,-1,"), with(",running,0,", ",running,1e99,"),
        with(",running,0,", ",running,nan,"), with(",running,0,", ",running,x,")}) {
    ASSERT_NE(changed, row);
    std::ofstream(folder_ / "telemetry.csv") << whole.substr(0, middle) << changed << whole.substr(after);
    EXPECT_TRUE(has(refusal(command::ExitCode::kBadData), "telemetry.csv:1002: is no row")) << changed;
  }
}

/// Any bytes end in words or in a refusal.
TEST_F(IncidentTest, SurvivesDamage) {
  const std::string whole = telemetry(Fault::kAlarm, [](int, TelemetryRecord&) {});
  const std::string begin = whole.substr(0, whole.find("\n0.020000,") + 1);
  for (std::size_t at = 0; at < begin.size(); at += 11) {
    for (const char byte : {'\0', '\n', ',', 'x', '9'}) {
      std::string damaged = begin;
      damaged[at] = byte;
      std::ofstream(folder_ / "telemetry.csv", std::ios::binary) << damaged;
      try {
        const Incident incident = read_incident(folder_);
        EXPECT_FALSE(explain(incident).empty());
        if (incident.stop) {
          EXPECT_TRUE(draw(incident).ends_with("</svg>\n"));
        }
      } catch (const command::Failure& failure) {
        EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadData) << failure.what();
      }
    }
  }
}

/// Without bounds the values stand alone.
TEST_F(IncidentTest, DoesWithoutRunToml) {
  write(Fault::kTooFast, [](int, TelemetryRecord& record) { record.cycle.torque[1] = 4.0; });
  fs::remove(folder_ / "run.toml");
  std::string text = words();
  EXPECT_TRUE(has(text, "note: run.toml is missing: the bounds are not known")) << text;
  EXPECT_TRUE(has(text, "  torque of a joint, joint 2          4 Nm\n")) << text;
  EXPECT_EQ(text.find("limits.force"), std::string::npos) << text;
  for (const char* content : {"rubbish", "[loop]\nperiod = nan\n", "[[joint]]\nlower = 'x'\n", "[loop]\n", ""}) {
    std::ofstream(folder_ / "run.toml") << content;
    EXPECT_TRUE(has(words(), "note: the bounds are not known: ")) << content << ": " << words();
  }
  std::string other = kRun;
  other.erase(other.rfind("[[joint]]"), other.rfind("[stop]") - other.rfind("[[joint]]"));
  std::ofstream(folder_ / "run.toml") << other;
  EXPECT_TRUE(has(words(), "run.toml has 2 joints, telemetry.csv 3: the bounds are not used")) << words();
}

TEST_F(IncidentTest, SaysThatNoFaultStoppedARun) {
  write(Fault::kNone);
  const Incident incident = read_incident(folder_);
  EXPECT_FALSE(incident.stop);
  EXPECT_TRUE(has(words(), "no fault stopped this run\n")) << words();
  EXPECT_TRUE(has(words(), "it did not end in order")) << words();
}

TEST_F(IncidentTest, IsTheLastOneOfARunAndOfTheNewestRun) {
  const auto stop_at = [&](const fs::path& folder, Fault fault) {
    fs::create_directories(folder);
    std::ofstream(folder / "telemetry.csv") << telemetry(fault, [](int, TelemetryRecord&) {});
  };
  const fs::path logs = folder_ / "logs";
  stop_at(logs / "one", Fault::kNone);
  stop_at(logs / "one" / "incident", Fault::kAlarm);
  for (int i = 2; i <= 11; ++i) {
    stop_at(logs / "one" / fmt::format("incident-{}", i), i == 11 ? Fault::kTooFast : Fault::kAlarm);
  }
  stop_at(logs / "two", Fault::kNone);
  fs::create_symlink("one", logs / "latest");
  EXPECT_EQ(read_incident(logs).folder, logs / "one" / "incident-11");
  EXPECT_EQ(read_incident(logs / "one").folder, logs / "one" / "incident-11");
  EXPECT_EQ(read_incident(logs / "one" / "incident").folder, logs / "one" / "incident");
  EXPECT_EQ(read_incident(logs / "two").folder, logs / "two");
}

/// Of a log with two stops, the last one; and no row of the time long before.
TEST_F(IncidentTest, IsTheLastStopOfALog) {
  std::string text = telemetry_header(1);
  for (int s = 0; s < 200; ++s) {
    TelemetryRecord record;
    record.times.deadline_ns = s * 1'000'000'000LL;
    record.cycle.fault = s == 50 || s == 51 ? Fault::kAlarm : s >= 100 && s < 103 ? Fault::kTooFast : Fault::kNone;
    append_telemetry_row(record, {1}, text);
  }
  std::ofstream(folder_ / "telemetry.csv") << text;
  const Incident incident = read_incident(folder_);
  ASSERT_TRUE(incident.stop);
  EXPECT_EQ(incident.rows[*incident.stop].t, 100.0);
  EXPECT_EQ(incident.rows[*incident.stop].fault, Fault::kTooFast);
  EXPECT_EQ(incident.rows.front().t, 70.0);
  EXPECT_EQ(incident.rows.back().t, 102.0);
}

TEST_F(IncidentTest, IsDrawnWithItsStopAndItsBounds) {
  write(Fault::kTooFast, [](int ms, TelemetryRecord& record) {
    record.cycle.F_G_R.force = Vector3(0.0, 0.0, ms == kStop_ms - 10 ? 20.0 : 0.0);
  });
  const Incident incident = read_incident(folder_);
  const std::string svg = draw(incident);
  EXPECT_TRUE(svg.starts_with("<svg ")) << svg.substr(0, 100);
  const auto count = [&](const std::string& what) {
    int found = 0;
    for (std::size_t at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("<polyline"), 4);
  EXPECT_EQ(count("stroke=\"#c00\""), 4) << "the stop in each panel";
  EXPECT_EQ(count("stroke-dasharray"), 1) << "the bound of the force; others are far above their curves";
  // 30 N, the bound, is the top of the first panel, and 20 N a third below it
  EXPECT_TRUE(has(svg, "627.2,90.0 ")) << "10 ms before the stop";
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(count("<"), count(">"));
}

}  // namespace
}  // namespace godobject::firmware::incident_test
