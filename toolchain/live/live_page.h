#pragma once

#include <string>
#include <string_view>

#include "toolchain/page/scene_header.h"

namespace godobject::live {

/// Contents of a live page before its first state.
struct LivePage {
  page::PageBodies bodies;
  Pose start;            ///< H_WM that the camera shows
  double force = 0.0;    ///< of the longest arrow [N]
  double torque = 0.0;   ///< [Nm]
  double period = 1e-3;  ///< of the controller [s]
  bool hand = false;     ///< a pointer may move the hand
  std::string source;    ///< the controller in words
};

/// Returns the page (LiveServer::Setup::page). Throws as page::scene_header.
std::string live_page(const LivePage& page, std::string_view title, std::string_view player);

}  // namespace godobject::live
