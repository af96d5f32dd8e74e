#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/pipeline/contact/arrival.h"
#include "core/pipeline/contact/certificate.h"
#include "core/pipeline/contact/contact_memory.h"
#include "core/pipeline/contact/contact_result.h"
#include "core/pipeline/contact/contact_scene.h"
#include "core/pipeline/contact/edge_certificate.h"
#include "core/pipeline/contact/edge_rows.h"
#include "core/pipeline/contact/even_pressure.h"
#include "core/pipeline/contact/implied_rows.h"
#include "core/pipeline/contact/motion_share.h"
#include "core/pipeline/contact/overlap.h"
#include "core/pipeline/contact/qp/contact_forces.h"
#include "core/pipeline/contact/second_look.h"
#include "core/pipeline/contact/substep_limits.h"
#include "core/pipeline/contact/surroundings.h"
#include "core/pipeline/cycle/state.h"
#include "core/pipeline/cycle/step_times.h"
#include "core/pipeline/cycle/unconstrained_motion.h"
#include "core/pipeline/cycle/workspace_limit.h"

namespace godobject::detail {

/// The sub-steps of one cycle of `contact`: the functions that `contact_cycle` calls in this order, and the variables
/// that they share. Real-time safe.
template <bool kFriction, DistanceField Field, DistanceField BodyField>
class ContactSubsteps {
 public:
  ContactSubsteps(const ContactScene<Field, BodyField>& scene, const CycleInput& input, const ProxyState& state,
                  ContactMemory& memory, StepTimes* times) noexcept
      : scene_(scene),
        lengths_(scene.lengths),
        input_(input),
        state_(state),
        memory_(memory),
        rows_(memory.workspace.rows),
        step_(memory.workspace.step),
        times_(times),
        wanted_(unconstrained_motion(state.H_WS, input.H_WD)),
        last_motion_(memory.last_step.motion),
        friction_(scene.friction),
        work_(memory.work),
        longest_search_radius_(std::max(memory.share.radius() * scene.longest_search_radius,
                                        lengths_.search_radius_for(0.0, scene.longest_search_radius))) {
    work_.start(scene.parameters->work_budget);
    work_.add(Work::kCycle);
    friction_.face_thickness = lengths_.margin;
    step_ = memory.last_step;
    memory.path.clear();
    result_.H_WS = state.H_WS;
    result_.inside = state.inside;
  }

  /// Begins a sub-step: computes the unconstrained motion from the god object to the device, #3.
  void begin() noexcept {
    H0_ = result_.H_WS;
    work_before_ = work_.spent();
    is_constrained_ = false;
    refills_left_ = kMostRefills;
    regain_ = 1.0;
    is_first_ = result_.substeps + free_substeps_ == 0;
    free_ = is_first_ ? wanted_ : unconstrained_motion(H0_, input_.H_WD);
    free_displacement_ = travel(lengths_.sphere, free_);
    if (kFriction && input_.outside) friction_.beyond = beyond();
    if (!is_first_) end(times_, &StepTimes::solve_ns);
    memory_.search.odometer.move_to(H0_, lengths_.sphere);
  }

  /// Tells whether earlier searches prove the motion to the device free; then moves the god object there.
  bool is_known_free() noexcept {
    if (!is_clear_to_device()) return false;
    follow_device();
    result_.inside = false;
    return true;
  }

  /// Finds the near points of both directions, the near edges, and their rows, #1.
  void find_surroundings() noexcept {
    work_.add(Work::kSubstep);
    KeptSearch& kept = memory_.kept;
    // `learn` has compared the poses already; lists of another pose would let the body cross
    goes_on_ = is_first_ && kept.goes_on && kept.H_WS == H0_;
    had_all_points_ = goes_on_ && kept.has_all;
    if (goes_on_) {
      search_radius_ = kept.radius;
      around_ = kept.around;
    } else {
      if (is_first_) {
        search_radius_ = first_search_radius(memory_, state_, input_.H_WD, lengths_, longest_search_radius_);
      }
      around_ = Surroundings{.free_displacement = search_radius_};
      rows_.count = 0;
      memory_.workspace.samples.clear();
      memory_.workspace.features.clear();
      memory_.search.start_over();
      kept.has_samples = kept.has_all = false;
    }
    if (scene_.has_features()) H0_features_ = FeatureDirection::pose(H0_, scene_.features.origin_W);
    memory_.workspace.edges.count = 0;
    has_all_points_ = had_all_points_ || (find_samples() && find_features());
    kept = {false, kept.has_samples, has_all_points_, H0_, search_radius_, around_};
    // a point inside has clearance 0, so it is near; both directions decide whether the first pose penetrates
    const bool may_be_inside = result_.inside || (is_first_ && !state_.started);
    result_.inside = may_be_inside && (around_.smallest <= 0.0 || !has_all_points_);
    memory_.first_search_ended |= has_all_points_;
    if (has_all_points_) find_edges();
    has_surroundings_ = has_all_points_ && !work_.is_spent();
    if ((around_.lacks_rows || had_all_points_) && !work_.is_spent()) select_again();
    end(times_, &StepTimes::step1_ns);
    result_.smallest = around_.smallest;
    result_.dropped = around_.unlisted + around_.unseen;
  }

  /// Tells whether the budget of work is spent: then the cycle ends where the last sub-step ended. The god object may
  /// lag, with the forces of the last motion. Nothing is known of the surroundings.
  bool is_out_of_work() noexcept {
    if (!work_.is_spent()) return false;
    if (is_constrained_) return_to_last_step();
    step_.motion = whole_;
    step_.follows = false;
    move_to(H0_);
    result_.cut = result_.out_of_work = true;
    return true;
  }

