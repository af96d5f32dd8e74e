#include "toolchain/viewer/render.h"

#include <fmt/format.h>

#include "toolchain/command_line/external_program.h"
#include "toolchain/files/work_folder.h"

namespace godobject::viewer {

void render(const std::string& pov_text, int width, int height, const std::filesystem::path& png) {
  const files::WorkFolder folder(png);
  const auto scene = folder.write("scene.pov", pov_text);
  const auto image = folder.path() / "image.png";
  // +A +AM2 +R2: anti-aliasing; +WT2: threads; +FN8: PNG of 8 bits per colour; -D -GA: no display, no console
  command::run_program({"povray", "+I" + scene.string(), "+O" + image.string(), fmt::format("+W{}", width),
                        fmt::format("+H{}", height), "+A0.15", "+AM2", "+R2", "+WT2", "+FN8", "-D", "-GA"},
                       "povray");
  folder.deliver("image.png", png);
}

}  // namespace godobject::viewer
