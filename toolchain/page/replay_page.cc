#include "toolchain/page/replay_page.h"

#include "toolchain/page/compressed_text.h"
#include "toolchain/page/page_html.h"

namespace godobject::page {
namespace {

constexpr const char* kOne =
    "The translucent body follows a hand that pushes it into the grey body. The solid blue "
    "body, the god object, should stay on the surface. The red arrow is the force of the spring that pulls the hand "
    "back.";
constexpr const char* kSeveral =
    "Each picture shows another replay of the same motion of a hand. The translucent body "
    "follows the hand into the grey body. The solid coloured body, the god object, should stay on the surface. The red "
    "arrow is the force of the spring that pulls the hand back.";

}  // namespace

std::string replay_page(const PageScene& scene, std::string_view title, std::string_view player) {
  return page_html({.title = title,
                    .lead = scene.replays.size() == 1 ? kOne : kSeveral,
                    .data_id = "replay-data",
                    .data = compressed_text(page_data(scene)),
                    .player = player,
                    .connections = "'none'"});
}

}  // namespace godobject::page
