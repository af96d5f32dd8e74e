#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "toolchain/files/scene_image.h"

namespace godobject::bench {

/// Compiled scenes in a folder. The name of each follows from the text of the scene file, the bytes of its meshes and
/// the compiler, so a second run need not compile, and a changed compiler never uses the scenes of an older one.
class SceneCache {
 public:
  /// Creates the folder if it is missing. Throws Failure.
  explicit SceneCache(std::filesystem::path folder);

  /// Returns the image of a scene file, and compiles it if it is not cached. `progress` may be empty. Throws Failure.
  files::SceneImage image(const std::filesystem::path& scene_file,
                          const std::function<void(const char* phase, double done)>& progress) const;

  /// The same for the text of a scene file, whose meshes have absolute paths; the file's name begins with `name`.
  files::SceneImage image_of_text(std::string_view name, std::string_view text,
                                  const std::function<void(const char* phase, double done)>& progress) const;

 private:
  std::filesystem::path folder_;
};

/// Returns $XDG_CACHE_HOME/godobject-bench, or ~/.cache/godobject-bench, or a folder among the temporary files.
std::filesystem::path default_cache_folder();

}  // namespace godobject::bench
