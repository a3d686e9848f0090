// Robot-camera calibration from pose pairs, against made-up truth.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "calib/solve/hand_eye.h"
#include "calib/solve/hand_eye_verdict.h"
#include "core/error.h"
#include "pair_scene.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

HandEyeResult solve(const std::vector<PosePair>& pairs, EyeSetup setup) {
  return calibrateRobotCamera(pairs, setup, [](double, const std::string&) {});
}

MadePairs made(const PairScene& scene, unsigned seed) {
  std::mt19937_64 dice(seed);
  return makePairs(scene, dice);
}

double cameraError(const HandEyeResult& result, const MadePairs& pairs) {
  return (result.pose.camera.translation() - pairs.truth.camera.translation()).norm();
}

TEST(HandEye, FindsExactPosesInBothSetups) {
  for (const EyeSetup setup : {EyeSetup::kEyeToHand, EyeSetup::kEyeInHand}) {
    PairScene scene;
    scene.setup = setup;
    scene.translation_m = scene.rotation_rad = 0.0;
    const MadePairs pairs = made(scene, 2);
    const HandEyeResult result = solve(pairs.pairs, setup);
    EXPECT_LT((result.pose.camera.matrix() - pairs.truth.camera.matrix()).norm(), 1e-9);
    EXPECT_LT((result.pose.target.matrix() - pairs.truth.target.matrix()).norm(), 1e-9);
    EXPECT_EQ(result.verdict.grade, Grade::kGood) << result.verdict.sentence;
  }
}

TEST(HandEye, ErrorsOfManySetsFollowTheirCovariance) {
  // Mean of e^T C^-1 e over sets is the number of unknowns, 12, if the covariance is right; it is
  // a little larger since the noise is itself estimated.
  double sum = 0.0;
  const int sets = 60;
  for (unsigned seed = 0; seed < sets; ++seed) {
    const MadePairs pairs = made({}, 100 + seed);
    const HandEyeResult result = solve(pairs.pairs, EyeSetup::kEyeToHand);
    sum += mahalanobis2(result.pose, result.covariance.value(), pairs.truth) / sets;
  }
  EXPECT_NEAR(sum, 12.0, 3.0);
}

TEST(HandEye, EstimatesTheNoiseOfThePairs) {
  PairScene scene;
  scene.pairs = 200;
  const HandEyeResult result = solve(made(scene, 7).pairs, scene.setup);
  EXPECT_NEAR(result.noise.translation_m, scene.translation_m, 0.05 * scene.translation_m);
  EXPECT_NEAR(result.noise.rotation_rad, scene.rotation_rad, 0.05 * scene.rotation_rad);
}

TEST(HandEye, NamesExactlyTheWrongPairs) {
  PairScene scene;
  scene.wrong_share = 0.2;
  const MadePairs pairs = made(scene, 5);
  const HandEyeResult result = solve(pairs.pairs, scene.setup);
  ASSERT_EQ(result.rejected.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(result.rejected[i].name, "pair " + std::to_string(i));
    EXPECT_THAT(result.rejected[i].reason, HasSubstr("mm"));
  }
  EXPECT_LT(cameraError(result, pairs), 0.001);
  EXPECT_NE(result.verdict.grade, Grade::kPoor) << result.verdict.sentence;
}

TEST(HandEye, HeldOutErrorsAreLargerThanResiduals) {
  PairScene scene;
  scene.pairs = 10;
  const HandEyeResult result = solve(made(scene, 11).pairs, scene.setup);
  EXPECT_GT(result.heldout.translation_m, result.residual.translation_m);
  EXPECT_GT(result.heldout.rotation_rad, result.residual.rotation_rad);
}

TEST(HandEye, RefusesParallelAxesAndSaysWhichToAdd) {
  PairScene scene;
  scene.axis_spread = 0.0;
  MadePairs pairs = made(scene, 3);
  const HandEyeResult result = solve(pairs.pairs, scene.setup);
  EXPECT_EQ(result.verdict.grade, Grade::kPoor);
  EXPECT_THAT(result.verdict.sentence, HasSubstr("flange turned"));
  EXPECT_THAT(result.verdict.sentence, HasSubstr("axis"));
}

TEST(HandEye, AdviceNamesAnAxisThatWasNotTurned) {
  std::vector<PosePair> pairs(8);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double turn = 0.2 * static_cast<double>(i);
    pairs[i].fMe = makePoseThetaU({0, 0, 0}, {0, 0, turn});
  }
  const std::string advice = motionAdvice(pairs);
  EXPECT_TRUE(advice.find("its x axis") != std::string::npos ||
              advice.find("its y axis") != std::string::npos)
      << advice;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].fMe = pairs[i].fMe * makePoseThetaU({0, 0, 0}, {i % 2 == 0 ? 0.9 : -0.9, 0, 0});
  }
  EXPECT_THAT(motionAdvice(pairs), ::testing::Not(HasSubstr("its x axis")));
}

TEST(HandEye, RefusesSmallMotion) {
  PairScene scene;
  scene.turn_rad = 0.03;
  scene.travel_m = 0.01;
  const HandEyeResult result = solve(made(scene, 3).pairs, scene.setup);
  EXPECT_EQ(result.verdict.grade, Grade::kPoor);
  EXPECT_THAT(result.verdict.sentence, HasSubstr("may be wrong by"));
  EXPECT_THAT(result.verdict.sentence, HasSubstr("turn the flange more"));
}

TEST(HandEye, RefusesTooFewPairsAndFlangesThatNeverTurn) {
  MadePairs pairs = made({}, 3);
  for (PosePair& pair : pairs.pairs) {
    pair.fMe.linear().setIdentity();
  }
  EXPECT_THROW(solve(pairs.pairs, EyeSetup::kEyeToHand), InputError);
  pairs.pairs.resize(3);
  EXPECT_THROW(solve(pairs.pairs, EyeSetup::kEyeToHand), InputError);
}

