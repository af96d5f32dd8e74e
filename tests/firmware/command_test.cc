// godobject-controller as its users meet it: the program is run, its exit codes, words and files are looked at.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <sys/wait.h>

#include "tests/support/small_scenes.h"

namespace godobject::firmware {
namespace {

class ControllerCommandTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("godobject_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
    const test::SceneImage image = test::ball_over_plate();
    std::ofstream(folder_ / "plate.scene", std::ios::binary)
        .write(reinterpret_cast<const char*>(image.bytes().data()), static_cast<std::streamsize>(image.bytes().size()));
    write_controller("");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write_controller(const std::string& more,
                        const std::string& gains = "damping = 5.0\nrotational = 0.003\n") const {
    std::ofstream(folder_ / "c.toml")
        << "[scene]\nimage = \"plate.scene\"\n[device]\nfile = \"" << GODOBJECT_FIRMWARE_DIR
        << "/devices/lwr.toml\"\n[workspace]\nposture = [0.0, -0.5, 0.0, 1.4, 0.0, -1.2, 0.0]\n"
        << "start = [0.0, 0.0, 0.06, 1.0, 0.0, 0.0, 0.0]\n[gains]\n"
        << gains << more;
  }

  /// A ball's path: 50 mm down in half a second, and it stays there.
  void write_path() const {
    std::ofstream out(folder_ / "path.csv");
    out << "t,px,py,pz,qw,qx,qy,qz\n";
    for (int k = 0; k < 1500; ++k) out << fmt::format("{},0,0,{},1,0,0,0\n", 1e-3 * k, 0.06 - 1e-4 * std::min(k, 500));
  }

  /// Exit code; `words_` gets stdout and stderr.
  int run(const std::string& arguments, const std::string& before = "") {
    const std::string command =
        fmt::format("cd {} && {} {} {} > log.txt 2>&1", folder_.string(), before, GODOBJECT_CONTROLLER, arguments);
    const int status = std::system(command.c_str());
    std::ostringstream text;
    text << std::ifstream(folder_ / "log.txt").rdbuf();
    words_ = text.str();
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  bool says(const std::string& what) const { return words_.find(what) != std::string::npos; }

  std::filesystem::path folder_;
  std::string words_;
};

TEST_F(ControllerCommandTest, RendersAPathAndLogsIt) {
  write_path();
  write_controller("[simulation]\npath = \"path.csv\"\nbegin = 6.0\n");
  ASSERT_EQ(run("c.toml --log logs"), 0) << words_;
  EXPECT_TRUE(says("stable up to")) << words_;
  EXPECT_FALSE(says("in contact in 0:")) << words_;
  EXPECT_TRUE(says(" 0 lost")) << words_;
  std::ifstream log(folder_ / "logs" / "telemetry.csv");
  std::string line;
  ASSERT_TRUE(std::getline(log, line));
  EXPECT_EQ(line.substr(0, 4), "t_s,");
  int rows = 0;
  bool contact = false;
  while (std::getline(log, line)) {
    ++rows;
    contact = contact || line.find(",running,0,1,contact,") != std::string::npos;
  }
  EXPECT_GE(rows, 6000);
  std::ifstream hand(folder_ / "logs" / "hand.csv");
  ASSERT_TRUE(std::getline(hand, line));
  EXPECT_EQ(line, "t_s,hand_J");
  int hand_rows = 0;
  std::string last;
  for (; std::getline(hand, line); ++hand_rows) last = line;
  EXPECT_EQ(hand_rows, rows);
  EXPECT_GT(std::stod(last.substr(last.find(',') + 1)), 0.0) << "it was moved and pressed";
  EXPECT_TRUE(contact);
}

TEST_F(ControllerCommandTest, EndsInOrderOnSigterm) {
  EXPECT_EQ(run("c.toml", "timeout --preserve-status --signal=TERM 1"), 0) << words_;
  EXPECT_TRUE(says("rendered in")) << words_;
  EXPECT_FALSE(says("stopped:")) << words_;
}

TEST_F(ControllerCommandTest, RefusesInOneLineWithTheRightCode) {
  EXPECT_EQ(run("c.toml --bus none0,none1"), 78);
  EXPECT_TRUE(says("--bus names 2 CAN interfaces, the device has 3 buses"));
  EXPECT_EQ(run("c.toml --bus none0,none1,none0"), 78);
  EXPECT_TRUE(says("names an interface twice"));
  EXPECT_EQ(run("c.toml --bus none0,none1,none2"), 69);  // whether or not the machine has CAN
  EXPECT_TRUE(says("--bus none0: ")) << words_;
  EXPECT_EQ(run(""), 64);
  EXPECT_EQ(run("c.toml --duration -1"), 64);
  EXPECT_EQ(run("nothing.toml"), 66);
  EXPECT_EQ(run("c.toml --scene nothing.scene"), 66);
  EXPECT_EQ(run("c.toml --scene c.toml"), 65);
  EXPECT_TRUE(says("is not a scene image")) << words_;
  write_controller("[limits]\nforce = nan\n");
  EXPECT_EQ(run("c.toml"), 78);
  EXPECT_TRUE(says("limits.force = nan")) << words_;
  EXPECT_EQ(std::count(words_.begin(), words_.end(), '\n'), 1) << words_;
  write_controller("", "damping = 5.0\nrotational = 0.003\nstiffness = 20000.0\n");
  EXPECT_EQ(run("c.toml"), 78);
  EXPECT_TRUE(says("stability boundary")) << words_;
  write_controller("", "damping = 20.0\n");
  EXPECT_EQ(run("c.toml"), 78);
  EXPECT_TRUE(says("no stiffness is stable")) << words_;
  write_path();
  write_controller("[simulation]\npath = \"path.csv\"\n");
  std::ofstream(folder_ / "path.csv") << "t,px,py,pz,qw,qx,qy,qz\n0,0.2,0,0.06,1,0,0,0\n";
  EXPECT_EQ(run("c.toml"), 78);
  EXPECT_TRUE(says("set workspace.start to its first pose")) << words_;
}

TEST_F(ControllerCommandTest, KeepsToTheClockOnRequest) {
  write_controller("[loop]\nreal_time = true\npriority = 1\n");
  EXPECT_EQ(run("c.toml --duration 0.3"), 0) << words_;
  EXPECT_TRUE(says("waking late: p50")) << words_;
}

TEST_F(ControllerCommandTest, ExaminesTheMachine) {
  EXPECT_EQ(run("doctor"), 0);
  EXPECT_TRUE(says("kernel: ")) << words_;
  EXPECT_TRUE(says("memlock: ")) << words_;
  EXPECT_EQ(run("doctor c.toml"), 0);
  EXPECT_EQ(run("doctor nothing.toml"), 66);
  EXPECT_EQ(run("--help"), 0);
  EXPECT_TRUE(says("Examples:")) << words_;
}

}  // namespace
}  // namespace godobject::firmware
