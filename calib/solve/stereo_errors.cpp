// How far a solution is from what was seen: in the images, and in rows after rectification.

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <set>

#include "calib/solve/stereo_problem.h"
#include "core/shortest_turn.h"

namespace ringhook {

std::vector<ViewError> viewErrors(const StereoSolution& solution,
                                  const std::vector<StereoView>& views, const Board& board) {
  const std::vector<Eigen::Vector3d> points =
      solution.board_points.empty() ? board.points() : solution.board_points;
  const auto residual2 = [](const CameraModel& camera, const Eigen::Vector3d& point_c,
                            const Eigen::Vector2d& seen) {
    return (projectNormalised(camera, point_c.hnormalized()) - seen).squaredNorm();
  };
  std::vector<ViewError> errors;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto squares = [&](const CameraModel& camera, const Pose& cMt,
                             const BoardSighting& sighting) {
      double sum = 0.0;
      for (std::size_t j = 0; j < sighting.ids.size(); ++j) {
        const Eigen::Vector3d& point_t = points[static_cast<std::size_t>(sighting.ids[j])];
        sum += residual2(camera, cMt * point_t, sighting.pixels[j]);
      }
      return sum;
    };
    const double left = squares(solution.rig.left, solution.c1Mt[i], views[i].left);
    const double right =
        squares(*solution.rig.right, solution.rig.c2Mc1 * solution.c1Mt[i], views[i].right);
    const auto n_left = static_cast<double>(views[i].left.ids.size());
    const auto n_right = static_cast<double>(views[i].right.ids.size());
    errors.push_back({std::sqrt(left / n_left), std::sqrt(right / n_right),
                      std::sqrt((left + right) / (n_left + n_right)),
                      static_cast<int>(n_left + n_right)});
  }
  return errors;
}

double rms(const std::vector<ViewError>& errors) {
  double sum = 0.0;
  double points = 0.0;
  for (const ViewError& e : errors) {
    sum += e.both_px * e.both_px * e.points;
    points += e.points;
  }
  return std::sqrt(sum / points);
}

int redundancy(const std::vector<StereoView>& views, const FitOptions& options) {
  std::size_t points = 0;
  std::set<int> seen;
  for (const StereoView& view : views) {
    points += view.left.ids.size() + view.right.ids.size();
    seen.insert(view.left.ids.begin(), view.left.ids.end());
    seen.insert(view.right.ids.begin(), view.right.ids.end());
  }
  const int n = static_cast<int>(views.size());
  const int shape = options.board_shape ? 3 * static_cast<int>(seen.size()) - 7 : 0;
  return 2 * static_cast<int>(points) - 2 * (4 + static_cast<int>(options.terms)) - 6 * (n + 1) -
         shape;
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
  std::size_t j = 0;
  for (std::size_t i = 0; i < view.left.ids.size(); ++i) {
    while (j < view.right.ids.size() && view.right.ids[j] < view.left.ids[i]) {
      ++j;
    }
    if (j == view.right.ids.size() || view.right.ids[j] != view.left.ids[i]) {
      continue;
    }
    const double d = row(rig.left, level * half, view.left.pixels[i]) -
                     row(right, level * half.conjugate(), view.right.pixels[j]);
    differences.push_back(std::isfinite(d) ? d : std::numeric_limits<double>::infinity());
  }
  return differences;
}

}  // namespace ringhook
