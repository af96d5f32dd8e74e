// A case file repeats a run, and each row's setups are of that row.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "toolchain/report/extremes/run.h"
#include "toolchain/report/extremes/seeker.h"
#include "toolchain/report/extremes/setup.h"

namespace godobject::report {
namespace {

TEST(CaseFile, BringsARunBack) {
  std::mt19937 random(5);
  for (int i = 0; i < 50; ++i) {
    report::Setup setup = any_setup(random);
    if (setup.world == "compiled") setup.world = "heap";
    setup.cycles = 40;
    setup.motion = "press";
    const std::string text = case_file(setup, "nothing");
    const report::Setup read = read_case(text);
    EXPECT_EQ(case_file(read, "nothing"), text);
    const auto rig = make_rig(setup, {});
    const auto again = make_rig(read, {});
    CycleReport report;
    CycleReport repeated;
    for (const Pose& H_WD : device_path(setup)) {
      ASSERT_EQ(rig->update(H_WD, {}, report), again->update(H_WD, {}, repeated));
      ASSERT_EQ(report.H_WS.translation, repeated.H_WS.translation);
    }
  }
}

/// Returns the case file with another number of the generator.
std::string of_generator(int generator, std::string text) {
  const std::string before = fmt::format("\"generator\": {}", kGenerator);
  return text.replace(text.find(before), before.size(), fmt::format("\"generator\": {}", generator));
}

TEST(CaseFile, OfAnotherGeneratorIsRefused) {
  const std::string text = case_file({}, "");
  EXPECT_NO_THROW(static_cast<void>(read_case(text)));
  EXPECT_THROW(static_cast<void>(read_case("{}")), std::exception);
  EXPECT_THROW(static_cast<void>(read_case("no JSON")), std::exception);
  EXPECT_THROW(static_cast<void>(read_case(of_generator(kGenerator + 1, text))), std::exception);
}

/// Each family of setups has the property of its row.
TEST(SetupOf, EachRowIsOfThatRow) {
  std::mt19937 random(6);
  double widest = 0.0;
  double narrowest = 1e9;
  for (int i = 0; i < 300; ++i) {
    for (std::size_t r = 0; r < kRowCount; ++r) {
      const report::Setup setup = setup_of(kRows[r], random);
      EXPECT_EQ(setup.row, kRows[r]);
      if (r == 0) widest = std::max(widest, setup.scale);
      if (r == 0) narrowest = std::min(narrowest, setup.scale);
      if (r == 5) {
        EXPECT_GE(setup.points, 1000);
      }
      if (r == 6) {
        EXPECT_GT(setup.aside, 0.0);
        EXPECT_LE(setup.start, 0.0);
      }
      if (setup.motion == "seek") continue;
      for (const Pose& H_WD : device_path(setup)) ASSERT_TRUE(H_WD.is_finite());
    }
  }
  EXPECT_GT(widest, 500.0);
  EXPECT_LT(narrowest, 2e-3);
}

/// Most sessions of the row that starts inside tight parts do so: the first cycle reports it.
TEST(SetupOf, TightStartsAreInside) {
  constexpr int kSessions = 200;
  std::mt19937 random(8);
  int inside = 0;
  for (int i = 0; i < kSessions; ++i) {
    const report::Setup setup = setup_of("starts inside tight parts", random);
    const auto rig = make_rig(setup, {});
    CycleReport report;
    ASSERT_EQ(rig->update(Seeker(setup).next({}, {}), {}, report), Status::kOk);
    inside += report.outcome == Outcome::kStartInside ? 1 : 0;
  }
  EXPECT_GT(inside, kSessions / 2);
}

/// Files of older generators still run, and lack what these did not have.
TEST(CaseFile, OfOlderGeneratorsIsRead) {
  const std::string text = case_file({}, "");
  const auto until = [&](const char* key) {
    return text.substr(0, text.find(fmt::format(",\n \"{}\"", key))) + "\n}\n";
  };
  const report::Setup first = read_case(of_generator(1, until("friction_viscous")));
  EXPECT_EQ(first.period, 1e-3);
  EXPECT_EQ(first.workspace, 0.0);
  EXPECT_FALSE(first.returns);
  const report::Setup second = read_case(of_generator(2, until("returns")));
  EXPECT_TRUE(second.remembers);
  EXPECT_FALSE(second.returns);
  EXPECT_TRUE(read_case(text).returns);
}

/// The generator has no blind spot: a thousand setups have each option, and most runs stay in contact.
TEST(AnySetup, HasEveryOptionAndStaysInContact) {
  struct Option {
    const char* name;
    bool (*has)(const report::Setup& setup);
    int count = 0;
  };
  std::vector<Option> options = {
      {"viscous friction", [](const report::Setup& s) { return s.friction_viscous > 0.0; }},
      {"friction", [](const report::Setup& s) { return s.friction; }},
      {"no friction", [](const report::Setup& s) { return !s.friction; }},
      {"bodies of different scale", [](const report::Setup& s) { return s.body_scale != 1.0; }},
      {"boxes", [](const report::Setup& s) { return s.workspace > 0.0; }},
      {"periods other than 1 ms", [](const report::Setup& s) { return s.period != 1e-3; }},
      {"budgets of points", [](const report::Setup& s) { return s.point_budget > 0; }},
      {"budgets of work", [](const report::Setup& s) { return s.work_budget > 0.0; }},
      {"no memory", [](const report::Setup& s) { return !s.remembers; }},
      {"concave bodies", [](const report::Setup& s) { return s.body == "ell"; }},
      {"invalid inputs", [](const report::Setup& s) { return s.bad_every > 0; }},
      {"starts inside", [](const report::Setup& s) { return s.start < 0.0; }},
      {"places far away", [](const report::Setup& s) { return s.far > 0.0; }},
      {"large and small scenes", [](const report::Setup& s) { return s.scale < 0.01 || s.scale > 0.1; }},
      {"tight clearances", [](const report::Setup& s) { return s.width < 1.1 && s.width > 1.0; }},
      {"no damping", [](const report::Setup& s) { return s.damping == 0.0; }},
      {"other solvers", [](const report::Setup& s) { return s.solver != Solver::kContact; }},
  };
  std::mt19937 random(7);
  std::int64_t cycles = 0, touching = 0;
  for (int i = 0; i < 1000; ++i) {
    report::Setup setup = any_setup(random);
    for (Option& option : options) option.count += option.has(setup) ? 1 : 0;
    if (i % 10 != 0 || setup.solver != Solver::kContact) continue;
    if (setup.world == "compiled") setup.world = "heap";
    const watch::Findings found = run_setup(setup, *make_rig(setup, {}));
    EXPECT_EQ(found.violations(), 0) << case_file(setup, found.first());
    cycles += found.cycles;
    touching += found.touching;
  }
  for (const Option& option : options) EXPECT_GT(option.count, 50) << option.name;
  EXPECT_GT(static_cast<double>(touching), 0.8 * static_cast<double>(cycles));
  std::printf("[ measured ] %.1f %% of %lld cycles touch\n",
              100.0 * static_cast<double>(touching) / static_cast<double>(cycles), static_cast<long long>(cycles));
}

}  // namespace
}  // namespace godobject::report
