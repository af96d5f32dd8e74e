#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "tests/support/folder_test.h"
#include "tests/support/small_scenes.h"

namespace godobject::firmware {

/// A folder with a scene, a controller file c.toml of the light-weight robot over it, and what a run writes there.
class ControllerFolderTest : public test::FolderTest {
 protected:
  void SetUp() override {
    const test::SceneImage image = test::ball_over_plate();
    std::ofstream(folder_ / "plate.scene", std::ios::binary)
        .write(reinterpret_cast<const char*>(image.bytes().data()), static_cast<std::streamsize>(image.bytes().size()));
    write_controller("");
  }

  void write_controller(const std::string& more,
                        const std::string& gains = "damping = 5.0\nrotational = 0.003\n") const {
    std::ofstream(folder_ / "c.toml")
        << "[scene]\nimage = \"plate.scene\"\n[device]\nfile = \"" << GODOBJECT_FIRMWARE_DIR
        << "/devices/lwr.toml\"\n[workspace]\nposture = [0.0, -0.5, 0.0, 1.4, 0.0, -1.2, 0.0]\n"
        << "start = [0.0, 0.0, 0.06, 1.0, 0.0, 0.0, 0.0]\n[gains]\n"
        << gains << more;
  }

  /// As write_controller, with the solver `contact`.
  void write_contact_controller(const std::string& more) const {
    write_controller(more);
    const std::string lines = text("c.toml");
    const std::string scene = "[scene]\n";
    std::ofstream(folder_ / "c.toml") << scene << "solver = \"contact\"\n" << lines.substr(scene.size());
  }

  /// A ball's path: 50 mm down in half a second, and it stays there.
  void write_path() const {
    std::ofstream out(folder_ / "path.csv");
    out << "t,px,py,pz,qw,qx,qy,qz\n";
    for (int k = 0; k < 1500; ++k) out << fmt::format("{},0,0,{},1,0,0,0\n", 1e-3 * k, 0.06 - 1e-4 * std::min(k, 500));
  }

  std::string text(const std::filesystem::path& file) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / file).rdbuf();
    return text.str();
  }
};

}  // namespace godobject::firmware