  /// Tells whether no point is near during the motion to the device; then moves the god object there.
  bool is_free() noexcept {
    const ContactWorkspace& near = memory_.workspace;
    const bool none_near = near.samples.count + near.features.count + near.edges.count == 0;
    ++(none_near ? free_substeps_ : result_.substeps);
    if (!none_near) return false;
    if (!is_clear_to_device() && allowed_share(free_, around_, search_radius_, lengths_, false) != 1.0) return false;
    follow_device();
    return true;
  }

  /// Computes the motion nearest to that to the device that all rows and the workspace allow, #4. Then rows that
  /// edge pairs imply are dropped, and rows that found no room are added, if the motion would violate them.
  void constrain() noexcept {
    if (!is_first_) memory_.workspace.last_step = step_;
    is_constrained_ = true;
    work_.set_aside(memory_.share.is_least() ? work_.budget() / 3 : std::min(memory_.attempt_work, work_.budget() / 4));
    if constexpr (kFriction) {
      friction_.patches = patches_of(step_, memory_.workspace.samples, lengths_, work_);
    }
    solve_without_implied_rows();
    work_.set_aside(0);
  }

  /// Tells whether after a start inside no motion meets all rows, or no work is left for the way out. Then the god
  /// object takes the way out that misses them least, but stays near the device. Where the field has no gradient it
  /// goes to the device, without force.
  bool is_lost() noexcept {
    if (!result_.inside || !(around_.swallowed || step_.infeasible)) return false;
    if (!around_.swallowed) {
      work_.add(Work::kScan, 25 * (memory_.workspace.samples.count + memory_.workspace.features.count));
      if (is_out_of_work()) return true;
    }
    step_ = ConstrainedStep{};
    move_to(around_.swallowed ? input_.H_WD : way_out());
    result_.cut = false;
    return true;
  }

  /// Tries the motion, or a share of it, until the certificate holds. Sets `motion_` and `H1_`.
  void certify() noexcept {
    share_ = MotionShare(allowed_share(step_.motion, around_, search_radius_, lengths_, rows_.count > 0));
    if (memory_.share.is_least()) share_.forgo_looks();
    limit_motion();
    extensions_left_ = kMostExtensions;
    at_sample_ = at_feature_ = Obstacle{};
    at_edge_ = EdgeObstacle{};
    is_outdated_ = false;
    may_look_at_end_ = true;
    led_away_ = false;
    first_look_row_ = rows_.count;
    const std::uint64_t begin = work_.spent();
    bool is_first_attempt = true;
    while (share_.next()) {
      result_.out_of_work = work_.is_spent();
      if (result_.out_of_work) break;
      if (!set_trial_pose()) {
        share_.halve();
        continue;
      }
      if (leads_away()) continue;
      end(times_, &StepTimes::solve_ns);
      work_.add(Work::kAttempt);
      const Freedom freedom{are_samples_free(), are_features_free(), are_edges_free()};
      if (is_first_attempt) attempt_work_ = work_.spent() - begin;
      is_first_attempt = false;
      const bool is_free = freedom.samples && freedom.features && freedom.edges;
      const bool overshoots = is_free && !share_.is_stopped() && share_.has_next() &&
                              travel(lengths_.sphere, motion_) > metric_.tolerance && passes_lowest_energy();
      end(times_, &StepTimes::step1_ns);
      if (overshoots) continue;
      if (is_free) return;
      if (!extend_rows(freedom)) react_to_obstacle(freedom);
    }
    share_.give_up();
    H1_ = H0_;
    motion_ = Motion{};
    if (!result_.out_of_work) return;
    return_to_last_step();
    step_.follows = false;
  }

  /// Moves the god object to the certified pose and chooses the next sub-step's search radius.
  void advance() noexcept {
    if (is_first_ && share_.value() != 0.0) first_work_ = work_.spent();
    const double remainder = (1.0 - share_.value()) * travel(lengths_.sphere, step_.motion);
    is_nearer_ = distance_gain() < 0.0;
    if constexpr (kFriction) slide_on();
    step_.motion = motion_;
    last_motion_ = motion_;
    add_to_whole(motion_);
    move_to(H1_);
    result_.cut = share_.is_cut();
    most_search_radius_ = std::min(std::max(most_search_radius_, 2.0 * search_radius_), longest_search_radius_);
    longest_displacement_ = std::max(longest_displacement_, travel(lengths_.sphere, motion_));
    // The remainder of a cut motion may change its direction, but is seldom twice as long; the motion past an edge is
    // seldom followed by a longer one. Measured (godobject-replay, the demo's paths): without the factor 2 the path
    // through the plate takes 1.5 % more sub-steps; 4 in place of either factor 2 changes few cycles.
    const double expected = result_.cut ? 2.0 * remainder : longest_displacement_;
    search_radius_ = std::min(most_search_radius_, lengths_.search_radius_for(expected, longest_search_radius_));
  }

  /// Tells whether another sub-step follows.
  bool remain() noexcept {
    // a motion that regains lost gaps, or that was shortened, may lead away by a margin: one in a cycle
    const bool is_unfinished = !led_away_ && (result_.cut || (is_outdated_ && is_nearer_) || is_provisional());
    const bool do_remain = share_.value() != 0.0 && is_unfinished && !result_.inside && budget_.balls > 0 &&
                           result_.substeps < kMaxSubsteps && free_substeps_ < kMostFreeSubsteps;
    if (!do_remain) return false;
    result_.out_of_work = !work_.has(work_.spent() - work_before_);  // another one may take as much as the last one
    return !result_.out_of_work;
  }

