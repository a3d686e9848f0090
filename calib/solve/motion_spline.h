#pragma once

/// \file
/// A smooth curve through stamped poses: the natural cubic spline of position and rotation vector,
/// the latter about the middle of the motion (so rotations stay well below half a turn of it).
/// Law: C2 piecewise cubics whose second derivative vanishes at both ends; the tridiagonal system
/// of de Boor, "A Practical Guide to Splines", 1978, chapter IV.

#include <optional>
#include <vector>

#include "core/pose.h"
#include "core/time.h"

namespace ringhook {

struct StampedPoint {
  Time stamp;
  Pose pose;
};

class MotionSpline {
 public:
  /// \param points stamps strictly growing, at least three; rotations within half a turn of the
  /// middle one's. \param largest_gap_s between two points; across a longer one nothing is told.
  MotionSpline(const std::vector<StampedPoint>& points, double largest_gap_s);

  /// Nothing outside of the points and in a gap.
  [[nodiscard]] std::optional<Pose> at(Time time) const;

 private:
  using Point = Eigen::Matrix<double, 6, 1>;  // position [m] over rotation vector [rad]
  std::vector<Time> stamps_;
  std::vector<Point> points_;
  std::vector<Point> curvature_;  // second derivatives
  Eigen::Matrix3d middle_;        // rotation that the vectors are counted from
  double largest_gap_s_;
};

}  // namespace ringhook
