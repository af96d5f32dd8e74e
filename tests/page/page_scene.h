#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include "tests/viewer/boxes.h"
#include "toolchain/page/page_data.h"

namespace godobject::page {

/// Returns a replay in which a box is pressed onto a plate and slides, with a known number in every column.
inline figures::ReplayLog sliding_log(std::size_t cycles) {
  figures::ReplayLog log;
  for (std::size_t i = 0; i < cycles; ++i) {
    const double t = 1e-3 * static_cast<double>(i);
    figures::ReplayRow row;
    row.t = t;
    row.H_WD = {exp_rotation(Vector3(0.0, 0.0, t)), Vector3(0.1 * t, 0.0, 0.028)};
    row.H_WS = {exp_rotation(Vector3(0.0, 0.0, t)), Vector3(0.1 * t, 0.0, 0.03)};
    row.wrench = {Vector3(3.0 * std::sin(t), 0.0, 4.0), Vector3(0.0, 0.01, 0.0)};
    row.depth = -1e-5;
    row.contacts = 4.0;
    row.step1_ns = 2000.0;
    row.solve_ns = 500.0;
    row.status = i == 0 ? "free" : "contact";
    log.push_back(row);
  }
  return log;
}

/// Returns a scene of a box on a plate with one replay.
inline PageScene sliding_scene(std::size_t cycles) {
  PageScene scene;
  scene.bodies = {viewer::box(Vector3(0.2, 0.2, 0.01)), viewer::box(Vector3(0.02, 0.02, 0.02))};
  scene.still_name = "plate";
  scene.moving_name = "box";
  scene.replays.push_back({"contact", sliding_log(cycles)});
  return scene;
}

}  // namespace godobject::page
