#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/pipeline/cycle/parameters.h"
#include "godobject/god_object.h"
#include "godobject/report.h"
#include "godobject/scene.h"
#include "godobject/status.h"
#include "toolchain/watch/edge_pairs.h"
#include "toolchain/watch/findings.h"
#include "toolchain/watch/oracle.h"
#include "toolchain/watch/way_out.h"

namespace godobject::watch {

/// Points that rest in one body, and the field of the other body.
struct Direction {
  const Oracle* field = nullptr;     ///< in the frame of the body that carries it: W, or S
  std::vector<Vector3> points = {};  ///< in the frame of the body that carries them: S, or W [m]
  bool points_move = true;           ///< true: points in S and field in W; false: points in W and field in S
  const Oracle* mesh = nullptr;      ///< exact surface of the field's body, in the field's frame; may be null
  double mesh_accuracy = 0.0;        ///< largest depth of the stored surface inside the mesh [m]
};

/// The session that the watch observes. The objects that it points to must outlive the watch.
struct WatchedSession {
  std::vector<Direction> directions = {};
  std::vector<WatchedEdge> moving_edges = {};  ///< in S; with `still_edges` for edge against edge
  std::vector<WatchedEdge> still_edges = {};   ///< in W
  Parameters parameters = {};
  Solver solver = Solver::kContact;
  bool friction = false;
  bool renders_ball = false;  ///< the god object turns with the device, without torque (is_ball)
  double rounding = 0.0;      ///< of coordinates [m]
};

/// One cycle: input, and everything that the session returned.
struct WatchedCycle {
  Pose H_WD;                        ///< body frame B as the device holds it
  Motion velocity_W;                ///< of its origin [m/s, rad/s]
  bool is_valid = true;             ///< false: pose or velocity must be refused
  Status status = Status::kOk;      ///< as returned
  CycleReport report = {};          ///< as returned
  std::span<const Pose> path = {};  ///< poses at the ends of the sub-steps, with `contact` (SubstepPath)
};

/// The nearest known point after a cycle.
struct Nearest {
  double gap = std::numeric_limits<double>::infinity();  ///< [m]
  Vector3 normal_W = Vector3::Zero();                    ///< direction in which the moving body gains distance; unit
};

/// Judges every cycle of a session by properties that any correct solver has (Property). It looks at every point of
/// both directions and at every pair of edges in every sub-step, with look-ups and methods of its own: it shares no
/// code with the solver, the search and the certificate.
///
/// A point is looked up unless its last distance, less the displacement since then times the field's Lipschitz
/// constant, proves it outside. Reference problems are solved by non-negative least squares (least_distance.h) in every
/// kReferenceEvery-th touching cycle. Cost: some 10 ns for each point and sub-step, and a look-up for near points.
class Watch {
 public:
  static constexpr int kReferenceEvery = 8;

  explicit Watch(WatchedSession session);

  /// Judges the next cycle. The first valid one is the session's first cycle after its start.
  void cycle(const WatchedCycle& cycle);

  const Findings& findings() const { return findings_; }
  /// Returns the nearest point at the god object's pose after the last cycle, of those that are near.
  const Nearest& nearest() const { return nearest_; }

 private:
  /// Points of a Direction with a lower bound of each point's distance at the god object's current pose.
  struct Points {
    Direction direction;
    std::vector<double> bound;
    std::vector<bool> is_exact;      ///< the bound is the distance
    std::vector<double> mesh_bound;  ///< the same of the distance from the mesh, whatever the field says
    std::vector<double> mesh_most;   ///< an upper bound of its size
    std::vector<double> in_mesh;     ///< distance from the mesh; NaN: not looked up at this pose
    Vector3 place(const Pose& H_WS, std::size_t i) const;
  };
  /// A touching point at the god object's pose.
  struct Contact {
    Vector3 lever_W;    ///< from the centre of mass [m]
    Vector3 point_S;    ///< [m]
    Vector3 normal_W;   ///< unit, gap grows as the moving body moves along it
    double gap = 0.0;   ///< [m]
    double left = 0.0;  ///< way in that leaves the linear field at the margin; below 0: lost [m]
  };

  void note(Property property, const std::string& what);
  /// Judges value <= bound; NaN is a violation. `words()` describes it.
  template <class Words>
  void judge(Property property, double value, double bound, const Words& words) {
    Tally& tally = findings_[property];
    ++tally.judged;
    if (bound > 0.0) tally.worst = std::max(tally.worst, value / bound);
    if (!(value <= bound)) note(property, words());
  }

