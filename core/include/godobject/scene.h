#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "godobject/pose.h"
#include "godobject/status.h"

namespace godobject {

struct SceneView;

/// The three solvers for the god object's motion. Use `contact`; the others are there for comparison.
enum class Solver : std::uint32_t {
  kPaper = 0,      ///< the printed heuristic of Sagardia and Hulin
  kCorrected = 1,  ///< one projection in closed form; exact for a single contact
  kContact = 2,    ///< constraints at all contact points; no penetration, Coulomb friction
};

/// The stiffness and damping that the device displays.
struct Gains {
  double stiffness = 0.0;   ///< k_D [N/m]
  double damping = 0.0;     ///< b_D [Ns/m]
  double rotational = 0.0;  ///< k_VC,r: rotational over translational stiffness [m^2]
};

/// The distance from a point to the still body's surface.
struct SurfaceDistance {
  double distance = 0.0;  ///< signed, positive outside [m]; plus or minus the band where `known` is false
  Vector3 normal_W =
      Vector3::Zero();  ///< unit, out of the body, in W; zero where `known` is false or nothing is nearest
  bool known = false;   ///< the point lies within the stored band around the surface
};

/// A scene image that `godobject-scenec` compiled: both bodies, solver data and settings. The object is a view of the
/// image's bytes, which the caller owns. Copies cost 2 KiB and view the same bytes. A scene that was never opened holds
/// no solver.
class Scene {
 public:
  /// Alignment of the image [bytes]: it must begin at a multiple of this.
  static constexpr std::size_t kImageAlignment = 64;

  Scene() noexcept;                               ///< a scene that was never opened
  Scene(const Scene& other) noexcept;             ///< a second view of the same bytes
  Scene& operator=(const Scene& other) noexcept;  ///< becomes a view of the other scene's bytes

  /// Checks the whole image once (checksums, layout, every index and every number) and makes `scene` a view of it. The
  /// bytes must stay in place, unchanged, as long as the scene, a copy of it or a god object in it is used.
  ///
  /// kImageLayout: `image` is not aligned, or a section is missing or misplaced. kImageTruncated, kImageForeign,
  /// kImageVersion, kImageChecksum, kImageValue: see Status. After a refusal `scene` is unchanged.
  ///
  /// Cost: one pass over the bytes, about 1 ms per MiB; no allocation. Not for the real-time loop.
  static Status open(std::span<const std::byte> image, Scene& scene) noexcept;

  Solver default_solver() const noexcept;     ///< the scene file's solver
  bool holds(Solver solver) const noexcept;   ///< true if the image has the data that this solver reads
  bool has_friction() const noexcept;         ///< true if the scene file has a friction table
  double voxel_size() const noexcept;         ///< voxel edge of the still body's field [m]
  Vector3 center_of_mass_M() const noexcept;  ///< centre of mass of the moving body, in its mesh frame M [m]

  /// Returns the signed distance from a point p_W, in W [m], to the still body. Cost: one look-up, some 60 ns.
  /// Real-time safe.
  SurfaceDistance distance(const Vector3& p_W) const noexcept;

  /// Returns the gains with which god objects start in this scene.
  Gains gains() const noexcept;
  /// Sets the gains of god objects that are started from now on, in this object and later copies of it; the image and
  /// running sessions do not change. kOutOfRange, and nothing changed: stiffness is not within 1e-12 .. 1e9, damping
  /// not within 0 .. 1e9, or rotational not within 1e-18 .. 1e9.
  Status set_gains(const Gains& gains) noexcept;

  /// Returns the time from one `GodObject::update` to the next with which god objects start in this scene [s].
  double period() const noexcept;
  /// Sets the period of god objects that are started from now on, in this object and later copies of it, as `set_gains`
  /// sets gains. It rules friction by speed (`viscous`) and the filter of `paper`. kOutOfRange, and nothing changed: it
  /// is not within 1.25e-4 .. 1e-2.
  Status set_period(double period) noexcept;

  /// Returns the parts of the image, for this project's own tools: their types are not part of the interface.
  const SceneView& view() const noexcept;
  /// Returns the scene with these parts, for this project's own tools.
  static Scene of(const SceneView& view) noexcept;

 private:
  static constexpr std::size_t kBytes = 2048;
  SceneView& mutable_view() noexcept;

  alignas(64) std::byte storage_[kBytes];
};

}  // namespace godobject
