// How far a solution is from what was seen: in the images, and in rows after rectification.

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "calib/solve/stereo_problem.h"
#include "core/shortest_turn.h"

namespace ringhook {

std::vector<ViewError> viewErrors(const StereoSolution& solution,
                                  const std::vector<StereoView>& views, const Chessboard& board) {
  const std::vector<Eigen::Vector3d> points = board.points();
  const auto residual2 = [](const CameraModel& camera, const Eigen::Vector3d& point_c,
                            const Eigen::Vector2d& seen) {
    return (projectNormalised(camera, point_c.hnormalized()) - seen).squaredNorm();
  };
  std::vector<ViewError> errors;
  for (std::size_t i = 0; i < views.size(); ++i) {
    double left = 0.0;
    double right = 0.0;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const Eigen::Vector3d point_c1 = solution.c1Mt[i] * points[j];
      left += residual2(solution.rig.left, point_c1, views[i].left[j]);
      right += residual2(*solution.rig.right, solution.rig.c2Mc1 * point_c1, views[i].right[j]);
    }
    const auto n = static_cast<double>(points.size());
    errors.push_back(
        {std::sqrt(left / n), std::sqrt(right / n), std::sqrt((left + right) / (2 * n))});
  }
  return errors;
}

double rms(const std::vector<ViewError>& errors) {
  double sum = 0.0;
  for (const ViewError& e : errors) {
    sum += e.both_px * e.both_px;
  }
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

int redundancy(std::size_t views, const Chessboard& board, LensTerms terms) {
  const int n = static_cast<int>(views);
  const int residuals = 4 * n * static_cast<int>(board.size());
  return residuals - 2 * (4 + static_cast<int>(terms)) - 6 * (n + 1);
}

std::vector<double> rowDifferences(const StereoRig& rig, const StereoView& view) {
  // Both cameras turn half way towards each other, then together until the baseline is along x.
  const CameraModel& right = rig.right.value();
  const Eigen::AngleAxisd c2Rc1(rig.c2Mc1.linear());
  const Eigen::Quaterniond half(Eigen::AngleAxisd(0.5 * c2Rc1.angle(), c2Rc1.axis()));
  const Eigen::Vector3d along = half.conjugate() * rig.c2Mc1.translation();
  const Eigen::Vector3d x_axis = (along.x() < 0.0 ? -1.0 : 1.0) * Eigen::Vector3d::UnitX();
  const Eigen::Quaterniond level = shortestTurn(along, x_axis);
  const double focal = 0.25 * (rig.left.K(0, 0) + rig.left.K(1, 1) + right.K(0, 0) + right.K(1, 1));
  const auto row = [&](const CameraModel& camera, const Eigen::Quaterniond& turn,
                       const Eigen::Vector2d& pixel) {
    const Outcome<Eigen::Vector2d> ray = undistortPixel(camera, pixel);
    return ray ? focal * (turn * ray->homogeneous()).hnormalized().y()
               : std::numeric_limits<double>::infinity();
  };
  std::vector<double> differences;
  for (std::size_t j = 0; j < view.left.size(); ++j) {
    const double d = row(rig.left, level * half, view.left[j]) -
                     row(right, level * half.conjugate(), view.right[j]);
    differences.push_back(std::isfinite(d) ? d : std::numeric_limits<double>::infinity());
  }
  return differences;
}

}  // namespace ringhook
