#include "calib/exchange/lens_fit.h"

#include <Eigen/Cholesky>
#include <vector>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr int kFitGrid = 24;     // steps across the image for the fit
constexpr int kLossGrid = 128;   // and for what is lost: near a lens's fold it rises steeply
constexpr int kIterations = 20;  // of Gauss-Newton; the problem is nearly linear

struct Sample {
  Eigen::Vector2d pixel;  ///< raw [px]
  Eigen::Vector2d ray;    ///< normalised
};

/// The image's pixels that the lens model has a ray for, on a grid with the borders.
std::vector<Sample> samplesOf(const CameraModel& camera, int steps) {
  std::vector<Sample> samples;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const Eigen::Vector2d pixel((camera.width - 1.0) * i / steps,
                                  (camera.height - 1.0) * j / steps);
      const Outcome<Eigen::Vector2d> ray = undistortPixel(camera, pixel);
      if (ray) {
        samples.push_back({pixel, *ray});
      }
    }
  }
  if (samples.size() < 20U) {
    throw InputError("the lens model cannot be inverted in most of the image");
  }
  return samples;
}

/// fx fy cx cy k1 [k2 p1 p2] to a camera and back.
Eigen::VectorXd valuesOf(const CameraModel& camera, int terms) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(4 + terms);
  values.head<4>() << camera.K(0, 0), camera.K(1, 1), camera.K(0, 2), camera.K(1, 2);
  const auto told = std::min<Eigen::Index>(terms, camera.distortion.size());
  values.segment(4, told) = camera.distortion.head(told);
  return values;
}

CameraModel cameraOf(const CameraModel& size, const Eigen::VectorXd& values) {
  CameraModel camera = size;
  camera.K << values[0], 0.0, values[2], 0.0, values[1], values[3], 0.0, 0.0, 1.0;
  camera.distortion = Eigen::VectorXd::Zero(4);
  camera.distortion.head(values.size() - 4) = values.tail(values.size() - 4);
  return camera;
}

Eigen::VectorXd residuals(const CameraModel& camera, const std::vector<Sample>& samples) {
  Eigen::VectorXd r(2 * static_cast<Eigen::Index>(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    r.segment<2>(2 * static_cast<Eigen::Index>(i)) =
        projectNormalised(camera, samples[i].ray) - samples[i].pixel;
  }
  return r;
}

double largest(const Eigen::VectorXd& r) {
  double worst = 0.0;
  for (Eigen::Index i = 0; i + 1 < r.size(); i += 2) {
    worst = std::max(worst, r.segment<2>(i).norm());
  }
  return worst;
}

CameraModel fit(const CameraModel& camera, int terms, const std::vector<Sample>& samples) {
  Eigen::VectorXd values = valuesOf(camera, terms);
  for (int n = 0; n < kIterations; ++n) {
    const Eigen::VectorXd r = residuals(cameraOf(camera, values), samples);
    Eigen::MatrixXd J(r.size(), values.size());
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      const double step = k < 4 ? 1e-2 : 1e-5;
      Eigen::VectorXd moved = values;
      moved[k] += step;
      J.col(k) = (residuals(cameraOf(camera, moved), samples) - r) / step;
    }
    const Eigen::VectorXd scale = J.colwise().norm().cwiseMax(1e-12);
    const Eigen::MatrixXd scaled = J * scale.cwiseInverse().asDiagonal();
    const Eigen::VectorXd step =
        (scaled.transpose() * scaled).ldlt().solve(scaled.transpose() * -r);
    values += step.cwiseQuotient(scale);
  }
  return cameraOf(camera, values);
}

/// Are all terms from `first` on zero?
bool endsAt(const CameraModel& camera, Eigen::Index first) {
  const Eigen::Index n = camera.distortion.size();
  return n <= first || camera.distortion.tail(n - first).isZero(0.0);
}

}  // namespace

FittedLens closestLens(const CameraModel& camera, LensKind kind) {
  if (kind == LensKind::kFull) {
    return {camera, 0.0};
  }
  const int terms = kind == LensKind::kRadialOne ? 1 : 4;
  if (endsAt(camera, terms)) {
    return {cameraOf(camera, valuesOf(camera, terms)), 0.0};
  }
  const CameraModel fitted = fit(camera, terms, samplesOf(camera, kFitGrid));
  if (!fitted.K.allFinite() || !fitted.distortion.allFinite()) {
    throw InputError("the lens cannot be told in a model with fewer terms");
  }
  return {fitted, largest(residuals(fitted, samplesOf(camera, kLossGrid)))};
}

InverseRadial inverseRadial(const CameraModel& camera) {
  const Eigen::Vector2d focal(camera.K(0, 0), camera.K(1, 1));
  double above = 0.0;
  double below = 0.0;
  const std::vector<Sample> samples = samplesOf(camera, kLossGrid);
  for (const Sample& s : samples) {
    const Eigen::Vector2d seen = distortNormalised(camera, s.ray);
    const Eigen::Vector2d slope = seen * seen.squaredNorm();
    above += slope.dot(s.ray - seen);
    below += slope.squaredNorm();
  }
  InverseRadial inverse{below > 0.0 ? above / below : 0.0};
  for (const Sample& s : samples) {
    const Eigen::Vector2d seen = distortNormalised(camera, s.ray);
    const Eigen::Vector2d back = seen * (1.0 + inverse.kdu * seen.squaredNorm());
    inverse.loss_px = std::max(inverse.loss_px, (back - s.ray).cwiseProduct(focal).norm());
  }
  return inverse;
}

}  // namespace ringhook
