#include "toolchain/viewer/render.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "toolchain/command/external_program.h"
#include "toolchain/command/failure.h"

namespace godobject::viewer {
namespace {

using command::ExitCode;
using command::Failure;

/// A folder beside the output, gone at the end whatever happens.
class WorkFolder {
 public:
  explicit WorkFolder(const std::filesystem::path& beside) {
    std::string name = (beside / ".godobject-view-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw Failure(ExitCode::kIo, fmt::format("{}: no folder can be made there ({}); choose one that may be written to", beside.string(),
                                               std::strerror(errno)));
    }
    path_ = name;
  }
  ~WorkFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

void render(const std::string& pov_text, int width, int height, const std::filesystem::path& png) {
  const auto parent = png.parent_path();
  const WorkFolder folder(parent.empty() ? std::filesystem::path(".") : parent);
  const auto scene = folder.path() / "scene.pov";
  const auto image = folder.path() / "image.png";
  std::ofstream stream(scene, std::ios::binary);
  stream << pov_text;
  stream.close();
  if (!stream) throw Failure(ExitCode::kIo, fmt::format("{}: could not be written whole; make room there", scene.string()));
  command::run_program({"povray", "+I" + scene.string(), "+O" + image.string(), fmt::format("+W{}", width), fmt::format("+H{}", height),
                        "+A0.15", "+AM2", "+R2", "+WT2", "+FN8", "-D", "-GA"},
                       "povray");
  std::error_code error;
  std::filesystem::rename(image, png, error);
  if (error) throw Failure(ExitCode::kIo, fmt::format("{}: could not be put in its place ({})", png.string(), error.message()));
}

}  // namespace godobject::viewer
