#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "godobject/pose.h"
#include "godobject/status.h"

namespace godobject {

struct Scene;

/// The three ways to compute the god object's motion; `contact` is the one to use, the others are there to compare with.
enum class Solver : std::uint32_t {
  kPaper = 0,      ///< the printed heuristic of Sagardia and Hulin
  kCorrected = 1,  ///< one projection in closed form; exact for a single contact
  kContact = 2,    ///< all contact points; no penetration, friction
};

/// Stiffness and damping that the device displays.
struct Gains {
  double stiffness = 0.0;   ///< k_D [N/m]
  double damping = 0.0;     ///< b_D [Ns/m]
  double rotational = 0.0;  ///< k_VC,r: rotational over translational stiffness [m^2]
};

/// The still body's surface as seen from a point.
struct SurfaceDistance {
  double distance = 0.0;               ///< signed, positive outside [m]; the band's edge where `known` is false
  Vector3 normal_W = Vector3::Zero();  ///< unit, away from the body; zero where `known` is false
  bool known = false;                  ///< the point lies within the stored band around the surface
};

/// A scene image that `godobject-scenec` compiled: both bodies, solver data and settings. A view of the image's bytes,
/// which stay with the caller. Copies are cheap and see the same bytes.
class CompiledScene {
 public:
  /// The image must begin at a multiple of this [bytes].
  static constexpr std::size_t kImageAlignment = 64;

  CompiledScene() noexcept;
  CompiledScene(const CompiledScene& other) noexcept;
  CompiledScene& operator=(const CompiledScene& other) noexcept;

  /// Checks the whole image once (checksums, layout, every index and every number) and makes `scene` a view of it. The
  /// bytes must stay where they are, unchanged, as long as the scene or a god object in it is used.
  /// kImageTruncated, kImageForeign, kImageVersion, kImageChecksum, kImageLayout, kImageValue: the image is refused;
  /// `scene` is unchanged. Cost: one pass over the bytes, about 1 ms per MiB; no allocation.
  static Status open(std::span<const std::byte> image, CompiledScene& scene) noexcept;

  Solver default_solver() const noexcept;     ///< of the scene file
  bool holds(Solver solver) const noexcept;   ///< the image holds the data that this solver reads
  bool has_friction() const noexcept;         ///< the scene file has a friction table
  double voxel_size() const noexcept;         ///< [m]
  Vector3 center_of_mass_M() const noexcept;  ///< of the moving body, in its mesh frame M [m]

  /// The signed distance from a point of W to the still body. Cost: one look-up, some 60 ns. Real-time safe.
  SurfaceDistance distance(const Vector3& p_W) const noexcept;

  Gains gains() const noexcept;
  /// For god objects that are started from now on. kOutOfRange: a gain is not finite, or stiffness or rotational is not
  /// positive, or damping is negative; nothing changed.
  Status set_gains(const Gains& gains) noexcept;

  /// For this project's own tools: the parts of the image. Their types are no part of the library's interface.
  const Scene& view() const noexcept;
  static CompiledScene of(const Scene& view) noexcept;

 private:
  static constexpr std::size_t kBytes = 2048;
  Scene& view() noexcept;

  alignas(64) std::byte storage_[kBytes];
};

}  // namespace godobject
