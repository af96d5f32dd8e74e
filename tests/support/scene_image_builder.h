#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scene/format.h"
#include "core/scene/scene.h"
#include "godobject/pose.h"

namespace godobject::test {

/// The bytes of a scene image, aligned as Scene::open wants them.
class SceneImage {
 public:
  explicit SceneImage(std::size_t bytes) : blocks_((bytes + sizeof(Block) - 1) / sizeof(Block)), bytes_(bytes) {}

  std::span<std::byte> bytes() { return {reinterpret_cast<std::byte*>(blocks_.data()), bytes_}; }
  std::span<const std::byte> bytes() const { return {reinterpret_cast<const std::byte*>(blocks_.data()), bytes_}; }

 private:
  struct alignas(format::kAlignment) Block {
    std::byte byte[format::kAlignment];
  };
  std::vector<Block> blocks_;
  std::size_t bytes_;
};

/// What a small scene is made of. All lengths in metres.
struct SceneDescription {
  /// Signed distance in W, positive outside, 1-Lipschitz; its zero set lies within surface_min .. surface_max.
  std::function<double(const Vector3&)> distance;
  Vector3 surface_min = Vector3::Zero();
  Vector3 surface_max = Vector3::Zero();
  double voxel_size = 0.005;
  double band = 0.0;  ///< 0: four voxels
  /// Whether the brick that is the cube of `edge` about `center` is refined; asked of stored positions, then of their
  /// octants. Empty: none is.
  std::function<bool(const Vector3& center, double edge)> refined;
  /// Whether the octant of a refined brick that is the cube of `edge` about `center` is left coarse. Empty: none is.
  std::function<bool(const Vector3& center, double edge)> coarse;

  /// Named by every brick that is looked up; grid.lipschitz is that of the field without.
  std::optional<format::Edge> edge;

  std::vector<Vector3> points;    ///< in the body frame B; the image may hold them in another order
  std::vector<Vector3> normals;   ///< unit, pointing into the body, one a point; empty: left out, and `paper` with them
  std::uint32_t level_count = 0;  ///< of the sphere tree; 0: as many as leave about eight points to a leaf
  Pose H_MB;
  std::array<double, 3> inertia{};  ///< principal moments over mass, ascending [m^2]; zeros: those of a solid ball

  std::optional<format::Workspace> workspace;
  format::Settings settings{};  ///< where a length or stiffness is 0: the scene file's default
  std::string provenance = "{}";
};

/// A valid image of the scene, checksums and all, written without the scene compiler: a second reading of format.h.
/// The grid covers the surface's box, one band and a voxel. Throws std::invalid_argument naming the member that is
/// wrong.
SceneImage build_scene_image(const SceneDescription& description);

/// The bytes of a section, without padding; empty where the image has none.
std::span<std::byte> section_bytes(SceneImage& image, format::SectionId id);

/// The i-th T of a section, to read or to spoil.
template <class T>
T& section_item(SceneImage& image, format::SectionId id, std::size_t i = 0) {
  return reinterpret_cast<T*>(section_bytes(image, id).data())[i];
}

/// Recomputes every checksum, so that what a test spoiled is met by the checks behind them.
void seal(SceneImage& image);

/// Opens an image that must be valid; throws std::runtime_error with the status otherwise.
Scene open_scene(const SceneImage& image);

}  // namespace godobject::test
