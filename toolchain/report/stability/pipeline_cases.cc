#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "core/device/stability.h"
#include "toolchain/report/contact_quality/compiled_scene.h"
#include "toolchain/report/contact_quality/meshes.h"
#include "toolchain/report/stability/axis_loop.h"
#include "toolchain/report/stability/axis_theory.h"
#include "toolchain/report/stability/bounds.h"
#include "toolchain/report/stability/cases.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject::report {
namespace {

constexpr double kBodyMass = 1.0;
constexpr double kDeviceDamping = 2.0;
constexpr double kPressed = 2e-3;       ///< length of the pressed spring [m]
constexpr std::uint32_t kPoints = 160;  ///< points of a body
constexpr double kDiedOut = 1e-3;       ///< share of the first swing; a smaller swing has died out
constexpr double kGrown = 6.0;          ///< share of the first swing, there and back; a larger swing has grown
constexpr double kResolution = 1e-3;    ///< of a boundary; a twentieth of the required one

/// A body over a plate of 64 x 64 x 16 mm with its top at z = 0. Flat on flat, the body does not rotate by itself, and
/// the stored distance is exact. The first user in a process compiles the scene in its folder.
class Press {
 public:
  /// A slab of 40 x 40 x 10 mm, which any few points of its lower face may support.
  static const Press& slab(const std::filesystem::path& work) {
    static const Press press("slab", box_mesh({-0.02, -0.02, -0.005}, {0.02, 0.02, 0.005}), work);
    return press;
  }
  /// The same on three feet of 4 x 4 mm, all of which support it.
  static const Press& tripod(const std::filesystem::path& work) {
    static const Press press(
        "tripod",
        cell_solid({{{-0.02, -0.016, -0.002, 0.002, 0.016, 0.02}, {-0.02, -0.016, 0.016, 0.02}, {-0.005, 0.0, 0.005}}},
                   [](int i, int j, int k) { return k == 1 || (j == 0 && (i == 0 || i == 4)) || (j == 2 && i == 2); }),
        work);
    return press;
  }

  static constexpr double kTouching = 0.005;  ///< height of the body's middle [m]
  const SceneView& scene() const { return image_.scene; }

 private:
  Press(const std::string& name, const TriangleMesh& body, const std::filesystem::path& work)
      : image_(compile(name + "-on-plate",
                       {.still = {.mesh = box_mesh({-0.032, -0.032, -0.016}, {0.032, 0.032, 0.0})},
                        .body = written(name, body, work),
                        .points = kPoints},
                       work)) {}

  static std::filesystem::path written(const std::string& name, const TriangleMesh& body,
                                       const std::filesystem::path& work) {
    const std::filesystem::path file = work / (name + ".ply");
    write_ply(body, file);
    return file;
  }

  files::SceneImage image_;
};

/// A floating body under a constant downward force; its height and its tilt about y move, each in closed form.
struct Floating {
  AxisSetup height{.mass = kBodyMass, .damping = kDeviceDamping};
  double gyration = 0.02;  ///< radius of gyration g of the device: inertia m g^2, damping b g^2 [m]
  double stiffness = 2000.0;
  double coupling_rotation = 0.0;  ///< k_VC,r [m^2]
  Solver solver = Solver::kContact;
  double load_shift = HUGE_VAL;  ///< linear range: largest shift of the centre of pressure [m]
  LoopFault fault = {};
};

/// Logarithm of the change of each swing's width from the second quarter of a run to the last.
struct Swings {
  double height = 0.0;
  double tilt = 0.0;
};

/// The floating body under delayed forces: height and tilt, each in closed form between two changes of its force.
class FloatingPlant {
 public:
  explicit FloatingPlant(const Floating& floating)
      : forces_(floating.height.delay / kPeriod + floating.fault.late),
        torques_(floating.height.delay / kPeriod + floating.fault.late),
        height_first_(kBodyMass, kDeviceDamping, before_change()),
        height_second_(kBodyMass, kDeviceDamping, kPeriod - before_change()),
        tilt_first_(kBodyMass * square(floating.gyration), kDeviceDamping * square(floating.gyration), before_change()),
        tilt_second_(kBodyMass * square(floating.gyration), kDeviceDamping * square(floating.gyration),
                     kPeriod - before_change()) {}

  FreeAxis::State height{.x = Press::kTouching + 1e-3};
  FreeAxis::State tilt;

