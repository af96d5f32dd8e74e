#pragma once

#include <cmath>

#include <Eigen/Core>

namespace godobject {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The point z nearest to a target in six dimensions that satisfies the inequalities c . z >= rhs added so far, by the
/// dual active set method of Goldfarb and Idnani (Mathematical Programming 27, 1983) with the identity as Hessian.
///
/// The active set has at most six inequalities. They are linearly independent, met with equality, and their multipliers
/// are >= 0:
///     z = target + sum of multiplier_i c_i
/// The matrix C of their gradients is stored as C = Q R, by Gram-Schmidt with reorthogonalisation: parallel, duplicated
/// and redundant inequalities are not special cases. `Tag` is the caller's data of an inequality. An addition costs
/// about 50 ns and at most 7 exchanges. Real-time safe.
template <class Tag>
class DualActiveSet {
 public:
  static constexpr int kCapacity = 6;

  /// The inequality gradient . z >= rhs.
  struct Inequality {
    // element by element: a loop would become a string instruction, which is slow for six elements
    Inequality() noexcept { gradient << 0.0, 0.0, 0.0, 0.0, 0.0, 0.0; }
    Inequality(const Vector6& c, double b, double lambda, const Tag& of) noexcept
        : gradient(c), rhs(b), multiplier(lambda), tag(of) {}

    Vector6 gradient;
    double rhs = 0.0;
    double multiplier = 0.0;
    Tag tag{};
  };

  /// Starts with an empty active set at the target.
  void start(const Vector6& target) noexcept {
    target_ = target;
    z_ = target;
    size_ = 0;
  }

  /// Returns the nearest point.
  const Vector6& z() const noexcept { return z_; }
  /// Returns the number of active inequalities.
  int size() const noexcept { return size_; }
  const Inequality& operator[](int i) const noexcept { return active_[i]; }
  /// Returns inequality `i` for changes; `resolve` must follow.
  Inequality& at(int i) noexcept { return active_[i]; }

  /// Puts an inequality into the set as a guess that it will be active; `resolve` must follow. False: the set is full.
  bool guess(const Inequality& inequality) noexcept {
    if (size_ == kCapacity) return false;
    active_[size_++] = inequality;
    return true;
  }

  /// Takes inequality `i` out; `resolve` must follow.
  void erase(int i) noexcept {
    for (--size_; i < size_; ++i) active_[i] = active_[i + 1];
  }

  /// Solves again with the inequalities of the set as equalities. Removes those that depend on others, then, one by
  /// one, those with a negative multiplier.
  void resolve() noexcept { resolve(target_); }

  /// The same for another target.
  void resolve(const Vector6& target) noexcept {
    target_ = target;
    const int guessed = size_;
    size_ = 0;
    for (int i = 0; i < guessed; ++i) {
      if (size_ != i) active_[size_] = active_[i];
      if (orthogonalise(size_, active_[size_].gradient)) ++size_;
    }
    while (!solve_equalities()) {
    }
  }

  /// Adds an inequality that z violates and removes those whose multipliers it reduces to zero. False: no z satisfies
  /// it together with the others; the set is unchanged.
  bool add(const Inequality& inequality) noexcept {
    const Inequality saved[kCapacity] = {active_[0], active_[1], active_[2], active_[3], active_[4], active_[5]};
    const int saved_size = size_;
    const double square = inequality.gradient.squaredNorm();
    double added = 0.0;  // multiplier of the new inequality
    for (int exchange = 0; exchange <= kCapacity; ++exchange) {
      Eigen::Matrix<double, kCapacity, 1> along;
      Vector6 step = inequality.gradient;
      project_out(step, along);
      const double steepness = step.squaredNorm();
      const bool dependent = size_ == kCapacity || steepness < kDependent * square;
      Eigen::Matrix<double, kCapacity, 1> decrease;
      back_substitute(along, decrease);
      int leaves = -1;
      double dual_step = 0.0;
      for (int j = 0; j < size_; ++j) {
        if (!(decrease[j] > 1e-12)) continue;
        const double allowed = active_[j].multiplier / decrease[j];
        if (leaves < 0 || allowed < dual_step) {
          leaves = j;
          dual_step = allowed;
        }
      }
      const double violation = inequality.rhs - inequality.gradient.dot(z_);
      const double primal_step = dependent ? 0.0 : violation / steepness;
      if (dependent && leaves < 0) break;
      const bool full = !dependent && (leaves < 0 || primal_step <= dual_step);
      const double length = full ? primal_step : dual_step;
      for (int j = 0; j < size_; ++j) active_[j].multiplier -= length * decrease[j];
      added += length;
      if (!dependent) z_ += length * step;
      if (full) {
        active_[size_] = inequality;
        active_[size_].multiplier = added;
        if (orthogonalise(size_, inequality.gradient)) ++size_;
        for (int j = 0; j < size_; ++j)
          active_[j].multiplier = active_[j].multiplier > 0.0 ? active_[j].multiplier : 0.0;
        return true;
      }
      remove(leaves);
    }
    for (int j = 0; j < saved_size; ++j) active_[j] = saved[j];
    size_ = saved_size;
    resolve();
    return false;
  }

