#include "calib/solve/motion_spline.h"

#include <algorithm>

namespace ringhook {
namespace {

using Point = Eigen::Matrix<double, 6, 1>;

/// Second derivatives at the knots: the tridiagonal system by elimination (Thomas).
std::vector<Point> naturalCurvature(const std::vector<Time>& t, const std::vector<Point>& y) {
  const std::size_t n = t.size();
  std::vector<double> upper(n, 0.0);
  std::vector<Point> m(n, Point::Zero());
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = t[i] - t[i - 1];
    const double after = t[i + 1] - t[i];
    const double pivot = 2.0 * (before + after) - before * upper[i - 1];
    upper[i] = after / pivot;
    const Point slope = (y[i + 1] - y[i]) / after - (y[i] - y[i - 1]) / before;
    m[i] = (6.0 * slope - before * m[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) {
    m[i] -= upper[i] * m[i + 1];
  }
  return m;
}

}  // namespace

MotionSpline::MotionSpline(const std::vector<StampedPoint>& points, double largest_gap_s)
    : middle_(points[points.size() / 2].pose.linear()), largest_gap_s_(largest_gap_s) {
  for (const StampedPoint& point : points) {
    Point value;
    value << point.pose.translation(), thetaU(middle_.transpose() * point.pose.linear());
    stamps_.push_back(point.stamp);
    points_.push_back(value);
  }
  curvature_ = naturalCurvature(stamps_, points_);
}

std::optional<Pose> MotionSpline::at(Time time) const {
  const auto above = std::upper_bound(stamps_.begin(), stamps_.end(), time);
  if (above == stamps_.begin() || above == stamps_.end()) {
    return std::nullopt;
  }
  const auto i = static_cast<std::size_t>(above - stamps_.begin());
  const double h = stamps_[i] - stamps_[i - 1];
  if (h > largest_gap_s_) {
    return std::nullopt;
  }
  const double b = (time - stamps_[i - 1]) / h;
  const double a = 1.0 - b;
  const Point value =
      a * points_[i - 1] + b * points_[i] +
      (h * h / 6.0) * ((a * a * a - a) * curvature_[i - 1] + (b * b * b - b) * curvature_[i]);
  const Pose relative = makePoseThetaU(Eigen::Vector3d::Zero(), value.tail<3>());
  Pose pose = Pose::Identity();
  pose.linear() = middle_ * relative.linear();
  pose.translation() = value.head<3>();
  return pose;
}

}  // namespace ringhook
