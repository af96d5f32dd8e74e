#include "toolchain/report/extremes/seeker.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "toolchain/report/extremes/rig.h"

namespace godobject::report {
namespace {

constexpr int kPatience = 6;           // cycles without contact, before the device looks for it
constexpr int kLost = 30 * kPatience;  // the same, before it tries to come out of the still body

/// Returns a number between low and high with an even logarithm.
double spread(Draw& draw, double low, double high) { return low * std::pow(high / low, draw.between(0.0, 1.0)); }

}  // namespace

Seeker::Seeker(const Setup& setup) : setup_(setup), draw_(setup.seed + setup.session) {
  const Pose H_WO = placement(setup);
  const double s = setup.scale;
  Pose H_OD;
  H_OD.translation = s * Vector3(draw_.between(-0.5, 0.5), draw_.between(-0.5, 0.5), setup.start);
  if (setup.world == "slot" || setup.world == "bore" || setup.world == "groove") H_OD.translation.head<2>().setZero();
  const bool is_narrow = setup.world == "slot" || setup.world == "bore" || setup.world == "mesh-cavity";
  if (setup.world == "mesh-cavity") H_OD.translation = Vector3(0.0, 0.0, -half_size_of_body(setup).z());
  if (!is_narrow) H_OD.rotation = exp_rotation(draw_.between(0.0, 3.0) * draw_.direction());
  if (is_narrow && setup.aside > 0.0) {
    H_OD.translation += setup.aside * s * draw_.direction();
    H_OD.rotation = exp_rotation(setup.aside * draw_.direction());
  }
  H_WD_ = H_WO * H_OD;
  H_WD_held_ = H_WD_;
  normal_W_ = H_WO.rotation._transformVector(Vector3::UnitZ());
}

void Seeker::choose_mode() {
  const double s = setup_.scale;
  const double choice = draw_.between(0.0, 1.0);
  mode_ = choice < 0.35   ? Mode::kSlide
          : choice < 0.55 ? Mode::kSpin
          : choice < 0.70 ? Mode::kPulse
          : choice < 0.80 ? Mode::kJump
          : choice < 0.88 ? Mode::kDash
          : choice < 0.98 ? Mode::kRest
                          : Mode::kLeave;
  total_ = left_ = static_cast<int>(mode_ == Mode::kLeave  ? 20.0
                                    : mode_ == Mode::kRest ? 200.0
                                                           : spread(draw_, 30.0, 300.0));
  depth_ = s * spread(draw_, 1e-3, std::max(2e-3, setup_.depth));
  drift_W_ = s * spread(draw_, 1e-5, 1e-3) * setup_.speed * (setup_.period / 1e-3) * draw_.direction();
  drift_W_ *= std::min(1.0, 0.5 * s / drift_W_.norm());
  spin_B_ = std::min(0.5, setup_.spin * setup_.period) * draw_.direction();
  H_WD_held_ = H_WD_;
  if (mode_ == Mode::kJump) {
    H_WD_held_.translation += 2.0 * s * draw_.in_cube(1.0) - 0.5 * s * normal_W_;
    H_WD_held_.rotation = (H_WD_.rotation * exp_rotation(draw_.between(0.0, 1.5) * draw_.direction())).normalized();
  }
}

/// Returns a direction that leads away from the still body, to look for contact against it.
Vector3 Seeker::away_from_world(const Pose& H_WS) {
  const Pose H_WO = placement(setup_);
  const Vector3 p_O = H_WO.inverse() * H_WS.translation;
  Vector3 away = p_O - inner_place(setup_) + 0.1 * setup_.scale * draw_.in_cube(1.0);
  if (setup_.world == "plane" || setup_.world == "groove") away = Vector3::UnitZ();
  if (setup_.world == "plate" || setup_.world == "mesh-plate" || setup_.world == "mesh-shell") {
    away = Vector3(0.0, 0.0, p_O.z() < 0.0 ? -1.0 : 1.0);
  }
  if (setup_.world == "slot") away = Vector3(draw_.between(-1.0, 1.0) < 0.0 ? -1.0 : 1.0, 0.0, 0.0);
  if (setup_.world == "bore") away = Vector3(draw_.between(-1.0, 1.0), draw_.between(-1.0, 1.0), 0.0);
  if (setup_.world == "mesh-cavity") away = draw_.direction();
  if (setup_.returns) away = way_back(p_O).value_or(away);
  return H_WO.rotation._transformVector(away.normalized());
}

/// Returns the way from the middle of the scene to a place that is beside the still body, out of the cavity or out of
/// the workspace box, if it is.
std::optional<Vector3> Seeker::way_back(const Vector3& p_O) const {
  const double s = setup_.scale;
  Vector3 middle(0.0, 0.0, 0.0);
  bool is_lost = (is_compiled(setup_) || setup_.world == "plate") && std::hypot(p_O.x(), p_O.y()) > 1.5 * s;
  if (setup_.world == "mesh-cavity") {
    middle.z() = -half_size_of_body(setup_).z();
    is_lost = (p_O - middle).norm() > 0.5 * s;
  }
  const Vector3 box(0.0, 0.0, 0.5 * s * setup_.body_scale);
  const Vector3 in_box = placement(setup_).rotation._transformVector(p_O - box);
  if (setup_.workspace > 0.0 && in_box.cwiseAbs().maxCoeff() > setup_.workspace * s) {
    middle = box;
    is_lost = true;
  }
  if (!is_lost) return std::nullopt;
  return p_O - middle;
}

/// Moves the device towards the place at `depth_` behind the god object, along the last normal.
void Seeker::press(const Pose& H_WS) {
  const double depth = mode_ == Mode::kPulse ? depth_ * (0.55 - 0.45 * std::cos(0.2 * left_)) : depth_;
  const Vector3 wanted = H_WS.translation - depth * normal_W_;
  const Vector3 step = wanted - H_WD_.translation;
  const double most = std::max(0.05, 0.02 * setup_.voxel) * setup_.scale;
  H_WD_.translation += std::min(0.3, most / std::max(step.norm(), 1e-300)) * step;
  // the device turns back where the god object's rotation no longer follows
  const Vector3 lag = log_rotation(H_WS.rotation.conjugate() * H_WD_.rotation);
  if (lag.norm() > 0.5) H_WD_.rotation = H_WD_.rotation * exp_rotation(-0.1 * lag);
}

Pose Seeker::next(const Pose& H_WS, const watch::Nearest& nearest) {
  if (is_first_) {
    is_first_ = false;
    return H_WD_;
  }
  if (--left_ < 0) choose_mode();
  if (nearest.normal_W.squaredNorm() > 0.5) {
    normal_W_ = nearest.normal_W;
    without_contact_ = 0;
  } else if (++without_contact_ % kPatience == 0 && mode_ != Mode::kLeave) {
    normal_W_ = away_from_world(H_WS);
    mode_ = Mode::kSlide;
    depth_ = std::max(depth_, 0.1 * setup_.scale);
    left_ = total_ = 60;
    if (setup_.returns) drift_W_.setZero();
    if (setup_.returns && without_contact_ >= kLost) {
      mode_ = Mode::kLeave;
      without_contact_ = 0;
    }
  }
  switch (mode_) {
    case Mode::kSlide:
    case Mode::kPulse:
      press(H_WS);
      H_WD_.translation += drift_W_ - normal_W_.dot(drift_W_) * normal_W_;
      H_WD_.rotation = H_WD_.rotation * exp_rotation(0.1 * spin_B_);
      break;
    case Mode::kSpin:
      press(H_WS);
      H_WD_.rotation = H_WD_.rotation * exp_rotation(spin_B_);
      break;
    case Mode::kJump:
      H_WD_ = H_WD_held_;
      if (total_ - left_ > 12) left_ = 0;  // then the next mode begins from there
      break;
    case Mode::kDash: {
      const double along = 2.0 * (0.5 - 0.5 * std::cos(2.0 * M_PI * (total_ - left_) / std::max(1, total_)));
      H_WD_.translation = H_WD_held_.translation - setup_.scale * along * normal_W_ + 50.0 * along * drift_W_;
      H_WD_.rotation = H_WD_.rotation * exp_rotation(0.1 * spin_B_);
      break;
    }
    case Mode::kRest:
      H_WD_ = H_WD_held_;
      H_WD_.translation += 1e-4 * setup_.voxel * setup_.scale * draw_.in_cube(1.0);  // the encoders' steps
      break;
    case Mode::kLeave: H_WD_.translation += 0.02 * setup_.scale * normal_W_; break;
  }
  H_WD_.rotation.normalize();
  return H_WD_;
}

}  // namespace godobject::report
