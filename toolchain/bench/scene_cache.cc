#include "toolchain/bench/scene_cache.h"

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "toolchain/files/atomic_file.h"
#include "toolchain/files/output_target.h"
#include "toolchain/scene_compiler/compile_scene.h"
#include "toolchain/scene_compiler/compiler_digest.h"
#include "toolchain/scene_compiler/scene_config.h"

namespace godobject::bench {
namespace {

/// FNV-1a, 64 bits. It distinguishes files, but does not resist forgery.
class Digest {
 public:
  void add(std::string_view bytes) noexcept {
    for (const char byte : bytes) value_ = (value_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  }
  std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

SceneCache::SceneCache(std::filesystem::path folder) : folder_(std::move(folder)) {
  files::make_output_folder(folder_);
}

files::SceneImage SceneCache::image(const std::filesystem::path& scene_file,
                                    const std::function<void(const char* phase, double done)>& progress) const {
  const scene_compiler::SceneConfig config = scene_compiler::read_scene_config(scene_file);
  Digest digest;
  digest.add(scene_compiler::compiler_digest());
  for (const auto& file : {scene_file, config.still.file, config.moving.file}) digest.add(bytes_of(file));
  const auto image = folder_ / fmt::format("{}-{:016x}.scene", scene_file.stem().string(), digest.value());
  if (!std::filesystem::exists(image)) {
    scene_compiler::compile_scene({.scene_file = scene_file, .output = image, .only_solver = {}, .progress = progress});
  }
  return files::SceneImage::read(image);
}

files::SceneImage SceneCache::image_of_text(std::string_view name, std::string_view text,
                                            const std::function<void(const char* phase, double done)>& progress) const {
  const auto file = folder_ / fmt::format("{}.toml", name);
  files::AtomicFile out(file);
  out.write(text);
  out.commit();
  return image(file, progress);
}

std::filesystem::path default_cache_folder() {
  const auto variable = [](const char* name) -> std::string {
    const char* const value = std::getenv(name);
    return value == nullptr ? "" : value;
  };
  if (const std::string cache = variable("XDG_CACHE_HOME"); !cache.empty()) {
    return std::filesystem::path(cache) / "godobject-bench";
  }
  if (const std::string home = variable("HOME"); !home.empty()) {
    return std::filesystem::path(home) / ".cache" / "godobject-bench";
  }
  return std::filesystem::temp_directory_path() / "godobject-bench";
}

}  // namespace godobject::bench
