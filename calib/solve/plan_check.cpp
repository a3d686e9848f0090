#include "calib/solve/plan_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "rig/camera_model.h"
#include "stereo/triangulation.h"

namespace ringhook {
namespace {

PinholeView undistortedView(const CameraModel& camera, const Pose& cMc1) {
  return {camera.K(0, 0),
          camera.K(1, 1),
          camera.K(0, 2),
          camera.K(1, 2),
          camera.width,
          camera.height,
          cMc1};
}

/// The undistorted pixel of a raw one.
Outcome<Eigen::Vector2d> undistorted(const CameraModel& camera, const Eigen::Vector2d& raw) {
  const Outcome<Eigen::Vector2d> ray = undistortPixel(camera, raw);
  if (!ray) {
    return ray;
  }
  return Eigen::Vector2d((camera.K * ray->homogeneous()).head<2>());
}

/// Everything that measures one point again and again.
struct Bench {
  const PlanView& view;
  double sigma_px;
  std::mt19937_64 engine;
  std::normal_distribution<double> noise;
  TriangulationOptions options;

  /// A raw pixel with noise, undistorted.
  Outcome<Eigen::Vector2d> seen(const CameraModel& camera, const Eigen::Vector3d& point_c) {
    const Eigen::Vector2d exact = projectNormalised(camera, point_c.hnormalized());
    const double du = noise(engine);
    const double dv = noise(engine);
    return undistorted(camera, exact + Eigen::Vector2d(du, dv));
  }

  Outcome<TriangulatedPoint> measure(const Eigen::Vector3d& point_c1) {
    const CameraModel& right_camera = *view.rig.right;
    const auto left_px = seen(view.rig.left, point_c1);
    const auto right_px = seen(right_camera, view.rig.c2Mc1 * point_c1);
    if (!left_px || !right_px) {
      return Refusal{"pixel beyond the lens model"};
    }
    return triangulateOptimal(undistortedView(view.rig.left, Pose::Identity()),
                              undistortedView(right_camera, view.rig.c2Mc1), *left_px, *right_px,
                              sigma_px, options);
  }
};

}  // namespace

std::vector<CheckedPoint> checkPlan(const PlanView& view,
                                    const std::vector<Eigen::Vector3d>& points_m, double sigma_px,
                                    int draws, std::uint64_t seed) {
  Bench bench{view,
              sigma_px,
              std::mt19937_64(seed),
              std::normal_distribution<double>(0.0, sigma_px),
              {1e-6, 2.0 + 5.0 * sigma_px}};
  std::vector<CheckedPoint> checked;
  for (const Eigen::Vector3d& point_m : points_m) {
    CheckedPoint point{point_m, std::sqrt(pointCovariance(view, point_m, sigma_px).trace())};
    const Eigen::Vector3d point_c1 = view.c1Mm * point_m;
    double sum = 0.0;
    for (int i = 0; i < draws; ++i) {
      const auto measured = bench.measure(point_c1);
      point.refused += measured ? 0 : 1;
      sum += measured ? (measured->point_c1 - point_c1).squaredNorm() : 0.0;
    }
    point.measured_m = std::sqrt(sum / std::max(1, draws - point.refused));
    checked.push_back(point);
  }
  return checked;
}

double largestDisagreement(const std::vector<CheckedPoint>& points) {
  double worst = 0.0;
  for (const CheckedPoint& p : points) {
    const double here = p.refused > 0 ? std::numeric_limits<double>::infinity()
                                      : std::abs(p.measured_m / p.predicted_m - 1.0);
    worst = std::max(worst, here);
  }
  return worst;
}

}  // namespace ringhook
