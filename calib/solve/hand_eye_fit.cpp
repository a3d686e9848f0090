#include "calib/solve/hand_eye_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/solve/small_statistics.h"

namespace ringhook {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector12 = Eigen::Matrix<double, 12, 1>;

constexpr double kGate = 22.46;          // chi-square, 6 degrees, 99.9 %
constexpr double kCauchy = 12.59;        // the same, 95 %: weight one half
constexpr double kMedianRadius = 1.538;  // median length of a standard normal vector in space
constexpr PairNoise kLeastNoise{5e-6, 5e-6};
constexpr double kOnePercent = -2.326;  // point of the normal law
constexpr int kNoiseRounds = 10;
constexpr double kUndetermined = 1e-12;  // least over greatest eigenvalue of the scaled matrix

// Inverse of the left Jacobian of SO(3) at -w: d thetaU(R exp(b)) / db.
Eigen::Matrix3d rotationDerivative(const Eigen::Vector3d& w) {
  const double theta = w.norm();
  const Eigen::Matrix3d k = skew(w);
  if (theta < 1e-4) {
    return Eigen::Matrix3d::Identity() + 0.5 * k + k * k / 12.0;
  }
  const double c = 1.0 / (theta * theta) - 0.5 / (theta * std::tan(0.5 * theta));
  return Eigen::Matrix3d::Identity() + 0.5 * k + c * k * k;
}

struct Problem {
  const std::vector<PosePair>& pairs;
  EyeSetup setup;
  std::vector<Matrix6> information;
  std::vector<bool> used;
  bool robust = false;

  void setNoise(const PairNoise& noise) {
    information.clear();
    for (const PosePair& pair : pairs) {
      information.push_back(pairCovariance(pair, noise).inverse());
    }
  }
  [[nodiscard]] double distance(std::size_t i, const Twist& e) const {
    return e.dot(information[i] * e);
  }
  [[nodiscard]] double cost(const HandEye& pose) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (used[i]) {
        const double m2 = distance(i, linearise(pose, pairs[i], setup).e);
        sum += robust ? kCauchy * std::log1p(m2 / kCauchy) : m2;
      }
    }
    return sum;
  }
  void normalEquations(const HandEye& pose, Covariance12& H, Vector12& g) const {
    H.setZero();
    g.setZero();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (used[i]) {
        const PairRow row = linearise(pose, pairs[i], setup);
        const double weight = robust ? 1.0 / (1.0 + distance(i, row.e) / kCauchy) : 1.0;
        Eigen::Matrix<double, 6, 12> J;
        J << row.by_camera, row.by_target;
        H += weight * J.transpose() * information[i] * J;
        g += weight * J.transpose() * information[i] * row.e;
      }
    }
  }
};

HandEye moved(const HandEye& pose, const Vector12& d) {
  return {pose.camera * expSe3(d.head<6>()), pose.target * expSe3(d.tail<6>())};
}

HandEye minimise(const Problem& problem, HandEye pose, int steps) {
  double cost = problem.cost(pose);
  double damping = 1e-6;
  for (int step = 0; step < steps && std::isfinite(cost); ++step) {
    Covariance12 H;
    Vector12 g;
    problem.normalEquations(pose, H, g);
    Covariance12 damped = H;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += 1e-12 * H.diagonal().maxCoeff();
    const Vector12 d = -damped.ldlt().solve(g);
    const HandEye next = moved(pose, d);
    const double next_cost = problem.cost(next);
    if (!(next_cost < cost)) {
      damping *= 10.0;
      if (damping > 1e6) {
        break;
      }
      continue;
    }
    const bool settled = cost - next_cost < 1e-10 * cost;
    pose = next;
    cost = next_cost;
    damping = std::max(1e-12, 0.1 * damping);
    if (settled) {
      break;
    }
  }
  return pose;
}