 private:
  static constexpr double kDependent = 1e-12;  // squared sine of the angle to the span of the others

  /// Subtracts from `v` its part in the span of the set; `along` receives Q' v.
  void project_out(Vector6& v, Eigen::Matrix<double, kCapacity, 1>& along) const noexcept {
    for (int j = 0; j < size_; ++j) along[j] = 0.0;
    for (int pass = 0; pass < 2; ++pass) {
      for (int j = 0; j < size_; ++j) {
        const double part = q_.col(j).dot(v);
        v -= part * q_.col(j);
        along[j] += part;
      }
    }
  }

  /// Computes column `k` of Q and R from the gradient. False: it depends on the columns before it.
  bool orthogonalise(int k, const Vector6& gradient) noexcept {
    Vector6 v = gradient;
    Eigen::Matrix<double, kCapacity, 1> along;
    project_out(v, along);
    const double square = v.squaredNorm();
    if (!(square > kDependent * gradient.squaredNorm())) return false;
    const double length = std::sqrt(square);
    for (int j = 0; j < k; ++j) r_(j, k) = along[j];
    r_(k, k) = length;
    q_.col(k) = v / length;
    return true;
  }

  /// Computes x = R^-1 y.
  void back_substitute(const Eigen::Matrix<double, kCapacity, 1>& y,
                       Eigen::Matrix<double, kCapacity, 1>& x) const noexcept {
    for (int i = size_ - 1; i >= 0; --i) {
      double sum = y[i];
      for (int j = i + 1; j < size_; ++j) sum -= r_(i, j) * x[j];
      x[i] = sum / r_(i, i);
    }
  }

  /// Removes inequality `k` and updates Q and R.
  void remove(int k) noexcept {
    for (int i = k; i + 1 < size_; ++i) active_[i] = active_[i + 1];
    --size_;
    const int after = size_;
    for (size_ = k; size_ < after; ++size_) orthogonalise(size_, active_[size_].gradient);
  }

  /// Solves R' R multiplier = rhs - C' target. False: a multiplier was negative, and the most negative one was removed.
  bool solve_equalities() noexcept {
    Eigen::Matrix<double, kCapacity, 1> y, multiplier;
    z_ = target_;
    for (int i = 0; i < size_; ++i) {
      double sum = active_[i].rhs - active_[i].gradient.dot(target_);
      for (int j = 0; j < i; ++j) sum -= r_(j, i) * y[j];
      y[i] = sum / r_(i, i);
      z_ += y[i] * q_.col(i);
    }
    back_substitute(y, multiplier);
    int worst = -1;
    for (int i = 0; i < size_; ++i) {
      active_[i].multiplier = multiplier[i];
      if (multiplier[i] < 0.0 && (worst < 0 || multiplier[i] < multiplier[worst])) worst = i;
    }
    if (worst < 0) return true;
    remove(worst);
    return false;
  }

  Vector6 target_ = Vector6::Zero();
  Vector6 z_ = Vector6::Zero();
  int size_{};
  Inequality active_[kCapacity];
  Matrix6 q_;
  Matrix6 r_;
};

}  // namespace godobject
