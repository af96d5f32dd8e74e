#pragma once

#include <string>
#include <vector>

#include "toolchain/figures/replay_log.h"
#include "toolchain/page/scene_header.h"

namespace godobject::page {

/// A replay with the name that the page shows.
struct NamedReplay {
  std::string name;
  figures::ReplayLog log;
};

/// A scene and the replays that a page plays side by side.
struct PageScene : PageBodies {
  std::vector<NamedReplay> replays;  ///< one or more, of the same motion of the device
};

/// Returns the data of a page: the length of the header (four bytes, lowest first), the header (JSON), and the columns
/// that it refers to (see ColumnPack). README.md lists the keys of the header. Vertices are rounded to 1 / 65535 of the
/// bounding box. Throws Failure (kBadData) if a body has more than kMaxTriangles triangles, or if the replays are not
/// of the same motion: other times, or other poses of the device.
std::string page_data(const PageScene& scene);

}  // namespace godobject::page