  Pose pose() const {
    Pose H_WM;
    H_WM.rotation = exp_rotation({0.0, tilt.x, 0.0});
    H_WM.translation.z() = height.x;
    return H_WM;
  }

  /// Returns the mean velocity since the last call.
  Motion velocity() {
    Motion velocity;
    velocity.translation.z() = (height.x - height_before_.x) / kPeriod;
    velocity.rotation.y() = (tilt.x - tilt_before_.x) / kPeriod;
    height_before_ = height;
    tilt_before_ = tilt;
    return velocity;
  }

  void send(const Wrench& wrench_W) {
    forces_.send(wrench_W.force.z());
    torques_.send(wrench_W.torque.y());
  }

  /// Advances one period; `load` is the force with which the hand presses down.
  void advance(double load) {
    height_first_.advance(forces_.before() - load, height);
    height_second_.advance(forces_.after() - load, height);
    tilt_first_.advance(torques_.before(), tilt);
    tilt_second_.advance(torques_.after(), tilt);
  }

 private:
  static double square(double x) { return x * x; }
  double before_change() const { return forces_.share_before() * kPeriod; }

  DelayedHold forces_, torques_;
  FreeAxis height_first_, height_second_, tilt_first_, tilt_second_;
  FreeAxis::State height_before_ = height;
  FreeAxis::State tilt_before_;
};

/// Widths of the swings of height and tilt in the second and in the last quarter of a run.
class SwingWidths {
 public:
  explicit SwingWidths(int periods) : periods_(periods), quarter_(periods / 4) {}

  void note(int period, double height, double tilt) {
    if (period >= periods_ - quarter_) {
      add(late_, height, tilt);
    } else if (period >= quarter_ && period < 2 * quarter_) {
      add(early_, height, tilt);
    }
  }

  /// Returns the logarithm of the change of the width of an axis (0: height, 1: tilt); `first` is the first swing.
  double growth(std::size_t axis, double first) const {
    const double late = late_.high[axis] - late_.low[axis];
    if (late > kGrown * first) return HUGE_VAL;
    return late < kDiedOut * first ? -HUGE_VAL : std::log(late / (early_.high[axis] - early_.low[axis]));
  }

 private:
  struct Range {
    std::array<double, 2> low{HUGE_VAL, HUGE_VAL};
    std::array<double, 2> high{-HUGE_VAL, -HUGE_VAL};
  };

  static void add(Range& range, double height, double tilt) {
    const std::array<double, 2> now{height, tilt};
    for (std::size_t axis = 0; axis < now.size(); ++axis) {
      range.low[axis] = std::min(range.low[axis], now[axis]);
      range.high[axis] = std::max(range.high[axis], now[axis]);
    }
  }

