#include "toolchain/report/assembly/chapter.h"

#include <functional>
#include <string>

#include <fmt/format.h>

#include "toolchain/files/input_file.h"
#include "toolchain/report/assembly/bounds.h"
#include "toolchain/report/assembly/cases.h"
#include "toolchain/report/assembly/generated_pairs.h"
#include "toolchain/report/assembly/pair.h"
#include "toolchain/report/study/result_file.h"

namespace godobject::report {
namespace {

using Write = std::function<std::filesystem::path(const std::filesystem::path& folder)>;
using Measure = std::function<CaseResult(const Pair& pair)>;

/// Adds a case for a pair of parts whose scene file is written into the case's folder.
void add_generated(Chapter& chapter, const AssemblyRequest& request, const std::string& name, double seconds,
                   const Write& write, const Measure& measure) {
  chapter.cases.push_back(
      {.name = "assembly." + name,
       .inputs = fmt::format("generated, quick {}, seed {}", request.quick, request.seed),
       .run = [write, measure, kept = request.kept](
                  const std::filesystem::path& work) { return measure(*read_pair(write(work), kept)); },
       .seconds = seconds});
}

/// Adds a case for a scene file. `what` is part of the case's name.
void add_scene(Chapter& chapter, const AssemblyRequest& request, const std::string& scene, const std::string& what,
               double seconds, const Measure& measure) {
  const std::filesystem::path file = request.scenes / (scene + ".toml");
  chapter.cases.push_back({.name = "assembly." + scene + what,
                           .inputs = fmt::format("{} seed {}", inputs_of_pair(file), request.seed),
                           .run = [file, measure, kept = request.kept](
                                      const std::filesystem::path&) { return measure(*read_pair(file, kept)); },
                           .seconds = seconds});
}

/// Adds the case of a scene's own path.
void add_path(Chapter& chapter, const AssemblyRequest& request, const std::string& pair, const std::string& scene,
              const std::string& path, double seconds) {
  constexpr int kOverlapEvery = 4;
  const std::filesystem::path file = request.scenes / "paths" / (path + ".toml");
  files::require_regular_input(file, "name the folder of the scene files with --scenes");
  const AssemblyEffort effort{.quick = request.quick, .seed = request.seed, .fault = request.fault};
  add_scene(chapter, request, scene, "-path", seconds,
            [=](const Pair& parts) { return path_case(pair, parts, file, kOverlapEvery, effort); });
  chapter.cases.back().inputs += " path " + file_digest(file);
}

/// Adds the cases of parts whose images take minutes to compile.
void add_parts(Chapter& chapter, const AssemblyRequest& request) {
  namespace bound = assembly_bound;
  const AssemblyEffort effort{.quick = request.quick, .seed = request.seed, .fault = request.fault};
  const CubeInCavity cube{.half_edge = 1e-2, .clearance = 5e-5};
  add_generated(
      chapter, request, "cavity", 60.0,
      [cube](const auto& folder) { return write_cavity(cube.half_edge, cube.clearance, 1.5e-4, folder); },
      [=](const Pair& pair) { return cavity_case(bound::kCavity, pair, cube, effort); });
  add_scene(chapter, request, "round-peg", "", 120.0,
            [=](const Pair& pair) { return jamming_case(bound::kRoundPeg, pair, OtherLoads::kShown, effort); });
  add_path(chapter, request, bound::kRoundPeg, "round-peg", "peg-8mm", 60.0);
  add_scene(chapter, request, "rectangular-peg", "", 150.0,
            [=](const Pair& pair) { return jamming_case(bound::kRectangularPeg, pair, OtherLoads::kJudged, effort); });
  add_path(chapter, request, bound::kRectangularPeg, "rectangular-peg", "peg-8mm", 60.0);
  const NutPlace m16{
      .start_z = 6e-3, .low = 24e-3, .high = 34e-3, .turns = 1.0, .cycles_of_turn = 4000, .overlap_every = 40};
  add_scene(chapter, request, "nut-m16", "", 400.0,
            [=](const Pair& pair) { return nut_case(bound::kNut, pair, m16, effort); });
  add_path(chapter, request, bound::kNut, "nut-m16", "nut-m16", 60.0);
  add_path(chapter, request, bound::kGear, "gears", "gears", 60.0);
}

}  // namespace

Chapter assembly_chapter(const AssemblyRequest& request) {
  namespace bound = assembly_bound;
  Chapter chapter{
      .name = "assembly",
      .title = "Parts that fit tightly",
      .introduction =
          "<p>Pegs, a nut, a cube in a cavity and a cross between posts with engineering clearances, compiled with "
          "<code>accuracy</code>. Measured forces, motions and coefficients of friction are compared with "
          "theory that is computed from the meshes alone: the power screw, self-locking, backlash, wedging "
          "and jamming (Whitney 1982). The overlap is that of the exact meshes.</p>",
      .bounds = bound::all(),
      .cases = {},
      .conclude = gather};
  const AssemblyEffort effort{.quick = request.quick, .seed = request.seed, .fault = request.fault};
  const CubeInCavity small{.half_edge = 2e-3, .clearance = 5e-5};
  add_generated(
      chapter, request, "small-cavity", 6.0,
      [small](const auto& folder) { return write_cavity(small.half_edge, small.clearance, 1e-4, folder); },
      [=](const Pair& pair) { return cavity_case(bound::kCavity, pair, small, effort); });
  add_generated(chapter, request, "short-round-peg", 20.0, write_round_peg,
                [=](const Pair& pair) { return jamming_case(bound::kRoundPeg, pair, OtherLoads::kShown, effort); });
  add_generated(chapter, request, "short-rectangular-peg", 7.0, write_rectangular_peg, [=](const Pair& pair) {
    return jamming_case(bound::kRectangularPeg, pair, OtherLoads::kJudged, effort);
  });
  const NutPlace coarse{
      .start_z = 6e-3, .low = 5e-3, .high = 16e-3, .turns = 0.5, .cycles_of_turn = 1440, .overlap_every = 20};
  add_generated(chapter, request, "coarse-nut", 60.0, write_nut,
                [=](const Pair& pair) { return nut_case(bound::kNut, pair, coarse, effort); });
  const GearPlace turnstile{.start_z = 0.0, .section_z = 1.5e-3, .radius = 7.5e-3};
  add_generated(chapter, request, "turnstile", 15.0, write_turnstile,
                [=](const Pair& pair) { return gear_case(bound::kGear, pair, turnstile, effort); });
  if (!request.quick) add_parts(chapter, request);
  return chapter;
}

}  // namespace godobject::report
