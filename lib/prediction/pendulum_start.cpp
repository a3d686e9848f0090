#include "prediction/pendulum_start.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "prediction/exact_pendulum.h"

namespace ringhook {
namespace {

constexpr double kShortest = 0.01;        // pendulum [m]
constexpr double kLongest = 30.0;         // [m]
constexpr int kGrid = 120;                // lengths tried
constexpr std::size_t kFewest = 8;        // samples
constexpr std::size_t kMostFitted = 400;  // samples of a record that a start looks at
constexpr double kLongestStart = 20.0;    // what is older is forgotten [s]
constexpr double kExplained = 0.75;
constexpr double kSureEnough = 0.05;  // standard deviation of a length, as a fraction

/// Offset that a measured pivot drives from rest: at each sample the pivot's speed jumps by what
/// its two lines differ, and the offset's the other way; between, it swings freely.
Eigen::VectorXd drivenSwing(const SwingRecord& record, const std::vector<double>& pivot,
                            const PendulumRates& rates) {
  const auto& t = record.time_s;
  Eigen::VectorXd driven = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(t.size()));
  Eigen::Vector2d state = Eigen::Vector2d::Zero();
  double speed = (pivot[1] - pivot[0]) / (t[1] - t[0]);
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double next = (pivot[i] - pivot[i - 1]) / (t[i] - t[i - 1]);
    state.y() -= next - speed;
    speed = next;
    state = exactPendulumTransition(rates, t[i] - t[i - 1]) * state;
    driven(static_cast<Eigen::Index>(i)) = state.x();
  }
  return driven;
}

/// Columns that stand linearly in the fit.
Eigen::MatrixXd freeSwings(const SwingRecord& record, const PendulumRates& rates) {
  const auto n = static_cast<Eigen::Index>(record.time_s.size());
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(n, 2 + record.free_columns);
  const double w = std::sqrt(rates.stiffness);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = record.time_s[static_cast<std::size_t>(i)] - record.time_s.front();
    const Eigen::Matrix2d A = exactPendulumTransition(rates, t);
    columns(i, 0) = A(0, 0);
    columns(i, 1) = w * A(0, 1);
    if (record.free_columns == 2) {
      columns(i, 3) = t - 0.5 * (record.time_s.back() - record.time_s.front());
    }
  }
  return columns;
}

/// What is left of all axes once the linear part is fitted.
Eigen::VectorXd residuals(const SwingRecord& record, const Eigen::Vector2d& theta) {
  const PendulumRates rates{std::exp(theta.x()), theta.y()};
  const Eigen::MatrixXd columns = freeSwings(record, rates);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  const Eigen::Index n = columns.rows();
  Eigen::VectorXd left(n * static_cast<Eigen::Index>(record.axes.size()));
  for (std::size_t axis = 0; axis < record.axes.size(); ++axis) {
    Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(record.axes[axis].data(), n);
    if (!record.pivots.empty()) {
      y -= Eigen::Map<const Eigen::VectorXd>(record.pivots[axis].data(), n) +
           drivenSwing(record, record.pivots[axis], rates);
    }
    const Eigen::VectorXd b = qr.solve(y);
    left.segment(static_cast<Eigen::Index>(axis) * n, n) = y - product(columns, b);
  }
  return left;
}

/// Sum of squares about an offset that does not swing.
double restSquares(const SwingRecord& record) {
  double sum = 0.0;
  for (std::size_t axis = 0; axis < record.axes.size(); ++axis) {
    const auto n = static_cast<Eigen::Index>(record.time_s.size());
    Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(record.axes[axis].data(), n);
    if (!record.pivots.empty()) {
      y -= Eigen::Map<const Eigen::VectorXd>(record.pivots[axis].data(), n);
    }
    sum +=
        record.free_columns > 0 ? (y.array() - y.mean()).matrix().squaredNorm() : y.squaredNorm();
  }
  return sum;
}

Eigen::Vector2d bestOfGrid(const SwingRecord& record, double gravity) {
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kGrid; ++i) {
    const double length = kShortest * std::pow(kLongest / kShortest, i / (kGrid - 1.0));
    const Eigen::Vector2d theta(std::log(gravity / length), 0.0);
    const double sum = residuals(record, theta).squaredNorm();
    if (sum < least) {
      least = sum;
      best = theta;
    }
  }
  return best;
}

/// Of the residuals by (log stiffness, damping), central differences.
Eigen::MatrixX2d slopes(const SwingRecord& record, const Eigen::Vector2d& theta) {
  constexpr double kStep = 1e-4;
  Eigen::MatrixX2d J(residuals(record, theta).size(), 2);
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(i);
    J.col(i) = (residuals(record, theta + step) - residuals(record, theta - step)) / (2.0 * kStep);
  }
  return J;
}

