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
#include "core/scene/scene_view.h"
#include "godobject/pose.h"

namespace godobject::test {

/// The bytes of a scene image, aligned as SceneView::open requires.
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

/// Describes a small scene for `build_scene_image`. All lengths are in metres.
struct SceneDescription {
  /// Signed distance in W, positive outside, 1-Lipschitz; its zero set lies within surface_min .. surface_max.
  std::function<double(const Vector3&)> distance;
  Vector3 surface_min = Vector3::Zero();
  Vector3 surface_max = Vector3::Zero();
  double voxel_size = 0.005;
  double band = 0.0;  ///< 0: four voxels
  /// Returns true if the brick with this centre and edge length is refined. The builder asks for all stored positions,
  /// then for their octants. Empty: no brick is refined.
  std::function<bool(const Vector3& center, double edge)> refined;
  /// Returns true if the octant of a refined brick with this centre and edge stays coarse. Empty: no octant does.
  std::function<bool(const Vector3& center, double edge)> coarse;

  /// The one facet of all bricks that are looked up: they are exact bricks with weights of a half. grid.lipschitz does
  /// not take it into account.
  std::optional<format::Facet> facet;

  std::vector<Vector3> points;    ///< in the body frame B; the image may store them in another order
  std::vector<Vector3> normals;   ///< unit, pointing into the body, one a point; empty: none, and no solver `paper`
  std::uint32_t level_count = 0;  ///< of the sphere tree; 0: as many levels as give a leaf about eight points
  Pose H_MB;
  std::array<double, 3> inertia{};  ///< principal moments over mass, ascending [m^2]; zeros: those of a solid ball

  std::optional<format::Workspace> workspace;
  format::Settings settings{};  ///< a length or stiffness of 0 stands for the scene file's default
  std::string provenance = "{}";
};

/// Returns a valid image of the scene, with checksums. The code is a second implementation of format.h, independent
/// of the scene compiler. The grid covers the surface's box, one band and a voxel. Throws std::invalid_argument, which
/// names the wrong member.
SceneImage build_scene_image(const SceneDescription& description);

/// A section of an image, without padding.
struct ImageSection {
  format::SectionId id;
  std::vector<std::byte> bytes;
};

/// Returns the image of these sections, in this order, with checksums.
SceneImage assemble_image(const std::vector<ImageSection>& sections);

/// Returns the bytes of a section, without padding. Empty if the image lacks the section.
std::span<std::byte> section_bytes(SceneImage& image, format::SectionId id);

/// Returns the i-th T of a section, which a test can read or damage.
template <class T>
T& section_item(SceneImage& image, format::SectionId id, std::size_t i = 0) {
  return reinterpret_cast<T*>(section_bytes(image, id).data())[i];
}

/// Recomputes all checksums. Then data that a test damaged passes them and meets the checks that follow.
void seal(SceneImage& image);

/// Opens an image that must be valid. Throws std::runtime_error with the status if it is not.
SceneView open_scene(const SceneImage& image);

}  // namespace godobject::test