  int periods_, quarter_;
  Range early_, late_;
};

/// Holds the body with the spring `kPressed` long until it is still, then releases it with `push` [m/s] and `turn`
/// [rad/s]. Growth beyond the linear range counts as infinite.
Swings release(const Press& press, const Floating& floating, double push, double turn) {
  SceneView scene = press.scene();
  scene.settings.stiffness = floating.stiffness;
  scene.settings.damping = floating.height.virtual_damping;
  scene.settings.coupling_rotation = floating.coupling_rotation;
  OwnedGodObject god_object;
  const Swings failed{HUGE_VAL, HUGE_VAL};
  if (god_object.start(scene, floating.solver, false) != Status::kOk) return failed;

  constexpr int kHeld = 400;
  const double middle = Press::kTouching - kPressed;
  const double most_torque = floating.stiffness * kPressed * floating.load_shift;
  FloatingPlant plant(floating);
  SwingWidths widths(floating.height.periods);
  double load = 0.0;
  CycleReport report;
  for (int k = -kHeld; k < floating.height.periods; ++k) {
    if (k < 0) {  // down within half of the time
      plant.height.x = std::max(middle, plant.height.x - (1e-3 + kPressed) / (0.5 * kHeld));
      plant.height.v = 0.0;
    }
    if (k == 0) {
      plant.height.v = push;
      plant.tilt.v = turn;
    }
    const Pose H_WM = plant.pose();
    if (god_object->update({H_WM, plant.velocity()}, report) != Status::kOk) return failed;
    Wrench wrench_W = report.force.total_W;
    wrench_W.force *= floating.fault.gain;
    wrench_W.torque *= floating.fault.gain;
    plant.send(wrench_W);
    if (k < 0) {
      load = wrench_W.force.z();
      continue;
    }
    const bool left_high = std::fabs(plant.height.x - middle) > 0.4 * kPressed;
    if (left_high || std::fabs(plant.tilt.x) > 0.02 || std::fabs(wrench_W.torque.y()) > most_torque) {
      return {left_high ? HUGE_VAL : -HUGE_VAL, left_high ? -HUGE_VAL : HUGE_VAL};
    }
    widths.note(k, plant.height.x, plant.tilt.x);
    plant.advance(load);
  }
  const double first_tilt = turn * std::sqrt(kBodyMass * (floating.gyration * floating.gyration) /
                                             (floating.stiffness * floating.coupling_rotation));
  return {widths.growth(0, push * std::sqrt(kBodyMass / floating.stiffness)), widths.growth(1, first_tilt)};
}

/// Returns a slab that is released on a plate.
Floating slab_on_plate(Solver solver, double delay, double damping, int periods) {
  Floating floating{.solver = solver};
  floating.height.delay = delay;
  floating.height.virtual_damping = damping;
  floating.height.periods = periods;
  floating.coupling_rotation = 1e-6;  // no rotation here
  return floating;
}

/// Z-width: the stiffest plate that a solver renders stably, for each virtual damping.
CaseResult z_width(Solver solver, double delay, const StabilityRequest& request, const std::filesystem::path& work) {
  const bool quick = request.quick;
  const char* name = format::kSolverNames[static_cast<std::size_t>(solver)];
  CaseResult result;
  Sheet sheet{
      .name = "stability_z_width", .columns = {"solver", "t_d_ms", "B_Ns_per_m", "K_exact", "K_measured"}, .rows = {}};
  std::vector<double> dampings =
      quick ? std::vector<double>{0, 20, 100, 200} : std::vector<double>{0, 5, 20, 50, 100, 200, 300, 400};
  if (request.one_place) dampings = {100};
  for (const double damping : dampings) {
    const int periods = quick ? 4000 : 8000;
    const double exact = stability_boundary(theory_of(slab_on_plate(solver, delay, damping, periods).height));
    if (!(exact > 0.0)) continue;
    const double measured = stiffest_stable_plate(solver, delay, damping, periods, work, request.fault);
    const std::string where =
        fmt::format("t_d {} ms B {}: {:.0f} of {:.0f} N/m", 1e3 * delay, damping, measured, exact);
    sheet.rows.push_back({name, cell(1e3 * delay), cell(damping), cell(exact), cell(measured)});
    result.findings.push_back(
        judged(stability_bound::z_width(solver), kPercent * std::max(0.0, 1.0 - measured / exact), where));
    // the other solvers dissipate energy, which stabilises
    const double off = kPercent * std::fabs(measured / exact - 1.0);
    if (solver == Solver::kContact) {
      result.findings.push_back(judged(stability_bound::kPlateExact, off, where));
    } else {
      result.findings.push_back(
          {.row = "Z-width",
           .what = fmt::format("{}: stiffest stable plate, distance from the exact boundary", name),
           .unit = "%",
           .value = off,
           .most = {},
           .where = where});
    }
  }
  result.sheets.push_back(sheet);
  return result;
}

/// Finds the largest k_VC,r for which the tilt of a device with radius of gyration g decays, at half of the height's
/// boundary. The damping b_D k_VC,r grows with it.
///
/// The theory's loop is linear: torque -k_D k_VC,r tilt - b_D k_VC,r rate. A plate can only push, and a torque moves
/// the centre of pressure by torque / load. While it stays within the supporting points, the loop is that of the
/// theory. Beyond them the torque is cut, and growth ends in a steady swing. So a run counts as grown as soon as it
/// comes near this limit, and it begins far below. A tripod's feet support it about the middle at every tilt. A slab
/// may rest on any three points of its face, and the centre of pressure may lie at their rim. Then `contact`, which
/// projects the damping on forces that these points can exert, cuts it until the next cycle finds other points.
CaseResult gyration(const StabilityRequest& request, const std::filesystem::path& work) {
  const bool quick = request.quick;
  constexpr double kMostShift = 4e-3;   // half the distance to the line between two feet [m]
  constexpr double kFirstShift = 2e-4;  // of the centre of pressure, by the spring of the first swing [m]
  CaseResult result;
  Sheet sheet{.name = "stability_gyration",
              .columns = {"gyration_mm", "B_Ns_per_m", "k_VC_r_exact", "k_VC_r_measured", "k_VC_r_slab"},
              .rows = {}};
  std::vector<double> radii =
      quick ? std::vector<double>{0.01, 0.04} : std::vector<double>{0.005, 0.01, 0.02, 0.04, 0.08, 0.16};
  if (request.one_place) radii = {0.01};
  for (const double damping : request.one_place ? std::vector<double>{0.0} : std::vector<double>{0.0, 20.0}) {
    for (const double radius : radii) {
      Floating floating{.gyration = radius, .load_shift = kMostShift, .fault = request.fault};
      floating.height.virtual_damping = damping;
      floating.height.periods = quick ? 3000 : 8000;
      floating.stiffness = 0.5 * stability_boundary(theory_of(floating.height));
      ArmLoop loop;
      loop.joint_count = 1;
      loop.mass(0, 0) = kBodyMass * radius * radius;
      loop.damping[0] = kDeviceDamping * radius * radius;
      loop.jacobian(0, 0) = 1.0;
      loop.timing = {kPeriod, floating.height.delay, 2};
      const double exact = boundary(1e-3 * radius * radius, [&](double coupling) {
        loop.stiffness = floating.stiffness * coupling;
        loop.tool_damping = damping * coupling;
        return spectral_radius(loop) < 1.0;
      });
      const auto measured_of = [&](const Press& press) {
        const auto stable = [&](double coupling) {
          floating.coupling_rotation = coupling;
          const double rate = std::sqrt(floating.stiffness * coupling / (kBodyMass * radius * radius));
          const double swing = std::min(1e-3, kPressed * kFirstShift / coupling);
          return release(press, floating, 0.0, swing * rate).tilt < 0.0;
        };
        return boundary(0.25 * exact, stable, kResolution);
      };
      const auto finding = [&](double measured) {
        return judged(stability_bound::kTilt, kPercent * std::fabs(measured / exact - 1.0),
                      fmt::format("g {} mm B {}: {:.3g} of {:.3g} m^2", 1e3 * radius, damping, measured, exact));
      };
      const double measured = measured_of(Press::tripod(work));
      result.findings.push_back(finding(measured));
      const double of_slab = damping > 0.0 && (!quick || radius < 0.02) ? measured_of(Press::slab(work)) : 0.0;
      if (of_slab > 0.0) {
        Finding shown = finding(of_slab);
        shown.what = "the same for a slab, supported by few points of its face";
        shown.most.reset();
        result.findings.push_back(shown);
      }
      sheet.rows.push_back(
          {cell(1e3 * radius), cell(damping), cell(exact), cell(measured), of_slab > 0.0 ? cell(of_slab) : ""});
    }
  }
  result.sheets.push_back(sheet);
  return result;
}

/// Random motion of a hand over the plate in four axes: up to 20 mm and 0.2 rad.
class HandOverPlate {
 public:
  explicit HandOverPlate(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> phase(0.0, 2.0 * M_PI);
    std::uniform_real_distribution<double> rate(1.0, 60.0);
    for (int i = 0; i < 4; ++i) {
      phases_[i] = phase(random);
      rates_[i] = rate(random);
    }
  }

