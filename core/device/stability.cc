// For the start only: dynamic matrices, eigenvalues of general matrices. Not part of the core's archive.
#include "core/device/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace godobject {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Eigen::Index;

/// exp(A t) and the integral of exp(A s) B over 0 .. t: two blocks of the exponential of [[A, B], [0, 0]] t, by scaling
/// and squaring. The scaled matrix has a norm of at most 0.5, for which 18 terms of Taylor's series are exact to
/// rounding: 0.5^19 / 19! = 1.6e-23.
struct Transition {
  Matrix state;
  Matrix input;

  Transition(const Matrix& A, const Matrix& B, double t) {
    const Index n = A.rows();
    Matrix generator = Matrix::Zero(n + B.cols(), n + B.cols());
    generator.topLeftCorner(n, n) = t * A;
    generator.topRightCorner(n, B.cols()) = t * B;
    const double size = generator.cwiseAbs().rowwise().sum().maxCoeff();
    const int squarings = size > 0.5 ? static_cast<int>(std::ceil(std::log2(size / 0.5))) : 0;
    generator /= std::exp2(squarings);
    const Matrix one = Matrix::Identity(generator.rows(), generator.cols());
    Matrix exponential = one;
    for (int k = 18; k >= 1; --k) exponential = one + generator * exponential / k;
    for (int k = 0; k < squarings; ++k) exponential = (exponential * exponential).eval();
    state = exponential.topLeftCorner(n, n);
    input = exponential.topRightCorner(n, B.cols());
  }
};

/// The loop with time in periods, joints scaled to a mass matrix with a diagonal of ones, and positions reduced to the
/// row space of the Jacobian.
struct ScaledLoop {
  Matrix inverse_mass;  // n x n
  Matrix damping;       // n x n
  Matrix row_space;     // n x r, orthonormal columns
  Matrix stiffness;     // r x r
  Matrix tool_damping;  // r x r
};

/// The bounds of the delay leave only positive periods.
bool is_possible(const LoopTiming& timing) noexcept {
  return timing.delay >= 0.0 && timing.delay < 100.0 * timing.period && timing.velocity_window >= 2 &&
         timing.velocity_window <= 100;
}

bool is_possible(const ArmLoop& loop) noexcept {
  for (const double number :
       {loop.stiffness, loop.rotation_stiffness, loop.tool_damping, loop.rotation_tool_damping}) {
    if (!std::isfinite(number)) return false;
  }
  return is_possible(loop.timing) && loop.joint_count >= 1 && loop.joint_count <= kMaxJoints && loop.mass.allFinite() &&
         loop.damping.allFinite() && loop.jacobian.allFinite();
}

Vector6 translation_and_rotation(double translation, double rotation) noexcept {
  Vector6 both;
  both << Vector3::Constant(translation), Vector3::Constant(rotation);
  return both;
}

bool scale(const ArmLoop& loop, ScaledLoop& scaled) {
  const Index n = loop.joint_count;
  const double T = loop.timing.period;
  const Eigen::LLT<Matrix> factor(loop.mass.topLeftCorner(n, n));
  if (factor.info() != Eigen::Success) return false;
  const Eigen::VectorXd root = loop.mass.diagonal().head(n).cwiseSqrt();
  const Eigen::VectorXd unit = root.cwiseInverse();
  scaled.inverse_mass = root.asDiagonal() * factor.solve(Matrix(root.asDiagonal()));
  scaled.damping = (T * loop.damping.head(n).cwiseProduct(unit.cwiseAbs2())).asDiagonal();

  const Matrix jacobian = loop.jacobian.leftCols(n) * unit.asDiagonal();
  Eigen::ColPivHouseholderQR<Matrix> rows(jacobian.transpose());
  rows.setThreshold(1e-9);
  const Matrix basis = rows.householderQ();
  scaled.row_space = basis.leftCols(rows.rank());
  const Matrix reduced = jacobian * scaled.row_space;
  const Vector6 k = translation_and_rotation(loop.stiffness, loop.rotation_stiffness);
  const Vector6 b = translation_and_rotation(loop.tool_damping, loop.rotation_tool_damping);
  scaled.stiffness = T * T * (reduced.transpose() * k.asDiagonal() * reduced);
  scaled.tool_damping = T * (reduced.transpose() * b.asDiagonal() * reduced);
  return true;
}

