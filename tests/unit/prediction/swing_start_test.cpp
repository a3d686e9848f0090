#include "prediction/swing_start.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "outcome_text.h"
#include "prediction/hook_swing.h"

namespace ringhook {
namespace {

constexpr double kFrame = 1.0 / 30.0;  // [s]
constexpr int kFrames = 60;

SwingFilterOptions knowledge() { return swingOptions({}); }

SwingVector usualState() {
  SwingVector state = knowledge().prior.mean;
  state.segment<6>(kSwingPivot) << 0.4, -0.5, 1.05, 0.0, 0.2, 0.0;
  state.segment<4>(kSwingAngle) << 0.08, -0.03, 0.1, 0.4;
  state(kSwingLogLength) += 0.02;
  state(kSwingDry) = 0.01;
  return state;
}

/// Poses of a hook that starts at `state`, with noise of `scale` times 0.2 mm and 1 mrad.
std::vector<SwingMeasurement> posesFrom(const SwingVector& state, double scale,
                                        std::mt19937& random) {
  const SwingFilterOptions options = knowledge();
  std::normal_distribution<double> normal;
  Twist sigma;
  sigma << Eigen::Vector3d::Constant(2e-4), Eigen::Vector3d::Constant(1e-3);
  std::vector<SwingMeasurement> seen;
  for (int i = 0; i < kFrames; ++i) {
    const Twist off =
        scale * sigma.cwiseProduct(Twist::NullaryExpr([&] { return normal(random); }));
    SwingMeasurement m;
    m.time = Time::fromSeconds(i * kFrame);
    m.fMo =
        swingPose(walkSwing(state, m.time.seconds(), options.law), options.pivot_o) * expSe3(off);
    m.covariance = Eigen::MatrixXd(sigma.cwiseAbs2().asDiagonal());
    seen.push_back(m);
  }
  return seen;
}

Outcome<SwingFit> fitOf(std::span<const SwingMeasurement> seen, const SwingPrior& prior) {
  const SwingFilterOptions options = knowledge();
  const SwingVector guess = guessSwing(seen, prior, options.law, options.pivot_o);
  return fitSwing(seen, prior, guess, options.law, options.pivot_o);
}

TEST(SwingStart, FindsTheTruthInDataWithoutNoise) {
  std::mt19937 random(1);
  SwingPrior prior = knowledge().prior;
  prior.covariance *= 100.0;  // little is believed; what is known stays so
  const SwingVector truth = usualState();
  const auto fit = fitOf(posesFrom(truth, 0.0, random), prior);
  ASSERT_TRUE(fit.hasValue());
  EXPECT_LT((fit->start.mean - truth).segment<4>(kSwingAngle).norm(), 1e-4);
  EXPECT_LT((fit->start.mean - truth).segment<6>(kSwingPivot).norm(), 1e-3);
  EXPECT_NEAR(fit->start.mean(kSwingLogLength), truth(kSwingLogLength), 1e-3);
  EXPECT_LT(fit->chi_square, 1e-2);
  const SwingVector end = walkSwing(fit->start.mean, (kFrames - 1) * kFrame, knowledge().law);
  EXPECT_LT((fit->end.mean - end).norm(), 1e-5);  // other steps
}

// NEES, Bar-Shalom, Li, Kirubarajan, 2001, section 5.4: what is drawn from the prior and seen with
// the noise that is told has chi-square errors, of 11 degrees here, within 4 deviations over 60.
TEST(SwingStart, ItsCovarianceIsTheSpreadOfItsErrors) {
  constexpr int kSeeds = 60;
  constexpr int kJudged[] = {kSwingPivot,     kSwingPivot + 1, kSwingPivot + 2, kSwingSpeed,
                             kSwingSpeed + 1, kSwingSpeed + 2, kSwingAngle,     kSwingAngle + 1,
                             kSwingRate,      kSwingRate + 1,  kSwingLogLength};
  const SwingPrior prior = knowledge().prior;
  double sum = 0.0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    SwingVector truth = usualState();
    for (int i = kSwingAcceleration; i < kSwingStates; ++i) {
      if (i < kSwingAngle || i >= kSwingLogLength) {
        truth(i) = prior.mean(i) + std::sqrt(prior.covariance(i, i)) * normal(random);
      }
    }
    truth(kSwingYaw) *= 0.1;
    const auto fit = fitOf(posesFrom(truth, 1.0, random), prior);
    ASSERT_TRUE(fit.hasValue()) << seed;
    Eigen::Matrix<double, 11, 1> off;
    Eigen::Matrix<double, 11, 11> P;
    for (int i = 0; i < 11; ++i) {
      off(i) = fit->start.mean(kJudged[i]) - truth(kJudged[i]);
      for (int j = 0; j < 11; ++j) {
        P(i, j) = fit->start.covariance(kJudged[i], kJudged[j]);
      }
    }
    sum += off.dot(P.inverse() * off);
  }
  EXPECT_NEAR(sum / kSeeds, 11.0, 4.0 * std::sqrt(2.0 * 11.0 / kSeeds));
}

TEST(SwingStart, OneWildFixInTwentyDoesNoHarm) {
  const SwingVector truth = usualState();
  double clean = 0.0;
  double spoilt = 0.0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    auto seen = posesFrom(truth, 1.0, random);
    const auto off = [&] {
      const auto fit = fitOf(seen, knowledge().prior);
      return fit ? (fit->end.mean - walkSwing(truth, (kFrames - 1) * kFrame, knowledge().law))
                       .segment<4>(kSwingAngle)
                       .squaredNorm()
                 : 1.0;
    };
    clean += off();
    for (const std::size_t i : {7, 23, 48}) {
      seen[i].fMo.translation() += Eigen::Vector3d(0.05, -0.03, 0.04);
    }
    spoilt += off();
  }
  EXPECT_LT(std::sqrt(spoilt), 2.0 * std::sqrt(clean));
}

TEST(SwingStart, RefusesNothingToFit) {
  EXPECT_EQ(reasonOf(fitSwing({}, knowledge().prior, usualState(), knowledge().law, {0, 0, 0.45})),
            "no measurement");
}

TEST(SwingStart, LeavesAloneWhatIsKnown) {
  std::mt19937 random(3);
  SwingPrior prior = knowledge().prior;
  prior.mean(kSwingViscous) = 0.123;
  prior.covariance(kSwingViscous, kSwingViscous) = 0.0;
  const auto fit = fitOf(posesFrom(usualState(), 1.0, random), prior);
  ASSERT_TRUE(fit.hasValue());
  EXPECT_EQ(fit->start.mean(kSwingViscous), 0.123);
  EXPECT_EQ(fit->start.covariance(kSwingViscous, kSwingViscous), 0.0);
}

}  // namespace
}  // namespace ringhook
