#include "rig/camera_model.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>

namespace ringhook {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kLargestRadius = 10.0;  // 84 degrees off the axis: no lens of this model sees it
constexpr int kLargestIterations = 30;
constexpr double kConverged = 1e-13;  // normalised; 2.5e-10 px at f = 2500 px

/// k1 k2 p1 p2 k3 k4 k5 k6, the missing ones zero.
std::array<double, 8> coefficients(const CameraModel& camera) {
  std::array<double, 8> k{};
  for (Eigen::Index i = 0; i < camera.distortion.size() && i < 8; ++i) {
    k[static_cast<std::size_t>(i)] = camera.distortion[i];
  }
  return k;
}

struct Radial {
  double scale;  // s
  double slope;  // ds / d(r^2)
};

Radial radial(const std::array<double, 8>& k, double r2) {
  const double numerator = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double denominator = 1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7]));
  const double numerator_slope = k[0] + r2 * (2.0 * k[1] + r2 * 3.0 * k[4]);
  const double denominator_slope = k[5] + r2 * (2.0 * k[6] + r2 * 3.0 * k[7]);
  const double scale = numerator / denominator;
  return {scale, (numerator_slope - scale * denominator_slope) / denominator};
}

/// d(s r)/dr: positive while the lens model is one-to-one along the radius.
double growth(const std::array<double, 8>& k, double r) {
  const Radial s = radial(k, r * r);
  return s.scale + 2.0 * r * r * s.slope;
}

}  // namespace

Vector2d distortNormalised(const CameraModel& camera, const Vector2d& normalised,
                           Matrix2d* jacobian) {
  const auto k = coefficients(camera);
  const double x = normalised.x();
  const double y = normalised.y();
  const double p1 = k[2];
  const double p2 = k[3];
  const Radial s = radial(k, x * x + y * y);
  if (jacobian != nullptr) {
    const double cross = 2.0 * x * y * s.slope + 2.0 * p1 * x + 2.0 * p2 * y;
    *jacobian << s.scale + 2.0 * x * x * s.slope + 2.0 * p1 * y + 6.0 * p2 * x, cross, cross,
        s.scale + 2.0 * y * y * s.slope + 6.0 * p1 * y + 2.0 * p2 * x;
  }
  return {s.scale * x + 2.0 * p1 * x * y + p2 * (3.0 * x * x + y * y),
          s.scale * y + p1 * (x * x + 3.0 * y * y) + 2.0 * p2 * x * y};
}

Vector2d projectNormalised(const CameraModel& camera, const Vector2d& normalised) {
  const Vector2d d = distortNormalised(camera, normalised);
  return {camera.K(0, 0) * d.x() + camera.K(0, 2), camera.K(1, 1) * d.y() + camera.K(1, 2)};
}

Outcome<Vector2d> undistortPixel(const CameraModel& camera, const Vector2d& pixel) {
  const Vector2d target((pixel.x() - camera.K(0, 2)) / camera.K(0, 0),
                        (pixel.y() - camera.K(1, 2)) / camera.K(1, 1));
  const auto k = coefficients(camera);
  Vector2d x = target;
  if (growth(k, x.norm()) <= 0.0) {
    x.setZero();
  }
  for (int i = 0; i < kLargestIterations; ++i) {
    Matrix2d jacobian;
    const Vector2d error = distortNormalised(camera, x, &jacobian) - target;
    const Vector2d step = jacobian.inverse() * error;
    x -= step;
    if (!x.allFinite() || x.norm() > kLargestRadius) {
      break;
    }
    if (step.norm() < kConverged * (1.0 + x.norm())) {
      // The root must be on the near branch: s r grows all the way to it.
      for (int part = 1; part <= 8; ++part) {
        if (growth(k, x.norm() * part / 8.0) <= 0.0) {
          return Refusal{"pixel beyond the lens model"};
        }
      }
      return x;
    }
  }
  return Refusal{"pixel beyond the lens model"};
}

double foldRadius(const CameraModel& camera) {
  const auto k = coefficients(camera);
  constexpr double step = 0.01;
  double inside = 0.0;
  while (growth(k, inside + step) > 0.0) {
    inside += step;
    if (inside >= kLargestRadius) {
      return std::numeric_limits<double>::infinity();
    }
  }
  double outside = inside + step;
  while (outside - inside > 1e-12) {
    const double middle = 0.5 * (inside + outside);
    (growth(k, middle) > 0.0 ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace ringhook
