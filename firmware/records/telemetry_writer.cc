#include "firmware/records/telemetry_writer.h"

#include <array>
#include <bit>
#include <charconv>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace godobject::firmware {
namespace {

constexpr std::uint64_t kRowsAtOnce = 64;  // rows a write call; chosen: some 40 KiB of text

std::string header(int joint_count) {
  std::string text = "t_s,late_us,compute_us,mode,fault,share,outcome,contacts,lost";
  for (const char* column : {"q{}_rad", "qd{}_rad_s", "torque{}_Nm"}) {
    for (int i = 1; i <= joint_count; ++i) text += ',' + fmt::format(fmt::runtime(column), i);
  }
  for (const char* frame : {"d", "g"}) {  // device pose and god object, with the column names of godobject-replay
    text += fmt::format(",{0}px_m,{0}py_m,{0}pz_m,{0}qw,{0}qx,{0}qy,{0}qz", frame);
  }
  return text + ",fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm,depth_m,absorbed_J,injected_Ns_per_m,drives_limited,drives_warm\n";
}

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

void append(std::string& text, const TelemetryRecord& record, int joint_count) {
  const CycleRecord& cycle = record.cycle;
  fmt::format_to(std::back_inserter(text), "{:.6f},{:.3f},{:.3f},{},{},{:.4g},{},{},{}",
                 1e-9 * static_cast<double>(record.times.deadline_ns), 1e-3 * static_cast<double>(record.times.late_ns),
                 1e-3 * static_cast<double>(record.times.compute_ns), name(cycle.mode), static_cast<int>(cycle.fault),
                 cycle.share, name(cycle.outcome), cycle.contacts, cycle.lost);
  append(text, cycle.q.head(joint_count));
  append(text, cycle.qd.head(joint_count));
  append(text, cycle.torque.head(joint_count));
  append(text, cycle.H_WM);
  append(text, cycle.god_object_W);
  append(text, cycle.F_G_R.force, 6);
  append(text, cycle.F_G_R.torque, 6);
  append(text, std::array{cycle.penetration, cycle.absorbed, cycle.injected_damping}, 6);
  const auto warm = static_cast<std::uint8_t>(cycle.warm | cycle.temperature_lost);
  append(text, std::array<double, 2>{static_cast<double>(std::popcount(cycle.limited)),
                                     static_cast<double>(std::popcount(warm))});
  text += '\n';
}

}  // namespace

TelemetryWriter::TelemetryWriter(LogFile file, int joint_count, TelemetryRing& ring)
    : file_(std::move(file)), joint_count_(joint_count), ring_(ring) {
  file_.write(header(joint_count), 0);
}

void TelemetryWriter::drain() {
  TelemetryRecord record;
  std::uint64_t rows = 0;
  while (ring_.pop(record)) {
    append(text_, record, joint_count_);
    if (++rows == kRowsAtOnce) {
      write_rows(rows);
      rows = 0;
    }
  }
  write_rows(rows);
}

void TelemetryWriter::write_rows(std::uint64_t rows) {
  file_.write(text_, rows);
  text_.clear();
}

}  // namespace godobject::firmware
