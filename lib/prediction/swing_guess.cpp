// The guess of swing_start.h: for every length of a grid a linear fit, and the best of them.

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "prediction/hanging_pose.h"
#include "prediction/swing_start.h"

namespace ringhook {
namespace {

constexpr double kGridStep = 0.04;   // of ln length: the phase slips by 1 rad in 50 rad of swing
constexpr double kNarrowest = 0.02;  // half width of the grid, of ln length

/// Two swinging coordinates over time, about x and about y, and the straight motion below them.
struct Series {
  std::vector<double> time;             ///< since the first measurement [s]
  std::vector<Eigen::Vector2d> swing;   ///< angles [rad], or horizontal offset (y, -x) [m]
  std::vector<Eigen::Vector3d> anchor;  ///< pivot, or o for a point [m]; else zeros
  bool in_metres = false;
  double yaw = 0.0;
};

/// r + v t + a cos(w t) + b sin(w t) in both coordinates: rows r, v, a, b.
using Coefficients = Eigen::Matrix<double, 4, 2>;

Eigen::Vector2d anglesTowards(const Eigen::Vector3d& down) {
  return {std::atan2(down.y(), -down.z()), std::atan2(-down.x(), std::hypot(down.y(), down.z()))};
}

Series seriesOf(std::span<const SwingMeasurement> measurements, const SwingPrior& prior,
                const Eigen::Vector3d& pivot_o) {
  Series series;
  series.in_metres = measurements.front().sight == SwingSight::kPoint;
  for (const SwingMeasurement& m : measurements) {
    series.time.push_back(m.time - measurements.front().time);
    Eigen::Vector2d swing = Eigen::Vector2d::Zero();
    Eigen::Vector3d anchor = Eigen::Vector3d::Zero();
    if (m.sight == SwingSight::kPose) {
      const Eigen::Vector3d pivot = pivot_o + Eigen::Vector3d(0, 0, prior.mean(kSwingLonger));
      const HangingPose hanging = hangingFromPose(m.fMo, pivot);
      swing = {hanging.swing_x, hanging.swing_y};
      anchor = hanging.pivot_f;
      series.yaw = hanging.yaw;
    } else if (m.sight == SwingSight::kPoint) {
      swing = {m.value(1), -m.value(0)};
      anchor = m.value.head<3>();
    } else if (m.sight == SwingSight::kPointAndPivot) {
      anchor = m.value.tail<3>();
      swing = anglesTowards(m.value.head<3>() - anchor);
    } else {
      swing.head(m.value.size()) = m.value;
    }
    series.swing.push_back(swing);
    series.anchor.push_back(anchor);
  }
  return series;
}

/// Variances that keep what the data do not tell near what was believed.
Eigen::Vector4d coefficientVariances(const Series& series, const SwingPrior& prior) {
  if (series.in_metres) {
    return {1e6, prior.covariance.diagonal().segment<3>(kSwingSpeed).maxCoeff(), 1.0, 1.0};
  }
  return {prior.covariance(kSwingRest, kSwingRest), 0.0, 1.0, 1.0};
}

/// Ridge regression at one frequency [rad/s]; returns the sum of squares it leaves.
double fitAt(double w, const Series& series, const Eigen::Vector4d& variances, double noise,
             Coefficients& coefficients) {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Coefficients b = Coefficients::Zero();
  const Eigen::Vector4d free = (variances.array() > 0.0).cast<double>();
  for (std::size_t i = 0; i < series.time.size(); ++i) {
    const double t = series.time[i];
    const Eigen::Vector4d row =
        free.cwiseProduct(Eigen::Vector4d(1.0, t, std::cos(w * t), std::sin(w * t)));
    A += row * row.transpose();
    b += row * series.swing[i].transpose();
  }
  for (int i = 0; i < 4; ++i) {
    A(i, i) += variances(i) > 0.0 ? noise * noise / variances(i) : 1.0;
  }
  coefficients = A.llt().solve(b);
  double left = 0.0;
  for (std::size_t i = 0; i < series.time.size(); ++i) {
    const double t = series.time[i];
    const Eigen::Vector4d row =
        free.cwiseProduct(Eigen::Vector4d(1.0, t, std::cos(w * t), std::sin(w * t)));
    left += (series.swing[i] - coefficients.transpose() * row).squaredNorm();
  }
  const Eigen::Vector4d pull =
      (variances.array() > 0.0).select(noise * noise / variances.array(), 0.0);
  return left + (coefficients.array().square().colwise() * pull.array()).sum();
}

struct BestSwing {
  Coefficients coefficients = Coefficients::Zero();
  double frequency = 0.0;  ///< [rad/s]
};

BestSwing bestSwing(const Series& series, const SwingPrior& prior, const SwingLaw& law,
                    double noise) {
  const double middle = prior.mean(kSwingLogLength);
  const double sigma = std::sqrt(prior.covariance(kSwingLogLength, kSwingLogLength));
  const double half = std::max(kNarrowest, 3.0 * sigma);
  const int steps = std::max(1, static_cast<int>(std::ceil(half / kGridStep)));
  const Eigen::Vector4d variances = coefficientVariances(series, prior);
  BestSwing best;
  double least = std::numeric_limits<double>::infinity();
  for (int i = -steps; i <= steps; ++i) {
    const double off = half * i / steps;
    const double w = std::sqrt(law.gravity / std::exp(middle + off));
    Coefficients coefficients;
    double cost = fitAt(w, series, variances, noise, coefficients);
    if (sigma > 0.0) {
      cost += noise * noise * off * off / (sigma * sigma);
    }
    if (cost < least) {
      least = cost;
      best = {coefficients, w};
    }
  }
  return best;
}

// Straight line through the anchors, per axis; the speed is kept near the prior's.
void placePivot(const Series& series, const SwingPrior& prior, double noise, SwingVector& state) {
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < series.time.size(); ++i) {
      const Eigen::Vector2d row(1.0, series.time[i]);
      A += row * row.transpose();
      b += row * series.anchor[i](axis);
    }
    const double variance = prior.covariance(kSwingSpeed + axis, kSwingSpeed + axis);
    const double pull = variance > 0.0 ? noise * noise / variance : 1e12;
    A(1, 1) += pull;
    b(1) += pull * prior.mean(kSwingSpeed + axis);
    const Eigen::Vector2d line = A.ldlt().solve(b);
    state(kSwingPivot + axis) = line(0);
    state(kSwingSpeed + axis) = line(1);
  }
}

