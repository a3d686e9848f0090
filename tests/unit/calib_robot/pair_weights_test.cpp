// Which weights the pairs left out decide for, against made-up truth.

#include "calib/solve/pair_weights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "calib/solve/hand_eye.h"
#include "pair_scene.h"

namespace ringhook {
namespace {

constexpr EyeSetup kSetup = EyeSetup::kEyeToHand;

// Half of the views are five times better than the other half, and all of them say how good they
// are: rightly, or each what another's noise is.
MadePairs unlikePairs(unsigned seed, bool rightly) {
  std::mt19937_64 dice(seed);
  std::normal_distribution<double> normal;
  PairScene scene;
  scene.pairs = 16;
  scene.translation_m = scene.rotation_rad = 0.0;
  MadePairs made = makePairs(scene, dice);
  for (std::size_t i = 0; i < made.pairs.size(); ++i) {
    PosePair& pair = made.pairs[i];
    const auto sigmas = [](bool good) {
      Twist s;
      s << Eigen::Vector3d::Constant(good ? 0.2e-3 : 1e-3),
          Eigen::Vector3d::Constant(good ? 1e-3 : 5e-3);
      return s;
    };
    const bool good = i % 2 == 0;
    Twist e;
    std::generate(e.begin(), e.end(), [&] { return normal(dice); });
    pair.cMt = pair.cMt * expSe3(sigmas(good).cwiseProduct(e));
    pair.covariance = Covariance6(sigmas(good == rightly).cwiseAbs2().asDiagonal());
  }
  return made;
}

std::vector<WeighedFit> everyWay(const MadePairs& made) {
  return fitInEveryWay(made.pairs, kSetup, fitHandEye(made.pairs, kSetup, made.truth));
}

double cameraError(const WeighedFit& fit, const MadePairs& made) {
  return (fit.pose.camera.translation() - made.truth.camera.translation()).norm();
}

// Twenty sets: how often the views' word was kept, and sums of squared errors of the camera.
struct Twenty {
  int kept = 0;
  double by_views = 0.0;
  double by_pairs = 0.0;
  double taken = 0.0;
};

Twenty twentySets(bool rightly) {
  Twenty sums;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const MadePairs made = unlikePairs(seed, rightly);
    const auto fits = everyWay(made);
    EXPECT_EQ(fits.front().weights, PairWeights::kViews);
    const std::size_t chosen = chosenFit(fits);
    sums.kept += chosen == 0 ? 1 : 0;
    sums.by_views += std::pow(cameraError(fits[0], made), 2);
    sums.by_pairs += std::pow(cameraError(fits[1], made), 2);
    sums.taken += std::pow(cameraError(fits[chosen], made), 2);
  }
  return sums;
}

TEST(PairWeights, StayWhatViewsSayWhereThatIsTrue) {
  const Twenty sums = twentySets(true);
  EXPECT_GE(sums.kept, 19);
  EXPECT_LT(sums.by_views, 0.5 * sums.by_pairs);
}

TEST(PairWeights, AreNotWhatViewsSayWhereThatIsFalse) {
  const Twenty sums = twentySets(false);
  EXPECT_LE(sums.kept, 5);
  EXPECT_LT(sums.taken, 0.7 * sums.by_views);
}

TEST(PairWeights, OfRotationFirstLetNoLengthTurnTheCamera) {
  std::mt19937_64 dice(4);
  MadePairs made = makePairs({}, dice);
  const WeighedFit before = everyWay(made).back();
  ASSERT_EQ(before.weights, PairWeights::kRotationFirst);
  for (PosePair& pair : made.pairs) {
    pair.cMt.translation() *= 1.01;  // a tag taken for larger than it is
  }
  const auto fits = everyWay(made);
  const auto turn = [&](const WeighedFit& fit) {
    return thetaU(before.pose.camera.linear().transpose() * fit.pose.camera.linear()).norm();
  };
  EXPECT_LT(turn(fits.back()), 5e-6);
  EXPECT_GT(turn(fits.front()), 1e-4);
}

TEST(PairWeights, OfRotationFirstHaveTheCovarianceOfTheirErrors) {
  // Mean of e^T C^-1 e over sets is the number of unknowns, 12, and a little more since the noise
  // is itself estimated.
  double sum = 0.0;
  const int sets = 60;
  for (unsigned seed = 0; seed < sets; ++seed) {
    std::mt19937_64 dice(500 + seed);
    const MadePairs made = makePairs({}, dice);
    const WeighedFit fit = everyWay(made).back();
    sum += mahalanobis2(fit.pose, fit.covariance.value(), made.truth) / sets;
  }
  EXPECT_NEAR(sum, 12.0, 3.0);
}

TEST(PairWeights, AreOnlyComparedWherePairsCanTell) {
  std::mt19937_64 dice(7);
  PairScene scene;
  scene.pairs = kFewestToWeigh - 1;
  const MadePairs few = makePairs(scene, dice);
  const auto quiet = [](double, const std::string&) {};
  EXPECT_TRUE(calibrateRobotCamera(few.pairs, kSetup, quiet).weighings.empty());
  scene.pairs = kFewestToWeigh;
  const MadePairs enough = makePairs(scene, dice);
  const HandEyeResult result = calibrateRobotCamera(enough.pairs, kSetup, quiet);
  ASSERT_EQ(result.weighings.size(), 2U);
  EXPECT_EQ(result.weighings[0].weights, PairWeights::kPairs);
  EXPECT_EQ(result.left_out.size(), result.weighings[0].left_out.errors.size());
}

}  // namespace
}  // namespace ringhook
