// replay_ball X.scene SOLVER on|off: lowers a ball onto a plate, slides and turns it there, and lifts it. The last
// argument switches friction. Prints one line a cycle with every bit of pose and force. callgrind counts only the
// function counted_update, which runs the sliding cycles. Exit 78, with the status, if the build lacks the pipeline.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <span>
#include <vector>

#include "godobject/god_object.h"

namespace {

using namespace godobject;

GodObject god_object;

/// Returns the device's input in cycle `i`. The ball is 1 mm deep from cycle 100 to 899.
GodObject::Input device(int i) {
  const double ramp = std::min({1.0, i / 100.0, (999 - i) / 100.0});
  const double t = 1e-3 * i;
  GodObject::Input input;
  input.H_WM.translation = Vector3(0.04 * (t - 0.5), 0.01 * std::sin(5.0 * t), 0.062 - 0.003 * ramp);
  input.H_WM.rotation = Quaternion(Eigen::AngleAxisd(2.0 * t, Vector3(0.6, 0.0, 0.8)));
  input.velocity_W.translation = Vector3(0.04, 0.05 * std::cos(5.0 * t), 0.0);
  return input;
}

}  // namespace

[[gnu::noinline]] Status counted_update(const GodObject::Input& input, CycleReport& report);
[[gnu::noinline]] Status counted_update(const GodObject::Input& input, CycleReport& report) {
  return god_object.update(input, report);
}

int main(int argc, char** argv) {
  std::ifstream file(argc == 4 ? argv[1] : "", std::ios::binary | std::ios::ate);
  if (!file) return std::fprintf(stderr, "usage: replay_ball X.scene SOLVER on|off\n"), 66;
  struct alignas(Scene::kImageAlignment) Line {
    char byte[Scene::kImageAlignment];
  };
  const auto bytes = static_cast<std::size_t>(file.tellg());
  std::vector<Line> image(bytes / sizeof(Line) + 1);
  file.seekg(0).read(image.data()->byte, static_cast<std::streamsize>(bytes));

  Scene scene;
  if (const Status status = Scene::open(std::as_bytes(std::span(image)).first(bytes), scene); status != Status::kOk) {
    return std::fprintf(stderr, "%s\n", describe(status)), 65;
  }
  constexpr const char* kSolvers[] = {"paper", "corrected", "contact"};
  const auto* const name = std::find_if(std::begin(kSolvers), std::end(kSolvers),
                                        [&](const char* solver) { return std::strcmp(solver, argv[2]) == 0; });
  if (name == std::end(kSolvers)) return 64;
  const auto solver = static_cast<Solver>(name - std::begin(kSolvers));
  static std::vector<Line> memory(GodObject::memory_size(scene) / sizeof(Line) + 1);
  const Status started =
      god_object.start(scene, solver, std::strcmp(argv[3], "on") == 0, std::as_writable_bytes(std::span(memory)));
  if (started != Status::kOk) return std::fprintf(stderr, "%s\n", describe(started)), 78;
  for (int i = 0; i < 1000; ++i) {
    CycleReport report;
    const bool slides = i >= 200 && i < 800;
    const Status status = slides ? counted_update(device(i), report) : god_object.update(device(i), report);
    if (status != Status::kOk) return 70;
    const Pose H_WM = god_object.mesh_pose();
    const Vector3& p = H_WM.translation;
    const Quaternion& q = H_WM.rotation;
    const Wrench& f = report.force.total_W;
    std::printf("%d %s %u %a %a %a %a %a %a %a %a %a %a %a %a %a\n", i, godobject::name(report.outcome),
                report.contacts, p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z(), f.force.x(), f.force.y(), f.force.z(),
                f.torque.x(), f.torque.y(), f.torque.z());
  }
  return 0;
}
