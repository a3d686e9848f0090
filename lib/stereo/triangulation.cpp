#include "stereo/triangulation.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "stereo/projection.h"

namespace ringhook {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kLargestIterations = 20;
constexpr double kConverged = 1e-12;  // step over distance

struct Ray {
  Vector3d origin;                       // in c1 [m]
  Vector3d direction;                    // in c1, unit
  Eigen::Matrix<double, 3, 2> by_pixel;  // derivative of the direction [1/px]
};

Ray rayOf(const PinholeView& view, const Vector2d& px) {
  const Pose c1Mc = view.cMc1.inverse();
  const Vector3d d((px.x() - view.cx) / view.fx, (px.y() - view.cy) / view.fy, 1.0);
  const double length = d.norm();
  const Vector3d unit = c1Mc.linear() * d / length;
  Eigen::Matrix<double, 3, 2> by_pixel;
  by_pixel.col(0) = c1Mc.linear().col(0) / (view.fx * length);
  by_pixel.col(1) = c1Mc.linear().col(1) / (view.fy * length);
  return {c1Mc.translation(), unit, by_pixel - unit * (unit.transpose() * by_pixel)};
}

/// The four residuals (seen minus projected) and their derivative.
struct Residuals {
  Eigen::Vector4d r;
  Eigen::Matrix<double, 4, 3> J;
};

using Views = std::array<const PinholeView*, 2>;
using Pixels = std::array<Vector2d, 2>;

std::optional<Residuals> residualsAt(const Views& views, const Pixels& pixels,
                                     const Vector3d& point_c1) {
  Residuals out;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto projection = projectWithJacobian(*views[i], point_c1);
    if (!projection) {
      return std::nullopt;
    }
    const auto row = static_cast<Eigen::Index>(2 * i);
    out.r.segment<2>(row) = pixels[i] - projection->pixel;
    out.J.middleRows<2>(row) = projection->jacobian;
  }
  return out;
}

/// RMS residual in place, or the reason to refuse the point.
Outcome<TriangulatedPoint> judged(TriangulatedPoint point, const std::optional<Residuals>& at,
                                  const TriangulationOptions& options) {
  if (!at) {
    return Refusal{"point behind a camera"};
  }
  point.residual_px = at->r.norm() / 2.0;
  if (!(point.residual_px <= options.largest_residual_px)) {
    return Refusal{"residual too large"};
  }
  return point;
}

}  // namespace

Outcome<TriangulatedPoint> triangulateMidpoint(const PinholeView& left, const PinholeView& right,
                                               const Vector2d& left_px, const Vector2d& right_px,
                                               double sigma_px,
                                               const TriangulationOptions& options) {
  const std::array<Ray, 2> rays = {rayOf(left, left_px), rayOf(right, right_px)};
  TriangulatedPoint out;
  const double sine = rays[0].direction.cross(rays[1].direction).norm();
  out.angle_rad = std::atan2(sine, rays[0].direction.dot(rays[1].direction));
  if (!(out.angle_rad >= options.smallest_angle_rad)) {
    return Refusal{"parallel rays"};
  }
  Matrix3d A = Matrix3d::Zero();
  Vector3d b = Vector3d::Zero();
  for (const Ray& ray : rays) {
    const Matrix3d P = Matrix3d::Identity() - ray.direction * ray.direction.transpose();
    A += P;
    b += P * ray.origin;
  }
  const Matrix3d inverse = A.inverse();
  out.point_c1 = inverse * b;
  // dX = A^-1 sum dP_i (o_i - X) with dP = -(dd d^T + d dd^T).
  Matrix3d sum = Matrix3d::Zero();
  for (const Ray& ray : rays) {
    const Vector3d back = ray.origin - out.point_c1;
    const Eigen::Matrix<double, 3, 2> by_pixel =
        -inverse * (ray.by_pixel * ray.direction.dot(back) +
                    ray.direction * (back.transpose() * ray.by_pixel));
    sum += by_pixel * by_pixel.transpose();
  }
  out.covariance = sigma_px * sigma_px * sum;
  return judged(out, residualsAt({&left, &right}, {left_px, right_px}, out.point_c1), options);
}

Outcome<TriangulatedPoint> triangulateOptimal(const PinholeView& left, const PinholeView& right,
                                              const Vector2d& left_px, const Vector2d& right_px,
                                              double sigma_px,
                                              const TriangulationOptions& options) {
  TriangulationOptions generous = options;
  generous.largest_residual_px = 10.0 * options.largest_residual_px;
  auto start = triangulateMidpoint(left, right, left_px, right_px, sigma_px, generous);
  if (!start) {
    return start;
  }
  TriangulatedPoint out = *start;
  for (int i = 0; i < kLargestIterations; ++i) {
    const auto at = residualsAt({&left, &right}, {left_px, right_px}, out.point_c1);
    if (!at) {
      return Refusal{"point behind a camera"};
    }
    const Matrix3d inverse = Matrix3d(at->J.transpose() * at->J).inverse();
    const Vector3d step = inverse * (at->J.transpose() * at->r);
    out.point_c1 += step;
    if (step.norm() <= kConverged * out.point_c1.norm()) {
      out.covariance = sigma_px * sigma_px * inverse;
      return judged(out, residualsAt({&left, &right}, {left_px, right_px}, out.point_c1), options);
    }
  }
  return Refusal{"not converged"};
}

}  // namespace ringhook
