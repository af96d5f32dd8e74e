#include <cfloat>

#include "core/pipeline/contact/qp/contact_set.h"

// The functions of the set that only friction uses: contacts, and half spaces of their cones.
namespace godobject::detail {

double ContactSet::ratio_of(const Contact& contact) const noexcept {
  if (!contact.has_friction) return 0.0;
  return slip_of(contact, last_).speed > metric_.still ? friction_->kinetic_ratio : friction_->static_ratio;
}

ActiveSet::Inequality ContactSet::cone_half_space(int contact_index, const Vector3& slip) const noexcept {
  const Contact& c = contact(contact_index);
  ActiveSet::Inequality half_space;
  half_space.gradient = space_.gradient(c.normal, c.point, -c.ratio * slip, c.grip);
  half_space.rhs = c.required_gain - c.ratio * c.shift;
  half_space.tag = {c.row, contact_index, slip};
  return half_space;
}

void ContactSet::set_viscous_metric(const std::array<double, kMaxContacts>& load) noexcept {
  double sum = 0.0;
  for (int k = 0; k < contact_count_; ++k) sum += contact(k).has_friction ? load[static_cast<std::size_t>(k)] : 0.0;
  Matrix6 H = Matrix6::Identity();
  for (int k = 0; k < contact_count_ && sum > 0.0; ++k) {
    const Contact& c = contact(k);
    if (!c.has_friction) continue;
    Matrix3 cross;  // v = x + r x P = x - P x r at the grip P
    cross << 0.0, -c.grip.z(), c.grip.y(), c.grip.z(), 0.0, -c.grip.x(), -c.grip.y(), c.grip.x(), 0.0;
    Eigen::Matrix<double, 3, 6> velocity;
    velocity << Matrix3::Identity(), -cross / space_.gyration();
    const Eigen::Matrix<double, 3, 6> tangential = velocity - c.normal * (c.normal.transpose() * velocity);
    const double share = load[static_cast<std::size_t>(k)] / sum;
    H += friction_->viscous_step * share * tangential.transpose() * tangential;
  }
  space_.set_metric(H);
}

int ContactSet::open(std::uint32_t row) noexcept {
  Contact& c = contact(contact_count_);
  const Vector3 normal = rows_.normal(row).normalized();  // in single precision it would tilt a slip of nanometres
  const Vector3 point = rows_.point(row);
  c = {.row = row,
       .normal = normal,
       .point = point,
       .grip = friction_->patches.grip(normal, point, friction_->face_thickness),
       .required_gain = static_cast<double>(rows_.required_gain[row]),
       .has_friction = rows_.id[row] != kFaceOfWorkspace};
  c.ratio = ratio_of(c);
  rows_.required_gain[row] = -FLT_MAX;
  return contact_count_++;
}

void ContactSet::close(int contact_index) noexcept {
  Contact& c = contact(contact_index);
  rows_.required_gain[c.row] = static_cast<float>(c.required_gain);
  c = contact(--contact_count_);
}

void ContactSet::close_idle() noexcept {
  int count = 0;
  for (int k = 0; k < contact_count_; ++k) {
    const Contact c = contact(k);
    bool used = false;
    for (int j = 0; j < active_.size(); ++j) {
      if (active_[j].tag.contact != k) continue;
      used = true;
      active_.at(j).tag.contact = count;
    }
    if (used) {
      contact(count++) = c;
    } else {
      rows_.required_gain[c.row] = static_cast<float>(c.required_gain);
    }
  }
  contact_count_ = count;
}

void ContactSet::close_all() noexcept {
  for (int k = 0; k < contact_count_; ++k)
    rows_.required_gain[contact(k).row] = static_cast<float>(contact(k).required_gain);
  contact_count_ = 0;
}

bool ContactSet::enter(std::uint32_t row, const Motion& m) noexcept {
  if (active_.size() == ActiveSet::kCapacity) return false;
  const int k = open(row);
  ++additions_;
  return active_.guess(cone_half_space(k, slip_of(contact(k), m).direction));
}

void ContactSet::resolve() noexcept {
  for (int j = 0; j < active_.size(); ++j) {
    active_.at(j) = cone_half_space(active_[j].tag.contact, Vector3(active_[j].tag.slip));
  }
  active_.resolve(target());
  close_idle();
}

void ContactSet::restart() noexcept {
  close_all();
  space_.reset();
  active_.start(target());
}

void ContactSet::restart_from_motion() noexcept {
  close_all();
  const Vector6 current = plain_motion();
  space_.reset();
  active_.start(current);
}

ContactSet::Saved ContactSet::save() const noexcept { return {active_, contacts_, contact_count_}; }

void ContactSet::restore(const Saved& saved) noexcept {
  close_all();
  active_ = saved.active;
  contacts_ = saved.contacts;
  contact_count_ = saved.contact_count;
  for (int k = 0; k < contact_count_; ++k) rows_.required_gain[contact(k).row] = -FLT_MAX;
}

}  // namespace godobject::detail
