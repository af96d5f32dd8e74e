#include "toolchain/watch/watch.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "toolchain/watch/rotation_vector.h"

namespace godobject::watch {
namespace {

constexpr double kReach = 0.125;  // distances above it count as it in a report [voxels] (CycleReport::penetration)
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Returns unit vectors to both sides along the axes; with `diagonals` also those to the edges and corners of a cube.
std::span<const Vector3> directions_to(bool diagonals) {
  static const std::vector<Vector3> all = [] {
    std::vector<Vector3> sorted;
    for (int axis = 0; axis < 3; ++axis) {
      sorted.emplace_back(Vector3::Unit(axis));
      sorted.emplace_back(-Vector3::Unit(axis));
    }
    for (int i = 0; i < 27; ++i) {
      const Vector3 to_cube(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (to_cube.squaredNorm() > 1.0) sorted.push_back(to_cube.normalized());
    }
    return sorted;
  }();
  return std::span(all).first(diagonals ? all.size() : 6);
}

/// Returns the gradient of the distance by differences over `step` to either side.
Vector3 differences_at(const Oracle& field, const Vector3& p, double step) {
  Vector3 slope;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 to_side = step * Vector3::Unit(axis);
    slope[axis] = (field.distance(p + to_side) - field.distance(p - to_side)) / (2.0 * step);
  }
  return slope;
}

}  // namespace

Vector3 Watch::Points::place(const Pose& H_WS, std::size_t i) const {
  const Vector3& p = direction.points[i];
  return direction.points_move ? Vector3(H_WS * p)
                               : Vector3(H_WS.rotation.conjugate()._transformVector(p - H_WS.translation));
}

Watch::Watch(WatchedSession session)
    : session_(std::move(session)),
      q_(session_.parameters),
      gyration_(std::sqrt(q_.coupling_rotation / q_.coupling_translation)) {
  for (Direction& direction : session_.directions) {
    Points points{std::move(direction), {}, {}, {}, {}, {}};
    points.bound.assign(points.direction.points.size(), 0.0);
    points.is_exact.assign(points.direction.points.size(), false);
    points.mesh_bound.assign(points.direction.points.size(), 0.0);
    points.mesh_most.assign(points.direction.points.size(), std::numeric_limits<double>::infinity());
    points.in_mesh.assign(points.direction.points.size(), kUnknown);
    points_.push_back(std::move(points));
  }
  edge_bound_.assign(session_.moving_edges.size() * session_.still_edges.size(), -1.0);
}

void Watch::note(Property property, const std::string& what) {
  Tally& tally = findings_[property];
  ++tally.violated;
  if (tally.first.empty()) tally.first = fmt::format("cycle {}: {}", cycle_, what);
}

Vector6 Watch::stretch(const Pose& H_WS, const Pose& H_WD) const {
  const Quaternion back = H_WS.rotation.conjugate();
  return stacked(
      back._transformVector(H_WD.translation - H_WS.translation),
      session_.renders_ball ? Vector3(Vector3::Zero()) : Vector3(gyration_ * rotation_vector(back * H_WD.rotation)));
}

Pose Watch::clamped(const Pose& H_WD) const {
  Pose followed = H_WD;
  if (!q_.workspace.limited) return followed;
  followed.translation = H_WD.translation.cwiseMax(q_.workspace.low).cwiseMin(q_.workspace.high);
  return followed;
}

void Watch::cycle(const WatchedCycle& cycle) {
  ++cycle_;
  ++findings_.cycles;
  if (!check_numbers(cycle)) return;
  const bool is_contact = session_.solver == Solver::kContact;
  const Pose H_WD = clamped(cycle.H_WD);
  if (q_.workspace.limited && !started_ && H_WD.translation != cycle.H_WD.translation) {
    // nothing is rendered until the device has been in the box
    judge(Property::kReport, cycle.report.force.total_W.force.norm(), 0.0, [] { return "force before the start"; });
    return;
  }
  const bool is_first = !started_;
  if (is_first) start(H_WD);
  resting_ = (cycle.H_WD.translation - H_WD_last_.translation).norm() < 0.01 * q_.voxel_size &&
                     rotation_vector(cycle.H_WD.rotation.conjugate() * H_WD_last_.rotation).norm() * q_.mass.radius <
                         0.01 * q_.voxel_size
                 ? resting_ + 1
                 : 0;
  if (cycle.report.out_of_work) resting_ = 0;
  H_WS_before_ = H_WS_;
  const bool was_inside = is_inside_;
  is_inside_ = is_contact && cycle.report.outcome == Outcome::kStartInside;
  edges_may_overlap_before_ = edges_may_overlap_;
  if (is_contact) {
    follow(cycle);
    look_for_overlaps(cycle.report.H_WS);
  }
  H_WS_ = cycle.report.H_WS;
  H_WD_last_ = cycle.H_WD;
  check_wrench(cycle);
  if (!is_contact) return;
  if (cycle.report.contacts > 0) ++findings_.touching;
  check_report(cycle, is_first || was_inside);
  if (is_inside_ || was_inside) return;
  check_distance(cycle);
  check_reference(cycle);
}

void Watch::start(const Pose& H_WD) {
  started_ = true;
  H_WS_ = H_WD;
  H_WD_last_ = H_WD;
  edges_may_overlap_ = true;
  look_for_overlaps(H_WS_);
}

/// Finds out whether edges may overlap at a pose of the god object. Once all are apart, none may. Edges that are
/// farther apart than a voxel may lie in each other's wedges although their bodies are apart. While a point of one edge
/// lies in the wedge of another a pair may still overlap: past an end no pair tells it. Edges may overlap after all
/// points are outside.
void Watch::look_for_overlaps(const Pose& H_WS) {
  if (is_inside_) edges_may_overlap_ = true;
  if (!edges_may_overlap_) return;
  for (const WatchedEdge& moving : session_.moving_edges) {
    const WatchedEdge edge = moving.at(H_WS);
    for (const WatchedEdge& other : session_.still_edges) {
      const EdgeDistance pair = distance_of(edge, other);
      if (pair.gap < 0.0 || (pair.in_a_wedge() && pair.length() < q_.voxel_size)) return;  // or within a sheet
    }
  }
  edges_may_overlap_ = false;
}

Sides Watch::sides_of(const Pose& H_WS, std::size_t i, std::size_t j, const EdgeDistance& pair) const {
  if (pair.length() >= q_.voxel_size) return Sides::kApart;
  return watch::sides_of(session_.moving_edges, H_WS, session_.still_edges, i, j, pair);
}

bool Watch::check_numbers(const WatchedCycle& cycle) {
  const CycleReport& report = cycle.report;
  const bool is_ok = cycle.status == Status::kOk;
  judge(Property::kStatus, is_ok == cycle.is_valid ? 0.0 : 1.0, 0.0, [&] {
    return cycle.is_valid ? fmt::format("a valid input was refused: {}", describe(cycle.status))
                          : std::string("an invalid input was accepted");
  });
  if (!is_ok) {
    const double force = report.force.total_W.force.norm() + report.force.total_W.torque.norm() +
                         report.force.spring_W.force.norm() + report.force.spring_W.torque.norm();
    judge(Property::kStatus, force, 0.0, [&] { return fmt::format("{} N or Nm after a refusal", force); });
    judge(Property::kStatus, report.outcome == Outcome::kBadInput ? 0.0 : 1.0, 0.0,
          [&] { return fmt::format("outcome {} after a refusal", name(report.outcome)); });
    if (started_) {
      judge(Property::kStatus, report.H_WS == H_WS_ ? 0.0 : 1.0, 0.0,
            [] { return "the refused pose moved the god object"; });
    }
    return false;
  }
  const bool finite = report.H_WS.is_finite() && report.force.total_W.force.allFinite() &&
                      report.force.total_W.torque.allFinite() && report.force.spring_W.force.allFinite() &&
                      report.force.spring_W.torque.allFinite();
  judge(Property::kFinite, finite ? std::fabs(report.H_WS.rotation.norm() - 1.0) : 1.0, 1e-9,
        [&] { return finite ? "the rotation is not of unit length" : "not finite"; });
  return cycle.is_valid && finite;
}

/// Follows the sub-steps: every point's chord in each of them.
void Watch::follow(const WatchedCycle& cycle) {
  travelled_ = 0.0;
  smallest_ = std::numeric_limits<double>::infinity();
  Pose here = H_WS_;
  H_WS_last_start_ = here;
  for (const Pose& next : cycle.path) {
    H_WS_last_start_ = here;
    look_for_overlaps(here);
    advance(here, next);
    here = next;
  }
  if (cycle.path.empty()) smallest_ = smallest_at(here);
  judge(Property::kReport, here == cycle.report.H_WS ? 0.0 : 1.0, 0.0,
        [] { return "the sub-steps do not end at the god object's pose"; });
  if (q_.workspace.limited) {
    const Vector3& p = cycle.report.H_WS.translation;
    judge(Property::kWorkspace, (p - p.cwiseMax(q_.workspace.low).cwiseMin(q_.workspace.high)).norm(), 0.0,
          [] { return "outside"; });
  }
}

void Watch::advance(const Pose& H0, const Pose& H1) {
  const double threshold = -1e-6 * q_.voxel_size - session_.rounding;
  const double resolution = 1e-2 * q_.voxel_size;
  const double near = 0.2 * q_.voxel_size;
  smallest_ = std::numeric_limits<double>::infinity();
  for (Points& points : points_) {
    const Oracle& field = *points.direction.field;
    const double lipschitz = field.lipschitz();
    for (std::size_t i = 0; i < points.bound.size(); ++i) {
      double& bound = points.bound[i];
      const Vector3 p0 = points.place(H0, i);
      const Vector3 p1 = points.place(H1, i);
      const double displacement = (p1 - p0).norm();
      travelled_ = std::max(travelled_, displacement);
      if (points.direction.mesh != nullptr) follow_mesh(points, i, p0, p1);
      const double may_lose = (1.0 + 1e-9) * lipschitz * displacement + session_.rounding;
      if (bound > may_lose + near) {
        bound -= may_lose;
        points.is_exact[i] = false;
        continue;
      }
      const double at_begin = points.is_exact[i] ? bound : field.distance(p0);
      smallest_ = std::min(smallest_, at_begin);
      bound = field.distance(p1);
      points.is_exact[i] = true;
      if (is_inside_) continue;
      judge(Property::kNoCrossing, falls_below(field, {p0, p1, at_begin, bound}, threshold, resolution) ? 1.0 : 0.0,
            0.0, [&] { return fmt::format("point {} from {} m to {} m", i, at_begin, bound); });
    }
  }
  advance_edges(H0, H1);
}

/// No edge of the moving body may meet one of the still body. Edges that overlap at the start may come out.
void Watch::advance_edges(const Pose& H0, const Pose& H1) {
  const double near = (edges_may_overlap_ ? 1.0 : 0.2) * q_.voxel_size;
  for (std::size_t i = 0; i < session_.moving_edges.size(); ++i) {
    const WatchedEdge from = session_.moving_edges[i].at(H0);
    const WatchedEdge to = session_.moving_edges[i].at(H1);
    const double displacement = std::max((to.end[0] - from.end[0]).norm(), (to.end[1] - from.end[1]).norm());
    travelled_ = std::max(travelled_, displacement);
    for (std::size_t j = 0; j < session_.still_edges.size(); ++j) {
      double& bound = edge_bound_[i * session_.still_edges.size() + j];
      const double may_lose = (1.0 + 1e-9) * displacement + session_.rounding;
      if (bound > may_lose + near) {
        bound -= may_lose;
        continue;
      }
      const WatchedEdge& other = session_.still_edges[j];
      const EdgeDistance begin = distance_of(from, other);
      const double at_begin = begin.gap;
      bound = std::max(0.0, distance_of(to, other).gap);
      if (is_inside_) continue;
      const Sides sides = edges_may_overlap_ ? sides_of(H0, i, j, begin) : Sides::kApart;
      if (sides != Sides::kAtAFace)
        smallest_ = std::min(smallest_, sides == Sides::kOverlap ? begin.overlap() : at_begin);
      const bool in_a_sheet = edges_may_overlap_ && at_begin < 0.0;
      if (in_a_sheet || sides != Sides::kApart) continue;
      const double resolution = 1e-6 * q_.voxel_size;
      judge(Property::kNoCrossing, falls_below(from, to, other, 0.0, resolution) ? 1.0 : 0.0, 0.0,
            [&] { return fmt::format("edge {} meets edge {} of the still body, from {} m", i, j, at_begin); });
    }
  }
}

/// Looks near points up in the mesh, with bounds of their own: a field that lacks a wall calls them far.
void Watch::follow_mesh(Points& points, std::size_t i, const Vector3& p0, const Vector3& p1) {
  double& bound = points.mesh_bound[i];
  const double may_lose = (1.0 + 1e-9) * (p1 - p0).norm() + session_.rounding;
  if (bound > may_lose + 0.2 * q_.voxel_size || is_inside_) {
    bound = std::max(0.0, bound - may_lose);
    points.mesh_most[i] += may_lose;
    points.in_mesh[i] = kUnknown;
    return;
  }
  check_mesh(points, i, p0, p1);
  bound = points.in_mesh[i];
}

/// The stored surface may lie inside the mesh by its accuracy, and no point deeper.
void Watch::check_mesh(Points& points, std::size_t i, const Vector3& p0, const Vector3& p1) {
  const Oracle& mesh = *points.direction.mesh;
  double& in_mesh = points.in_mesh[i];
  const double at_begin = std::isnan(in_mesh) ? mesh.distance_within(p0, points.mesh_most[i]) : in_mesh;
  const double at_end = mesh.distance_within(p1, std::fabs(at_begin) + mesh.lipschitz() * (p1 - p0).norm());
  const Chord chord{p0, p1, at_begin, at_end};
  in_mesh = chord.at_end;
  points.mesh_most[i] = std::fabs(at_end);
  const double most = points.direction.mesh_accuracy + 1e-6 * q_.voxel_size + session_.rounding;
  judge(Property::kMesh, falls_below(mesh, chord, -most, 1e-2 * q_.voxel_size) ? 1.0 : 0.0, 0.0, [&] {
    return fmt::format("from {} m to {} m outside of the mesh, by more than {} m", chord.at_begin, chord.at_end, most);
  });
  const double depth = -std::min(chord.at_begin, chord.at_end);
  findings_[Property::kMesh].worst = std::max(findings_[Property::kMesh].worst, depth / most);
}

double Watch::smallest_at(const Pose& H_WS) {
  double smallest = std::numeric_limits<double>::infinity();
  for (Points& points : points_) {
    for (std::size_t i = 0; i < points.bound.size(); ++i) {
      if (points.bound[i] > 0.2 * q_.voxel_size) continue;
      points.bound[i] = points.direction.field->distance(points.place(H_WS, i));
      points.is_exact[i] = true;
      smallest = std::min(smallest, points.bound[i]);
    }
  }
  for (const WatchedEdge& edge : session_.moving_edges) {
    const WatchedEdge here = edge.at(H_WS);
    for (const WatchedEdge& other : session_.still_edges) smallest = std::min(smallest, distance_of(here, other).gap);
  }
  return smallest;
}

/// Appends the contact of a point, given in the field's frame, with the plane through `at`.
void Watch::push_contact(const Points& points, const Pose& H_WS, std::size_t i, const Vector3& p, const Plane& plane,
                         double reach, std::vector<Contact>& contacts) const {
  const auto& [at, distance, gradient] = plane;
  const double steepness = gradient.norm();
  if (!(steepness > 1e-3)) return;
  const double gap = (distance + gradient.dot(p - at)) / steepness;
  const double left = gap - q_.margin / steepness;
  if (!(gap <= reach || left <= 0.0)) return;  // a flat field has the margin far off the surface
  Contact contact;
  contact.gap = gap;
  contact.left = left;
  if (points.direction.points_move) {
    contact.point_S = points.direction.points[i];
    contact.lever_W = p - H_WS.translation;
    contact.normal_W = gradient / steepness;
  } else {
    contact.point_S = p;
    contact.lever_W = points.direction.points[i] - H_WS.translation;
    contact.normal_W = H_WS.rotation._transformVector(-gradient / steepness);
  }
  contacts.push_back(contact);
}

/// Appends the contacts of pairs of edges within `reach`.
void Watch::push_edge_contacts(const Pose& H_WS, double reach, std::vector<Contact>& contacts) const {
  for (std::size_t i = 0; i < session_.moving_edges.size(); ++i) {
    const WatchedEdge edge = session_.moving_edges[i].at(H_WS);
    for (std::size_t j = 0; j < session_.still_edges.size(); ++j) {
      if (edge_bound_[i * session_.still_edges.size() + j] > reach + travelled_) continue;
      EdgeDistance pair = distance_of(edge, session_.still_edges[j]);
      const Sides sides = edges_may_overlap_before_ ? sides_of(H_WS, i, j, pair) : Sides::kApart;
      if (sides == Sides::kAtAFace) continue;
      if (sides == Sides::kOverlap) {
        pair.gap = pair.overlap();
        pair.normal = -pair.normal;
      }
      if (!(pair.gap <= reach)) continue;
      Contact contact;
      contact.gap = pair.gap;
      contact.left = pair.gap - q_.margin;
      contact.point_S = H_WS.rotation.conjugate()._transformVector(pair.on_first - H_WS.translation);
      contact.lever_W = pair.on_first - H_WS.translation;
      contact.normal_W = pair.normal;
      contacts.push_back(contact);
    }
  }
}

/// Returns the planes of the surface at the points within `reach`, and those between edges. At an edge or in a valley a
/// point has several: those of the places around it, too. Where the field passes from one representation to another its
/// gradient is not the slope of its values, which hold the body as well: with diagonals both count.
std::vector<Watch::Contact> Watch::contacts_at(const Pose& H_WS, double reach, double around, Around places) const {
  std::vector<Contact> contacts;
  const bool is_thorough = places == Around::kDiagonals;
  for (const Points& points : points_) {
    const Oracle& field = *points.direction.field;
    for (std::size_t i = 0; i < points.bound.size(); ++i) {
      if (points.bound[i] > reach + field.lipschitz() * travelled_) continue;
      const Vector3 p = points.place(H_WS, i);
      const Slope here = field.slope(p);
      if (!(here.distance <= reach)) continue;
      const std::size_t first = contacts.size();
      const auto push = [&](const Plane& plane) {
        const std::size_t count = contacts.size();
        push_contact(points, H_WS, i, p, plane, reach, contacts);
        if (contacts.size() == count) return;
        const auto is_same = [&](const Contact& c) { return (c.normal_W - contacts.back().normal_W).norm() <= 1e-6; };
        const auto begin = contacts.begin() + static_cast<std::ptrdiff_t>(first);
        if (std::any_of(begin, contacts.end() - 1, is_same)) contacts.pop_back();
      };
      const auto push_at = [&](const Vector3& at, const Slope& slope) {
        push({at, slope.distance, slope.gradient});
        if (is_thorough) push({at, slope.distance, differences_at(field, at, 0.01 * q_.voxel_size)});
      };
      push_at(p, here);
      for (const double radius : {3.0 * q_.margin, around}) {
        if (radius > around) continue;
        for (const Vector3& to_place : directions_to(is_thorough)) {
          const Vector3 at = p + radius * to_place;
          push_at(at, field.slope(at));
        }
      }
    }
  }
  push_edge_contacts(H_WS, reach, contacts);
  return contacts;
}

std::vector<Touch> Watch::touches_at(const Pose& H_WS, double reach) const {
  std::vector<Touch> touches;
  for (const Contact& contact : contacts_at(H_WS, reach, 0.05 * q_.voxel_size)) {
    touches.push_back({contact.point_S, H_WS.rotation.conjugate()._transformVector(contact.normal_W), contact.left});
  }
  return touches;
}

/// Tells whether the god object is at the device, but for rounding and the solver's tolerance of a thousandth of a
/// margin.
bool Watch::is_at_device(const WatchedCycle& cycle) const {
  const Pose H_WD = clamped(cycle.H_WD);
  const double tolerance = 2e-3 * q_.margin + 2e-6 * q_.voxel_size + session_.rounding;
  return (cycle.report.H_WS.translation - H_WD.translation).norm() <= tolerance &&
         gyration_ * rotation_vector(H_WD.rotation.conjugate() * cycle.report.H_WS.rotation).norm() <= tolerance;
}

/// `may_be_inside`: the session begins, or has not come out yet.
void Watch::check_report(const WatchedCycle& cycle, bool may_be_inside) {
  const CycleReport& report = cycle.report;
  const auto check = [&](bool holds, const char* what) {
    judge(Property::kReport, holds ? 0.0 : 1.0, 0.0, [&] { return what; });
  };
  if (report.outcome == Outcome::kFree) {
    check(report.contacts == 0, "free with contacts");
    check(is_at_device(cycle), "free, but not at the device");
  }
  if (report.outcome == Outcome::kContact) check(report.contacts > 0, "contact without a row that carries force");
  check((report.outcome == Outcome::kOverflow) <= (report.dropped > 0), "overflow without a dropped point");
  if (is_inside_) {
    check(may_be_inside, "start_inside after it was outside");
    check(report.out_of_work || smallest_ <= 1e-6 * q_.voxel_size + session_.rounding,
          "start_inside with every point outside");
    return;
  }
  const double shortest = kReach * q_.voxel_size;
  const double tolerance = 1e-5 * q_.voxel_size + session_.rounding;
  const double expected = -std::min(smallest_, shortest);
  const bool is_budgeted = q_.point_budget > 0 && report.outcome == Outcome::kFree;  // bounds prove the way free
  // then a sub-step may look at some of the points, or end before it has seen all
  const bool has_work_budget = q_.work_budget != WorkMeter::kUnlimited;
  if (report.dropped > 0 || is_budgeted || has_work_budget) {  // points without a look-up may be nearer
    return judge(Property::kReport, report.penetration - expected, tolerance, [&] {
      return fmt::format("penetration {} m, the smallest distance of all points is {} m", report.penetration,
                         smallest_);
    });
  }
  judge(Property::kReport, std::fabs(report.penetration - expected), tolerance, [&] {
    return fmt::format("penetration {} m, the smallest distance of all points is {} m", report.penetration, smallest_);
  });
}

/// Tells whether every point's chord from H0 to H1 keeps the clearance.
bool Watch::is_clear(const Pose& H0, const Pose& H1, double clearance) const {
  for (const Points& points : points_) {
    const Oracle& field = *points.direction.field;
    for (std::size_t i = 0; i < points.bound.size(); ++i) {
      const Vector3 p0 = points.place(H0, i);
      const Vector3 p1 = points.place(H1, i);
      const Chord chord{p0, p1, field.distance(p0), field.distance(p1)};
      if (falls_below(field, chord, clearance, 1e-2 * q_.voxel_size)) return false;
    }
  }
  for (const WatchedEdge& edge : session_.moving_edges) {
    const WatchedEdge from = edge.at(H0);
    const WatchedEdge to = edge.at(H1);
    for (const WatchedEdge& other : session_.still_edges) {
      if (falls_below(from, to, other, clearance, 1e-2 * q_.voxel_size)) return false;
    }
  }
  return true;
}

}  // namespace godobject::watch
