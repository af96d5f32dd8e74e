#include "toolchain/page/player_file.h"

#include <system_error>

#include "toolchain/files/input_file.h"
#include "toolchain/files/text_file.h"

namespace godobject::page {

std::string read_player(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path();
  const fs::path script = file.empty() ? folder / "share" / "godobject" / "player.js" : file;
  files::require_input(script, "build the target godobject_player, which puts it there, or name a player by --player");
  return files::read_text(script);
}

}  // namespace godobject::page