std::vector<PairError> errors(const HandEye& pose, const std::vector<PosePair>& pairs,
                              EyeSetup setup) {
  std::vector<PairError> all;
  for (const PosePair& pair : pairs) {
    all.push_back(pairError(pose, pair, setup));
  }
  return all;
}

// What the fit's twelve parameters take away from the residuals of n pairs, six each.
double redundancyShare(double n) { return std::max(n - 2.0, 0.5) / n; }

PairNoise atLeast(const PairNoise& noise) {
  return {std::max(noise.translation_m, kLeastNoise.translation_m),
          std::max(noise.rotation_rad, kLeastNoise.rotation_rad)};
}

// Without the views' share: a median knows nothing of it, and step 1 needs no more.
PairNoise noiseFromMedians(const HandEye& pose, const std::vector<PosePair>& pairs,
                           EyeSetup setup) {
  std::vector<double> t;
  std::vector<double> r;
  for (const PairError& e : errors(pose, pairs, setup)) {
    t.push_back(e.translation_m);
    r.push_back(e.rotation_rad);
  }
  const double scale =
      1.0 / (kMedianRadius * std::sqrt(redundancyShare(static_cast<double>(pairs.size()))));
  return atLeast({scale * median(t), scale * median(r)});
}

void judgeMotion(const Problem& problem, HandEyeFit& fit) {
  Covariance12 H;
  Vector12 g;
  problem.normalEquations(fit.pose, H, g);
  const Vector12 scale = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Covariance12 scaled = scale.asDiagonal() * H * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Covariance12> eigen(scaled);
  fit.weakest = (scale.asDiagonal() * eigen.eigenvectors().col(0)).normalized();
  if (eigen.eigenvalues()[0] > kUndetermined * eigen.eigenvalues()[11]) {
    const Covariance12 inverse = eigen.eigenvectors() *
                                 eigen.eigenvalues().cwiseInverse().asDiagonal() *
                                 eigen.eigenvectors().transpose();
    fit.covariance = Covariance12(scale.asDiagonal() * inverse * scale.asDiagonal());
  }
}

}  // namespace

PairRow linearise(const HandEye& pose, const PosePair& pair, EyeSetup setup) {
  const Pose predicted = predictedTarget(pose, pair, setup);
  const Pose D = pair.cMt.inverse() * predicted;
  const Eigen::Vector3d w = thetaU(D.linear());
  PairRow row;
  row.e << D.translation(), w;
  Matrix6 move = Matrix6::Zero();  // of e by a twist at t
  move.topLeftCorner<3, 3>() = D.linear();
  move.bottomRightCorner<3, 3>() = rotationDerivative(w);
  row.by_camera = -move * twistTransform(predicted.inverse());
  row.by_target = move;
  return row;
}

Covariance6 pairCovariance(const PosePair& pair, const PairNoise& noise) {
  Matrix6 C = pair.covariance ? Matrix6(*pair.covariance) : Matrix6(Matrix6::Zero());
  C.diagonal().head<3>().array() += noise.translation_m * noise.translation_m;
  C.diagonal().tail<3>().array() += noise.rotation_rad * noise.rotation_rad;
  return C;
}

// Expectation maximisation (Dempster, Laird, Rubin 1977) for s_t and s_r: the error e of a pair is
// the view's, of covariance V, plus another d, of covariance S; given e, d has the mean S C^-1 e
// and the covariance S - S C^-1 S. Without V its fixed point is the mean square of e.
PairNoise estimateNoise(const HandEye& pose, const std::vector<PosePair>& pairs,
                        const std::vector<bool>& used, EyeSetup setup, PairNoise noise) {
  for (int round = 0; round < kNoiseRounds; ++round) {
    double t2 = 0.0;
    double r2 = 0.0;
    double n = 0.0;
    const Matrix6 S = pairCovariance({}, noise);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (used[i]) {
        const Matrix6 gain = S * pairCovariance(pairs[i], noise).inverse();
        const Twist d = gain * linearise(pose, pairs[i], setup).e;
        const Matrix6 square = S - gain * S + d * d.transpose();
        t2 += square.topLeftCorner<3, 3>().trace();
        r2 += square.bottomRightCorner<3, 3>().trace();
        n += 1.0;
      }
    }
    const double freedom = 3.0 * n * redundancyShare(n);
    noise = atLeast({std::sqrt(t2 / freedom), std::sqrt(r2 / freedom)});
  }
  return noise;
}

