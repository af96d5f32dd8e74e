#include "toolchain/report/extremes/setup.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace godobject::report {
namespace {

constexpr std::size_t kTightStarts = 6;  ///< of kRows

class Choice {
 public:
  explicit Choice(std::mt19937& random) : random_(random) {}
  double between(double low, double high) { return low + (high - low) * unit(); }
  double spread(double low, double high) { return low * std::pow(high / low, unit()); }
  bool one_in(int n) { return unit() * n < 1.0; }
  std::string of(std::initializer_list<const char*> names) {
    return names.begin()[static_cast<std::size_t>(unit() * static_cast<double>(names.size()))];
  }
  std::uint32_t seed() { return static_cast<std::uint32_t>(random_()); }

 private:
  double unit() { return static_cast<double>(random_()) / 4294967296.0; }
  std::mt19937& random_;
};

}  // namespace

const char* const kRows[] = {
    "scale and place",   "slender and singular bodies", "start inside, deep, at the rim", "jumps and bad input",
    "opposing contacts", "hundreds of constraints",     "starts inside tight parts"};
const std::size_t kRowCount = std::size(kRows);

Setup any_setup(std::mt19937& random) {
  Choice choice(random);
  Setup setup;
  setup.row = "fuzzer";
  setup.world = choice.of({"plane", "slot", "groove", "bore", "plate", "heap", "heap", "compiled"});
  setup.body = choice.of({"ball", "box", "box", "ell", "needle", "flat", "line", "point"});
  setup.motion = choice.one_in(40) ? choice.of({"press", "dash", "jump", "spin", "rest"}) : "seek";
  setup.seed = choice.seed();
  setup.solver = choice.one_in(8) ? (choice.one_in(2) ? format::Solver::kPaper : format::Solver::kCorrected)
                                  : format::Solver::kContact;
  setup.friction = choice.one_in(2);
  setup.points = static_cast<int>(choice.spread(1.0, 400.0));
  setup.bad_every = choice.one_in(5) ? 37 : 0;
  setup.scale = choice.one_in(2) ? 0.02 : choice.spread(1e-3, 1e3);
  setup.far = choice.one_in(4) ? choice.spread(1.0, 1e3) : 0.0;
  setup.width = choice.one_in(2) ? choice.spread(1.0001, 1.1) : choice.between(0.6, 2.0);
  setup.start = choice.one_in(8) ? choice.between(-3.0, 1.0) : choice.between(1.0, 1.5);
  setup.cycles = 1000;
  setup.depth = choice.spread(1e-3, 3.0);
  setup.speed = choice.spread(0.1, 500.0);
  setup.spin = choice.one_in(3) ? 0.0 : choice.spread(0.1, 50.0);
  setup.voxel = choice.spread(0.02, 0.3);
  setup.stiffness = choice.spread(200.0, 20000.0);
  setup.damping = choice.one_in(3) ? 0.0 : choice.spread(1.0, 100.0);
  setup.coupling_rotation = choice.spread(0.01, 10.0);
  setup.friction_static = choice.spread(0.01, 2.0);
  setup.friction_kinetic = choice.between(0.0, 1.0) * setup.friction_static;
  setup.friction_viscous = choice.one_in(4) ? choice.spread(0.1, 30.0) : 0.0;
  setup.body_scale = choice.one_in(3) ? choice.spread(0.2, 3.0) : 1.0;
  setup.workspace = choice.one_in(4) ? choice.between(0.5, 3.0) : 0.0;
  if (setup.world == "heap" && setup.workspace > 0.0) setup.workspace += 1.5;  // else the box may hold no solid
  setup.period = choice.one_in(3) ? choice.spread(1.25e-4, 1e-2) : 1e-3;
  setup.point_budget = choice.one_in(6) ? static_cast<int>(choice.spread(4.0, 200.0)) : 0;
  setup.remembers = !choice.one_in(8);
  // without memory a search that the budget ends begins again from the root
  setup.work_budget = setup.remembers && choice.one_in(5) ? std::floor(choice.spread(2e5, 2e6)) : 0.0;
  return setup;
}

