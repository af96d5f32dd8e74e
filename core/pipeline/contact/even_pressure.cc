#include "core/pipeline/contact/even_pressure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <Eigen/LU>

namespace godobject::detail {
namespace {

constexpr std::uint32_t kLeastPoints = 12;  // fewer do not describe a face

/// The load on one face.
struct FaceLoad {
  Vector3 normal = Vector3::Zero();
  Vector3 centre = Vector3::Zero();
  double load = 0.0;           ///< [m], as the multipliers
  double mean_distance = 0.0;  ///< of the forces from the place where it is least [m]
};

/// Returns the load of the forces on the face of force `first`, and takes them out of `left`, a bit mask.
FaceLoad take_face(const ConstrainedStep& step, std::uint32_t first, double thickness, std::uint32_t& left) noexcept {
  FaceLoad face;
  face.normal = step.forces[first].normal;
  std::uint32_t taken = 0;
  for (std::uint32_t i = first; i < step.force_count; ++i) {
    const ContactForce& force = step.forces[i];
    const double height = face.normal.dot(force.point - step.forces[first].point);
    if ((left >> i & 1) == 0 || !ContactPatches::have_one_normal(face.normal, force.normal)) continue;
    if (std::fabs(height) > thickness) continue;
    taken |= 1u << i;
    face.load += force.multiplier;
    face.centre += force.multiplier * force.point;
  }
  left &= ~taken;
  if (!(face.load > 0.0)) return face;
  face.centre /= face.load;
  constexpr int kSteps = 8;
  Vector3 median = face.centre;
  for (int k = 0; k <= kSteps; ++k) {  // Weiszfeld's method
    Vector3 next = Vector3::Zero();
    double weights = 0.0;
    face.mean_distance = 0.0;
    for (std::uint32_t i = first; i < step.force_count; ++i) {
      if ((taken >> i & 1) == 0) continue;
      const ContactForce& force = step.forces[i];
      const double distance = std::max((force.point - median).norm(), 1e-3 * thickness);
      face.mean_distance += force.multiplier / face.load * distance;
      weights += force.multiplier / distance;
      next += force.multiplier / distance * force.point;
    }
    median = next / weights;
  }
  return face;
}

/// The plane of a face, with its origin at the load's centre.
struct FacePlane {
  Vector3 t, u;  ///< unit axes

  explicit FacePlane(const Vector3& normal) noexcept : t(normal.unitOrthogonal()), u(normal.cross(t)) {}
};

/// Calls visit(x, y) for the sample points that touch the face [m].
template <class Visit>
void for_each_touching(const FaceLoad& face, const FacePlane& plane, const NearPoints& samples,
                       const ContactLengths& lengths, const Visit& visit) noexcept {
  const double touching = 2.0 * lengths.margin;
  for (std::uint32_t k = 0; k < samples.count; ++k) {
    if (!(samples.distance[k] <= touching)) continue;
    const Vector3 from_centre = samples.point(k) - face.centre;
    if (!(std::fabs(face.normal.dot(from_centre)) <= touching)) continue;
    visit(plane.t.dot(from_centre), plane.u.dot(from_centre));
  }
}

/// One side of the convex hull of points in the plane: per row of y the point that is farthest out along x, then only
/// the corners of the hull. `sign`: -1 for the side of small x, 1 for the other.
class HullSide {
 public:
  static constexpr int kRows = 16;

  explicit HullSide(double sign) noexcept : sign_(sign) {}

