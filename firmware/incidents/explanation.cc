#include "firmware/incidents/explanation.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "firmware/incidents/hand_motion.h"

namespace godobject::firmware {
namespace {

constexpr double kMoment = 0.1;  // span before the stop whose largest values are shown, chosen [s]

/// Advice after a fault, beside the cure that `describe` names.
const char* advice(Fault fault) {
  switch (fault) {
    case Fault::kNone: return "";
    case Fault::kDrivesAbsent:
      return "supply and wiring of the drives, their node numbers and bit rate; can.log shows who answers";
    case Fault::kNotAtRest: return "the brake of the joint that moved: its q*_rad changes in telemetry.csv";
    case Fault::kPositionLost:
      return "column lost of telemetry.csv, then can.log: whose TPDO1 is missing after a SYNC? Check the wiring of "
             "that drive, and the load of its bus (doctor prints it)";
    case Fault::kPositionJump: return "q*_rad of the joint before the stop: cable and shield of its encoder";
    case Fault::kNotFinite: return "the drive of the joint: its scaling in the device file";
    case Fault::kEncoderStuck:
      return "q*_rad of the joint stands still while others move: its encoder, or dry friction above "
             "limits.stuck_torque";
    case Fault::kComputation: return "the last rows of telemetry.csv: outcome, q*_rad, device pose";
    case Fault::kOverruns: return "late_us of telemetry.csv; then godobject-controller doctor";
    case Fault::kDriveLeft: return "the display of the drive and object 603F; then its supply";
    case Fault::kAlarm: return "can.log around the stop; the drive's manual has its emergency codes";
    case Fault::kSendFailed: return "the CAN interface: its state and its queue (ip -details link show)";
    case Fault::kEmergencyStop: return "who pressed it, and why; if nobody did, the wiring of the panel";
    case Fault::kEnableReleased: return "nothing, if the operator released it; else the switch and its wiring";
    case Fault::kJointLimit: return "q*_rad of the joint: did the hand pull it there? Else workspace.posture";
    case Fault::kTooFast: return "the speeds above: did the hand move so fast? Else lower the gains: the arm may ring";
    case Fault::kSignWrong: return "sign of the joint in the device file, masses of the arm, and who held the tool";
    case Fault::kSignUndecided: return "the brake of the joint, and start.push: is it above dry friction?";
    case Fault::kOutsideLimits: return "zero of the joint in the device file";
    case Fault::kNotBalanced:
      return "the tool's way in telemetry.csv: did a hand push? Else weigh the tool, and compare payload and masses";
    case Fault::kDrifts: return "payload of the device file: weigh what the arm carries; then masses of the links";
    case Fault::kTorqueWrong: return "object 6077 of the drive against torque*_Nm: its current limits, rated_torque";
    case Fault::kDriveLimited: return "object 2310 or the like of the drive's manual: which limit acts, and why";
    case Fault::kComputedLate: return "compute_us of telemetry.csv, and other work on this processor (loop.cpu)";
  }
  return "the manual of the version that wrote this record";
}

/// The joint of the fault, from 1; 0: none, or not known. Rows of an older version do not have it.
int joint_of(const Incident& incident) {
  const IncidentRow& stop = incident.rows[*incident.stop];
  if (stop.fault_joint > 0 || !incident.bounds) return stop.fault_joint;
  for (int i = 0; i < incident.joint_count; ++i) {
    const IncidentBounds::Joint& joint = incident.bounds->joints[static_cast<std::size_t>(i)];
    if (stop.fault == Fault::kJointLimit || stop.fault == Fault::kOutsideLimits) {
      if (stop.q[i] < joint.lower || stop.q[i] > joint.upper) return i + 1;
    }
    if (stop.fault == Fault::kTooFast) {
      if (std::fabs(stop.qd[i]) > incident.bounds->joint_speed_stop * joint.velocity) return i + 1;
    }
  }
  return 0;
}

std::string drive_of(const Incident& incident, int joint) {
  if (!incident.bounds || joint > static_cast<int>(incident.bounds->joints.size())) return "";
  const IncidentBounds::Joint& drive = incident.bounds->joints[static_cast<std::size_t>(joint - 1)];
  const auto bus = static_cast<std::size_t>(drive.bus);
  return fmt::format(", drive: node {} on {}", drive.node,
                     bus < incident.bounds->buses.size() ? incident.bounds->buses[bus] : fmt::format("bus {}", bus));
}

/// For a stop by speed: what was nearest to its stop speed, or beyond it.
std::string fastest(const Incident& incident) {
  const IncidentRow& stop = incident.rows[*incident.stop];
  if (stop.fault != Fault::kTooFast || !incident.bounds) return "";
  const IncidentBounds& bounds = *incident.bounds;
  std::string name = "speed of the hand";
  double share = hand_speed(incident, *incident.stop) / bounds.speed_stop;
  if (const double turn = hand_turn(incident, *incident.stop) / bounds.turn_stop; turn > share) {
    name = "turning of the hand";
    share = turn;
  }
  for (int i = 0; i < incident.joint_count; ++i) {
    const double limit = bounds.joint_speed_stop * bounds.joints[static_cast<std::size_t>(i)].velocity;
    if (!(std::fabs(stop.qd[i]) > share * limit)) continue;
    name = fmt::format("speed of joint {}", i + 1);
    share = std::fabs(stop.qd[i]) / limit;
  }
  return fmt::format("fastest: {}, {:.0f} % of its stop speed\n", name, 100.0 * share);
}

void add_fault(const Incident& incident, std::string& text) {
  const IncidentRow& stop = incident.rows[*incident.stop];
  const int joint = joint_of(incident);
  text += fmt::format("fault {}: {}\n", static_cast<int>(stop.fault), describe(stop.fault));
  if (stop.alarm != hal::Alarm::kNone) {
    text += fmt::format("alarm {}: {}\n", static_cast<int>(stop.alarm), describe(stop.alarm));
  }
  text += joint > 0 ? fmt::format("joint: {}{}\n", joint, drive_of(incident, joint))
                    : std::string("joint: no single joint is known\n");
  text += fastest(incident);
  if (!incident.words.empty()) text += fmt::format("the controller said: {}\n", incident.words);
}

void add_modes(const Incident& incident, double zero, std::string& text) {
  text += "modes, in seconds from the stop:";
  const char* separator = " ";
  const std::string* last = nullptr;
  for (const IncidentRow& row : incident.rows) {
    if (last != nullptr && *last == row.mode) continue;
    text += fmt::format("{}{} {:+.3f}", separator, row.mode, row.t - zero);
    separator = ", ";
    last = &row.mode;
  }
  text += '\n';
}

/// The largest value of rows with its row.
struct Largest {
  double value = 0.0;
  std::size_t row = 0;
  int joint = 0;  ///< from 1