  /// Ends the cycle: #6, #7 and the report. Statuses as those of `commit`.
  Status finish(ProxyState& state, CycleReport& report) noexcept {
    if (result_.substeps == 0 && step_.follows) {
      step_.motion = wanted_;  // for any number of sub-steps
    } else if (result_.substeps + free_substeps_ > 1) {
      // friction needs the slip of the whole cycle; in the sum the slip of a point that stuck stays zero
      step_.motion = whole_;
    }
    result_.unknown = result_.inside && !memory_.first_search_ended;
    const Status status = finish_contact(input_, result_, step_, *scene_.parameters, lengths_, memory_, state, report);
    if (status != Status::kOk) return status;
    if (attempt_work_ > 0) memory_.attempt_work = attempt_work_;
    if (first_work_ == 0 && !result_.out_of_work) first_work_ = work_.spent();
    learn();
    return status;
  }

 private:
  /// Learns how much of a motion the budget of work allows, unless the next cycle goes on with the search of this one
  /// or has its points from the beginning.
  void learn() noexcept {
    KeptSearch& kept = memory_.kept;
    const ContactSearch& search = memory_.search;
    // while points are missing it is not known whether the god object is inside
    const bool is_inside = result_.inside && kept.has_all;
    const bool stays = result_.out_of_work && !is_inside && kept.H_WS == result_.H_WS;
    const bool may_go_on = kept.has_all ? has_surroundings_ || !had_all_points_
                                        : (kept.has_samples ? search.features : search.samples).may_go_on();
    kept.goes_on = stays && may_go_on;
    if (!kept.goes_on) return memory_.share.learn(work_, first_work_);
    if (first_work_ > 0) return memory_.share.lengthen_motion();  // an earlier sub-step of this cycle
    memory_.share.shorten_search();
    if (had_all_points_) memory_.share.shorten_motion();
  }

  /// Solves in the best metric, without rows that edge pairs imply, then with those that found no room.
  void solve_without_implied_rows() noexcept {
    solve_in_best_metric();
    for (int round = 0; round < kMostImpliedRounds && !step_.infeasible && drop_implied_rows(); ++round) {
      solve_in_best_metric();
    }
    add_violated_rows();
  }

  /// Drops the rows with a force that edge pairs imply. Returns whether there was one.
  bool drop_implied_rows() noexcept {
    bool dropped = false;
    if constexpr (kSceneTraits.edges) {
      const NearEdges& near = memory_.workspace.edges;
      if (near.count == 0) return false;
      for (std::uint32_t f = 0; f < step_.force_count && !work_.is_spent(); ++f) {
        work_.add(Work::kScan, 8 * near.count + memory_.workspace.samples.count / 4 + rows_.count / 4);
        const std::uint32_t id = step_.forces[f].id;
        const std::uint32_t row = rows_.find(id, 0);
        if (row == rows_.count) continue;  // several forces of one row
        const bool is_feature = (id & kFeature) != 0;
        NearPoints& points = is_feature ? memory_.workspace.features : memory_.workspace.samples;
        const std::uint32_t k = points.find(id & ~kFeature);
        if (k == points.count) continue;
        const HeldPoint point{H0_ * rows_.point(row), points.distance[k], is_feature};
        const double gap = implied_gap(point, scene_.edges, near, H0_, lengths_.margin, 0.1 * lengths_.margin);
        if (!(gap < std::numeric_limits<double>::infinity())) continue;
        rows_.remove(row);
        points.forget_gradient(k);
        // the certificate asks no more of the point than the pairs keep, which may be nearer, as after a start inside
        if (gap > 0.0) points.distance[k] = std::min(points.distance[k], gap);
        dropped = true;
      }
    }
    return dropped;
  }

  /// If there are more near points than rows, adds those that the motion would violate, and computes the motion again.
  void add_violated_rows() noexcept {
    if (!around_.lacks_rows) return;
    while (!work_.is_spent()) {
      const std::uint32_t begin = rows_.count;
      work_.add(Work::kScan, 2 * (memory_.workspace.samples.count + memory_.workspace.features.count));
      result_.dropped = around_.unlisted + around_.unseen + push_left_out();
      const std::uint32_t end = rows_.count;
      if (end == begin) return;
      if (refills_left_ == 0) {
        rows_.count = begin;  // the motion does not know them
        return;
      }
      --refills_left_;
      const bool infeasible = step_.infeasible;  // then the rows have lost their required gains
      solve_in_best_metric();
      step_.infeasible |= infeasible;
      if (rows_.count < end) return;  // rows have given way to the faces of the workspace
    }
  }

  /// Tells whether another motion may follow at once: rows of a second look directed this one, or it ended at the
  /// lowest energy along its way. Not after a motion within a margin, nor after one that only regains lost margins.
  bool is_provisional() const noexcept {
    return (share_.looks_left() < kMostSecondLooks || share_.is_stopped()) && is_nearer_ &&
           travel(lengths_.sphere, motion_) > lengths_.margin;
  }

  /// Adds the motion to what friction opposes in the next sub-step, in the body frame there, if a contact carried load.
  void slide_on() noexcept {
    Motion& slid = friction_.slid;
    if (step_.force_count == 0) {
      slid = Motion{};
      return;
    }
    const Quaternion back = exp_rotation(motion_.rotation).conjugate();
    slid.translation = back * Vector3(slid.translation + motion_.translation);
    slid.rotation = back * Vector3(slid.rotation + motion_.rotation);
  }

  /// Takes the forces of the last sub-step, or of the last cycle, for those of this one.
  void return_to_last_step() noexcept { step_ = is_first_ ? memory_.last_step : memory_.workspace.last_step; }

  /// Returns the motion to the device's own pose, which may lie outside of the workspace: the stretch that contacts and
  /// faces of the workspace balance. `motion`: from `H` to the pose that the cycle follows.
  Motion on_to_device(const Pose& H, Motion motion) const noexcept {
    if (input_.outside) motion.translation += H.rotation.conjugate()._transformVector(input_.beyond_W);
    return motion;
  }

