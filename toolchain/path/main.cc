#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "toolchain/command_line/run.h"
#include "toolchain/files/atomic_file.h"
#include "toolchain/files/output_target.h"
#include "toolchain/path/keyframes.h"
#include "toolchain/path/shake.h"
#include "toolchain/path/trajectory.h"

namespace {

const char* const kFooter = R"(Examples:
  godobject-path peg.keyframes.toml -o peg.csv
  godobject-path peg.keyframes.toml --shake 7 -o shaken.csv

KEYFRAMES.toml:
  period = 0.001               # optional: time between two poses [s], 0.000125 to 0.01; as coupling.period of the scene
  pivot = [0, 0, 0]            # optional: point of the moving mesh (scaled, own frame) to which positions refer [m]
  [[keyframe]]                 # at least two
  t = 0.0                      # [s]
  position = [0, 0, 0.1]       # of the pivot in W, the still mesh's frame [m]
  axis_angle = [0, 0, 1, 90]   # x, y, z, degrees; or quaternion = [w, x, y, z]; default: not rotated
  [[oscillation]]              # optional: a sine added to the path
  from = 1.0                   # [s]
  to = 2.0
  frequency = 9.0              # [Hz]
  phase_deg = 0                # optional; a circle is two oscillations 90 degrees apart
  fade = 0.1                   # optional: time of growth and decay at both ends [s]
  translation = [0.001, 0, 0]  # amplitude of the pivot in W [m]
  rotation_deg = [0, 0, 2]     # amplitude as a rotation vector in W, about the pivot

POSES.csv gets the columns t,px,py,pz,qw,qx,qy,qz, one row for each period: the moving mesh's frame in W. The body
rests at each keyframe. Between two keyframes the pivot moves straight and the rotation along the shorter arc, with the
least jerk (10 u^3 - 15 u^4 + 6 u^5).

--shake SEED adds the slow swing of an unsteady hand, of some millimetres and degrees: the same task by another hand. Each
seed gives another swing.

Exit codes: 0 done, 64 usage, 66 KEYFRAMES.toml is missing or cannot be read, 74 cannot write, 77 no permission to
write, 78 not TOML, or a bad key.)";

/// `decimals`: of the time.
std::string row(const godobject::path::Sample& sample, int decimals) {
  const godobject::Vector3& p = sample.pose.translation;
  const godobject::Quaternion& q = sample.pose.rotation;
  return fmt::format("{:.{}f},{:.12f},{:.12f},{:.12f},{:.12f},{:.12f},{:.12f},{:.12f}\n", sample.t, decimals, p.x(),
                     p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Makes a device path, one pose for each millisecond or other period, from keyframes.", "godobject-path");
  app.footer(kFooter);
  std::string keyframes_path, out_path;
  std::optional<std::uint64_t> seed;
  app.add_option("KEYFRAMES.toml", keyframes_path, "places, times, oscillations")->required()->type_name("");
  app.add_option("-o,--output", out_path, "device path to write")->required()->type_name("POSES.csv");
  app.add_option("--shake", seed, "adds the swing of an unsteady hand")->type_name("SEED");

  return godobject::command::run(app, argc, argv, [&] {
    godobject::files::output_target(out_path);  // refused before anything is read
    godobject::path::Keyframes motion = godobject::path::read_keyframes(keyframes_path);
    if (seed) godobject::path::shake(*seed, motion);
    godobject::files::AtomicFile out(out_path);
    out.write("t,px,py,pz,qw,qx,qy,qz\n");
    const bool whole_ms = std::abs(std::remainder(motion.period, 1e-3)) < 1e-9;
    const int decimals = whole_ms ? 3 : 6;
    for (const godobject::path::Sample& sample : godobject::path::sample(motion)) out.write(row(sample, decimals));
    out.commit();
  });
}
