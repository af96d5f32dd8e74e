// Runs godobject-replay as its users do and checks its files and exit codes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <sys/wait.h>

#include "tests/support/analytic_shapes.h"
#include "tests/support/folder_test.h"
#include "tests/support/scene_image_builder.h"

namespace godobject::test {
namespace {

class ReplayTest : public test::FolderTest {
 protected:
  void SetUp() override { write_scene(true); }

  void write_scene(bool friction) const {
    SceneDescription d;
    d.distance = [](const Vector3& p) { return ball_distance(p, 0.06); };
    d.surface_min = Vector3::Constant(-0.06);
    d.surface_max = Vector3::Constant(0.06);
    const SurfaceSamples samples = sample_ball(0.02, 500);
    d.points = samples.points;
    d.normals = samples.normals;
    d.settings.friction = friction ? 1 : 0;
    d.settings.friction_static = 0.2;
    d.settings.friction_kinetic = 0.18;
    d.settings.solvers = (1u << format::kSolverCount) - 1u;
    d.settings.default_solver = static_cast<std::uint32_t>(format::Solver::kContact);
    const SceneImage image = build_scene_image(d);
    std::ofstream(folder_ / "balls.scene", std::ios::binary)
        .write(reinterpret_cast<const char*>(image.bytes().data()), static_cast<std::streamsize>(image.bytes().size()));
  }

  /// From 10 mm above contact to 10 mm below, and back; `spoil` replaces the row of that index.
  void write_path(int rows = 300, int spoiled = -1, const std::string& spoil = "") const {
    std::ofstream out(folder_ / "path.csv");
    out << "t,px,py,pz,qw,qx,qy,qz\n";
    for (int k = 0; k < rows; ++k) {
      if (k == spoiled) {
        out << spoil << "\n";
        continue;
      }
      out << fmt::format("{},{},0,{},1,0,0,0\n", 1e-3 * k, 1e-5 * k, 0.090 - 0.020 * std::sin(M_PI * k / rows));
    }
  }