  bool is_clear_to_device() const noexcept { return memory_.search.is_free(free_displacement_, scene_.free_clearance); }

  void add_to_whole(const Motion& motion) noexcept {
    whole_.translation += motion.translation;
    whole_.rotation += motion.rotation;
  }

  void move_to(const Pose& H_WS) noexcept {
    result_.H_WS = H_WS;
    memory_.path.push(H_WS);
  }

  /// Returns the pose at the end of the way out. In the coupling's metric it is at most `longest_way_out` from the
  /// device, so that the force on the hand is bounded and does not jump when the device leaves.
  Pose way_out() const noexcept {
    Overlap overlap(lengths_);
    overlap.add<SampleDirection>(memory_.workspace.samples, H0_);
    if (scene_.has_features()) overlap.add<FeatureDirection>(memory_.workspace.features, H0_features_);
    Motion out = overlap.way_out(free_);
    Pose H_out = H0_ * set_matrix(out);
    const Motion back = unconstrained_motion(H_out, input_.H_WD);
    const double stretch = std::hypot(back.translation.norm(), lengths_.metric.gyration * back.rotation.norm());
    if (stretch > lengths_.longest_way_out) {
      const double share = 1.0 - lengths_.longest_way_out / stretch;
      H_out = H_out * set_matrix({share * back.translation, share * back.rotation});
    }
    cut_off(scene_.parameters->workspace, H0_, H_out, out);
    return H_out;
  }

  /// Computes the motion nearest to that to the device for the coupling's metric, or a stiffer one.
  void solve_in_best_metric() noexcept {
    metric_ = lengths_.metric;
    aim_ = on_to_device(H0_, free_);
    solve();
    if (arc_energy(step_) > kMostOvershoot * squared(step_.motion)) stiffen();
  }

  /// Adds rows of left-out near points that the step violates. Returns how many groups of points have one.
  std::uint32_t push_left_out() noexcept {
    std::uint32_t groups =
        push_violated<SampleDirection>(H0_, step_, lengths_, regain_, memory_.workspace.samples, rows_);
    if (scene_.has_features() && memory_.workspace.features.count > 0) {
      groups +=
          push_violated<FeatureDirection>(H0_features_, step_, lengths_, regain_, memory_.workspace.features, rows_);
    }
    return groups;
  }

  /// Returns the squared length of a motion in `metric_` [m^2].
  double squared(const Motion& motion) const noexcept { return metric_.squared(motion); }

  /// Returns by how much the squared distance from the aim is larger after the step than at rest [m^2].
  double distance_gain() const noexcept {
    const Motion remainder{step_.motion.translation - aim_.translation, step_.motion.rotation - aim_.rotation};
    return squared(remainder) - squared(aim_);
  }

  /// Returns the squared distance of rest from the aim [m^2], for a device outside of the workspace from the pose that
  /// the cycle follows: faces hold off the rest of the way, so that a sideways motion would hardly count beside it.
  double squared_rest() const noexcept {
    Motion followed = aim_;
    if (input_.outside) followed.translation -= beyond();
    return squared(followed);
  }

  /// Returns the way from the pose that the cycle follows on to the device, in S at the begin of the sub-step [m].
  Vector3 beyond() const noexcept { return H0_.rotation.conjugate()._transformVector(input_.beyond_W); }

  /// Solves again for a coupling that is stiffer in rotation, by the energy of the arcs on which the points move: else
  /// forces with long levers turn the body too far (Newton's method in place of the steepest descent). At rest both
  /// couplings have the same forces.
  void stiffen() noexcept {
    const double turn = step_.motion.rotation.norm();
    const double squared_gyration = metric_.gyration * metric_.gyration;
    const double stiffer = squared_gyration + arc_energy(step_) / (turn * turn);
    if (!(turn > 0.0) || !std::isfinite(stiffer)) return;
    metric_.gyration = std::sqrt(stiffer);
    aim_.rotation *= squared_gyration / stiffer;
    const bool infeasible = step_.infeasible;
    solve();
    step_.infeasible |= infeasible;
    step_.follows = false;
  }

  /// Returns the energy of the arcs, less the part that `metric_` contains [m^2].
  double excess_arc_energy() const noexcept {
    const double added = metric_.gyration * metric_.gyration - lengths_.metric.gyration * lengths_.metric.gyration;
    return arc_energy(step_) - added * step_.motion.rotation.squaredNorm();
  }

  /// Shortens a motion that would raise the coupling's energy again because the points move along arcs.
  void limit_arcs() noexcept {
    const double length = squared(step_.motion);
    const double excess = excess_arc_energy();
    if (excess > kMostOvershoot * length) share_.limit_to(length / (length + excess));
  }

  /// Computes the motion nearest to `aim_` in `metric_` that all rows and the workspace allow. Rows that contradict
  /// each other up to rounding count as rows without a common solution.
  void solve() noexcept {
    solve_rows();
    if (work_.is_spent()) return;
    if (!leads_far_away()) return regain_slowly();
    for (std::uint32_t i = 0; i < rows_.count; ++i) rows_.required_gain[i] = std::min(rows_.required_gain[i], 0.0f);
    step_.force_count = 0;
    solve_rows();
    step_.infeasible = true;
  }