  Pose pose(double t) const {
    const double share = std::min(1.0, t);
    Pose H_WM;
    H_WM.translation = {0.02 * std::sin(rates_[0] * t), 0.02 * std::sin(rates_[1] * t),
                        0.012 + share * 0.01 * std::sin(rates_[2] * t + phases_[2])};
    H_WM.rotation = exp_rotation(share * 0.2 * Vector3(std::sin(rates_[3] * t), std::sin(rates_[1] * t), 0.0));
    return H_WM;
  }

 private:
  double phases_[4] = {};
  double rates_[4] = {};
};

/// Returns the energy of the coupling between the god object S and the device D [J].
double stored_energy(const Pose& H_WS, const Pose& H_WD, const Parameters& q) {
  const Motion x = get_motion(H_WS.inverse() * H_WD);
  return 0.5 * q.stiffness *
         (q.coupling_translation * x.translation.squaredNorm() + q.coupling_rotation * x.rotation.squaredNorm());
}

/// A run of the energy's account.
struct EnergyAccount {
  double missing = 0.0;  ///< largest energy in the coupling that the hand had not supplied [J]; NaN: a cycle failed
  double most = 0.0;     ///< largest energy in the coupling [J]
};

EnergyAccount account(const SceneView& scene, Solver solver, unsigned seed, const LoopFault& fault) {
  constexpr int kCycles = 5000;
  const HandOverPlate hand(seed);
  OwnedGodObject god_object;
  if (god_object.start(scene, solver, false) != Status::kOk) return {.missing = std::nan("")};
  std::vector<Wrench> late(static_cast<std::size_t>(fault.late) + 1);
  CycleReport report;
  Pose before = hand.pose(0.0) * scene.H_MB;
  EnergyAccount all;
  double supplied = 0.0;
  for (int k = 0; k < kCycles; ++k) {
    const Pose H_WM = hand.pose(kPeriod * k);
    if (god_object->update({H_WM, {}}, report) != Status::kOk) return {.missing = std::nan("")};
    const Pose H_WD = H_WM * scene.H_MB;
    late[static_cast<std::size_t>(k) % late.size()] = report.force.spring_W;
    const Wrench& force = late[static_cast<std::size_t>(k + 1) % late.size()];
    const Vector3 turned = H_WD.rotation._transformVector(log_rotation(before.rotation.conjugate() * H_WD.rotation));
    supplied -= fault.gain * (force.force.dot(H_WD.translation - before.translation) + force.torque.dot(turned));
    before = H_WD;
    const double stored = stored_energy(report.H_WS, H_WD, god_object.parameters());
    all.most = std::max(all.most, stored);
    all.missing = std::max(all.missing, stored - supplied);
  }
  return all;
}

/// A11 through the pipeline, for random motions of the hand in all six axes together: the coupling, whose energy
/// follows from the poses, never contains more than the hand has supplied against the force.
CaseResult pipeline_observer(const StabilityRequest& request, const std::filesystem::path& work) {
  const SceneView& scene = Press::slab(work).scene();
  CaseResult result;
  for (std::uint32_t s = 0; s < format::kSolverCount; ++s) {
    const auto solver = static_cast<Solver>(s);
    if (request.one_place && solver != Solver::kContact) continue;
    double worst = 0.0;
    for (unsigned seed = 1; seed <= (request.quick ? 3u : 20u); ++seed) {
      const EnergyAccount run = account(scene, solver, seed + 100 * request.seed, request.fault);
      const double share = kPercent * run.missing / run.most;
      worst = std::isnan(share) ? share : std::max(worst, share);
      if (std::isnan(share)) break;
    }
    Finding finding = judged(stability_bound::kPlate, worst);
    if (solver != Solver::kContact) {
      finding.what = fmt::format("{} over a plate: the same", format::kSolverNames[s]);
      finding.most.reset();
    }
    result.findings.push_back(finding);
  }
  return result;
}

}  // namespace