Setup setup_of(const std::string& row, std::mt19937& random) {
  Setup setup = any_setup(random);
  Choice choice(random);
  setup.row = row;
  setup.solver = format::Solver::kContact;
  if (setup.world == "compiled") setup.world = "heap";
  if (row == kRows[0]) {
    setup.scale = choice.spread(1e-3, 1e3);
    setup.far = choice.spread(1.0, 1e4);
    setup.start = 2.0;
  } else if (row == kRows[1]) {
    setup.body = choice.of({"needle", "flat", "line", "point"});
  } else if (row == kRows[2]) {
    setup.start = choice.of({"deep", "just"}) == "deep" ? choice.between(-30.0, -1.0) : choice.between(-1.0, 1.0);
  } else if (row == kRows[3]) {
    setup.motion = choice.of({"jump", "dash"});
    setup.scale = 0.02;
    setup.speed = choice.spread(50.0, 500.0);  // up to 10 m/s
    setup.spin = choice.spread(5.0, 50.0);
    setup.bad_every = choice.one_in(2) ? 17 : 0;
  } else if (row == kRows[4]) {
    setup.world = choice.of({"slot", "groove", "bore"});
    setup.width = choice.spread(1.0001, 1.05);
    setup.body = choice.of({"ball", "box"});
    setup.far = 0.0;
    setup.start = 0.0;
  } else if (row == kRows[kTightStarts]) {
    setup.world = choice.of({"slot", "groove", "bore"});
    setup.body = choice.of({"box", "ell", "ball"});
    setup.body_scale = setup.body == "box" ? 1.25 : setup.body == "ell" ? 1.1 : 1.0;  // each is 2 `scale` wide
    setup.motion = "seek";
    setup.width = 1.0 + choice.spread(1e-4, 0.05);
    setup.start = choice.between(-0.5, 0.0);
    setup.aside = choice.spread(0.01, 1.0);
  } else {
    setup.body = choice.of({"box", "flat"});
    setup.points = static_cast<int>(choice.spread(1000.0, 4000.0));
    setup.motion = choice.of({"press", "spin"});
    setup.world = choice.of({"plane", "groove", "plate"});
    setup.start = 2.0;
    setup.cycles = 60;
  }
  return setup;
}

namespace {

/// Keeps what a session chooses within what compiled worlds take; `seed` decides whether it may begin inside, if its
/// row does not.
void fit_session(Setup& setup, std::uint32_t seed) {
  if (setup.body == "center" && setup.solver == format::Solver::kPaper) setup.solver = format::Solver::kContact;
  const bool begins_inside = setup.row == kRows[kTightStarts] || seed / 64 % 8 == 0;
  if (!begins_inside) setup.start = std::max(setup.start, 2.0);
  setup.period = 1e-3;
  setup.bad_every = 17;
}

}  // namespace

void choose_mesh(Setup& setup) {
  constexpr const char* kMeshes[] = {"mesh-box", "mesh-ball", "mesh-plate", "mesh-turned", "mesh-cavity", "mesh-shell"};
  constexpr std::size_t kConvex = 3;  // of these: only they take a ball that is rendered by its centre
  constexpr const char* kBodies[] = {"box", "ball", "ell", "center", "box"};
  const std::size_t mesh = setup.seed % std::size(kMeshes);
  setup.world = kMeshes[mesh];
  setup.body = kBodies[setup.seed / 7 % std::size(kBodies)];
  const bool takes_center = mesh < kConvex && setup.solver != format::Solver::kPaper;
  if (setup.body == "center" && !takes_center) setup.body = "ball";
  setup.voxel = std::max(setup.voxel, 0.1);
  setup.points = std::clamp(setup.points, 60, 200);
  setup.far = std::min(setup.far, 10.0);  // an image has coordinates in single precision
  fit_session(setup, setup.seed);
}