  /// Solves again for a share of the lost gaps, if regaining them leads away from the aim: farther than rest, by more
  /// than a margin. An example is a wedge between a surface and a face of the workspace. Without friction the distance
  /// from the aim is convex in that share, so that the second step leads away by a margin at most. Not on the way out
  /// of an overlap.
  void regain_slowly() noexcept {
    const double gain = distance_gain();
    if (result_.inside || !(gain > 0.0)) return;
    const double rest = std::sqrt(squared_rest());
    const double farther = std::sqrt(rest * rest + gain) - rest;
    if (!(farther > lengths_.margin)) return;
    const double share = lengths_.margin / farther;
    regain_ *= share;
    for (std::uint32_t i = 0; i < rows_.count; ++i) {
      if (rows_.required_gain[i] > 0.0f) rows_.required_gain[i] *= static_cast<float>(share);
    }
    solve_rows();
  }

  /// Tells whether the step ends farther from the aim than rest, by much more than any gap has to grow: a ball that
  /// fits tightly into a bore could regain its margins only by leaving it.
  bool leads_far_away() const noexcept {
    const double gain = distance_gain();
    if (!(gain > 0.0)) return false;
    double most = metric_.tolerance;
    for (std::uint32_t i = 0; i < rows_.count; ++i) most = std::max(most, static_cast<double>(rows_.required_gain[i]));
    const double rest = squared_rest();
    return std::sqrt(rest + gain) > std::sqrt(rest) + kMostLever * most;
  }

  void solve_rows() noexcept {
    const WorkspaceBox& box = scene_.parameters->workspace;
    const bool has_friction = kFriction && !memory_.share.is_least();
    const ContactFriction* const friction = has_friction ? &friction_ : nullptr;
    bool contradictory = false;
    face_push_ = Vector3::Zero();
    if (!input_.outside) {
      least_constraint(rows_, aim_, metric_, friction, last_motion_, work_, step_);
      contradictory = step_.infeasible;
    }
    if (input_.outside || (box.limited && !box.contains(H0_ * step_.motion.translation))) {
      constrain_within(box, friction);
    }
    step_.infeasible |= contradictory;
    step_.unconverged |= kFriction && !has_friction;
  }

  /// Computes the motion nearest to `aim_` with the faces of the box as rows. Their forces are left out of the step:
  /// they are no contacts. With too many rows the last ones give way to the faces.
  void constrain_within(const WorkspaceBox& box, const ContactFriction* friction) noexcept {
    constexpr std::uint32_t kFaces = 6;
    const std::uint32_t contacts = std::min(rows_.count, ContactRows::kCapacity - kFaces);
    result_.dropped += rows_.count - contacts;
    rows_.count = contacts;
    push_faces(box, H0_, [&](const Vector3& normal_S, double gain) noexcept {
      rows_.push(kFaceOfWorkspace, normal_S, Vector3::Zero(), gain);
    });
    least_constraint(rows_, aim_, metric_, friction, last_motion_, work_, step_);
    rows_.count = contacts;
    for (std::uint32_t f = 0; f < step_.force_count; ++f) {
      const ContactForce& force = step_.forces[f];
      if (force.id == kFaceOfWorkspace) face_push_ += force.multiplier * force.normal;
    }
    drop_forces(kFaceOfWorkspace, step_);
    if (step_.force_count > 0) return;
    step_.follows = true;  // to the place in the box that is nearest to the device
    step_.motion = aim_;
    step_.motion.translation -= beyond();
  }

  void follow_device() noexcept {
    move_to(input_.H_WD);
    add_to_whole(free_);
    friction_.slid = Motion{};
    step_.release();
    result_.smallest = std::numeric_limits<double>::infinity();
    result_.dropped = 0;
    result_.cut = false;
  }

  /// Finds the near sample points. False: as find_near.
  bool find_samples() noexcept {
    ContactSearch& search = memory_.search;
    bool& has_samples = memory_.kept.has_samples;
    if (has_samples) return true;
    const double travelled = search.odometer.travelled();
    has_samples =
        search.samples.is_free(travelled, search_radius_) ||
        find_near(search.samples, SampleDirection{}, *scene_.field, *scene_.shell, H0_, travelled, search_radius_,
                  exact_radius(), lengths_, point_budget(), work_, memory_.workspace.samples, rows_, around_, goes_on_);
    return has_samples;
  }

  /// Finds the near feature points. False: as find_near.
  bool find_features() noexcept {
    if (!scene_.has_features()) return true;
    ContactSearch& search = memory_.search;
    const double travelled = search.odometer.travelled();
    const double stretch = scene_.feature_direction.most_stretch();
    const double radius = search_radius_ * stretch;
    if (search.features.is_free(travelled, radius)) return true;
    return find_near(search.features, scene_.feature_direction, *scene_.features.map, scene_.features.points,
                     H0_features_, travelled, radius, exact_radius() * stretch, lengths_, point_budget(), work_,
                     memory_.workspace.features, rows_, around_, goes_on_);
  }

  /// Returns the distance up to which near points are looked up exactly and become rows [m]. Not less than what the
  /// report and the contact patches need; all points within the search radius on the way out of an overlap.
  double exact_radius() const noexcept {
    if (result_.inside || !state_.started) return search_radius_;
    return std::max({kExactShare * search_radius_, lengths_.shortest_search_radius, 3.0 * lengths_.margin});
  }

  /// Returns how many points a sub-step looks up.
  PointBudget point_budget() const noexcept { return {lengths_.point_budget, lengths_.margin}; }

