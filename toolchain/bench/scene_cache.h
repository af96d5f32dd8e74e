#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "toolchain/files/scene_image.h"

namespace godobject::bench {

/// Compiled scenes in a folder, each under a name that follows from the scene file's text, its meshes' bytes and the
/// compiler, so that a second run need not compile and a changed compiler is never mixed up with an older one.
class SceneCache {
 public:
  /// Makes the folder where it is not there. Throws Failure.
  explicit SceneCache(std::filesystem::path folder);

  /// The image of a scene file, compiled if it is not there. `progress` may be empty. Throws Failure.
  files::SceneImage image(const std::filesystem::path& scene_file,
                          const std::function<void(const char* phase, double done)>& progress) const;

  /// The same of a text, whose meshes have absolute paths; `name` is a file name's begin.
  files::SceneImage image_of_text(std::string_view name, std::string_view text,
                                  const std::function<void(const char* phase, double done)>& progress) const;

 private:
  std::filesystem::path folder_;
};

/// $XDG_CACHE_HOME/godobject-bench, or ~/.cache/godobject-bench, or a folder in the one for temporary files.
std::filesystem::path default_cache_folder();

}  // namespace godobject::bench