  /// Returns the exit code. `output` gets stdout and stderr.
  int run(const std::string& arguments, const std::string& out = "out.csv") {
    const std::string command = fmt::format("cd {} && {} balls.scene path.csv -o {} {} > log.txt 2>&1",
                                            folder_.string(), GODOBJECT_REPLAY, out, arguments);
    const int status = std::system(command.c_str());
    std::ostringstream text;
    text << std::ifstream(folder_ / "log.txt").rdbuf();
    output_ = text.str();
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::vector<std::vector<std::string>> rows(const std::string& name = "out.csv") const {
    std::vector<std::vector<std::string>> table;
    std::ifstream in(folder_ / name);
    for (std::string line; std::getline(in, line);) {
      table.emplace_back();
      std::istringstream fields(line);
      for (std::string field; std::getline(fields, field, ',');) table.back().push_back(field);
    }
    return table;
  }

  std::string output_;
};

constexpr const char* kSolvers[] = {"paper", "corrected", "contact"};
constexpr std::size_t kDepth = 21, kContacts = 22, kSubsteps = 23, kStep1 = 24, kSolve = 25, kStatus = 26, kGodZ = 10,
                      kForceZ = 17;

TEST_F(ReplayTest, WritesOneRowACycleWithTheColumnsOfTheContract) {
  write_path();
  ASSERT_EQ(run("--solver corrected --friction off"), 0) << output_;
  const auto table = rows();
  ASSERT_EQ(table.size(), 301u);
  std::string header;
  for (const std::string& name : table[0]) header += name + ",";
  EXPECT_EQ(header,
            "t,dpx,dpy,dpz,dqw,dqx,dqy,dqz,gpx,gpy,gpz,gqw,gqx,gqy,gqz,fx,fy,fz,tx,ty,tz,point_depth,contacts,substeps,"
            "step1_ns,"
            "solve_ns,status,");
  EXPECT_EQ(table[1][kStatus], "free");
  EXPECT_EQ(table[151][kStatus], "contact");
  EXPECT_GT(std::stod(table[151][kForceZ]), 2000.0 * 0.009);
  EXPECT_GT(std::stod(table[151][kGodZ]), 0.079);
  EXPECT_LT(std::stod(table[151][kDepth]), 0.1 * 0.005);
  EXPECT_GT(std::stol(table[151][kStep1]), 0);
  EXPECT_NE(output_.find("floating-point exceptions: none"), std::string::npos);
}

TEST_F(ReplayTest, KeepsAGapWithTheSolverContactWhichIsTheScenesDefault) {
  write_path();
  ASSERT_EQ(run("--friction off"), 0) << output_;
  const auto table = rows();
  ASSERT_EQ(table.size(), 301u);
  double gap = 1.0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    ASSERT_LT(std::stod(table[i][kDepth]), 0.0) << "row " << i;
    gap = std::min(gap, -std::stod(table[i][kDepth]));
    ASSERT_TRUE(table[i][kStatus] == "contact" || table[i][kStatus] == "free") << table[i][kStatus];
  }
  EXPECT_NE(output_.find(fmt::format("no sample point inside, the nearest {:.4f} mm from the surface", 1e3 * gap)),
            std::string::npos)
      << output_;
  EXPECT_EQ(table[1][kStatus], "free");
  EXPECT_EQ(table[300][kStatus], "free");
  EXPECT_EQ(table[151][kStatus], "contact");
  EXPECT_EQ(table[151][kSubsteps], "1");
  EXPECT_GE(std::stoi(table[151][kContacts]), 1);
  EXPECT_LE(std::stoi(table[151][kContacts]), 3);
  EXPECT_NEAR(std::stod(table[151][kForceZ]), 2000.0 * 0.010, 2000.0 * 0.0005);
}

TEST_F(ReplayTest, IsTheSameToTheLastBitApartFromTiming) {
  write_path();
  for (const std::string solver : kSolvers) {
    ASSERT_EQ(run("--solver " + solver, "a.csv"), 0) << output_;
    ASSERT_EQ(run("--solver " + solver, "b.csv"), 0) << output_;
    auto a = rows("a.csv");
    auto b = rows("b.csv");
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 1; i < a.size(); ++i) {
      for (const std::size_t column : {kStep1, kSolve}) a[i][column] = b[i][column] = "";
      ASSERT_EQ(a[i], b[i]);
    }
  }
}

TEST_F(ReplayTest, HoldsTheGodObjectOnBadRowsAndSaysSoAtTheEnd) {
  for (const std::string bad :
       {"0.1,nan,0,0.08,1,0,0,0", "0.1,0,inf,0.08,1,0,0,0", "0.1,0,0,0.08,1.1,0,0,0", "0.1,0,0,0.08,0,0,0,0"}) {
    write_path(300, 100, bad);
    EXPECT_EQ(run(""), 65);
    EXPECT_NE(output_.find("path.csv:102"), std::string::npos) << output_;
    const auto table = rows();
    ASSERT_EQ(table.size(), 301u);
    EXPECT_EQ(table[101][kStatus], "bad_input");
    EXPECT_EQ(table[101][kGodZ], table[100][kGodZ]);
    EXPECT_EQ(std::stod(table[101][kForceZ]), 0.0);
    EXPECT_NE(table[102][kStatus], "bad_input");
  }
}

TEST_F(ReplayTest, TakesAQuaternionOfEitherSignAndAlmostUnitLength) {
  write_path(300, 100, "0.1,0.001,0,0.07,-1.0009,0,0,0");
  EXPECT_EQ(run(""), 0) << output_;
}

/// A scene of 4 ms, with friction by speed alone: a ball that is dragged at 50 mm/s with 20 Ns/m drags with 1 N. The
/// rows of its paths are 4 ms apart.
TEST_F(ReplayTest, HasThePeriodOfTheScene) {
  SceneDescription d;
  d.distance = [](const Vector3& p) { return p.z(); };
  d.surface_min = Vector3(-0.05, -0.05, 0.0);
  d.surface_max = Vector3(0.05, 0.05, 0.0);
  d.points = sample_ball(0.02, 500).points;
  d.settings.friction = 1;
  d.settings.friction_viscous = 20.0;
  d.settings.period = 4e-3;
  const SceneImage image = build_scene_image(d);
  std::ofstream(folder_ / "balls.scene", std::ios::binary)
      .write(reinterpret_cast<const char*>(image.bytes().data()), static_cast<std::streamsize>(image.bytes().size()));
  for (const double step : {4e-3, 1e-3}) {
    std::ofstream out(folder_ / "path.csv");
    out << "t,px,py,pz,qw,qx,qy,qz\n";
    for (int k = 0; k < 200; ++k) {
      out << fmt::format("{},{},0,{},1,0,0,0\n", step * k, -0.02 + 0.05 * 4e-3 * k, k == 0 ? 0.021 : 0.018);
    }
    out.close();
    const bool fits = step == 4e-3;
    EXPECT_EQ(run("--solver contact"), fits ? 0 : 65) << output_;
    if (fits) {
      EXPECT_NEAR(std::stod(rows().back().at(kForceZ - 2)), -1.0, 0.03);
    } else {
      EXPECT_NE(output_.find("is not 4 ms (within 10 %) after the row before"), std::string::npos) << output_;
    }
  }
}

TEST_F(ReplayTest, RefusesTimesThatAreNotOneMillisecondApart) {
  for (const std::string bad : {"0.1002,0,0,0.08,1,0,0,0", "0.099,0,0,0.08,1,0,0,0", "nan,0,0,0.08,1,0,0,0"}) {
    write_path(300, 100, bad);
    EXPECT_EQ(run(""), 65) << bad;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.csv"));
  }
  write_path(300, 100, "0.10009,0,0,0.08,1,0,0,0");
  EXPECT_EQ(run(""), 0) << output_;
}

TEST_F(ReplayTest, StartsInsideWithItsStatus) {
  std::ofstream(folder_ / "path.csv") << "t,px,py,pz,qw,qx,qy,qz\n0,0,0,0.07,1,0,0,0\n0.001,0,0,0.07,1,0,0,0\n";
  for (const std::string solver : kSolvers) {
    ASSERT_EQ(run("--solver " + solver), 0) << output_;
    EXPECT_EQ(rows()[1][kStatus], "start_inside") << solver;
    EXPECT_EQ(output_.find("at least"), std::string::npos) << output_;
  }
}

TEST_F(ReplayTest, CountsTheCyclesThatDidNotGoAsWished) {
  // thirty poses inside, then a jump through the whole ball, which no sub-steps can finish in one cycle
  std::ofstream path(folder_ / "path.csv");
  path << "t,px,py,pz,qw,qx,qy,qz\n";
  for (int k = 0; k < 40; ++k) path << fmt::format("{},0,0,{},1,0,0,0\n", 1e-3 * k, k < 30 ? 0.07 : -0.3);
  path.close();
  for (const std::string solver : kSolvers) {
    ASSERT_EQ(run("--solver " + solver), 0) << output_;
    std::map<std::string, int> count;
    for (const auto& row : rows()) ++count[row.back()];
    EXPECT_GT(count["start_inside"], 1);
    const std::string said = fmt::format("; overflow {}, cut {}, infeasible {}, start_inside {}", count["overflow"],
                                         count["cut"], count["infeasible"], count["start_inside"]);
    EXPECT_NE(output_.find(said), std::string::npos) << said << "\n" << output_;
    EXPECT_EQ(output_.find("friction not found in ") != std::string::npos, solver == "contact") << output_;
  }
}

/// Of many units, and of one.
TEST_F(ReplayTest, TellsHowFarABudgetOfWorkKeepsTheGodObjectBehind) {
  write_path();
  ASSERT_EQ(run(""), 0) << output_;
  EXPECT_EQ(output_.find("behind a god object"), std::string::npos) << output_;
  ASSERT_EQ(run("--work-budget 1000000000"), 0) << output_;
  EXPECT_NE(
      output_.find("behind a god object without a budget: p50 0.0000 mm, p99.9 0.0000 mm, largest 0.0000 mm; more "
                   "than 0.05 mm in 0 cycles, at most 0 in a row\n"),
      std::string::npos)
      << output_;
  ASSERT_EQ(run("--work-budget 1"), 0) << output_;
  EXPECT_NE(output_.find("behind a god object without a budget: p50 "), std::string::npos) << output_;
  EXPECT_EQ(output_.find("largest 0.0000 mm"), std::string::npos) << output_;
}

TEST_F(ReplayTest, TakesAnotherStiffness) {
  write_path();
  ASSERT_EQ(run("--friction off", "scene.csv"), 0) << output_;
  ASSERT_EQ(run("--friction off --stiffness 500", "soft.csv"), 0) << output_;
  const auto scene = rows("scene.csv");
  const auto soft = rows("soft.csv");
  ASSERT_EQ(scene.size(), soft.size());
  for (std::size_t i = 1; i < scene.size(); ++i) {
    // the motion does not depend on the stiffness, and the force is proportional to it: 2000 N/m in the scene
    ASSERT_EQ(scene[i][kGodZ], soft[i][kGodZ]);
    ASSERT_NEAR(std::stod(soft[i][kForceZ]), 0.25 * std::stod(scene[i][kForceZ]), 1e-9);
  }
  EXPECT_GT(std::stod(soft[151][kForceZ]), 1.0);
  for (const std::string bad : {"0", "-1", "1e9", "nan", "inf", "2000N", "\"\""}) {
    EXPECT_EQ(run("--stiffness=" + bad), 64) << bad << ": " << output_;
    EXPECT_EQ(std::count(output_.begin(), output_.end(), '\n'), 1) << output_;
  }
}

TEST_F(ReplayTest, SaysWhenNothingCameNear) {
  std::ofstream(folder_ / "path.csv") << "t,px,py,pz,qw,qx,qy,qz\n0,0,0,0.5,1,0,0,0\n";
  ASSERT_EQ(run(""), 0) << output_;
  EXPECT_NE(output_.find("no sample point within the stored band"), std::string::npos) << output_;
}

TEST_F(ReplayTest, SaysThatAPathSeemsToBeInMillimetres) {
  std::ofstream(folder_ / "path.csv") << "t,px,py,pz,qw,qx,qy,qz\n0,nan,0,90,1,0,0,0\n0.001,0,0,90,1,0,0,0\n";
  ASSERT_EQ(run(""), 65) << output_;
  EXPECT_NE(output_.find("path.csv:3: the moving mesh is 90 m away"), std::string::npos) << output_;
  EXPECT_NE(output_.find("positions are in metres"), std::string::npos) << output_;
  std::ofstream(folder_ / "path.csv") << "t,px,py,pz,qw,qx,qy,qz\n0,0,0,0.9,1,0,0,0\n";  // 15 radii away: free flight
  ASSERT_EQ(run(""), 0) << output_;
  EXPECT_EQ(std::count(output_.begin(), output_.end(), '\n'), 1) << output_;
}

TEST_F(ReplayTest, SaysWhereTheFieldTellsNoDepth) {
  std::ofstream(folder_ / "path.csv") << "t,px,py,pz,qw,qx,qy,qz\n0,0,0,0.02,1,0,0,0\n";
  for (const std::string solver : kSolvers) {
    ASSERT_EQ(run("--solver " + solver), 0) << output_;
    EXPECT_NE(output_.find("deepest sample point at least "), std::string::npos) << output_;
    EXPECT_NE(output_.find("(the stored band)"), std::string::npos) << output_;
  }
}

TEST_F(ReplayTest, EndsWithTheExitCodesOfTheContract) {
  write_path();
  EXPECT_EQ(run("--solver nonsense"), 64);
  EXPECT_EQ(run("--unknown"), 64);
  EXPECT_EQ(run("--help"), 0);
  EXPECT_NE(output_.find("Examples:"), std::string::npos);
  EXPECT_NE(output_.find("infeasible"), std::string::npos);
  EXPECT_NE(output_.find("neither limited nor smoothed"), std::string::npos);
  EXPECT_NE(output_.find("Exit codes: 0 done, 64 usage"), std::string::npos);
  EXPECT_EQ(output_.find("TEXT"), std::string::npos) << "says not what is wanted: " << output_;
  EXPECT_EQ(run("--version"), 0);
  EXPECT_NE(output_.find("godobject-replay"), std::string::npos);
  EXPECT_EQ(run("", "absent/out.csv"), 74);
  EXPECT_NE(output_.find("there is no folder absent; make it"), std::string::npos) << output_;
  write_scene(false);
  EXPECT_EQ(run("--friction on"), 78);
  EXPECT_EQ(run("--friction off"), 0) << output_;
  std::filesystem::remove(folder_ / "path.csv");
  EXPECT_EQ(run(""), 66);
  std::ofstream(folder_ / "path.csv") << "t,px,py,pz,qw,qx,qy,qz\n";
  EXPECT_EQ(run(""), 65);
  std::filesystem::resize_file(folder_ / "balls.scene", 1000);
  EXPECT_EQ(run(""), 65);
  EXPECT_EQ(std::count(output_.begin(), output_.end(), '\n'), 1) << output_;
  std::filesystem::remove(folder_ / "balls.scene");
  EXPECT_EQ(run(""), 66);
}

}  // namespace
}  // namespace godobject::test
