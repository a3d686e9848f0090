#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>

#include "joint_samples.h"
#include "robot/rx60/kinematics.h"

namespace ringhook::rx60 {
namespace {

using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

double positionError(const Pose& a, const Pose& b) {
  return (a.translation() - b.translation()).norm();
}
double rotationError(const Pose& a, const Pose& b) {
  return thetaU(a.linear().transpose() * b.linear()).norm();
}

JointVector joints(double q1, double q2, double q3, double q4, double q5, double q6) {
  JointVector q;
  q << q1, q2, q3, q4, q5, q6;
  return q;
}

/// Distance from q to the nearest of the solutions, turns of joints 4 and 6 expanded.
double distanceToSolutions(const JointVector& q, const InverseSolutions& solutions) {
  double least = std::numeric_limits<double>::infinity();
  for (const InverseSolution& solution : solutions) {
    for (const JointVector& candidate : expandTurns(solution.q, limits())) {
      least = std::min(least, (candidate - q).cwiseAbs().maxCoeff());
    }
  }
  return least;
}

/// The nearest solution; a test failure and zeros without one.
JointVector nearestOrFail(const JointLimits& within, const Pose& fMe,
                          const JointVector& reference) {
  const auto nearest = nearestInverse(rx60(), within, fMe, reference);
  if (nearest) {
    return *nearest;
  }
  ADD_FAILURE() << "no solution: " << nearest.reason();
  return JointVector::Zero();
}

struct WorstCase {
  double position = 0.0;    // [m]
  double rotation = 0.0;    // [rad]
  double generating = 0.0;  // distance of the generating joints to the nearest solution [rad]
};

WorstCase roundTrips(const Geometry& geometry, int count, unsigned seed) {
  JointSamples samples(seed);
  WorstCase worst;
  for (int i = 0; i < count; ++i) {
    const JointVector q = samples.within(limits());
    const Pose fMe = forward(geometry, q);
    const auto solutions = inverse(geometry, fMe);
    if (!solutions || solutions->size() != 8) {
      ADD_FAILURE() << "not eight branches at " << q.transpose();
      continue;
    }
    for (const InverseSolution& solution : *solutions) {
      const Pose back = forward(geometry, solution.q);
      worst.position = std::max(worst.position, positionError(fMe, back));
      worst.rotation = std::max(worst.rotation, rotationError(fMe, back));
    }
    worst.generating = std::max(worst.generating, distanceToSolutions(q, *solutions));
  }
  return worst;
}

TEST(Rx60Inverse, EveryBranchLeadsBackForAHundredThousandPoses) {
  const WorstCase worst = roundTrips(rx60(), 100000, 11);
  EXPECT_LT(worst.position, 1e-9);
  EXPECT_LT(worst.rotation, 1e-9);
  EXPECT_LT(worst.generating, 1e-6);  // the angle itself is ill-conditioned near singularities
  std::printf("worst: position %.2e m, rotation %.2e rad, generating joints %.2e rad\n",
              worst.position, worst.rotation, worst.generating);
}

TEST(Rx60Inverse, ServesTheLongArmToo) {
  const WorstCase worst = roundTrips(rx60L(), 20000, 12);
  EXPECT_LT(worst.position, 1e-9);
  EXPECT_LT(worst.rotation, 1e-9);
  EXPECT_LT(worst.generating, 1e-6);
}

TEST(Rx60Inverse, LabelsEightDifferentBranches) {
  const Pose fMe = forward(rx60(), joints(0.3, 0.5, 1.1, 0.4, 0.7, -0.2));
  const auto solutions = inverse(rx60(), fMe);
  ASSERT_TRUE(solutions);
  std::set<std::tuple<Shoulder, Elbow, Wrist>> labels;
  for (const InverseSolution& s : *solutions) {
    labels.insert({s.shoulder, s.elbow, s.wrist});
    EXPECT_EQ(s.q(2) > 0.0, s.elbow == Elbow::kPositive);
    EXPECT_EQ(s.q(4) > 0.0, s.wrist == Wrist::kPositive);
    const Pose turned_back =
        Eigen::AngleAxisd(-s.q(0), Eigen::Vector3d::UnitZ()) * Pose(forward(rx60(), s.q));
    const double wrist_x = (turned_back * Eigen::Vector3d(0.0, 0.0, -0.065)).x();
    EXPECT_EQ(wrist_x > 0.0, s.shoulder == Shoulder::kFront);
  }
  EXPECT_EQ(labels.size(), 8U);
}

TEST(Rx60Inverse, ChoosesJoint4ZeroWhenTheWristIsStraight) {
  const JointVector q = joints(0.2, 0.4, 1.2, 0.9, 0.0, -0.3);
  const auto solutions = inverse(rx60(), forward(rx60(), q));
  ASSERT_TRUE(solutions);
  int singular = 0;
  for (const InverseSolution& s : *solutions) {
    EXPECT_LT(positionError(forward(rx60(), s.q), forward(rx60(), q)), 1e-9);
    EXPECT_LT(rotationError(forward(rx60(), s.q), forward(rx60(), q)), 1e-9);
    singular += s.wrist_singular ? 1 : 0;
    if (s.wrist_singular) {
      EXPECT_EQ(s.q(3), 0.0);
      EXPECT_NEAR(s.q(5), 0.6, 1e-9);
    }
  }
  EXPECT_EQ(singular, 1);
}

TEST(Rx60Inverse, StaysExactWhileTheWristPassesTheSingularity) {
  for (double q5 = 1e-2; q5 > 1e-14; q5 *= 0.5) {
    const Pose fMe = forward(rx60(), joints(0.2, 0.4, 1.2, 0.9, q5, -0.3));
    const auto solutions = inverse(rx60(), fMe);
    ASSERT_TRUE(solutions);
    for (const InverseSolution& s : *solutions) {
      EXPECT_LT(rotationError(forward(rx60(), s.q), fMe), 1e-9) << "q5 = " << q5;
    }
  }
}

TEST(Rx60Inverse, ReachesTheStretchedArm) {
  const Pose fMe = forward(rx60(), JointVector::Zero());
  // Straight up the wrist stands on the shoulder's cylinder, stretched and wrist-singular at once.
  const auto solutions = inverse(rx60(), fMe);
  ASSERT_TRUE(solutions);
  for (const InverseSolution& s : *solutions) {
    EXPECT_LT(positionError(forward(rx60(), s.q), fMe), 1e-9);
    EXPECT_LT(rotationError(forward(rx60(), s.q), fMe), 1e-9);
  }
}

TEST(Rx60Inverse, RefusesWhatIsOutOfReach) {
  Pose fMe = Pose::Identity();
  fMe.translation() << 0.7, 0.0, 0.4;
  EXPECT_THAT(inverse(rx60(), fMe).reason(), HasSubstr("from the shoulder, at most 0.600"));
  fMe.translation() << 0.0501, 0.0, 0.341 + 0.065 + 0.015;  // |L2 - L4| = 0.02 m
  EXPECT_THAT(inverse(rx60(), fMe).reason(), HasSubstr("at least 0.020"));
  fMe.translation() << 0.02, 0.0, 0.8;
  EXPECT_THAT(inverse(rx60(), fMe).reason(), HasSubstr("axis of joint 1"));
  fMe.translation() << 0.3, 0.0, std::nan("");
  EXPECT_THAT(inverse(rx60(), fMe).reason(), HasSubstr("finite"));
}

TEST(Rx60ExpandTurns, FindsEveryTurnWithinTheLimits) {
  const JointVector q = joints(0.0, 0.0, 0.5, 2.0, 0.5, -2.0);  // 2 - 2 pi > -270 deg: two each
  const auto expanded = expandTurns(q, limits());
  EXPECT_EQ(expanded.size(), 4U);
  for (const JointVector& candidate : expanded) {
    EXPECT_LT(rotationError(forward(rx60(), candidate), forward(rx60(), q)), 1e-12);
  }
  EXPECT_EQ(expandTurns(joints(0.0, 0.0, 0.5, 0.1, 0.5, 0.1), limits()).size(), 1U);
  EXPECT_TRUE(expandTurns(joints(3.0, 0.0, 0.5, 0.1, 0.5, 0.1), limits()).empty());
}

TEST(Rx60NearestInverse, ReturnsTheReferenceItself) {
  JointSamples samples(13);
  for (int i = 0; i < 5000; ++i) {
    const JointVector q = samples.within(limits());
    const JointVector nearest = nearestOrFail(limits(), forward(rx60(), q), q);
    EXPECT_LT((nearest - q).cwiseAbs().maxCoeff(), 1e-6) << q.transpose();
  }
}

TEST(Rx60NearestInverse, KeepsJoint4InTheSingularWrist) {
  const JointVector q = joints(0.2, 0.4, 1.2, 2.1, 0.0, -1.3);
  const JointVector nearest = nearestOrFail(limits(), forward(rx60(), q), q);
  EXPECT_LT((nearest - q).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Rx60NearestInverse, FollowsAContinuousMotionWithoutJumps) {
  JointVector q = joints(0.1, 0.3, 1.3, 0.2, 0.6, 0.1);
  const Pose start = forward(rx60(), q);
  for (int step = 1; step <= 400; ++step) {
    Pose fMe = start;
    const double phase = 2.0 * kPi * step / 400.0;
    fMe.translation() +=
        Eigen::Vector3d(0.05 * (std::cos(phase) - 1.0), 0.05 * std::sin(phase), 0.0);
    fMe.rotate(Eigen::AngleAxisd(0.5 * std::sin(phase), Eigen::Vector3d::UnitZ()));
    const JointVector next = nearestOrFail(limits(), fMe, q);
    EXPECT_LT((next - q).cwiseAbs().maxCoeff(), 0.05);
    q = next;
  }
}

TEST(Rx60NearestInverse, SaysByHowMuchTheLimitsAreBroken) {
  const JointVector q = joints(0.2, 0.4, 1.2, 0.3, 0.6, -0.3);
  JointLimits narrow = limits();
  narrow.upper(0) = 0.1;  // front branches need J1 = 0.2, back branches another half turn
  narrow.lower(0) = -0.1;
  const auto refused = nearestInverse(rx60(), narrow, forward(rx60(), q), q);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.reason(), HasSubstr("J1 by 5.7 deg"));
}

TEST(Rx60NearestInverse, OfAnArmWithCorrectedZerosAnswersInReportedJoints) {
  Geometry arm = rx60();
  arm.zero = joints(0.01, -0.02, 0.015, 0.03, -0.01, 0.02);
  JointSamples samples(15);
  for (int i = 0; i < 1000; ++i) {
    const JointVector q = 0.9 * samples.within(limits());
    const Pose fMe = forward(arm, q);
    EXPECT_TRUE(fMe.isApprox(forward(rx60(), q + arm.zero), 1e-14));
    const auto nearest = nearestInverse(arm, limits(), fMe, q);
    ASSERT_TRUE(nearest) << nearest.reason();
    EXPECT_LT((*nearest - q).cwiseAbs().maxCoeff(), 1e-7);
  }
}

TEST(Rx60NearestInverse, StaysWithinTheLimitsForAnyReachablePose) {
  JointSamples samples(14);
  for (int i = 0; i < 5000; ++i) {
    const Pose fMe = forward(rx60(), samples.within(limits()));
    const JointVector nearest = nearestOrFail(limits(), fMe, samples.within(limits()));
    EXPECT_TRUE((nearest.array() >= limits().lower.array()).all());
    EXPECT_TRUE((nearest.array() <= limits().upper.array()).all());
    EXPECT_LT(positionError(forward(rx60(), nearest), fMe), 1e-9);
  }
}

}  // namespace
}  // namespace ringhook::rx60
