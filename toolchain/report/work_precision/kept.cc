#include "toolchain/report/work_precision/kept.h"

#include <array>
#include <fstream>
#include <span>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/atomic_file.h"
#include "toolchain/files/output_target.h"
#include "toolchain/report/study/made_once.h"
#include "toolchain/report/study/result_file.h"
#include "toolchain/scene_compiler/compile_scene.h"
#include "toolchain/scene_compiler/compiler_digest.h"

namespace godobject::report {
namespace {

using precision::TracedCycle;
using Numbers = std::array<double, 13>;

std::filesystem::path file_of(const std::filesystem::path& folder, const std::string& maker, const std::string& key,
                              const char* ending) {
  files::make_output_folder(folder);
  return folder / (digest(maker + " " + key) + ending);
}

Numbers numbers_of(const TracedCycle& cycle) {
  const Quaternion& q = cycle.H_WM.rotation;
  const Vector3& p = cycle.H_WM.translation;
  const Vector3& f = cycle.spring_W.force;
  const Vector3& t = cycle.spring_W.torque;
  return {q.w(), q.x(), q.y(), q.z(), p.x(), p.y(), p.z(), f.x(), f.y(), f.z(), t.x(), t.y(), t.z()};
}

TracedCycle cycle_of(const Numbers& n) {
  TracedCycle cycle;
  cycle.H_WM.rotation = Quaternion(n[0], n[1], n[2], n[3]);
  cycle.H_WM.translation = {n[4], n[5], n[6]};
  cycle.spring_W.force = {n[7], n[8], n[9]};
  cycle.spring_W.torque = {n[10], n[11], n[12]};
  return cycle;
}

}  // namespace

files::SceneImage kept_image(const std::filesystem::path& folder, const std::string& key,
                             const scene_compiler::SceneConfig& config) {
  const std::filesystem::path file = file_of(folder, scene_compiler::compiler_digest(), key, ".scene");
  make_once(file, [&] {
    scene_compiler::compile_scene(
        {.scene_file = {}, .config = config, .output = file, .only_solver = {}, .choice = {}, .progress = {}});
  });
  return files::SceneImage::read(file);
}

std::vector<TracedCycle> kept_cycles(const std::filesystem::path& folder, const std::string& key,
                                     const std::function<std::vector<TracedCycle>()>& run) {
  const std::filesystem::path file = file_of(folder, program_digest(), key, ".cycles");
  make_once(file, [&] {
    files::AtomicFile out(file);
    for (const TracedCycle& cycle : run()) {
      const Numbers numbers = numbers_of(cycle);
      out.write(std::as_bytes(std::span(numbers)));
    }
    out.commit();
  });
  std::ifstream in(file, std::ios::binary);
  std::vector<TracedCycle> cycles;
  Numbers numbers;
  while (in.read(reinterpret_cast<char*>(numbers.data()), sizeof numbers)) cycles.push_back(cycle_of(numbers));
  if (in.gcount() == 0 && !cycles.empty()) return cycles;
  throw command::Failure(command::ExitCode::kBadData,
                         fmt::format("{}: the file is incomplete; remove it", file.string()));
}

}  // namespace godobject::report
