#include "toolchain/files/work_folder.h"

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "toolchain/files/output_target.h"

namespace godobject::files {

using command::ExitCode;
using command::Failure;

WorkFolder::WorkFolder(const std::filesystem::path& output) {
  const auto parent = output_target(output).parent_path();
  std::string name = ((parent.empty() ? "." : parent) / ".work-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw output_failure(output, "cannot be made", errno);
  path_ = name;
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path WorkFolder::write(const char* name, std::string_view text) const {
  const auto file = path_ / name;
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream)
    throw Failure(ExitCode::kIo, fmt::format("{}: cannot be written completely; free some space there", file.string()));
  return file;
}

void WorkFolder::deliver(const char* name, const std::filesystem::path& output) const {
  std::error_code error;
  std::filesystem::rename(path_ / name, output_target(output), error);
  if (error) throw output_failure(output, "cannot be renamed to its final name", error.value());
}

}  // namespace godobject::files
