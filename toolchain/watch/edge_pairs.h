#pragma once

#include <vector>

#include "core/scene/sharp_edges.h"
#include "godobject/pose.h"

namespace godobject::watch {

/// A convex sharp edge of a body, in the body's frame or in W.
struct WatchedEdge {
  Vector3 end[2] = {Vector3::Zero(), Vector3::Zero()};     ///< [m]
  Vector3 normal[2] = {Vector3::Zero(), Vector3::Zero()};  ///< outward unit normals of its faces; 0 on a sheet
  double radius = 0.0;                                     ///< of a sheet: half its thickness [m]

  /// Returns the edge of a body at pose H.
  WatchedEdge at(const Pose& H) const;
};

/// Returns the sharp edges of an image.
std::vector<WatchedEdge> watched_edges(const SharpEdges& sharp);

/// The nearest points of two edges. It shares no code with the core's edge_gap.
struct EdgeDistance {
  double gap = 0.0;                     ///< between the surfaces [m]
  Vector3 normal = Vector3::Zero();     ///< unit: the gap grows as the first edge moves along it
  Vector3 on_first = Vector3::Zero();   ///< [m]
  Vector3 on_second = Vector3::Zero();  ///< [m]
  bool over_a_face = false;             ///< a face beside one of the edges is nearer to the other edge
  double above_a_face = 0.0;            ///< largest cosine between a face's normal and the direction to the other edge
  double askew = 0.0;                   ///< largest cosine between an edge and that direction; 0 if no point is an end

  /// Tells whether each edge lies inside the wedge of the other, beside no end, as where two solids overlap.
  bool in_both_wedges() const { return above_a_face < 0.0 && askew <= 1e-3; }
};

/// Returns the gap of two edges: the least of the distance at the common perpendicular and those of the four ends.
EdgeDistance distance_of(const WatchedEdge& first, const WatchedEdge& second);

/// Tells whether the gap of an edge that moves from `from` to `to`, each point straight, to the edge `other` falls
/// below `limit` [m] at some time. Times are halved until the gaps at both ends prove the answer or the ends move by
/// less than `resolution` [m].
bool falls_below(const WatchedEdge& from, const WatchedEdge& to, const WatchedEdge& other, double limit,
                 double resolution);

}  // namespace godobject::watch
