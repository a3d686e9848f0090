#include "calib/solve/joint_zeros.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace ringhook {
namespace {

using Matrix18 = Eigen::Matrix<double, 18, 18>;
using Vector18 = Eigen::Matrix<double, 18, 1>;
constexpr int kSteps = 8;  // Gauss-Newton; starts are near
constexpr int kNoiseRounds = 6;

struct State {
  HandEye pose;
  JointVector zero = JointVector::Zero();
};

// Twist of the flange at and in e per joint velocity.
Jacobian flangeJacobian(const rx60::Geometry& geometry, const JointVector& q) {
  const Eigen::Matrix3d eRf = rx60::forward(geometry, q).linear().transpose();
  Jacobian J = rx60::jacobian(geometry, q);
  J.topRows<3>() = (eRf * J.topRows<3>()).eval();
  J.bottomRows<3>() = (eRf * J.bottomRows<3>()).eval();
  return J;
}

struct Fit {
  const std::vector<PosePair>& pairs;
  const std::vector<JointVector>& joints;
  const rx60::Geometry& geometry;
  EyeSetup setup;

  [[nodiscard]] PosePair corrected(std::size_t i, const JointVector& zero) const {
    PosePair pair = pairs[i];
    // The arm as reported, moved by what the zeros change: fMe need not be our own arithmetic's.
    pair.fMe = pair.fMe * rx60::forward(geometry, joints[i]).inverse() *
               rx60::forward(geometry, joints[i] + zero);
    return pair;
  }

  [[nodiscard]] Eigen::Matrix<double, 6, 18> jacobianOf(const State& state, std::size_t i,
                                                        const PairRow& row) const {
    const Jacobian J = flangeJacobian(geometry, joints[i] + state.zero);
    const bool to_hand = setup == EyeSetup::kEyeToHand;
    // eye-to-hand: the target moves with the flange; eye-in-hand: the camera does.
    const Eigen::Matrix<double, 6, 6> by_zero =
        to_hand ? row.by_target * twistTransform(state.pose.target.inverse()) * J
                : row.by_camera * twistTransform(state.pose.camera.inverse()) * J;
    Eigen::Matrix<double, 6, 18> all;
    all << row.by_camera, row.by_target, by_zero;
    return all;
  }

  // Normal equations; returns the matrix at the state.
  Matrix18 step(State& state, const std::vector<bool>& used, const PairNoise& noise) const {
    Matrix18 H = Matrix18::Zero();
    Vector18 g = Vector18::Zero();
    const double prior = 1.0 / (kJointZeroPrior * kJointZeroPrior);
    H.diagonal().tail<6>().setConstant(prior);
    g.tail<6>() = prior * state.zero;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (used[i]) {
        const PosePair pair = corrected(i, state.zero);
        const PairRow row = linearise(state.pose, pair, setup);
        const Eigen::Matrix<double, 6, 18> J = jacobianOf(state, i, row);
        const Covariance6 information = pairCovariance(pair, noise).inverse();
        H += J.transpose() * information * J;
        g += J.transpose() * information * row.e;
      }
    }
    const Vector18 d = -H.ldlt().solve(g);
    state.pose.camera = state.pose.camera * expSe3(d.head<6>());
    state.pose.target = state.pose.target * expSe3(d.segment<6>(6));
    state.zero += d.tail<6>();
    return H;
  }

  Matrix18 solve(State& state, const std::vector<bool>& used, const PairNoise& noise) const {
    Matrix18 H;
    for (int i = 0; i < kSteps; ++i) {
      H = step(state, used, noise);
    }
    return H;
  }

  [[nodiscard]] std::vector<PosePair> correctedPairs(const JointVector& zero) const {
    std::vector<PosePair> all;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      all.push_back(corrected(i, zero));
    }
    return all;
  }

  [[nodiscard]] PairError leaveOut(const State& state, const std::vector<bool>& used,
                                   const PairNoise& noise) const {
    PairError sum;
    double n = 0.0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (used[i]) {
        std::vector<bool> others = used;
        others[i] = false;
        State without = state;
        solve(without, others, noise);
        const PairError e = pairError(without.pose, corrected(i, without.zero), setup);
        sum.translation_m += e.translation_m * e.translation_m;
        sum.rotation_rad += e.rotation_rad * e.rotation_rad;
        n += 1.0;
      }
    }
    return {std::sqrt(sum.translation_m / n), std::sqrt(sum.rotation_rad / n)};
  }
};

}  // namespace

JointZeros fitJointZeros(const std::vector<PosePair>& pairs, const std::vector<JointVector>& joints,
                         const rx60::Geometry& geometry, const HandEyeResult& start) {
  const Fit fit{pairs, joints, geometry, start.setup};
  State state{start.pose};
  JointZeros result;
  result.noise = start.noise;
  Matrix18 H;
  for (int round = 0; round < kNoiseRounds; ++round) {
    H = fit.solve(state, start.used, result.noise);
    result.noise = estimateNoise(state.pose, fit.correctedPairs(state.zero), start.used,
                                 start.setup, result.noise);
  }
  const Matrix18 covariance = H.inverse();
  result.pose = state.pose;
  result.zero_rad = state.zero;
  result.sigma_rad = covariance.diagonal().tail<6>().cwiseSqrt();
  result.covariance = covariance.topLeftCorner<12, 12>();
  result.residual = rmsError(state.pose, fit.correctedPairs(state.zero), start.used, start.setup);
  result.heldout = fit.leaveOut(state, start.used, result.noise);
  return result;
}

}  // namespace ringhook