/// The map from one period to the next. States: positions y (r), velocities (n), the last D + 1 inputs (r each, newest
/// first), the last N - 1 positions.
Matrix period_map(const ScaledLoop& loop, const LoopTiming& timing) {
  const Index n = loop.row_space.rows();
  const Index r = loop.row_space.cols();
  const double periods = timing.delay / timing.period;
  const auto whole = static_cast<Index>(std::floor(periods));
  const double fraction = periods - static_cast<double>(whole);
  const Index window = timing.velocity_window;

  Matrix A = Matrix::Zero(r + n, r + n);
  A.topRightCorner(r, n) = loop.row_space.transpose();
  A.bottomRightCorner(n, n) = -loop.inverse_mass * loop.damping;
  Matrix B = Matrix::Zero(r + n, r);
  B.bottomRows(n) = loop.inverse_mass * loop.row_space;
  const Transition before(A, B, fraction);       // with the input of D + 1 samples ago
  const Transition after(A, B, 1.0 - fraction);  // with the input of D samples ago

  const Index inputs = r + n;
  const Index positions = inputs + (whole + 1) * r;
  const Index size = positions + (window - 1) * r;
  Matrix law = Matrix::Zero(r, size);  // the input of this sample
  const auto N = static_cast<double>(window);
  for (Index age = 0; age < window; ++age) {
    const double weight = 12.0 / (N * (N * N - 1.0)) * (0.5 * (N - 1.0) - static_cast<double>(age));
    law.middleCols(age == 0 ? 0 : positions + (age - 1) * r, r) = -weight * loop.tool_damping;
  }
  law.leftCols(r) -= loop.stiffness;

  Matrix map = Matrix::Zero(size, size);
  map.topLeftCorner(r + n, r + n) = after.state * before.state;
  map.block(0, inputs + whole * r, r + n, r) += after.state * before.input;
  if (whole == 0) {
    map.topRows(r + n) += after.input * law;
  } else {
    map.block(0, inputs + (whole - 1) * r, r + n, r) += after.input;
  }
  map.middleRows(inputs, r) = law;
  map.block(inputs + r, inputs, whole * r, whole * r).setIdentity();
  map.block(positions, 0, r, r).setIdentity();
  map.block(positions + r, positions, (window - 2) * r, (window - 2) * r).setIdentity();
  return map;
}

ArmLoop as_arm(const AxisLoop& axis, double stiffness) noexcept {
  ArmLoop loop;
  loop.joint_count = 1;
  loop.mass(0, 0) = axis.mass;
  loop.damping[0] = axis.damping;
  loop.jacobian(0, 0) = 1.0;
  loop.stiffness = stiffness;
  loop.tool_damping = axis.virtual_damping;
  loop.timing = axis.timing;
  return loop;
}

/// Largest x from `start` on with `stable(x)`; 0 if `start` is not stable.
template <class Stable>
double largest_stable(double start, Stable stable) {
  if (!stable(start)) return 0.0;
  double low = start;
  double high = 2.0 * start;
  for (int i = 0; stable(high); ++i) {
    if (i == 100) return std::numeric_limits<double>::infinity();
    low = high;
    high *= 2.0;
  }
  while (high - low > 1e-6 * high) {
    const double middle = 0.5 * (low + high);
    (stable(middle) ? low : high) = middle;
  }
  return low;
}

/// The softest spring of the searches, in m/T^2. Derived: its poles lie sqrt(1e-8) = 1e-4 from 1, which the eigenvalue
/// solver still resolves: an eigenvalue of multiplicity two is known to about sqrt(2e-16) = 1.5e-8.
constexpr double kSoftest = 1e-8;

}  // namespace

double spectral_radius(const ArmLoop& loop) noexcept {
  ScaledLoop scaled;
  if (!is_possible(loop) || !scale(loop, scaled)) return std::numeric_limits<double>::infinity();
  const Eigen::EigenSolver<Matrix> solver(period_map(scaled, loop.timing), /*computeEigenvectors=*/false);
  if (solver.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  return solver.eigenvalues().cwiseAbs().maxCoeff();
}

double stiffness_margin(const ArmLoop& loop) noexcept {
  if (!(loop.stiffness > 0.0) && !(loop.rotation_stiffness > 0.0)) return 0.0;
  return largest_stable(1e-3, [&](double factor) {
    ArmLoop stiffer = loop;
    stiffer.stiffness *= factor;
    stiffer.rotation_stiffness *= factor;
    return spectral_radius(stiffer) < 1.0;
  });
}

double passivity_excess(const ArmLoop& loop) noexcept {
  const Index n = loop.joint_count;
  const Vector6 k = translation_and_rotation(loop.stiffness, loop.rotation_stiffness);
  Matrix excess = loop.damping.head(n).asDiagonal();
  excess -= (0.5 * loop.timing.period + loop.timing.delay) *
            (loop.jacobian.leftCols(n).transpose() * k.asDiagonal() * loop.jacobian.leftCols(n));
  return Eigen::SelfAdjointEigenSolver<Matrix>(excess, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

double stability_boundary(const AxisLoop& loop) noexcept {
  const double softest = kSoftest * loop.mass / (loop.timing.period * loop.timing.period);
  return largest_stable(softest, [&](double stiffness) { return spectral_radius(as_arm(loop, stiffness)) < 1.0; });
}

double damping_boundary(const AxisLoop& loop) noexcept {
  const double softest = kSoftest * loop.mass / (loop.timing.period * loop.timing.period);
  return largest_stable(1e-3 * loop.mass / loop.timing.period, [&](double virtual_damping) {
    AxisLoop damped = loop;
    damped.virtual_damping = virtual_damping;
    return spectral_radius(as_arm(damped, softest)) < 1.0;
  });
}

}  // namespace godobject