double stiffest_stable_plate(Solver solver, double delay, double damping, int periods,
                             const std::filesystem::path& work, const LoopFault& fault) {
  const Press& press = Press::slab(work);
  Floating floating = slab_on_plate(solver, delay, damping, periods);
  floating.fault = fault;
  const double exact = stability_boundary(theory_of(floating.height));
  return boundary(
      0.25 * exact,
      [&](double stiffness) {
        floating.stiffness = stiffness;
        const double rate = std::sqrt(stiffness / kBodyMass);
        return release(press, floating, 0.01 * kPressed * rate, 0.0).height < 0.0;
      },
      kResolution);
}

std::vector<StudyCase> pipeline_cases(const StabilityRequest& request) {
  const std::string inputs = inputs_of(request);
  std::vector<StudyCase> cases;
  for (std::uint32_t s = 0; s < format::kSolverCount; ++s) {
    for (const double delay : request.quick ? std::vector<double>{1e-3} : std::vector<double>{0.5e-3, 1e-3, 2e-3}) {
      cases.push_back({.name = fmt::format("stability.z-width-{}-{}ms", format::kSolverNames[s], 1e3 * delay),
                       .inputs = inputs,
                       .run = [=](const auto& work) { return z_width(static_cast<Solver>(s), delay, request, work); }});
    }
  }
  cases.push_back({.name = "stability.gyration", .inputs = inputs, .run = [request](const auto& work) {
                     return gyration(request, work);
                   }});
  cases.push_back({.name = "stability.pipeline-observer", .inputs = inputs, .run = [request](const auto& work) {
                     return pipeline_observer(request, work);
                   }});
  return cases;
}

}  // namespace godobject::report
