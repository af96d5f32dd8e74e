#include "toolchain/live/live_page.h"

#include "toolchain/page/compressed_text.h"
#include "toolchain/page/page_html.h"

namespace godobject::live {
namespace {

constexpr const char* kLooks =
    "The translucent body follows the hand. The solid one, the god object, stays on the "
    "surface of the grey body.";
constexpr const char* kSteers =
    "Drag the blue body: a hand pulls it along. The solid one, the god object, stays on the "
    "surface of the grey body.";

}  // namespace

std::string live_page(const LivePage& page, std::string_view title, std::string_view player) {
  constexpr double kZoom = 0.5;  // room for the motion and for some of the arm
  page::ColumnPack pack;
  nlohmann::json header = page::scene_header(page.bodies, {{page.start, page.start}}, pack, kZoom);
  header["statuses"] = nlohmann::json::array();
  header["live"] = {{"force", page.force},
                    {"torque", page.torque},
                    {"period", page.period},
                    {"hand", page.hand},
                    {"source", page.source}};
  return page::page_html({.title = title,
                          .lead = page.hand ? kSteers : kLooks,
                          .data_id = "live-data",
                          .data = page::compressed_text(page::packed(header, pack)),
                          .player = player,
                          .connections = "'self' ws://@HOST@"});
}

}  // namespace godobject::live