TEST(HandEye, RefusesSetsOfWhichAThirdIsWrong) {
  PairScene scene;
  scene.wrong_share = 0.35;
  const HandEyeResult result = solve(made(scene, 3).pairs, scene.setup);
  EXPECT_EQ(result.verdict.grade, Grade::kPoor);
  EXPECT_THAT(result.verdict.sentence, HasSubstr("contradict"));
}

TEST(HandEye, NamesInvertedRobotPosesAndTheOtherSetup) {
  MadePairs pairs = made({}, 4);
  EXPECT_THAT(solve(pairs.pairs, EyeSetup::kEyeInHand).verdict.sentence, HasSubstr("eye-to-hand"));
  for (PosePair& pair : pairs.pairs) {
    pair.fMe = pair.fMe.inverse();
  }
  const HandEyeResult result = solve(pairs.pairs, EyeSetup::kEyeToHand);
  EXPECT_EQ(result.verdict.grade, Grade::kPoor);
  EXPECT_THAT(result.verdict.sentence, HasSubstr("robot poses are inverted"));
  EXPECT_THAT(result.verdict.sentence, HasSubstr("times better"));
}

TEST(HandEye, NamesInvertedTargetPoses) {
  MadePairs pairs = made({}, 4);
  for (PosePair& pair : pairs.pairs) {
    pair.cMt = pair.cMt.inverse();
  }
  EXPECT_THAT(solve(pairs.pairs, EyeSetup::kEyeToHand).verdict.sentence,
              HasSubstr("target poses are inverted"));
}

TEST(HandEye, NamesTheOtherOrderOfQuaternions) {
  MadePairs pairs = made({}, 4);
  for (PosePair& pair : pairs.pairs) {
    const Eigen::Quaterniond q(pair.fMe.linear());
    // Written as w, x, y, z, read as x, y, z, w.
    pair.fMe = makePose(pair.fMe.translation(), Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()));
  }
  EXPECT_THAT(solve(pairs.pairs, EyeSetup::kEyeToHand).verdict.sentence,
              HasSubstr("the robot's quaternions are in the order w, x, y, z"));
}

TEST(HandEye, NamesRowsShiftedByOne) {
  MadePairs pairs = made({}, 4);
  for (std::size_t i = 0; i + 1 < pairs.pairs.size(); ++i) {
    pairs.pairs[i].cMt = pairs.pairs[i + 1].cMt;
  }
  pairs.pairs.pop_back();
  EXPECT_THAT(solve(pairs.pairs, EyeSetup::kEyeToHand).verdict.sentence, HasSubstr("one row"));
}

TEST(HandEye, AcceptedAnswersAreRightAndUsualOnesAreAccepted) {
  int accepted = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    PairScene scene;
    scene.setup = seed % 2 == 0 ? EyeSetup::kEyeToHand : EyeSetup::kEyeInHand;
    scene.pairs = 12;
    scene.turn_rad = seed % 3 == 0 ? 0.08 : 0.5;
    const MadePairs pairs = made(scene, 500 + seed);
    const HandEyeResult result = solve(pairs.pairs, scene.setup);
    if (result.verdict.grade != Grade::kPoor) {
      EXPECT_LT(cameraError(result, pairs), 0.005) << seed;
      ++accepted;
    }
  }
  EXPECT_GE(accepted, 15);
}

TEST(HandEyeFit, WeighsViewsByTheirOwnCovariance) {
  // Two thirds of the pairs are ten times worse and say so: the rest must decide.
  PairScene scene;
  scene.pairs = 30;
  double with_m = 0.0;
  double without_m = 0.0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    MadePairs pairs = made(scene, 40 + seed);
    std::mt19937_64 dice(seed);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < pairs.pairs.size(); ++i) {
      const double factor = i % 3 == 0 ? 1.0 : 10.0;
      Twist d;
      for (int k = 0; k < 6; ++k) {
        d[k] = std::sqrt(factor * factor - 1.0) * normal(dice) * (k < 3 ? 0.0003 : 0.002);
      }
      pairs.pairs[i].cMt = pairs.pairs[i].cMt * expSe3(d);
    }
    const auto plain = fitHandEye(pairs.pairs, scene.setup, pairs.truth);
    for (std::size_t i = 0; i < pairs.pairs.size(); ++i) {
      const double factor = i % 3 == 0 ? 1.0 : 10.0;
      Covariance6 V = Covariance6::Zero();
      V.diagonal().head<3>().setConstant(std::pow(factor * 0.0003, 2));
      V.diagonal().tail<3>().setConstant(std::pow(factor * 0.002, 2));
      pairs.pairs[i].covariance = V;
    }
    const auto told = fitHandEye(pairs.pairs, scene.setup, pairs.truth);
    const auto error = [&](const HandEyeFit& fit) {
      return (fit.pose.camera.translation() - pairs.truth.camera.translation()).squaredNorm();
    };
    with_m += error(told);
    without_m += error(plain);
  }
  EXPECT_LT(2.0 * std::sqrt(with_m), std::sqrt(without_m));
}

TEST(BoundFactor, IsWiderForFewerResiduals) {
  EXPECT_NEAR(boundFactor(1e6), std::sqrt(16.27), 0.02);
  EXPECT_GT(boundFactor(6), 2.0 * boundFactor(1000));
  // chi-square with 18 degrees has its 1 % point at 7.015.
  EXPECT_NEAR(boundFactor(18), std::sqrt(16.27 * 18.0 / 7.015), 0.1);
}

}  // namespace
}  // namespace ringhook
