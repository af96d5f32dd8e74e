#pragma once

#include <filesystem>
#include <fstream>

#include "firmware/configuration/controller_file.h"
#include "tests/support/small_scenes.h"

namespace godobject::live {

/// Returns the controller of the light-weight robot with the ball of `test::ball_over_plate`, 20 mm above the plate,
/// whose image it writes to `folder`.
inline firmware::ControllerConfig ball_in_hand(const std::filesystem::path& folder) {
  const test::SceneImage image = test::ball_over_plate();
  std::ofstream(folder / "ball.scene", std::ios::binary)
      .write(reinterpret_cast<const char*>(image.bytes().data()), static_cast<std::streamsize>(image.bytes().size()));
  std::ofstream(folder / "controller.toml") << "[scene]\nimage = \"ball.scene\"\nsolver = \"contact\"\n"
                                            << "[device]\nfile = \"" GODOBJECT_FIRMWARE_DIR "/devices/lwr.toml\"\n"
                                            << R"([workspace]
posture = [0.0, -0.5, 0.0, 1.4, 0.0, -1.2, 0.0]
start = [0.0, 0.0, 0.05, 1.0, 0.0, 0.0, 0.0]
[loop]
velocity_window = 2
[gains]
stiffness = 1000.0
damping = 5.0
rotational = 0.003
[limits]
stuck_torque = 0.002
turn = 4.0
turn_stop = 6.0
)";
  return firmware::read_controller_file(folder / "controller.toml");
}

}  // namespace godobject::live
