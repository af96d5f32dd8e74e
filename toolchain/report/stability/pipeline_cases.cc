#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "core/device/stability.h"
#include "core/pipeline/god_object.h"
#include "toolchain/report/contact_quality/compiled_scene.h"
#include "toolchain/report/contact_quality/meshes.h"
#include "toolchain/report/stability/axis_loop.h"
#include "toolchain/report/stability/axis_theory.h"
#include "toolchain/report/stability/cases.h"

namespace godobject::report {
namespace {

constexpr double kPeriod = 1e-3;
constexpr double kMass = 1.0;
constexpr double kDeviceDamping = 2.0;
constexpr double kPressed = 2e-3;  ///< m of the spring
constexpr double kPercent = 100.0;
constexpr std::uint32_t kPoints = 160;  ///< of a body
constexpr double kGone = 1e-3;          ///< of the first swing: what is left has died out
constexpr double kGrown = 6.0;  ///< of the first swing, there and back: it has grown, even where it no longer does
constexpr double kResolution = 1e-3;  ///< of a boundary; what is required is twenty times as much

/// A body over a plate of 64 x 64 x 16 mm, its top at z = 0: flat on flat, so nothing turns unless it is turned, and
/// the stored distance is exact. Both are compiled once in a process, by whoever comes first, in its folder.
class Press {
 public:
  /// 40 x 40 x 10 mm: of its lower face any few points may hold it.
  static const Press& slab(const std::filesystem::path& work) {
    static const Press press("slab", box_mesh({-0.02, -0.02, -0.005}, {0.02, 0.02, 0.005}), work);
    return press;
  }
  /// The same on three feet of 4 x 4 mm: all of them hold it.
  static const Press& tripod(const std::filesystem::path& work) {
    static const Press press(
        "tripod",
        cell_solid({{{-0.02, -0.016, -0.002, 0.002, 0.016, 0.02}, {-0.02, -0.016, 0.016, 0.02}, {-0.005, 0.0, 0.005}}},
                   [](int i, int j, int k) { return k == 1 || (j == 0 && (i == 0 || i == 4)) || (j == 2 && i == 2); }),
        work);
    return press;
  }

