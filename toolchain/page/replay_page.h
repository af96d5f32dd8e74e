#pragma once

#include <string>
#include <string_view>

#include "toolchain/page/page_data.h"

namespace godobject::page {

/// Returns a web page that plays the replays of a scene: the data and `player`, the text of the bundled script. The
/// page loads nothing else. `title`: plain text. Throws Failure as page_data does.
std::string replay_page(const PageScene& scene, std::string_view title, std::string_view player);

}  // namespace godobject::page