double leastNoiseShare(double residuals) {
  const double c = 2.0 / (9.0 * std::max(residuals, 1.0));
  return std::pow(std::max(1.0 - c + kOnePercent * std::sqrt(c), 0.05), 3);
}

PairError pairError(const HandEye& pose, const PosePair& pair, EyeSetup setup) {
  const Pose D = pair.cMt.inverse() * predictedTarget(pose, pair, setup);
  return {D.translation().norm(), thetaU(D.linear()).norm()};
}

PairError rms(const std::vector<PairError>& errors) {
  PairError sum;
  for (const PairError& e : errors) {
    sum.translation_m += e.translation_m * e.translation_m;
    sum.rotation_rad += e.rotation_rad * e.rotation_rad;
  }
  const auto n = static_cast<double>(errors.size());
  return {std::sqrt(sum.translation_m / n), std::sqrt(sum.rotation_rad / n)};
}

PairError rmsError(const HandEye& pose, const std::vector<PosePair>& pairs,
                   const std::vector<bool>& used, EyeSetup setup) {
  std::vector<PairError> errors;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (used[i]) {
      errors.push_back(pairError(pose, pairs[i], setup));
    }
  }
  return rms(errors);
}

double medianError(const HandEye& pose, const std::vector<PosePair>& pairs, EyeSetup setup) {
  std::vector<double> lengths;
  for (const PairError& e : errors(pose, pairs, setup)) {
    lengths.push_back(std::hypot(e.translation_m, kErrorLever * e.rotation_rad));
  }
  return median(lengths);
}

HandEyeFit fitHandEye(const std::vector<PosePair>& pairs, EyeSetup setup, const HandEye& start) {
  Problem problem{pairs, setup, {}, std::vector<bool>(pairs.size(), true), true};
  HandEyeFit fit{start, problem.used, {}, std::nullopt, Vector12::Zero()};
  for (int round = 0; round < 10; ++round) {
    fit.noise = noiseFromMedians(fit.pose, pairs, setup);
    problem.setNoise(fit.noise);
    fit.pose = minimise(problem, fit.pose, 10);
  }
  fit.noise = noiseFromMedians(fit.pose, pairs, setup);
  problem.setNoise(fit.noise);
  problem.robust = false;
  for (int round = 0; round < 20; ++round) {
    const auto before = static_cast<double>(std::count(fit.used.begin(), fit.used.end(), true));
    const double gate = kGate / leastNoiseShare(3.0 * before - 6.0);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      problem.used[i] = problem.distance(i, linearise(fit.pose, pairs[i], setup).e) < gate;
      kept += problem.used[i] ? 1 : 0;
    }
    const bool same = problem.used == fit.used && round > 4;
    fit.used = problem.used;
    if (same || kept < 3) {
      break;
    }
    fit.pose = minimise(problem, fit.pose, 50);
    fit.noise = estimateNoise(fit.pose, pairs, fit.used, setup, fit.noise);
    problem.setNoise(fit.noise);
  }
  judgeMotion(problem, fit);
  return fit;
}

HandEye refitHandEye(const std::vector<PosePair>& pairs, EyeSetup setup, const HandEye& start,
                     const std::vector<bool>& used, const PairNoise& noise) {
  Problem problem{pairs, setup, {}, used, false};
  problem.setNoise(noise);
  return minimise(problem, start, 50);
}

}  // namespace ringhook