  static constexpr double kTouching = 0.005;  ///< height of the body's middle [m]
  const Scene& scene() const { return image_.scene; }

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

/// A floating body that is pushed down by a constant force: height and tilt about y move, each by the closed form.
struct Floating {
  AxisSetup height{.mass = kMass, .damping = kDeviceDamping};
  double gyration = 0.02;  ///< of the device: inertia m g^2, damping b g^2 [m]
  double stiffness = 2000.0;
  double coupling_rotation = 0.0;  ///< k_VC,r [m^2]
  Solver solver = Solver::kContact;
  double load_shift = HUGE_VAL;  ///< of the middle of the pushes, up to which all is linear [m]
};

struct Swings {
  double height = 0.0;  ///< logarithm of what became of the swing from the second quarter to the last
  double tilt = 0.0;
};

/// Held where the spring is `kPressed` long until all is still, then let go with `push` [m/s] and `turn` [rad/s]. Grown
/// beyond the linear range counts as infinite.
Swings let_go(const Press& press, const Floating& floating, double push, double turn) {
  Scene scene = press.scene();
  scene.settings.stiffness = floating.stiffness;
  scene.settings.damping = floating.height.virtual_damping;
  scene.settings.coupling_rotation = floating.coupling_rotation;
  std::vector<std::uint32_t> memory(GodObject::memory(scene));
  const auto god_object = std::make_unique<GodObject>();
  Swings swings{HUGE_VAL, HUGE_VAL};
  if (god_object->start(scene, floating.solver, false, memory) != Status::kOk) return swings;

  const double g2 = floating.gyration * floating.gyration;
  const double delay = floating.height.delay / kPeriod;
  DelayedHold forces(delay);
  DelayedHold torques(delay);
  const double split = forces.share_before() * kPeriod;
  const FreeAxis height_first(kMass, kDeviceDamping, split);
  const FreeAxis height_second(kMass, kDeviceDamping, kPeriod - split);
  const FreeAxis tilt_first(kMass * g2, kDeviceDamping * g2, split);
  const FreeAxis tilt_second(kMass * g2, kDeviceDamping * g2, kPeriod - split);

  constexpr int kHeld = 400;
  const double middle = Press::kTouching - kPressed;
  FreeAxis::State height{.x = Press::kTouching + 1e-3};
  FreeAxis::State tilt;
  FreeAxis::State height_before = height;
  FreeAxis::State tilt_before;
  double carried = 0.0;  // what the hand presses with, down
  double low[2][2] = {{HUGE_VAL, HUGE_VAL}, {HUGE_VAL, HUGE_VAL}};
  double high[2][2] = {{-HUGE_VAL, -HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
  const int quarter = floating.height.periods / 4;
  CycleReport report;
  for (int k = -kHeld; k < floating.height.periods; ++k) {
    if (k < 0) {  // down within half of the time
      height.x = std::max(middle, height.x - (1e-3 + kPressed) / (0.5 * kHeld));
      height.v = 0.0;
    }
    if (k == 0) {
      height.v = push;
      tilt.v = turn;
    }
    Pose H_WM;
    H_WM.rotation = exp_rotation({0.0, tilt.x, 0.0});
    H_WM.translation.z() = height.x;
    Motion velocity;
    velocity.translation.z() = (height.x - height_before.x) / kPeriod;
    velocity.rotation.y() = (tilt.x - tilt_before.x) / kPeriod;
    height_before = height;
    tilt_before = tilt;
    if (god_object->update({H_WM, velocity}, report) != Status::kOk) return swings;
    forces.send(report.force.total_W.force.z());
    torques.send(report.force.total_W.torque.y());
    if (k < 0) {
      carried = report.force.total_W.force.z();
      continue;
    }
    const bool left_high = std::fabs(height.x - middle) > 0.4 * kPressed;
    const double most_torque = floating.stiffness * kPressed * floating.load_shift;
    if (left_high || std::fabs(tilt.x) > 0.02 || std::fabs(report.force.total_W.torque.y()) > most_torque) {
      return {left_high ? HUGE_VAL : -HUGE_VAL, left_high ? -HUGE_VAL : HUGE_VAL};
    }
    const int stretch = k >= floating.height.periods - quarter ? 1 : k >= quarter && k < 2 * quarter ? 0 : -1;
    if (stretch >= 0) {
      const double now[2] = {height.x, tilt.x};
      for (int axis = 0; axis < 2; ++axis) {
        low[stretch][axis] = std::min(low[stretch][axis], now[axis]);
        high[stretch][axis] = std::max(high[stretch][axis], now[axis]);
      }
    }
    height_first.advance(forces.before() - carried, height);
    height_second.advance(forces.after() - carried, height);
    tilt_first.advance(torques.before(), tilt);
    tilt_second.advance(torques.after(), tilt);
  }
  const auto growth_of = [&](int axis, double first) {
    const double late = high[1][axis] - low[1][axis];
    if (late > kGrown * first) return HUGE_VAL;
    return late < kGone * first ? -HUGE_VAL : std::log(late / (high[0][axis] - low[0][axis]));
  };
  swings.height = growth_of(0, push * std::sqrt(kMass / floating.stiffness));
  swings.tilt = growth_of(1, turn * std::sqrt(kMass * g2 / (floating.stiffness * floating.coupling_rotation)));
  return swings;
}

/// A slab that is let go on a plate.
Floating slab_on_plate(Solver solver, double delay, double damping, int periods) {
  Floating floating{.solver = solver};
  floating.height.delay = delay;
  floating.height.virtual_damping = damping;
  floating.height.periods = periods;
  floating.coupling_rotation = 1e-6;  // nothing turns here
  return floating;
}

/// Z-width: the stiffest plate that a solver renders stably, for each virtual damping.
CaseResult z_width(Solver solver, double delay, bool quick, const std::filesystem::path& work) {
  const char* name = format::kSolverNames[static_cast<std::size_t>(solver)];
  CaseResult result;
  Sheet sheet{
      .name = "stability_z_width", .columns = {"solver", "t_d_ms", "B_Ns_per_m", "K_exact", "K_measured"}, .rows = {}};
  const std::vector<double> dampings =
      quick ? std::vector<double>{0, 20, 100, 200} : std::vector<double>{0, 5, 20, 50, 100, 200, 300, 400};
  for (const double damping : dampings) {
    const int periods = quick ? 4000 : 8000;
    const double exact = stability_boundary(theory_of(slab_on_plate(solver, delay, damping, periods).height));
    if (!(exact > 0.0)) continue;
    const double measured = stiffest_stable_plate(solver, delay, damping, periods, work);
    const std::string where =
        fmt::format("t_d {} ms B {}: {:.0f} of {:.0f} N/m", 1e3 * delay, damping, measured, exact);
    sheet.rows.push_back({name, cell(1e3 * delay), cell(damping), cell(exact), cell(measured)});
    result.findings.push_back({.row = "Z-width",
                               .what = fmt::format("{}: stiffest stable plate below the exact boundary", name),
                               .unit = "%",
                               .value = kPercent * std::max(0.0, 1.0 - measured / exact),
                               .most = 2.0,
                               .where = where});
    // the others have losses of their own, which help
    result.findings.push_back({.row = "Z-width",
                               .what = fmt::format("{}: the same off the exact boundary, either way", name),
                               .unit = "%",
                               .value = kPercent * std::fabs(measured / exact - 1.0),
                               .most = solver == Solver::kContact ? std::optional<double>{2.0} : std::nullopt,
                               .where = where});
  }
  result.sheets.push_back(sheet);
  return result;
}

/// k_VC,r up to which the tilt of a device with radius of gyration g decays, at half of the height's boundary. Its
/// damping grows with it, b_D k_VC,r.
///
/// The theory's loop is linear: torque -k_D k_VC,r tilt - b_D k_VC,r rate. A plate can only push, and a torque moves
/// the middle of its pushes by torque / load. While that stays within the points that hold the body the loop is the
/// theory's. Beyond them the torque is cut, and a loop that grows ends in a swing that does not: so a run counts as
/// grown once it comes near, and begins far from there. A tripod's feet hold it about the middle whatever the tilt. Of
/// a slab's face any three points may, and the middle of the pushes may lie at their rim: then `contact`, which
/// projects the damping on what these can push, cuts it until the next cycle has found others.
CaseResult gyration(bool quick, const std::filesystem::path& work) {
  constexpr double kMostShift = 4e-3;   // half of the way to where two of the feet hold all [m]
  constexpr double kFirstShift = 2e-4;  // of the first swing's spring [m]
  CaseResult result;
  Sheet sheet{.name = "stability_gyration",
              .columns = {"gyration_mm", "B_Ns_per_m", "k_VC_r_exact", "k_VC_r_measured", "k_VC_r_slab"},
              .rows = {}};
  const std::vector<double> radii =
      quick ? std::vector<double>{0.01, 0.04} : std::vector<double>{0.005, 0.01, 0.02, 0.04, 0.08, 0.16};
  for (const double damping : {0.0, 20.0}) {
    for (const double radius : radii) {
      Floating floating{.gyration = radius, .load_shift = kMostShift};
      floating.height.virtual_damping = damping;
      floating.height.periods = quick ? 3000 : 8000;
      floating.stiffness = 0.5 * stability_boundary(theory_of(floating.height));
      ArmLoop loop;
      loop.joint_count = 1;
      loop.mass(0, 0) = kMass * radius * radius;
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
          const double rate = std::sqrt(floating.stiffness * coupling / (kMass * radius * radius));
          const double swing = std::min(1e-3, kPressed * kFirstShift / coupling);
          return let_go(press, floating, 0.0, swing * rate).tilt < 0.0;
        };
        return boundary(0.25 * exact, stable, kResolution);
      };
      const auto note = [&](const char* what, double measured, std::optional<double> most) {
        result.findings.push_back(
            {.row = "k_VC,r",
             .what = what,
             .unit = "%",
             .value = kPercent * std::fabs(measured / exact - 1.0),
             .most = most,
             .where = fmt::format("g {} mm B {}: {:.3g} of {:.3g} m^2", 1e3 * radius, damping, measured, exact)});
      };
      const double measured = measured_of(Press::tripod(work));
      note("largest stable k_VC,r against the exact one, by the radius of gyration", measured, 2.0);
      const double of_slab = damping > 0.0 && (!quick || radius < 0.02) ? measured_of(Press::slab(work)) : 0.0;
      if (of_slab > 0.0) note("the same of a slab, whose face is held by few of its points", of_slab, std::nullopt);
      sheet.rows.push_back(
          {cell(1e3 * radius), cell(damping), cell(exact), cell(measured), of_slab > 0.0 ? cell(of_slab) : ""});
    }
  }
  result.sheets.push_back(sheet);
  return result;
}

/// A11 through the pipeline: what the spring's law gives away where the hand moves as it likes, all six axes together.
CaseResult pipeline_observer(bool quick, const std::filesystem::path& work) {
  constexpr double kQuantum = 5e-6;  // of an encoder, at the hand
  const Press& press = Press::slab(work);
  CaseResult result;
  for (std::uint32_t s = 0; s < format::kSolverCount; ++s) {
    const auto solver = static_cast<Solver>(s);
    double lowest = 0.0;
    const Scene& scene = press.scene();
    for (unsigned seed = 1; seed <= (quick ? 3u : 20u); ++seed) {
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> phase(0.0, 2.0 * M_PI);
      std::uniform_real_distribution<double> rate(1.0, 60.0);
      double phases[4];
      double rates[4];
      for (int i = 0; i < 4; ++i) {
        phases[i] = phase(random);
        rates[i] = rate(random);
      }
      std::vector<std::uint32_t> memory(GodObject::memory(scene));
      const auto god_object = std::make_unique<GodObject>();
      if (god_object->start(scene, solver, false, memory) != Status::kOk) continue;
      CycleReport report;
      Pose before;
      double energy = 0.0;
      for (int k = 0; k < 5000; ++k) {
        const double t = kPeriod * k;
        const double share = std::min(1.0, t);
        Pose H_WM;
        H_WM.translation = {0.02 * std::sin(rates[0] * t), 0.02 * std::sin(rates[1] * t),
                            0.012 + share * 0.01 * std::sin(rates[2] * t + phases[2])};
        H_WM.rotation = exp_rotation(share * 0.2 * Vector3(std::sin(rates[3] * t), std::sin(rates[1] * t), 0.0));
        if (god_object->update({H_WM, {}}, report) != Status::kOk) {
          lowest = std::nan("");
          break;
        }
        if (k > 0) {
          const Vector3 turned =
              H_WM.rotation._transformVector(log_rotation(before.rotation.conjugate() * H_WM.rotation));
          energy -= report.force.spring_W.force.dot(H_WM.translation - before.translation) +
                    report.force.spring_W.torque.dot(turned);
        }
        before = H_WM;
        lowest = std::min(lowest, energy);
      }
    }
    const double allowed = 0.5 * scene.settings.stiffness * kQuantum * kQuantum;
    result.findings.push_back(
        {.row = "A11",
         .what = fmt::format("{} over a plate: energy given away, of K h^2 / 2", format::kSolverNames[s]),
         .unit = "",
         .value = std::max(0.0, -lowest) / allowed,
         .most = solver == Solver::kContact ? std::optional<double>{1.0} : std::nullopt});
  }
  return result;
}

}  // namespace

double stiffest_stable_plate(Solver solver, double delay, double damping, int periods,
                             const std::filesystem::path& work) {
  const Press& press = Press::slab(work);
  Floating floating = slab_on_plate(solver, delay, damping, periods);
  const double exact = stability_boundary(theory_of(floating.height));
  return boundary(
      0.25 * exact,
      [&](double stiffness) {
        floating.stiffness = stiffness;
        const double rate = std::sqrt(stiffness / kMass);
        return let_go(press, floating, 0.01 * kPressed * rate, 0.0).height < 0.0;
      },
      kResolution);
}

std::vector<StudyCase> pipeline_cases(bool quick) {
  const std::string inputs = fmt::format("quick {}", quick);
  std::vector<StudyCase> cases;
  for (std::uint32_t s = 0; s < format::kSolverCount; ++s) {
    for (const double delay : quick ? std::vector<double>{1e-3} : std::vector<double>{0.5e-3, 1e-3, 2e-3}) {
      cases.push_back({.name = fmt::format("stability.z-width-{}-{}ms", format::kSolverNames[s], 1e3 * delay),
                       .inputs = inputs,
                       .run = [=](const auto& work) { return z_width(static_cast<Solver>(s), delay, quick, work); }});
    }
  }
  cases.push_back({.name = "stability.gyration", .inputs = inputs, .run = [quick](const auto& work) {
                     return gyration(quick, work);
                   }});
  cases.push_back({.name = "stability.pipeline-observer", .inputs = inputs, .run = [quick](const auto& work) {
                     return pipeline_observer(quick, work);
                   }});
  return cases;
}

}  // namespace godobject::report