  void start(const Pose& H_WD);
  void look_for_overlaps(const Pose& H_WS);
  Sides sides_of(const Pose& H_WS, std::size_t i, std::size_t j, const EdgeDistance& pair) const;
  void follow(const WatchedCycle& cycle);
  void advance(const Pose& H0, const Pose& H1);
  void advance_edges(const Pose& H0, const Pose& H1);
  void push_edge_contacts(const Pose& H_WS, double reach, std::vector<Contact>& contacts) const;
  void follow_mesh(Points& points, std::size_t i, const Vector3& p0, const Vector3& p1);
  void check_mesh(Points& points, std::size_t i, const Vector3& p0, const Vector3& p1);
  bool is_at_device(const WatchedCycle& cycle) const;
  double smallest_at(const Pose& H_WS);
  /// A plane of a field, through `at`.
  struct Plane {
    Vector3 at;
    double distance = 0.0;  ///< of `at` [m]
    Vector3 gradient;
  };
  void push_contact(const Points& points, const Pose& H_WS, std::size_t i, const Vector3& p, const Plane& plane,
                    double reach, std::vector<Contact>& contacts) const;
  /// The places around a point whose planes count: along the axes, or also between them.
  enum class Around { kAxes, kDiagonals };
  std::vector<Contact> contacts_at(const Pose& H_WS, double reach, double around, Around places = Around::kAxes) const;
  std::vector<Touch> touches_at(const Pose& H_WS, double reach) const;
  bool is_clear(const Pose& H0, const Pose& H1, double clearance) const;

  bool check_numbers(const WatchedCycle& cycle);
  void check_wrench(const WatchedCycle& cycle);
  void check_heuristic_damping(const WatchedCycle& cycle);
  void check_report(const WatchedCycle& cycle, bool may_be_inside);
  void check_distance(const WatchedCycle& cycle);
  void check_reference(const WatchedCycle& cycle);
  void check_pushes(const WatchedCycle& cycle, bool between_planes);
  ConeProjection push_at(const WatchedCycle& cycle, Around places) const;
  const Contact* one_normal(const WatchedCycle& cycle, const std::vector<Contact>& contacts, int& count) const;
  void check_friction(const WatchedCycle& cycle, const std::vector<Contact>& contacts);
  void check_damping(const WatchedCycle& cycle, const Contact& contact, double turned);
  void check_work(const WatchedCycle& cycle);
  bool is_between_planes(const WatchedCycle& cycle) const;
  void check_power(const WatchedCycle& cycle);
  void check_damped_load(const WatchedCycle& cycle, const std::vector<Contact>& contacts);
  bool may_touch_the_box(const CycleReport& report) const;
  void check_optimum(const WatchedCycle& cycle);
  void check_lag(const WatchedCycle& cycle);
  void check_progress(const WatchedCycle& cycle);
  std::vector<Vector6> rays_at(const Pose& H_WS, const std::vector<Contact>& contacts, const WatchedCycle& cycle) const;
  Vector6 load(const CycleReport& report) const;

  Vector6 stretch(const Pose& H_WS, const Pose& H_WD) const;
  Pose clamped(const Pose& H_WD) const;

  WatchedSession session_;
  const Parameters& q_;
  double gyration_;
  std::vector<Points> points_;
  bool edges_may_overlap_ = false;         ///< at the current pose: since the start no pose had all edges apart
  bool edges_may_overlap_before_ = false;  ///< the same at the start of the cycle
  std::vector<double> edge_bound_;         ///< lower bounds of all pairs' gaps at the current pose [m]
  Findings findings_;
  Nearest nearest_;

  // state carried from cycle to cycle
  bool started_ = false;
  bool is_inside_ = false;  // the session has not come out yet after a start inside
  Pose H_WS_;               // the god object after the last cycle
  Pose H_WS_before_;        // and before it
  Pose H_WS_last_start_;    // at the start of the last sub-step
  Pose H_WD_last_;          // device pose
  double smallest_ = 0.0;   // distance of all points at the start of the last sub-step [m]
  double travelled_ = 0.0;  // largest displacement of a point in this cycle [m]
  int resting_ = 0;         // cycles for which the device has hardly moved
  int behind_ = 0;          // of these, cycles in a row that ended away from the optimum
  int stuck_ = 0;           // cycles in a row that were cut and hardly moved
  std::int64_t cycle_ = -1;
};

}  // namespace godobject::watch
