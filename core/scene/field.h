#pragma once

#include <concepts>

#include "core/spatial/vector.h"

namespace godobject {

/// The still body's signed distance at a point of W, positive outside.
struct FieldSample {
  double distance = 0.0;               ///< phi [m]; +band or -band where `known` is false
  Vector3 gradient = Vector3::Zero();  ///< grad phi in W, not normalised; 0 where `known` is false
  bool known = false;                  ///< the point lies within the stored band
  double clearance = 0.0;              ///< no point nearer than this has a distance <= 0; 0 where none is known [m]
};

/// What the paper's step #1 reads (its Figure 3 g): the layer of the voxel around a point. Voxels are centred at the
/// nodes.
struct LayerSample {
  int layer = 0;                        ///< v: 0 on the surface, negative outside, positive inside
  Vector3 to_center = Vector3::Zero();  ///< e: from the point to the voxel's centre C, in W [m]
};

/// A still body as steps #1-#7 see it: the compiled `Voxelmap`, or an analytic world in tests.
///
/// `sample(p)`          distance, gradient and clearance at p_W.
/// `layer(p)`           the paper's integer layer at p_W.
/// `lower_bound(c, r)`  no point x with |x - c| <= r is nearer to the surface: sample(x).distance is not below it, or
/// is
///                      the band. May exceed the band, and may be loose; negative infinity wherever no bound of at
///                      least 0 is known.
/// `lipschitz()`        L >= 1: for any points p and x, sample(x).clearance is at least
///                      min(sample(p).clearance - |x - p|, band) / L.
/// `voxel_size()`       s [m];  `band()`  distances beyond it are not known [m].
template <class F>
concept DistanceField = requires(const F& field, const Vector3& p, double r) {
  { field.sample(p) }
  noexcept->std::same_as<FieldSample>;
  { field.layer(p) }
  noexcept->std::same_as<LayerSample>;
  { field.lower_bound(p, r) }
  noexcept->std::same_as<double>;
  { field.lipschitz() }
  noexcept->std::same_as<double>;
  { field.voxel_size() }
  noexcept->std::same_as<double>;
  { field.band() }
  noexcept->std::same_as<double>;
};

}  // namespace godobject
