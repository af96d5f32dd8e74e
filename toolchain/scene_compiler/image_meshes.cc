#include "toolchain/scene_compiler/image_meshes.h"

#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace godobject::scene_compiler {

std::string difference_of_meshes(const SceneView& scene, const SceneConfig& config) {
  const std::string_view text(reinterpret_cast<const char*>(scene.provenance.data()), scene.provenance.size());
  const auto record = nlohmann::json::parse(text, nullptr, false);
  const auto difference = [&record](const char* body, const SceneConfig::Mesh& mesh) -> std::string {
    if (!record.is_object() || !record.contains(body)) return "";
    const std::string name = record[body].value("file", mesh.name);
    const double scale = record[body].value("scale", mesh.scale);
    if (name == mesh.name && scale == mesh.scale) return "";
    return fmt::format("the {} mesh is {} with scale {}, that of the image {} with scale {}", body, mesh.name,
                       mesh.scale, name, scale);
  };
  const std::string still = difference("still", config.still);
  return still.empty() ? difference("moving", config.moving) : still;
}

}  // namespace godobject::scene_compiler