Setup any_session_in(const Setup& world, std::mt19937& random) {
  Setup session = world.row == "fuzzer" ? any_setup(random) : setup_of(world.row, random);
  session.session = session.seed;
  session.row = world.row;
  session.world = world.world;
  session.body = world.body;
  session.seed = world.seed;
  session.scale = world.scale;
  session.far = world.far;
  session.width = world.width;
  session.voxel = world.voxel;
  session.points = world.points;
  session.body_scale = world.body_scale;
  fit_session(session, session.session);
  return session;
}

std::string case_file(const Setup& s, const std::string& found) {
  return nlohmann::ordered_json{{"generator", kGenerator},
                                {"found", found},
                                {"row", s.row},
                                {"world", s.world},
                                {"body", s.body},
                                {"motion", s.motion},
                                {"seed", s.seed},
                                {"cycles", s.cycles},
                                {"solver", format::kSolverNames[static_cast<std::size_t>(s.solver)]},
                                {"friction", s.friction},
                                {"points", s.points},
                                {"bad_every", s.bad_every},
                                {"scale", s.scale},
                                {"far", s.far},
                                {"width", s.width},
                                {"start", s.start},
                                {"depth", s.depth},
                                {"speed", s.speed},
                                {"spin", s.spin},
                                {"voxel", s.voxel},
                                {"stiffness", s.stiffness},
                                {"damping", s.damping},
                                {"coupling_rotation", s.coupling_rotation},
                                {"friction_static", s.friction_static},
                                {"friction_kinetic", s.friction_kinetic},
                                {"friction_viscous", s.friction_viscous},
                                {"body_scale", s.body_scale},
                                {"workspace", s.workspace},
                                {"period", s.period},
                                {"point_budget", s.point_budget},
                                {"remembers", s.remembers},
                                {"work_budget", s.work_budget},
                                {"returns", s.returns},
                                {"session", s.session},
                                {"aside", s.aside}}
             .dump(1) +
         "\n";
}

Setup read_case(const std::string& text) {
  const nlohmann::json all = nlohmann::json::parse(text);
  const int generator = all.at("generator");
  if (generator < 1 || generator > kGenerator) throw std::runtime_error("it is of another generator");
  Setup s;
  s.row = all.at("row");
  s.world = all.at("world");
  s.body = all.at("body");
  s.motion = all.at("motion");
  s.seed = all.at("seed");
  s.cycles = all.at("cycles");
  const std::string solver = all.at("solver");
  std::uint32_t number = 0;
  while (number < format::kSolverCount && solver != format::kSolverNames[number]) ++number;
  if (number == format::kSolverCount) throw std::runtime_error(fmt::format("no solver {}", solver));
  s.solver = static_cast<format::Solver>(number);
  s.friction = all.at("friction");
  s.points = all.at("points");
  s.bad_every = all.at("bad_every");
  s.scale = all.at("scale");
  s.far = all.at("far");
  s.width = all.at("width");
  s.start = all.at("start");
  s.depth = all.at("depth");
  s.speed = all.at("speed");
  s.spin = all.at("spin");
  s.voxel = all.at("voxel");
  s.stiffness = all.at("stiffness");
  s.damping = all.at("damping");
  s.coupling_rotation = all.at("coupling_rotation");
  s.friction_static = all.at("friction_static");
  s.friction_kinetic = all.at("friction_kinetic");
  // files of generator 1 lack these
  s.friction_viscous = all.value("friction_viscous", 0.0);
  s.body_scale = all.value("body_scale", 1.0);
  s.workspace = all.value("workspace", 0.0);
  s.period = all.value("period", 1e-3);
  s.point_budget = all.value("point_budget", 0);
  s.remembers = all.value("remembers", true);
  s.returns = all.value("returns", false);        // files of generator 2 lack it
  s.session = all.value("session", 0u);           // files of generator 3 lack it
  s.work_budget = all.value("work_budget", 0.0);  // files of generator 4 lack it
  s.aside = all.value("aside", 0.0);              // files of generator 5 lack it
  return s;
}

}  // namespace godobject::report
