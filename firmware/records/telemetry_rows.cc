#include "firmware/records/telemetry_rows.h"

#include <array>
#include <bit>
#include <charconv>
#include <iterator>

#include <fmt/format.h>

namespace godobject::firmware {
namespace {

/// Appends a comma and each value, as printf's %.*g would write it. A row has some fifty values, and std::to_chars is
/// quicker than fmt.
template <class Values>
void append(std::string& text, const Values& values, int digits = 9) {
  std::array<char, 32> number;  // a sign, 9 digits, a point and an exponent take 16
  for (const double value : values) {
    const auto written =
        std::to_chars(number.data(), number.data() + number.size(), value, std::chars_format::general, digits);
    text += ',';
    text.append(number.data(), written.ptr);
  }
}

void append(std::string& text, const Pose& pose) {
  append(text, pose.translation);
  const Quaternion& q = pose.rotation;
  append(text, std::array{q.w(), q.x(), q.y(), q.z()});
}

}  // namespace

std::string telemetry_header(int joint_count) {
  std::string text = "t_s,late_us,compute_us,mode,fault,share,outcome,contacts,lost";
  for (const char* column : {"q{}_rad", "qd{}_rad_s", "torque{}_Nm"}) {
    for (int i = 1; i <= joint_count; ++i) text += ',' + fmt::format(fmt::runtime(column), i);
  }
  for (const char* frame : {"d", "g"}) {  // device pose and god object, with the column names of godobject-replay
    text += fmt::format(",{0}px_m,{0}py_m,{0}pz_m,{0}qw,{0}qx,{0}qy,{0}qz", frame);
  }
  return text +
         ",fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm,depth_m,absorbed_J,injected_Ns_per_m,fault_joint,alarm,alarm_joint,"
         "drives_limited,drives_warm,wqw,wqx,wqy,wqz\n";
}

void append_telemetry_row(const TelemetryRecord& record, const TelemetryFormat& format, std::string& text) {
  const CycleRecord& cycle = record.cycle;
  fmt::format_to(std::back_inserter(text), "{:.6f},{:.3f},{:.3f},{},{},{:.4g},{},{},{}",
                 1e-9 * static_cast<double>(record.times.deadline_ns), 1e-3 * static_cast<double>(record.times.late_ns),
                 1e-3 * static_cast<double>(record.times.compute_ns), name(cycle.mode), static_cast<int>(cycle.fault),
                 cycle.share, name(cycle.outcome), cycle.contacts, cycle.lost);
  append(text, cycle.q.head(format.joint_count));
  append(text, cycle.qd.head(format.joint_count));
  append(text, cycle.torque.head(format.joint_count));
  append(text, cycle.H_WM);
  append(text, cycle.god_object_W);
  append(text, cycle.F_G_R.force, 6);
  append(text, cycle.F_G_R.torque, 6);
  append(text, std::array{cycle.penetration, cycle.absorbed, cycle.injected_damping}, 6);
  const auto warm = static_cast<std::uint8_t>(cycle.warm | cycle.temperature_lost);
  fmt::format_to(std::back_inserter(text), ",{},{},{},{},{}", cycle.fault_joint + 1, static_cast<int>(cycle.alarm),
                 cycle.alarm_joint + 1, std::popcount(cycle.limited), std::popcount(warm));
  append(text, std::array{format.R_WR.w(), format.R_WR.x(), format.R_WR.y(), format.R_WR.z()});
  text += '\n';
}

}  // namespace godobject::firmware