  /// Takes a point of the row into account; lowest and highest points have the rows -1 and kRows.
  void add(int row, double x, double y) noexcept {
    Corner& here = corner_[static_cast<std::size_t>(row + 1)];
    if (here.is_set && sign_ * x <= sign_ * here.x) return;
    here = {x, y, true};
  }
  /// Drops all points that are no corners of the hull. Call it after the last `add`.
  void close() noexcept {
    for (const Corner& next : corner_) {
      if (!next.is_set) continue;
      while (count_ >= 2 && !is_convex(chain_[count_ - 2], chain_[count_ - 1], next)) --count_;
      chain_[count_++] = next;
    }
  }
  /// Returns x of the side at a height that lies between the lowest and the highest point.
  double at(double y) const noexcept {
    std::size_t i = 1;
    while (i + 1 < count_ && chain_[i].y < y) ++i;
    const Corner& a = chain_[i - 1];
    const Corner& b = chain_[i];
    return a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);  // b is above a: y lies between the lowest and the highest point
  }

 private:
  struct Corner {
    double x{}, y{};
    bool is_set = false;
  };
  bool is_convex(const Corner& a, const Corner& b, const Corner& c) const noexcept {
    return sign_ * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) > 0.0;
  }

  double sign_;
  std::array<Corner, kRows + 2> corner_{};
  std::array<Corner, kRows + 2> chain_{};
  std::size_t count_ = 0;
};

/// The part of a plane that touching points cover: their convex hull, less the cells of a grid without a point. So it
/// does not matter that edges have more points than faces.
class CoveredPart {
 public:
  void widen(double x, double y) noexcept {
    ++count_;
    low_x_ = std::min(low_x_, x);
    high_x_ = std::max(high_x_, x);
    if (y < low_y_) {
      low_y_ = y;
      x_of_lowest_ = x;
    }
    if (y > high_y_) {
      high_y_ = y;
      x_of_highest_ = x;
    }
  }
  /// Call it after the last `widen`. False: too few points, or all on one line along an axis.
  bool divide() noexcept {
    if (count_ < kLeastPoints) return false;
    cells_ = std::clamp(static_cast<int>(std::sqrt(count_ / kInCell)), 3, kMostCells);
    const double width = high_x_ - low_x_;
    const double height = high_y_ - low_y_;
    return width > kSlender * height && height > kSlender * width;
  }
  /// Takes every point a second time. Call `close` after the last one.
  void occupy(double x, double y) noexcept {
    const int column = part(x - low_x_, high_x_ - low_x_, cells_);
    occupied_ |= std::uint64_t{1} << (column + kMostCells * part(y - low_y_, high_y_ - low_y_, cells_));
    const int row = part(y - low_y_, high_y_ - low_y_, HullSide::kRows);
    left_.add(row, x, y);
    right_.add(row, x, y);
  }
  void close() noexcept {
    for (HullSide* const side : {&left_, &right_}) {
      side->add(-1, x_of_lowest_, low_y_);
      side->add(HullSide::kRows, x_of_highest_, high_y_);
      side->close();
    }
  }

  /// Calls visit(x, y, area) for rectangles that fill the part [m, m^2].
  template <class Visit>
  void for_each_part(const Visit& visit) const noexcept {
    const double width = (high_x_ - low_x_) / cells_;
    const int rows = kRowsOfCell * cells_;
    const double height = (high_y_ - low_y_) / rows;
    for (int j = 0; j < rows; ++j) {
      const double y = low_y_ + (j + 0.5) * height;
      const double left = left_.at(y);
      const double right = right_.at(y);
      for (int i = 0; i < cells_; ++i) {
        if ((occupied_ >> (i + kMostCells * (j / kRowsOfCell)) & 1) == 0) continue;
        const double from = std::max(left, low_x_ + i * width);
        const double to = std::min(right, low_x_ + (i + 1) * width);
        if (to > from) visit(0.5 * (from + to), y, (to - from) * height);
      }
    }
  }

 private:
  static constexpr int kMostCells = 8;      // along an axis
  static constexpr int kRowsOfCell = 2;     // that follow the hull
  static constexpr double kInCell = 9.0;    // points for each cell, so that none inside of the face is empty
  static constexpr double kSlender = 1e-3;  // a narrower face is a line