  /// Finds the near edges and appends their rows. While a point is inside, edges may lie on the wrong sides of each
  /// other, so that no edge pair counts until the points have led the body out.
  void find_edges() noexcept {
    NearEdges& near = memory_.workspace.edges;
    near.count = 0;
    if (!scene_.has_edges() || result_.inside) return;
    if constexpr (kSceneTraits.edges) {
      ContactSearch& search = memory_.search;
      // every pair that overlaps is found: one that is not would be held on its wrong side from now on
      const double deepest = memory_.edges_may_overlap ? lengths_.deepest_overlap : 0.0;
      const EdgeSurroundings around =
          search.edges.find(H0_, search.odometer.travelled(), std::max(search_radius_, deepest),
                            kEdgeSlack * lengths_.longest_search_radius, deepest, work_, near);
      if (work_.is_spent()) return;
      memory_.edges_may_overlap = memory_.edges_may_overlap && around.may_overlap;
      around_.unlisted += around.unlisted;
      around_.free_displacement = std::min(around_.free_displacement, around.free_displacement);
      for (std::uint32_t k = 0; k < near.count; ++k) {
        around_.smallest = std::min(around_.smallest, near.gap[k].distance);
      }
      around_.lacks_rows |= push_edges(H0_, lengths_, near, rows_) > 0;
    }
  }

  /// Selects the rows again when there are more near points than rows: those of all edges, the deepest points, and some
  /// spread over the others.
  void select_again() noexcept {
    work_.add(Work::kScan, 4 * (memory_.workspace.samples.count + memory_.workspace.features.count));
    const Selection selection = select_rows(memory_.workspace);
    rows_.count = 0;
    push_edges(H0_, lengths_, memory_.workspace.edges, rows_);
    push_selected<SampleDirection>(H0_, selection, lengths_, memory_.workspace.samples, rows_);
    if (scene_.has_features() && memory_.workspace.features.count > 0) {
      push_selected<FeatureDirection>(H0_features_, selection, lengths_, memory_.workspace.features, rows_);
    }
  }

  /// Sets `motion_` and `H1_` for the current share. False: points that are not near are not proved free for the
  /// motion, which a face of the workspace may have changed.
  bool set_trial_pose() noexcept {
    motion_ = {share_.value() * step_.motion.translation, share_.value() * step_.motion.rotation};
    H1_ = step_.follows && share_.is_whole() ? input_.H_WD : H0_ * set_matrix(motion_);
    is_cut_by_faces_ = cut_off(scene_.parameters->workspace, H0_, H1_, motion_);
    return travel(lengths_.sphere, motion_) <= around_.free_displacement;
  }

  /// Shortens a motion that ends farther from the device than rest, by more than a margin. False: it does not. Only a
  /// motion that the solver has not finished may: the faces of the workspace then take the part of it that would lead
  /// nearer. Distances are compared as in `regain_slowly`.
  bool leads_away() noexcept {
    if (!is_cut_by_faces_ || !step_.unconverged || result_.inside) return false;
    work_.add(Work::kBall);
    const double gain = lengths_.metric.squared(on_to_device(H1_, unconstrained_motion(H1_, input_.H_WD))) -
                        lengths_.metric.squared(on_to_device(H0_, free_));
    const double rest = std::sqrt(lengths_.metric.squared(free_));  // without the way beyond the workspace
    const double farther = std::sqrt(std::max(0.0, rest * rest + gain)) - rest;
    if (!(farther > lengths_.margin)) return false;
    led_away_ = true;
    share_.limit_to(0.5 * lengths_.margin / farther * share_.value());
    return true;
  }

  bool are_samples_free() noexcept {
    return motion_is_free(*scene_.field, H0_, H1_, share_.least_gap(lengths_), lengths_, memory_.workspace.samples,
                          budget_, at_sample_);
  }

  bool are_features_free() noexcept {
    if (!scene_.has_features() || memory_.workspace.features.count == 0) return true;
    H1_features_ = FeatureDirection::pose(H1_, scene_.features.origin_W);
    return motion_is_free(*scene_.features.map, H0_features_, H1_features_, share_.least_gap(lengths_), lengths_,
                          memory_.workspace.features, budget_, at_feature_);
  }

  bool are_edges_free() noexcept {
    if constexpr (kSceneTraits.edges) {
      if (memory_.workspace.edges.count == 0) return true;
      return edges_are_free(scene_.edges, H0_, H1_, share_.least_gap(lengths_), lengths_, memory_.workspace.edges,
                            budget_, at_edge_);
    }
    return true;
  }

  /// The result of an attempt: which contacts of it are proved free.
  struct Freedom {
    bool samples;
    bool features;
    bool edges;
  };

  /// Limits a new motion.
  void limit_motion() noexcept {
    share_.limit_to(memory_.share.motion());
    // by the triangle inequality the distance grows by at most a margin
    most_gain_ = std::max(0.0, distance_gain()) + 2.0 * lengths_.margin * std::sqrt(squared_rest());
    limit_arcs();
  }

  /// After an attempt that met a point of which only a bound is known: makes rows of all such points in the way and
  /// computes the motion again. False: there is none, or none of their rows is violated.
  bool extend_rows(const Freedom& freedom) noexcept {
    NearPoints& samples = memory_.workspace.samples;
    NearPoints& features = memory_.workspace.features;
    const std::uint32_t rows = rows_.count;
    bool lacks_rows = false;
    bool found = false;
    if (extensions_left_ == 0) return false;
    if (!freedom.samples && samples.is_bound_only(at_sample_.near)) {
      found = look_up_bounded<SampleDirection>(*scene_.field, H0_, H1_, lengths_, samples, rows_, lacks_rows, work_);
    }
    if (scene_.has_features() && !freedom.features && features.is_bound_only(at_feature_.near)) {
      found |= look_up_bounded<FeatureDirection>(*scene_.features.map, H0_features_, H1_features_, lengths_, features,
                                                 rows_, lacks_rows, work_);
    }
    if (!found || !(lacks_rows || violates_rows(rows))) return false;
    around_.lacks_rows |= lacks_rows;
    memory_.kept.around.lacks_rows |= lacks_rows;
    --extensions_left_;
    if (share_.looks_left() == kMostSecondLooks) first_look_row_ = rows_.count;
    const bool infeasible = step_.infeasible;  // then the rows have lost their required gains
    solve_without_implied_rows();
    step_.infeasible |= infeasible;
    share_.restart(allowed_share(step_.motion, around_, search_radius_, lengths_, true));
    limit_motion();
    return true;
  }

