#include "calib/solve/pair_weights.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/solve/small_statistics.h"

namespace ringhook {
namespace {

using Vector12 = Eigen::Matrix<double, 12, 1>;

constexpr int kNoiseRounds = 10;
/// An angle then counts as this much translation [m]: hundreds of times farther than the pairs
/// reach, so that no translation moves the rotations.
constexpr double kFarLever = 100.0;

// Pairs and noise whose pairCovariance is the weights' inverse.
struct Weighing {
  std::vector<PosePair> pairs;
  PairNoise noise;

  Weighing(const std::vector<PosePair>& all, const PairNoise& scatter, PairWeights weights)
      : pairs(all), noise(scatter) {
    if (weights != PairWeights::kViews) {
      for (PosePair& pair : pairs) {
        pair.covariance.reset();
      }
    }
    if (weights == PairWeights::kRotationFirst) {
      noise.rotation_rad = noise.translation_m / kFarLever;
    }
  }
};

// Of least squares whose weights W_i need not be the inverse of the pairs' covariance C_i:
// H^-1 (sum of J_i^T W_i C_i W_i J_i) H^-1, H the normal matrix.
Covariance12 covarianceUnder(const Weighing& weighing, EyeSetup setup, const HandEye& pose,
                             const std::vector<bool>& used, const PairNoise& scatter) {
  Covariance12 H = Covariance12::Zero();
  Covariance12 spread = Covariance12::Zero();
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) {
      const PosePair& pair = weighing.pairs[i];
      const PairRow row = linearise(pose, pair, setup);
      Eigen::Matrix<double, 6, 12> J;
      J << row.by_camera, row.by_target;
      const Eigen::Matrix<double, 12, 6> JtW =
          J.transpose() * pairCovariance(pair, weighing.noise).inverse();
      H += JtW * J;
      spread += JtW * pairCovariance(pair, scatter) * JtW.transpose();
    }
  }
  const Covariance12 inverse = H.ldlt().solve(Covariance12::Identity());
  return inverse * spread * inverse.transpose();
}

// Every pair the same, and the scatter that the pairs then show.
WeighedFit fitPairs(const std::vector<PosePair>& pairs, EyeSetup setup,
                    const HandEyeFit& believed) {
  WeighedFit fit{PairWeights::kPairs, believed.pose, believed.noise, std::nullopt, {}};
  for (int round = 0; round < kNoiseRounds; ++round) {
    const Weighing weighing(pairs, fit.noise, fit.weights);
    fit.pose = refitHandEye(weighing.pairs, setup, fit.pose, believed.used, weighing.noise);
    fit.noise = estimateNoise(fit.pose, weighing.pairs, believed.used, setup, fit.noise);
  }
  return fit;
}

// The scatter is that of the best fit: this one's residuals hold its own errors too.
WeighedFit fitRotationFirst(const std::vector<PosePair>& pairs, EyeSetup setup,
                            const WeighedFit& best, const std::vector<bool>& used) {
  WeighedFit fit{PairWeights::kRotationFirst, best.pose, best.noise, std::nullopt, {}};
  const Weighing weighing(pairs, fit.noise, fit.weights);
  fit.pose = refitHandEye(weighing.pairs, setup, fit.pose, used, weighing.noise);
  return fit;
}

// Errors are counted in those of `than`, so that millimetres and degrees add up.
bool clearlyBetter(const LeftOut& fit, const LeftOut& than) {
  const auto square = [&](const PairError& e) {
    return std::pow(e.translation_m / than.rms.translation_m, 2) +
           std::pow(e.rotation_rad / than.rms.rotation_rad, 2);
  };
  std::vector<double> falls;
  for (std::size_t i = 0; i < fit.errors.size(); ++i) {
    falls.push_back(square(than.errors[i]) - square(fit.errors[i]));
  }
  return clearlyPositive(falls);
}

double product(const PairError& error) { return error.translation_m * error.rotation_rad; }

}  // namespace

std::string toString(PairWeights weights) {
  switch (weights) {
    case PairWeights::kViews:
      return "covariances of the views";
    case PairWeights::kPairs:
      return "scatter of the pairs";
    case PairWeights::kRotationFirst:
      return "rotation first";
  }
  return {};
}

PairWeights believedWeights(const std::vector<PosePair>& pairs) {
  const bool told = std::any_of(pairs.begin(), pairs.end(),
                                [](const PosePair& pair) { return pair.covariance.has_value(); });
  return told ? PairWeights::kViews : PairWeights::kPairs;
}

LeftOut leaveEachOut(const std::vector<PosePair>& pairs, EyeSetup setup, const WeighedFit& fit,
                     const std::vector<bool>& used) {
  const Weighing weighing(pairs, fit.noise, fit.weights);
  LeftOut left_out;
  std::vector<Vector12> changes;
  Vector12 sum = Vector12::Zero();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (used[i]) {
      std::vector<bool> others = used;
      others[i] = false;
      const HandEye without = refitHandEye(weighing.pairs, setup, fit.pose, others, weighing.noise);
      left_out.errors.push_back(pairError(without, pairs[i], setup));
      Vector12 change;
      change << logSe3(fit.pose.camera.inverse() * without.camera),
          logSe3(fit.pose.target.inverse() * without.target);
      changes.push_back(change);
      sum += change;
    }
  }
  left_out.rms = rms(left_out.errors);
  const auto n = static_cast<double>(changes.size());
  for (const Vector12& change : changes) {
    const Vector12 from_mean = change - sum / n;
    left_out.jackknife += (n - 1.0) / n * from_mean * from_mean.transpose();
  }
  return left_out;
}

std::vector<WeighedFit> fitInEveryWay(const std::vector<PosePair>& pairs, EyeSetup setup,
                                      const HandEyeFit& believed) {
  std::vector<WeighedFit> fits{
      {believedWeights(pairs), believed.pose, believed.noise, believed.covariance, {}}};
  if (fits.front().weights == PairWeights::kViews) {
    fits.push_back(fitPairs(pairs, setup, believed));
  }
  fits.push_back(fitRotationFirst(pairs, setup, fits.back(), believed.used));
  for (WeighedFit& fit : fits) {
    if (!fit.covariance) {
      fit.covariance = covarianceUnder(Weighing(pairs, fit.noise, fit.weights), setup, fit.pose,
                                       believed.used, fit.noise);
    }
    fit.left_out = leaveEachOut(pairs, setup, fit, believed.used);
  }
  return fits;
}

std::size_t chosenFit(const std::vector<WeighedFit>& fits) {
  std::size_t chosen = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < fits.size(); ++i) {
    const LeftOut& left_out = fits[i].left_out;
    if (clearlyBetter(left_out, fits[0].left_out) && product(left_out.rms) < least) {
      chosen = i;
      least = product(left_out.rms);
    }
  }
  return chosen;
}

}  // namespace ringhook
