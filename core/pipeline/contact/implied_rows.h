#pragma once

#include "core/pipeline/contact/edges/near_edges.h"
#include "core/pipeline/contact/qp/contact_rows.h"
#include "godobject/pose.h"

/// Rows of points that rows of edge pairs imply.
///
/// The row of a point near an edge describes the surface by its tangent plane. The plane leans back while the point
/// comes over the edge, so it holds the point back although the way is free: a body would catch on an edge with each
/// of its sample points. Where a pair of edges holds the body at its margin already, the point needs no row.
namespace godobject::detail {

/// A point that a row holds.
struct HeldPoint {
  Vector3 position_W;  ///< [m]
  double distance;     ///< to the other body [m]
  bool is_feature;     ///< it belongs to the still body
};

/// Tells whether rows of edge pairs imply that of a point. It does not come nearer than the pairs, because the edge of
/// the other body that is nearest to the point is the edge of
///
/// - a pair whose other edge the point lies on, or
/// - two pairs whose other edges bound a face that the point lies on. The edge passes over the face from the one to the
///   other, with the point between.
///
/// H_WS: pose of the moving body; `tolerance`: of places and distances [m]. Only pairs that have a row count, and that
/// are no farther apart than the point by more than `margin` [m]. Cost: some 60 ns for each such pair, and for each two
/// of them. Real-time safe.
bool is_implied(const HeldPoint& point, const EdgeContacts& edges, const NearEdges& near, const Pose& H_WS,
                const ContactRows& rows, double margin, double tolerance) noexcept;

}  // namespace godobject::detail