/// Levenberg-Marquardt from the grid's best.
Eigen::Vector2d refined(const SwingRecord& record, Eigen::Vector2d theta) {
  double sum = residuals(record, theta).squaredNorm();
  double mu = 1e-3;
  for (int i = 0; i < 20; ++i) {
    const Eigen::MatrixX2d J = slopes(record, theta);
    Eigen::Matrix2d H = product(J.transpose(), J);
    H.diagonal() *= 1.0 + mu;
    const Eigen::Vector2d step = -H.inverse() * product(J.transpose(), residuals(record, theta));
    const double next = step.allFinite() && step.cwiseAbs().maxCoeff() < 5.0
                            ? residuals(record, theta + step).squaredNorm()
                            : std::numeric_limits<double>::infinity();
    if (next < sum) {
      const bool settled = sum - next < 1e-9 * sum;
      theta += step;
      sum = next;
      mu *= 0.3;
      if (settled) {
        break;
      }
    } else {
      mu *= 10.0;
    }
  }
  return theta;
}

/// Every so manieth sample, so that a fit takes a bounded time.
SwingRecord recordOf(TrajectoryKind kind, const std::vector<Time>& times,
                     const std::vector<Eigen::VectorXd>& values) {
  const bool angles = isAngular(kind);
  const int axes = angles ? valueSize(kind) : 2;
  SwingRecord record;
  record.free_columns = angles ? 0 : kind == TrajectoryKind::kPointAndPivot ? 1 : 2;
  record.axes.resize(static_cast<std::size_t>(axes));
  if (kind == TrajectoryKind::kPointAndPivot) {
    record.pivots.resize(2);
  }
  const std::size_t stride = 1 + times.size() / kMostFitted;
  for (std::size_t i = (times.size() - 1) % stride; i < times.size(); i += stride) {
    record.time_s.push_back(times[i] - times.front());
    for (int axis = 0; axis < axes; ++axis) {
      record.axes[static_cast<std::size_t>(axis)].push_back(values[i](axis));
      if (!record.pivots.empty()) {
        record.pivots[static_cast<std::size_t>(axis)].push_back(values[i](3 + axis));
      }
    }
  }
  return record;
}

}  // namespace

Outcome<PendulumFit> fitPendulum(const SwingRecord& record, double gravity) {
  if (record.time_s.size() < kFewest) {
    return Refusal{"too few samples"};
  }
  const Eigen::Vector2d theta = refined(record, bestOfGrid(record, gravity));
  const Eigen::VectorXd left = residuals(record, theta);
  const Eigen::MatrixX2d J = slopes(record, theta);
  const auto linear = static_cast<double>(record.axes.size()) * (2.0 + record.free_columns);
  const double freedom = std::max(1.0, static_cast<double>(left.size()) - linear - 2.0);
  const Eigen::Matrix2d P =
      (left.squaredNorm() / freedom) * Eigen::Matrix2d(product(J.transpose(), J)).inverse();
  PendulumFit fit;
  fit.length_m = gravity / std::exp(theta.x());
  fit.length_sigma_m = fit.length_m * std::sqrt(P(0, 0));
  fit.damping_per_s = std::max(0.0, theta.y());
  fit.damping_sigma_per_s = std::sqrt(P(1, 1));
  fit.residual = std::sqrt(left.squaredNorm() / static_cast<double>(left.size()));
  fit.explained = 1.0 - left.squaredNorm() / restSquares(record);
  const double seen = record.time_s.back() - record.time_s.front();
  fit.periods = seen * std::exp(0.5 * theta.x()) / (2.0 * std::numbers::pi);
  if (!theta.allFinite() || !P.allFinite() || fit.length_m < kShortest || fit.length_m > kLongest) {
    return Refusal{"no swing to be seen"};
  }
  return fit;
}

PendulumStart::PendulumStart(TrajectoryKind kind, double gravity)
    : kind_(kind), gravity_(gravity) {}

void PendulumStart::forgetOld() {
  const auto recent = std::find_if(times_.begin(), times_.end(), [this](Time time) {
    return times_.back() - time <= kLongestStart;
  });
  values_.erase(values_.begin(), values_.begin() + (recent - times_.begin()));
  times_.erase(times_.begin(), recent);
}

std::optional<PendulumFit> PendulumStart::add(Time time, const Eigen::VectorXd& value) {
  constexpr double kFirstLook = 0.25;  // [s]
  times_.push_back(time);
  values_.push_back(value);
  const double seen = time - times_.front();
  if (seen < std::max(kFirstLook, next_s_)) {
    return std::nullopt;
  }
  next_s_ = std::min(1.1 * seen, 0.95 * kLongestStart);
  const auto fit = fitPendulum(recordOf(kind_, times_, values_), gravity_);
  forgetOld();
  if (!fit || fit->periods < 1.0 || fit->explained < kExplained ||
      fit->length_sigma_m > kSureEnough * fit->length_m) {
    return std::nullopt;
  }
  return *fit;
}

}  // namespace ringhook