// A point shows the horizontal swing about its mean line; the pivot is straight above.
void placeFromPoint(const Series& series, const BestSwing& best, const Eigen::Vector3d& pivot_o,
                    SwingVector& state) {
  const double reach = pivot_o.z() + state(kSwingLonger);
  double lowest = series.anchor.front().z();
  for (const Eigen::Vector3d& point : series.anchor) {
    lowest = std::min(lowest, point.z());
  }
  const Coefficients& c = best.coefficients;
  state.segment<3>(kSwingPivot) << -c(0, 1), c(0, 0), lowest + reach;
  state.segment<3>(kSwingSpeed) << -c(1, 1), c(1, 0), 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    state(kSwingAngle + axis) = std::asin(std::clamp(c(2, axis) / reach, -1.0, 1.0));
    state(kSwingRate + axis) = c(3, axis) * best.frequency / reach;
  }
}

// A large swing is slower than a small one of the same length: T / T0 = 1 + a^2/16 + 11 a^4/3072.
double lengthAtAmplitude(double frequency, double amplitude, double gravity) {
  const double a2 = amplitude * amplitude;
  const double slower = 1.0 + a2 / 16.0 + 11.0 * a2 * a2 / 3072.0;
  return gravity / (frequency * frequency * slower * slower);
}

}  // namespace

SwingVector guessSwing(std::span<const SwingMeasurement> measurements, const SwingPrior& prior,
                       const SwingLaw& law, const Eigen::Vector3d& pivot_o) {
  const Series series = seriesOf(measurements, prior, pivot_o);
  const double noise = std::sqrt(measurements.front().covariance.trace() /
                                 static_cast<double>(measurements.front().covariance.rows()));
  const BestSwing best = bestSwing(series, prior, law, noise);
  SwingVector state = prior.mean;
  const bool length_known = !(prior.covariance(kSwingLogLength, kSwingLogLength) > 0.0);
  if (series.in_metres) {
    if (prior.covariance(kSwingLonger, kSwingLonger) >
        0.01) {  // a reach unknown by more than 0.1 m
      const double length = law.gravity / (best.frequency * best.frequency);
      state(kSwingLonger) = prior.reach_per_length * length - pivot_o.z();
    }
    placeFromPoint(series, best, pivot_o, state);
  } else {
    placePivot(series, prior, noise, state);
    state.segment<2>(kSwingRest) = best.coefficients.row(0).transpose();
    state.segment<2>(kSwingAngle) = best.coefficients.row(2).transpose();
    state.segment<2>(kSwingRate) = best.frequency * best.coefficients.row(3).transpose();
    state(kSwingYaw) = series.yaw;
  }
  if (!length_known) {
    const double amplitude = std::hypot(state.segment<2>(kSwingAngle).norm(),
                                        state.segment<2>(kSwingRate).norm() / best.frequency);
    state(kSwingLogLength) = std::log(lengthAtAmplitude(best.frequency, amplitude, law.gravity));
  }
  return state;
}

}  // namespace ringhook
