#include "toolchain/files/text_file.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"

namespace godobject::files {

using command::ExitCode;
using command::Failure;

std::string read_text(const std::filesystem::path& file, std::size_t most) {
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  require_input(file);
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  while (stream && text.size() <= most) {
    const std::size_t begin = text.size();
    text.resize(std::min(begin + kPiece, most + 1));
    stream.read(text.data() + begin, static_cast<std::streamsize>(text.size() - begin));
    text.resize(begin + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad())
    throw Failure(ExitCode::kIo, fmt::format("{}: cannot be read to its end; check the disk", file.string()));
  if (text.size() > most) {
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: is longer than {} bytes; check the path, or split the file", file.string(), most));
  }
  return text;
}

}  // namespace godobject::files