  /// Returns the number of the part, of `parts` of the length, that contains a place.
  static int part(double place, double length, int parts) noexcept {
    return std::clamp(static_cast<int>(place / length * parts), 0, parts - 1);
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double low_x_ = kInfinity, high_x_ = -kInfinity;
  double low_y_ = kInfinity, high_y_ = -kInfinity;
  double x_of_lowest_{}, x_of_highest_{};
  std::uint32_t count_ = 0;
  int cells_{};
  std::uint64_t occupied_ = 0;
  HullSide left_{-1.0};
  HullSide right_{1.0};
};

/// Returns the mean distance of the covered part from the place where it is least, weighted by the linear pressure with
/// the load's centre [m]; 0 if no part is covered.
double mean_distance_of(const CoveredPart& part) noexcept {
  double whole = 0.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  part.for_each_part([&](double x, double y, double area) noexcept {
    const Eigen::Vector2d q(x, y);
    whole += area;
    sum += area * q;
    squares += area * q * q.transpose();
  });
  if (!(whole > 0.0)) return 0.0;
  const Eigen::Vector2d middle = sum / whole;
  const Eigen::Matrix2d spread = squares / whole - middle * middle.transpose();
  const double trace = spread.trace();
  if (!(spread.determinant() > 1e-6 * trace * trace)) return 0.0;
  // p(q) = 1 + slope . (q - middle) has its centre at q = 0
  const Eigen::Vector2d slope = -(spread.inverse() * middle);
  const auto pressure_on = [&](const Eigen::Vector2d& q, double area) noexcept {
    return area * std::max(0.0, 1.0 + slope.dot(q - middle));
  };
  // a step of Weiszfeld's method from the load's centre
  Eigen::Vector2d nearest = Eigen::Vector2d::Zero();
  double weights = 0.0;
  part.for_each_part([&](double x, double y, double area) noexcept {
    const Eigen::Vector2d q(x, y);
    const double weight = pressure_on(q, area) / std::max(q.norm(), 0.1 * std::sqrt(area));
    weights += weight;
    nearest += weight * q;
  });
  if (!(weights > 0.0)) return 0.0;
  nearest /= weights;
  double pressure = 0.0;
  double moment = 0.0;
  part.for_each_part([&](double x, double y, double area) noexcept {
    const Eigen::Vector2d q(x, y);
    pressure += pressure_on(q, area);
    moment += pressure_on(q, area) * (q - nearest).norm();
  });
  return moment / pressure;
}

/// Returns the mean distance of even pressure [m]; 0 if too few points touch.
double even_distance(const FaceLoad& face, const NearPoints& samples, const ContactLengths& lengths) noexcept {
  const FacePlane plane(face.normal);
  CoveredPart part;
  for_each_touching(face, plane, samples, lengths, [&](double x, double y) noexcept { part.widen(x, y); });
  if (!part.divide()) return 0.0;
  for_each_touching(face, plane, samples, lengths, [&](double x, double y) noexcept { part.occupy(x, y); });
  part.close();
  return mean_distance_of(part);
}

}  // namespace

ContactPatches patches_of(const ConstrainedStep& last, const NearPoints& samples, const ContactLengths& lengths,
                          WorkMeter& work) noexcept {
  ContactPatches found;
  std::uint32_t left = (1u << last.force_count) - 1;
  for (std::uint32_t i = 0; i < last.force_count && found.count < ContactPatches::kMost; ++i) {
    if ((left >> i & 1) == 0) continue;
    const FaceLoad face = take_face(last, i, lengths.margin, left);
    if (!(face.mean_distance > lengths.margin)) continue;
    const std::uint32_t scanned = 5 * samples.count;
    if (!work.has(cost_of(Work::kScan) * scanned)) break;
    work.add(Work::kScan, scanned);
    work.add(Work::kFace);
    const double even = even_distance(face, samples, lengths);
    if (!(even > 0.0)) continue;
    found.patch[found.count++] = {face.normal, face.centre, std::min(1.0, even / face.mean_distance)};
  }
  return found;
}

}  // namespace godobject::detail