  /// Tells whether the step violates a row from `first` on.
  bool violates_rows(std::uint32_t first) const noexcept {
    work_.add(Work::kScan, rows_.count - first);
    const double tolerance = 2.0 * lengths_.metric.tolerance;  // rows of the step are met within one
    for (std::uint32_t row = first; row < rows_.count; ++row) {
      const Vector3 displacement = step_.motion.translation + step_.motion.rotation.cross(rows_.point(row));
      if (static_cast<double>(rows_.required_gain[row]) - rows_.normal(row).dot(displacement) > tolerance) return true;
    }
    return false;
  }

  /// Reacts to a failed attempt: turns the obstacle into a row, or shortens the motion.
  void react_to_obstacle(const Freedom& freedom) noexcept {
    if (at_sample_.exhausted || at_feature_.exhausted || at_edge_.exhausted) {
      share_.shrink_to(
          std::min({at_sample_.exhausted ? at_sample_.share : 1.0, at_feature_.exhausted ? at_feature_.share : 1.0,
                    at_edge_.exhausted ? at_edge_.share : 1.0}));
      return;
    }
    if (!look_again(freedom)) share_.shrink_at_obstacle();
  }

  /// Tells whether a free motion goes far beyond the lowest energy of the coupling, and prepares another attempt: with
  /// the surface at its end, or else shorter. Sets `is_outdated_`.
  ///
  /// Along the motion, a share of v, the energy of coupling and contact forces is M(t) = M(0) - 2 |v|^2 t + b t^2. Its
  /// value at the end, t = share, gives b; the lowest one is at t = |v|^2 / b = share / (1 + overshoot).
  bool passes_lowest_energy() noexcept {
    const Arrival arrival = arrive(scene_, H0_, H1_, step_, share_.value());
    is_outdated_ = share_.is_whole() && (arrival.opened || arrival.turn > kMostTurn);
    const double share = share_.value();
    const double rise = arrival.rise + share * share * excess_arc_energy();
    if (!(rise > (1.0 + kMostOvershoot - share) * share * squared(step_.motion))) return false;
    // measured again: surfaces that turn need not raise the energy
    const EndGaps gaps = end_gaps(scene_, H0_, H1_, step_, share);
    const Motion left = on_to_device(H1_, unconstrained_motion(H1_, input_.H_WD));
    const double fall = lengths_.metric.squared(on_to_device(H0_, free_)) - lengths_.metric.squared(left) +
                        2.0 * face_push_.dot(motion_.translation) - gaps.energy;
    const double overshoot = 1.0 - fall / (share * squared(step_.motion));
    if (!(overshoot > kMostOvershoot)) return false;
    is_outdated_ = false;
    may_look_at_end_ = may_look_at_end_ && look_at_end(gaps);
    if (!may_look_at_end_) share_.stop_at(share / (1.0 + overshoot));
    return true;
  }

  /// Solves again with the surface at the end of a motion that overshoots: that of the point that lacks most becomes a
  /// row. False: as of `look_again`.
  bool look_at_end(const EndGaps& gaps) noexcept {
    if (!(gaps.most > 0.0)) return false;
    if (scene_.has_edges() && is_edge_pair(gaps.id)) return look_at_end_of_edge(pair_of(gaps.id));
    const bool is_sample = (gaps.id & kFeature) == 0;
    const NearPoints& near = is_sample ? memory_.workspace.samples : memory_.workspace.features;
    Obstacle& end = is_sample ? at_sample_ : at_feature_;
    const std::uint32_t* const begin = near.index;
    end.near = static_cast<std::uint32_t>(std::find(begin, begin + near.count, gaps.id & ~kFeature) - begin);
    if (end.near == near.count) return false;
    end.share = 1.0;
    end.sample = gaps.sample;
    return look_again({.samples = !is_sample, .features = is_sample, .edges = true});
  }

  bool look_at_end_of_edge(const EdgePair& pair) noexcept {
    const NearEdges& near = memory_.workspace.edges;
    at_edge_.near = near.find(pair);
    if (at_edge_.near == near.count) return false;
    at_edge_.share = 1.0;
    if constexpr (kSceneTraits.edges) at_edge_.gap = gap_at(scene_.edges, pair, H1_);
    return look_again({.samples = true, .features = true, .edges = false});
  }

  bool differs(const Motion& a, const Motion& b) const noexcept {
    return squared({a.translation - b.translation, a.rotation - b.rotation}) > metric_.tolerance * metric_.tolerance;
  }

  /// Solves again with the rows of the obstacles: first with what the arcs of the points lose, unless that gains too
  /// little (`most_arc_gain`), then without. False: they cannot become rows, change nothing, would drive the god object
  /// away from the device, or let it rest on a face that ends before the point; then the step is as before.
  bool look_again(const Freedom& freedom) noexcept {
    const ConstrainedStep tried = step_;
    const CouplingMetric metric = metric_;
    const Motion aim = aim_;
    const Vector3 face_push = face_push_;
    const std::uint32_t rows = rows_.count;
    const std::uint32_t dropped = result_.dropped;
    const double most_with_arc =
        std::min(most_gain_, most_arc_gain(distance_gain(), squared(tried.motion), share_.value()));
    for (const bool is_arc : {true, false}) {
      if (work_.is_spent() || !push_obstacles(freedom, tried.motion, is_arc)) return false;
      solve_in_best_metric();
      add_violated_rows();
      if (distance_gain() <= (is_arc ? most_with_arc : most_gain_) && differs(step_.motion, tried.motion) &&
          !rests_beside_a_face()) {
        step_.infeasible |= tried.infeasible;
        share_.look_again(allowed_share(step_.motion, around_, search_radius_, lengths_, true));
        limit_arcs();
        return true;
      }
      rows_.count = std::min(rows, rows_.count);  // fewer: rows have given way to the faces of the workspace
      result_.dropped = dropped;
      const bool infeasible = step_.infeasible;  // then the rows have lost their required gains
      step_ = tried;
      step_.infeasible |= infeasible;
      metric_ = metric;
      aim_ = aim;
      face_push_ = face_push;
    }
    return false;
  }

