#include "calib/solve/pair_weights.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "calib/solve/small_statistics.h"

namespace ringhook {
namespace {

constexpr int kNoiseRounds = 10;
constexpr double kClearly = 2.0;  // standard errors
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

void leaveOut(const std::vector<PosePair>& pairs, EyeSetup setup, const std::vector<bool>& used,
              WeighedFit& fit) {
  const auto without = refitsWithoutEach(pairs, setup, fit.pose, used, fit.noise, fit.weights);
  std::size_t next = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (used[i]) {
      fit.left_out.push_back(pairError(without[next++], pairs[i], setup));
    }
  }
  fit.heldout = rms(fit.left_out);
}

// Every pair the same, and the scatter that the pairs then show.
WeighedFit fitPairs(const std::vector<PosePair>& pairs, EyeSetup setup,
                    const HandEyeFit& believed) {
  WeighedFit fit{PairWeights::kPairs, believed.pose, believed.noise, std::nullopt, {}, {}};
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
  WeighedFit fit{PairWeights::kRotationFirst, best.pose, best.noise, std::nullopt, {}, {}};
  const Weighing weighing(pairs, fit.noise, fit.weights);
  fit.pose = refitHandEye(weighing.pairs, setup, fit.pose, used, weighing.noise);
  return fit;
}

bool clearlyBetter(const WeighedFit& fit, const WeighedFit& than) {
  const auto share = [](double error, double rms) { return error * error / (rms * rms); };
  std::vector<double> falls;
  for (std::size_t i = 0; i < fit.left_out.size(); ++i) {
    const PairError& a = than.left_out[i];
    const PairError& b = fit.left_out[i];
    falls.push_back(share(a.translation_m, than.heldout.translation_m) -
                    share(b.translation_m, than.heldout.translation_m) +
                    share(a.rotation_rad, than.heldout.rotation_rad) -
                    share(b.rotation_rad, than.heldout.rotation_rad));
  }
  return meanInStandardErrors(falls) > kClearly;
}

double product(const WeighedFit& fit) {
  return fit.heldout.translation_m * fit.heldout.rotation_rad;
}

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

std::vector<HandEye> refitsWithoutEach(const std::vector<PosePair>& pairs, EyeSetup setup,
                                       const HandEye& pose, const std::vector<bool>& used,
                                       const PairNoise& noise, PairWeights weights) {
  const Weighing weighing(pairs, noise, weights);
  std::vector<HandEye> without;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (used[i]) {
      std::vector<bool> others = used;
      others[i] = false;
      without.push_back(refitHandEye(weighing.pairs, setup, pose, others, weighing.noise));
    }
  }
  return without;
}

std::vector<WeighedFit> fitInEveryWay(const std::vector<PosePair>& pairs, EyeSetup setup,
                                      const HandEyeFit& believed) {
  std::vector<WeighedFit> fits{
      {believedWeights(pairs), believed.pose, believed.noise, believed.covariance, {}, {}}};
  if (fits.front().weights == PairWeights::kViews) {
    fits.push_back(fitPairs(pairs, setup, believed));
  }
  fits.push_back(fitRotationFirst(pairs, setup, fits.back(), believed.used));
  for (WeighedFit& fit : fits) {
    if (!fit.covariance) {
      fit.covariance = covarianceUnder(Weighing(pairs, fit.noise, fit.weights), setup, fit.pose,
                                       believed.used, fit.noise);
    }
    leaveOut(pairs, setup, believed.used, fit);
  }
  return fits;
}

std::size_t chosenFit(const std::vector<WeighedFit>& fits) {
  std::size_t chosen = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < fits.size(); ++i) {
    if (clearlyBetter(fits[i], fits[0]) && product(fits[i]) < least) {
      chosen = i;
      least = product(fits[i]);
    }
  }
  return chosen;
}

}  // namespace ringhook
