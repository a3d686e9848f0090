// Zero errors of an RX60's joints, against made-up truth.

#include "calib/solve/joint_zeros.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

namespace ringhook {
namespace {

struct MadeArm {
  HandEye truth;
  JointVector zero;
  std::vector<JointVector> joints;  // reported
  std::vector<PosePair> pairs;
};

MadeArm makeArm(EyeSetup setup, double noise_m) {
  MadeArm made;
  made.truth.camera = makePoseThetaU({1.75, 0.1, 0.7}, {1.2, -1.2, 1.1});
  made.truth.target = makePoseThetaU({-0.08, 0.0, 0.05}, {0.1, 3.0, 0.2});
  made.zero << 4e-4, -6e-4, 5e-4, 7e-4, -8e-4, 3e-4;
  std::mt19937_64 dice(9);
  std::normal_distribution<double> normal;
  JointVector middle;
  middle << -0.2, 0.7, 1.2, 0.4, 0.6, 0.1;
  for (int i = 0; i < 30; ++i) {
    JointVector q = middle;
    Twist d;
    for (int k = 0; k < 6; ++k) {
      q[k] += 0.4 * normal(dice);
      d[k] = (k < 3 ? noise_m : 5.0 * noise_m) * normal(dice);
    }
    PosePair pair{"pair " + std::to_string(i), rx60::forward(rx60::rx60(), q + made.zero), {}, {}};
    pair.cMt = predictedTarget(made.truth, pair, setup) * expSe3(d);
    pair.fMe = rx60::forward(rx60::rx60(), q);
    made.joints.push_back(q);
    made.pairs.push_back(pair);
  }
  return made;
}

TEST(JointZeros, ComeOutWithTheirUncertaintyInBothSetups) {
  for (const EyeSetup setup : {EyeSetup::kEyeToHand, EyeSetup::kEyeInHand}) {
    const MadeArm made = makeArm(setup, 0.00003);
    const auto plain = calibrateRobotCamera(made.pairs, setup, [](double, const std::string&) {});
    const JointZeros found = fitJointZeros(made.pairs, made.joints, rx60::rx60(), plain);
    for (int k = 1; k < 5; ++k) {  // the base turns like joint 1, the tool like joint 6
      EXPECT_NEAR(found.zero_rad[k], made.zero[k], 4.0 * found.sigma_rad[k]) << k;
      EXPECT_LT(found.sigma_rad[k], 1e-4) << k;
    }
    EXPECT_EQ(found.zero_rad[0], 0.0);
    EXPECT_EQ(found.zero_rad[5], 0.0);
    EXPECT_LT(found.heldout.translation_m, plain.heldout.translation_m);
    EXPECT_LT(found.heldout.translation_m, 1.4 * std::sqrt(3.0) * 0.00003);  // noise is left
    EXPECT_LT(found.residual.translation_m, 0.00007);
  }
}

// Errors of pairs left out, without zeros and with them.
std::pair<std::vector<PairError>, std::vector<PairError>> judged(double noise_m,
                                                                 const JointVector& zero) {
  MadeArm made = makeArm(EyeSetup::kEyeToHand, noise_m);
  for (std::size_t i = 0; i < made.pairs.size(); ++i) {
    made.joints[i] += made.zero - zero;
    made.pairs[i].fMe = rx60::forward(rx60::rx60(), made.joints[i]);
  }
  const auto plain =
      calibrateRobotCamera(made.pairs, EyeSetup::kEyeToHand, [](double, const std::string&) {});
  const JointZeros found = fitJointZeros(made.pairs, made.joints, rx60::rx60(), plain);
  return {plain.left_out, found.left_out};
}

TEST(JointZeros, PayOnlyWhereThereAreErrorsAboveTheNoise) {
  JointVector zero;
  zero << 0, -6e-4, 5e-4, 7e-4, -8e-4, 0;
  const auto [plain, with] = judged(0.00003, zero);
  EXPECT_TRUE(zerosPay(plain, with));
  const auto [plain_noise, with_noise] = judged(0.0003, JointVector::Zero());
  EXPECT_FALSE(zerosPay(plain_noise, with_noise));
  EXPECT_FALSE(zerosPay(with, with));
}

TEST(JointZeros, AreZeroForAnArmWithoutErrors) {
  MadeArm made = makeArm(EyeSetup::kEyeToHand, 0.00003);
  for (std::size_t i = 0; i < made.pairs.size(); ++i) {
    made.pairs[i].fMe = rx60::forward(rx60::rx60(), made.joints[i] + made.zero);
    made.joints[i] += made.zero;
  }
  const auto plain =
      calibrateRobotCamera(made.pairs, EyeSetup::kEyeToHand, [](double, const std::string&) {});
  const JointZeros found = fitJointZeros(made.pairs, made.joints, rx60::rx60(), plain);
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(found.zero_rad[k], 0.0, 4.0 * found.sigma_rad[k]) << k;
  }
}

}  // namespace
}  // namespace ringhook
