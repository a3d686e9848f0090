#include "prediction/swing_start.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "prediction/chi_square.h"

namespace ringhook {
namespace {

constexpr int kMaxIterations = 60;

/// Normal equations of the fit at one state.
struct Normal {
  double cost = std::numeric_limits<double>::infinity();  ///< half of what is minimised
  double chi_square = 0.0;
  int residuals = 0;
  SwingMatrix A = SwingMatrix::Zero();
  SwingVector b = SwingVector::Zero();
};

// ln(reach / length) is near what it is for hanging things.
void addReach(const SwingPrior& prior, double reach, double log_length, Normal& normal) {
  const double off = std::log(prior.reach_per_length) - (std::log(reach) - log_length);
  SwingVector slope = SwingVector::Zero();
  slope(kSwingLonger) = 1.0 / reach;
  slope(kSwingLogLength) = -1.0;
  const double weight = 1.0 / (prior.reach_sigma * prior.reach_sigma);
  normal.A += weight * slope.lazyProduct(slope.transpose());
  normal.b += weight * off * slope;
  normal.cost += 0.5 * weight * off * off;
}

void addPrior(const SwingPrior& prior, const SwingVector& start, Normal& normal) {
  normal.cost = 0.0;
  for (int i = 0; i < kSwingStates; ++i) {
    const double variance = prior.covariance(i, i);
    if (variance > 0.0) {
      const double off = prior.mean(i) - start(i);
      normal.A(i, i) += 1.0 / variance;
      normal.b(i) += off / variance;
      normal.cost += 0.5 * off * off / variance;
    }
  }
}

// Huber: quadratic up to the radius k of a measurement's normalised residual, linear beyond.
void addMeasurement(const SwingMeasurement& measurement, const SwingTransition& walked, double k,
                    const Eigen::Vector3d& pivot_o, Normal& normal) {
  const SwingInnovation innovation = swingInnovation(walked.state, measurement, pivot_o);
  const Eigen::LLT<SwingValueCovariance> llt(measurement.covariance);
  const SwingValueJacobian J = innovation.H.lazyProduct(walked.Phi);
  const SwingValueJacobian WJ = llt.solve(J);
  const double nis = innovation.residual.dot(llt.solve(innovation.residual));
  const double radius = std::sqrt(nis);
  const double weight = radius <= k ? 1.0 : k / radius;
  normal.cost += radius <= k ? 0.5 * nis : k * (radius - 0.5 * k);
  normal.chi_square += nis;
  normal.residuals += static_cast<int>(innovation.residual.size());
  normal.A += weight * J.transpose().lazyProduct(WJ);
  normal.b += weight * WJ.transpose().lazyProduct(innovation.residual);
}

Normal normalAt(std::span<const SwingMeasurement> measurements, const SwingPrior& prior,
                const SwingVector& start, const SwingLaw& law, const Eigen::Vector3d& pivot_o) {
  const double k = std::sqrt(chiSquareQuantile(0.999, swingSightSize(measurements.front().sight)));
  Normal normal;
  addPrior(prior, start, normal);
  if (prior.reach_sigma > 0.0) {
    addReach(prior, pivot_o.z() + start(kSwingLonger), start(kSwingLogLength), normal);
  }
  SwingTransition walked{start, SwingMatrix::Identity()};
  Time time = measurements.front().time;
  for (const SwingMeasurement& measurement : measurements) {
    if (measurement.time > time) {
      const SwingTransition leg =
          walkSwingWithTransition(walked.state, measurement.time - time, law);
      walked = {leg.state, product(leg.Phi, walked.Phi)};
      time = measurement.time;
    }
    addMeasurement(measurement, walked, k, pivot_o, normal);
  }
  if (!std::isfinite(normal.cost)) {
    normal.cost = std::numeric_limits<double>::infinity();
  }
  return normal;
}

// Known states keep still: their rows become identity.
void holdKnown(const SwingPrior& prior, SwingMatrix& A, SwingVector& b) {
  for (int i = 0; i < kSwingStates; ++i) {
    if (!(prior.covariance(i, i) > 0.0)) {
      A.row(i).setZero();
      A.col(i).setZero();
      A(i, i) = 1.0;
      b(i) = 0.0;
    }
  }
}

SwingMatrix inverseOfFree(const SwingPrior& prior, SwingMatrix A) {
  SwingVector none = SwingVector::Zero();
  holdKnown(prior, A, none);
  SwingMatrix P = A.llt().solve(SwingMatrix::Identity());
  for (int i = 0; i < kSwingStates; ++i) {
    if (!(prior.covariance(i, i) > 0.0)) {
      P(i, i) = 0.0;
    }
  }
  return 0.5 * (P + P.transpose());
}

// A reach that the data hardly tell, with angles that follow it: reach * angle is what is seen. In
// (reach * angle, reach * rate, reach) that valley is straight, in (angle, rate, reach) it is bent
// and an iteration would creep along it. Columns: d state / d those coordinates.
SwingMatrix reachCoordinates(const SwingVector& state, double reach) {
  SwingMatrix T = SwingMatrix::Identity();
  for (int i = kSwingAngle; i < kSwingRate + 2; ++i) {
    T(i, i) = 1.0 / reach;
    T(i, kSwingLonger) = -state(i) / reach;
  }
  return T;
}

SwingVector stepped(const SwingVector& state, const SwingVector& step, double reach) {
  SwingVector next = state + step;
  const double factor = reach / (reach + step(kSwingLonger));
  for (int i = kSwingAngle; i < kSwingRate + 2; ++i) {
    next(i) = (state(i) + step(i) / reach) * factor;
  }
  return next;
}

struct Minimum {
  SwingVector start;
  Normal normal;
  int iterations = 0;
  bool converged = false;
};

// Damping after Nielsen ("Damping Parameter in Marquardt's Method", 1999). At the end the step that
// is left is less than a thirtieth of a standard deviation.
template <class NormalAt>
Minimum minimise(const SwingPrior& prior, const SwingVector& guess, double pivot_height,
                 NormalAt normalOf) {
  Minimum at{guess, normalOf(guess)};
  double damping = 1e-3;
  double growth = 2.0;
  for (; at.iterations < kMaxIterations && !at.converged; ++at.iterations) {
    const bool reach_free = prior.covariance(kSwingLonger, kSwingLonger) > 0.0;
    const double reach = reach_free ? pivot_height + at.start(kSwingLonger) : 1.0;
    const SwingMatrix T =
        reach_free ? reachCoordinates(at.start, reach) : SwingMatrix(SwingMatrix::Identity());
    SwingMatrix A = product(SwingMatrix(T.transpose()), product(at.normal.A, T));
    SwingVector b = product(SwingMatrix(T.transpose()), at.normal.b);
    holdKnown(prior, A, b);
    const SwingVector scale = A.diagonal();
    A.diagonal() += damping * scale;
    const SwingVector step = A.llt().solve(b);
    const double promised = 0.5 * step.dot(b + damping * scale.cwiseProduct(step));
    const SwingVector there =
        reach_free ? stepped(at.start, step, reach) : SwingVector(at.start + step);
    const Normal next = normalOf(there);
    const double gain = (at.normal.cost - next.cost) / promised;
    if (next.cost < at.normal.cost) {
      at.start = there;
      at.normal = next;
      damping *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3));
      growth = 2.0;
    } else {
      damping *= growth;
      growth *= 2.0;
    }
    at.converged = promised < 5e-4 && damping < 1.0;
  }
  return at;
}

}  // namespace

Outcome<SwingFit> fitSwing(std::span<const SwingMeasurement> measurements, const SwingPrior& prior,
                           const SwingVector& guess, const SwingLaw& law,
                           const Eigen::Vector3d& pivot_o) {
  if (measurements.empty()) {
    return Refusal{"no measurement"};
  }
  const Minimum at = minimise(prior, guess, pivot_o.z(), [&](const SwingVector& start) {
    return normalAt(measurements, prior, start, law, pivot_o);
  });
  if (!at.converged || !std::isfinite(at.normal.cost)) {
    return Refusal{"fit did not converge"};
  }
  SwingFit fit;
  fit.start = {at.start, inverseOfFree(prior, at.normal.A)};
  const SwingTransition whole =
      walkSwingWithTransition(at.start, measurements.back().time - measurements.front().time, law);
  fit.end.mean = whole.state;
  const SwingMatrix P = carried(whole.Phi, fit.start.covariance);
  fit.end.covariance = 0.5 * (P + P.transpose());
  fit.cost = at.normal.cost;
  fit.chi_square = at.normal.chi_square;
  fit.residuals = at.normal.residuals;
  fit.iterations = at.iterations;
  return fit;
}

}  // namespace ringhook