  void see(double candidate, std::size_t at, int its_joint = 0) {
    if (!(candidate > value)) return;
    *this = {candidate, at, its_joint};
  }
};

/// Rows of the moment before the stop, with the stop.
struct Moment {
  Largest force, torque, speed, turn, late, computing, lost, missing;
  Largest joint_speed, joint_torque;  ///< share of the bound, or the number itself without bounds
  Largest beyond;                     ///< of a joint's position limit [rad]
};

Moment look_back(const Incident& incident) {
  Moment moment;
  const double stop_t = incident.rows[*incident.stop].t;
  for (std::size_t k = 0; k <= *incident.stop; ++k) {
    const IncidentRow& row = incident.rows[k];
    if (row.t < stop_t - kMoment) continue;
    moment.force.see(row.force.norm(), k);
    moment.torque.see(row.hand_torque.norm(), k);
    moment.speed.see(hand_speed(incident, k), k);
    moment.turn.see(hand_turn(incident, k), k);
    moment.late.see(row.late, k);
    moment.computing.see(row.computing, k);
    moment.lost.see(row.lost, k);
    if (k > 0 && incident.bounds) {
      moment.missing.see(std::round((row.t - incident.rows[k - 1].t) / incident.bounds->period) - 1.0, k);
    }
    for (int i = 0; i < incident.joint_count; ++i) {
      IncidentBounds::Joint joint{.velocity = 1.0, .torque = 1.0};
      if (incident.bounds) joint = incident.bounds->joints[static_cast<std::size_t>(i)];
      moment.joint_speed.see(std::fabs(row.qd[i]) / joint.velocity, k, i + 1);
      moment.joint_torque.see(std::fabs(row.torque[i]) / joint.torque, k, i + 1);
      if (incident.bounds) moment.beyond.see(std::max(joint.lower - row.q[i], row.q[i] - joint.upper), k, i + 1);
    }
  }
  return moment;
}

/// A line of the table: name, largest value, bound. `bound`: not above zero: not known.
std::string value_line(const std::string& name, double value, double bound, const char* unit, const char* of_bound) {
  constexpr double kNothing = 1e-9;  // smaller values are rounding errors
  std::string line = fmt::format("  {:<26} {:>10.4g} {:<6}", name, value < kNothing ? 0.0 : value, unit);
  if (bound > 0.0) {
    line += fmt::format(" {:>10.4g} {:<6} {}{}", bound, unit, of_bound, value > bound ? "  <- beyond" : "");
  }
  return line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
}

std::string of_joint(const char* name, int joint) {
  return joint > 0 ? fmt::format("{}, joint {}", name, joint) : std::string(name);
}

void add_values(const Incident& incident, std::string& text) {
  const Moment moment = look_back(incident);
  const IncidentBounds bounds = incident.bounds.value_or(IncidentBounds{});
  const bool known = incident.bounds.has_value();
  text += fmt::format("largest values of the last {:.0f} ms before the stop, and their bounds:\n", 1e3 * kMoment);
  text += value_line("force at the hand", moment.force.value, bounds.force, "N", "limits.force");
  text += value_line("torque at the hand", moment.torque.value, bounds.torque, "Nm", "limits.torque");
  text += value_line("speed of the hand", moment.speed.value, bounds.speed_stop, "m/s", "limits.speed_stop");
  text += value_line("turning of the hand", moment.turn.value, bounds.turn_stop, "rad/s", "limits.turn_stop");
  const double share = known ? 100.0 : 1.0;
  text += value_line(of_joint("speed of a joint", moment.joint_speed.joint), share * moment.joint_speed.value,
                     share * bounds.joint_speed_stop, known ? "%" : "rad/s", "of its speed limit");
  text += value_line(of_joint("torque of a joint", moment.joint_torque.joint), share * moment.joint_torque.value,
                     known ? 100.0 : 0.0, known ? "%" : "Nm", "of its torque limit");
  if (moment.beyond.joint > 0) {
    text += fmt::format("  joint {} is {:.4g} rad beyond its position limit  <- beyond\n", moment.beyond.joint,
                        moment.beyond.value);
  }
  text += value_line("waking late", 1e6 * moment.late.value, 0.0, "us", "");
  text += value_line("computing", 1e6 * moment.computing.value, 1e6 * bounds.compute, "us", "loop.compute");
  text += value_line("cycles without position", moment.lost.value, 0.0, "", "");
  if (moment.missing.value > 0.0) {
    text += fmt::format("  {:.0f} cycles in a row have no row\n", moment.missing.value);
  }
}

void add_emergencies(const Incident& incident, std::string& text) {
  constexpr std::size_t kMost = 8;
  const std::vector<Emergency>& all = incident.emergencies;
  for (std::size_t k = all.size() > kMost ? all.size() - kMost : 0; k < all.size(); ++k) {
    std::string joint;
    for (int i = 0; incident.bounds && i < incident.joint_count; ++i) {
      const IncidentBounds::Joint& drive = incident.bounds->joints[static_cast<std::size_t>(i)];
      const auto bus = static_cast<std::size_t>(drive.bus);
      if (drive.node == all[k].node && bus < incident.bounds->buses.size() &&
          incident.bounds->buses[bus] == all[k].bus) {
        joint = fmt::format(", joint {}", i + 1);
      }
    }
    text += fmt::format("emergency message {:04X} of node {} on {}{}\n", all[k].code, all[k].node, all[k].bus, joint);
  }
}

void add_facts(const Incident& incident, std::string& text) {
  if (!incident.program.empty()) text += fmt::format("program: {}\n", incident.program);
  if (!incident.machine.empty()) text += fmt::format("machine: {}\n", incident.machine);
  if (!incident.image.empty()) text += fmt::format("image: {}\n", incident.image);
  for (const std::string& note : incident.notes) text += fmt::format("note: {}\n", note);
}

}  // namespace

std::string explain(const Incident& incident) {
  std::string text = fmt::format("{}\n", incident.folder.string());
  const IncidentRow& last = incident.rows.back();
  if (!incident.stop) {
    text += fmt::format("no fault stopped this run\nits last row is of {:.3f} s, in the mode {}\n", last.t, last.mode);
    if (last.mode != "ended") text += "it did not end in order: the run goes on, was killed, or its disk was full\n";
    add_facts(incident, text);
    return text;
  }
  const IncidentRow& stop = incident.rows[*incident.stop];
  text += fmt::format("when: {}{:.6f} s by the controller's clock{}\n",
                      incident.stopped.empty() ? "" : incident.stopped + ", ", stop.t,
                      incident.began.empty() ? "" : fmt::format("; the run began {}", incident.began));
  add_fault(incident, text);
  text += fmt::format("look at: {}\n", advice(stop.fault));
  add_modes(incident, stop.t, text);
  add_values(incident, text);
  add_emergencies(incident, text);
  text += fmt::format("record: {} rows, from {:.3f} s before the stop to {:.3f} s after it\n", incident.rows.size(),
                      stop.t - incident.rows.front().t, last.t - stop.t);
  add_facts(incident, text);
  return text;
}

}  // namespace godobject::firmware