  /// Tells whether nothing moves because a row of a second look holds a point beyond the end of its face. Then a
  /// shorter motion leads on.
  bool rests_beside_a_face() noexcept {
    if (!(travel(lengths_.sphere, step_.motion) <= metric_.tolerance)) return false;
    for (std::uint32_t f = 0; f < step_.force_count; ++f) {
      const ContactForce& force = step_.forces[f];
      if (is_edge_pair(force.id) || !is_of_second_look(force)) continue;
      work_.add(Work::kBall);
      const bool is_feature = (force.id & kFeature) != 0;
      if (is_feature ? face_ends_before(*scene_.features.map, force.point, -force.normal, lengths_)
                     : face_ends_before(*scene_.field, H0_ * force.point, H0_.rotation._transformVector(force.normal),
                                        lengths_)) {
        return true;
      }
    }
    return false;
  }

  /// Tells whether the row of a force is that of a second look.
  bool is_of_second_look(const ContactForce& force) const noexcept {
    for (std::uint32_t row = rows_.find(force.id, first_look_row_); row < rows_.count;
         row = rows_.find(force.id, row + 1)) {
      if ((rows_.normal(row) - force.normal).isZero(1e-6)) return true;
    }
    return false;
  }

  /// Adds the rows of the second look after a motion in S. `is_arc`: as in Attempt. False: none was added.
  bool push_obstacles(const Freedom& freedom, const Motion& step, bool is_arc) noexcept {
    if (share_.looks_left() == 0) return false;
    bool pushed = false;
    if (!freedom.samples) {
      const Attempt attempt{H0_, H1_, step, share_.value(), is_arc};
      pushed = push_obstacle<SampleDirection>(attempt, lengths_, memory_.workspace.samples, at_sample_, rows_);
    }
    if (scene_.has_edges() && !freedom.edges) {
      const Attempt attempt{H0_, H1_, step, share_.value(), is_arc};
      pushed |= push_edge_obstacle(attempt, lengths_, scene_.edges, memory_.workspace.edges, at_edge_, rows_);
    }
    if (scene_.has_features() && !freedom.features) {
      const Attempt attempt{H0_features_, H1_features_, step, share_.value(), is_arc};
      pushed |= push_obstacle<FeatureDirection>(attempt, lengths_, memory_.workspace.features, at_feature_, rows_);
    }
    return pushed;
  }

  const ContactScene<Field, BodyField>& scene_;
  const ContactLengths& lengths_;
  const CycleInput& input_;
  const ProxyState& state_;
  ContactMemory& memory_;
  ContactRows& rows_;
  ConstrainedStep& step_;
  StepTimes* times_;
  const Motion wanted_;  // unconstrained motion of the cycle

  // state of the cycle
  ContactResult result_;
  Motion last_motion_;
  ContactFriction friction_;  // with the faces that carried load before
  Motion whole_;
  WorkMeter& work_;
  Budget budget_{work_};
  double longest_search_radius_;
  std::uint32_t free_substeps_ = 0;
  double most_search_radius_ = 0.0;
  double longest_displacement_ = 0.0;  // of a point in a sub-step [m]
  bool is_outdated_{};                 // holding points have left the surface, or it has turned
  bool is_cut_by_faces_{};             // the faces of the workspace have moved the end of the motion that is tried
  bool led_away_{};                    // a motion of this sub-step was shortened because it led away
  bool may_look_at_end_{};             // no second look at the end of a motion has failed in this sub-step
  bool is_nearer_{};                   // the last step leads nearer to the device

  // state of the sub-step
  bool is_first_{};
  bool has_all_points_{};           // the search has visited all near points
  bool goes_on_{};                  // the search is that of the last cycle
  bool had_all_points_ = false;     // and has visited all near points before
  bool has_surroundings_ = false;   // all near points and edges are listed
  bool is_constrained_{};           // `step_` is that of the sub-step
  std::uint64_t work_before_{};     // at its start [units]
  std::uint64_t attempt_work_ = 0;  // of its first attempt [units]
  std::uint64_t first_work_ = 0;    // of the first sub-step; 0: the budget was spent before its end [units]
  Pose H0_;
  Pose H0_features_;
  Motion free_;
  Motion aim_;                  // of the solver: the motion to the device, in `metric_`
  Vector3 face_push_;           // of the workspace's faces on the god object in the step, in S [m]
  CouplingMetric metric_;       // in which the step is solved
  double most_gain_{};          // bound of `distance_gain` after second looks [m^2]
  double free_displacement_{};  // upper bound of a point's displacement in `free_` [m]
  double search_radius_{};
  Surroundings around_{};
  std::uint32_t first_look_row_{};  // rows of second looks begin here
  int extensions_left_{};           // times that bounded points may become rows
  int refills_left_{};
  double regain_{};  // share of the lost gaps that the rows regain of what the gap law demands [1]
  MotionShare share_{1.0};
  Motion motion_;
  Pose H1_;
  Pose H1_features_;
  Obstacle at_sample_;
  Obstacle at_feature_;
  EdgeObstacle at_edge_;
};

}  // namespace godobject::detail
