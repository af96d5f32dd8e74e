#pragma once

#include <cstddef>
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
  bool first_inside = false;   ///< `on_first` lies inside the wedge of the second edge, beside no end of that edge
  bool second_inside = false;  ///< `on_second` lies inside the wedge of the first edge, beside no end of that edge
  bool end_of_first = false;   ///< `on_first` is an end
  bool end_of_second = false;  ///< `on_second` is an end

  /// Returns the distance of the nearest points [m].
  double length() const { return (on_first - on_second).norm(); }
  /// Returns the gap of edges that overlap [m].
  double overlap() const { return gap - 2.0 * length(); }
  /// Tells whether each edge lies inside the wedge of the other, beside no end, as where two solids overlap.
  bool in_both_wedges() const { return first_inside && second_inside; }
  /// Tells whether one of them does.
  bool in_a_wedge() const { return first_inside || second_inside; }
};

/// Returns the gap of two edges: the least of the distance at the common perpendicular and those of the four ends.
EdgeDistance distance_of(const WatchedEdge& first, const WatchedEdge& second);

/// Sides of two near edges, by their wedges.
enum class Sides {
  kApart,
  kOverlap,  ///< each lies in the wedge of the other, or an end of one does and no other edge is nearer to that end
  kAtAFace,  ///< another point of one lies inside the wedge of the other: a face is nearer to it than the edge
};

/// Returns the sides of the edge `moving[i]`, with the body at H_WS, and the edge `still[j]`. `distance`: theirs.
/// `moving`: all edges of the moving body, in S; `still`: all of the still body.
Sides sides_of(const std::vector<WatchedEdge>& moving, const Pose& H_WS, const std::vector<WatchedEdge>& still,
               std::size_t i, std::size_t j, const EdgeDistance& distance);

/// Tells whether the gap of an edge that moves from `from` to `to`, each point straight, to the edge `other` falls
/// below `limit` [m] at some time. Times are halved until the gaps at both ends prove the answer or the ends move by
/// less than `resolution` [m].
bool falls_below(const WatchedEdge& from, const WatchedEdge& to, const WatchedEdge& other, double limit,
                 double resolution);

}  // namespace godobject::watch
