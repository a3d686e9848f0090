#include "calib/solve/joint_zeros.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "calib/solve/small_statistics.h"

namespace ringhook {
namespace {

using Matrix18 = Eigen::Matrix<double, 18, 18>;
using Vector18 = Eigen::Matrix<double, 18, 1>;
constexpr int kSteps = 8;       // Gauss-Newton; starts are near
constexpr double kHeld = 1e-7;  // [rad]
constexpr int kNoiseRounds = 6;

struct State {
  HandEye pose;
  JointVector zero = JointVector::Zero();
};

// Of the zeros [1/rad^2]; base and tool turn like joints 1 and 6, which are held.
JointVector priorInformation() {
  JointVector sigma = JointVector::Constant(kJointZeroPrior);
  sigma[0] = sigma[5] = kHeld;
  return sigma.cwiseAbs2().cwiseInverse();
}

// Twist of the flange at and in e per joint velocity.
Jacobian flangeJacobian(const rx60::Geometry& geometry, const JointVector& q) {
  const Eigen::Matrix3d eRf = rx60::forward(geometry, q).linear().transpose();
  Jacobian J = rx60::jacobian(geometry, q);
  J.topRows<3>() = (eRf * J.topRows<3>()).eval();
  J.bottomRows<3>() = (eRf * J.bottomRows<3>()).eval();
  return J;
}

// The arm as reported, moved by what the zeros change: fMe need not be our own arithmetic's.
PosePair withZero(PosePair pair, const JointVector& joints, const rx60::Geometry& geometry,
                  const JointVector& zero) {
  pair.fMe =
      pair.fMe * rx60::forward(geometry, joints).inverse() * rx60::forward(geometry, joints + zero);
  return pair;
}

struct Fit {
  const std::vector<PosePair>& pairs;
  const std::vector<JointVector>& joints;
  const rx60::Geometry& geometry;
  EyeSetup setup;

  [[nodiscard]] PosePair corrected(std::size_t i, const JointVector& zero) const {
    return withZero(pairs[i], joints[i], geometry, zero);
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
    const JointVector prior = priorInformation();
    H.diagonal().tail<6>() = prior;
    g.tail<6>() = prior.cwiseProduct(state.zero);
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
    return withZeros(pairs, joints, geometry, zero);
  }

  [[nodiscard]] std::vector<PairError> leaveOut(const State& state, const std::vector<bool>& used,
                                                const PairNoise& noise) const {
    std::vector<PairError> left_out;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (used[i]) {
        std::vector<bool> others = used;
        others[i] = false;
        State without = state;
        solve(without, others, noise);
        left_out.push_back(pairError(without.pose, corrected(i, without.zero), setup));
      }
    }
    return left_out;
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
  for (const int held : {0, 5}) {
    result.zero_rad[held] = result.sigma_rad[held] = 0.0;
  }
  result.covariance = covariance.topLeftCorner<12, 12>();
  result.residual = rmsError(state.pose, fit.correctedPairs(state.zero), start.used, start.setup);
  result.left_out = fit.leaveOut(state, start.used, result.noise);
  result.heldout = rms(result.left_out);
  return result;
}

bool zerosPay(const std::vector<PairError>& plain, const std::vector<PairError>& with_zeros) {
  std::vector<double> falls;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    falls.push_back(plain[i].translation_m * plain[i].translation_m -
                    with_zeros[i].translation_m * with_zeros[i].translation_m);
  }
  return clearlyPositive(falls);
}

std::vector<PosePair> withZeros(const std::vector<PosePair>& pairs,
                                const std::vector<JointVector>& joints,
                                const rx60::Geometry& geometry, const JointVector& zero) {
  std::vector<PosePair> all;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    all.push_back(withZero(pairs[i], joints[i], geometry, zero));
  }
  return all;
}

}  // namespace ringhook
