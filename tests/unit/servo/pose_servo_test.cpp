#include "servo/pose_servo.h"
#include "core/angle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "core/error.h"

namespace ringhook {
namespace {

using Eigen::Vector3d;

constexpr double kPeriod = 0.004;  // [s], the arm's 250 Hz
constexpr double kLambda = 4.0;    // [1/s]

ServoGains constantGain(double lambda) { return {lambda, lambda, 30.0}; }

RingGoal placeAt(const Vector3d& position) {
  RingGoal goal;
  goal.oMr.translation() = position;
  return goal;
}

ServoCommand commandOrFail(PoseServo& servo, const Pose& fMr, const HookEstimate& hook,
                           const RingGoal& goal) {
  const auto command = servo.command(fMr, hook, goal);
  if (command) {
    return *command;
  }
  ADD_FAILURE() << command.reason();
  return {};
}

/// A hook on a belt at 0.2 m/s, swinging about a pivot 0.45 m above o in two planes: pose and
/// velocity in closed form, which is the truth of these tests.
struct SwingingHook {
  double belt = 0.2;    // [m/s]
  double swing = 0.26;  // [rad]
  double omega = 4.67;  // [rad/s]
  Vector3d pivot_o{0.0, -0.02, 0.45};

  [[nodiscard]] HookEstimate at(double t) const {
    const double angle_x = swing * std::sin(omega * t);
    const double angle_y = 0.5 * swing * std::cos(omega * t);
    const double rate_x = swing * omega * std::cos(omega * t);
    const double rate_y = -0.5 * swing * omega * std::sin(omega * t);
    const Eigen::AngleAxisd about_x(angle_x, Vector3d::UnitX());
    HookEstimate hook;
    hook.time = Time::fromSeconds(t);
    hook.fMo = Pose::Identity();
    hook.fMo.linear() =
        (about_x * Eigen::AngleAxisd(angle_y, Vector3d::UnitY())).toRotationMatrix();
    const Vector3d pivot_f(0.42, belt * t, 1.05);
    hook.fMo.translation() = pivot_f - hook.fMo.linear() * pivot_o;
    const Vector3d turning = rate_x * Vector3d::UnitX() + rate_y * (about_x * Vector3d::UnitY());
    hook.twist_f << Vector3d(0.0, belt, 0.0) +
                        turning.cross(Vector3d(hook.fMo.translation() - pivot_f)),
        turning;
    return hook;
  }
};

struct Lag {
  double translation = 0.0;  // greatest after settling [m]
  double rotation = 0.0;     // [rad]
};

/// Ring following `goal` on the hook, commands integrated at 250 Hz; errors judged at the sampling
/// instants. The hook is given for the middle of each period, the ring moved on there.
Lag follow(const SwingingHook& truth, const RingGoal& goal, bool feed_forward) {
  PoseServo servo(constantGain(kLambda));
  Pose fMr = truth.at(0.0).fMo * goal.oMr;
  Twist last = Twist::Zero();
  Lag lag;
  for (int k = 0; k < 2000; ++k) {
    const double t = k * kPeriod;
    const Pose dMr = (truth.at(t).fMo * goal.oMr).inverse() * fMr;
    if (t > 4.0) {
      lag.translation = std::max(lag.translation, dMr.translation().norm());
      lag.rotation = std::max(lag.rotation, thetaU(dMr.linear()).norm());
    }
    HookEstimate hook = truth.at(t + 0.5 * kPeriod);
    if (!feed_forward) {
      hook.twist_f.setZero();
    }
    const Pose fMr_middle = fMr * expSe3(0.5 * kPeriod * last);
    last = commandOrFail(servo, fMr_middle, hook, goal).twist_r;
    fMr = fMr * expSe3(kPeriod * last);
  }
  return lag;
}

TEST(SwingingHook, TellsTheVelocityOfItsOwnPoses) {
  constexpr double kStep = 1e-6;  // [s]
  const SwingingHook truth;
  for (double t = 0.0; t < 2.0; t += 0.1) {
    const Pose before = truth.at(t - kStep).fMo;
    const Pose after = truth.at(t + kStep).fMo;
    Twist difference;
    difference << after.translation() - before.translation(),
        thetaU(after.linear() * before.linear().transpose());
    EXPECT_LT((difference / (2.0 * kStep) - truth.at(t).twist_f).norm(), 1e-7);
  }
}

TEST(PoseServo, FollowsAHookThatTravelsAndSwingsWithinATenthOfAMillimetre) {
  const Lag lag = follow(SwingingHook(), placeAt({0.0, 0.035, 0.007}), true);
  std::printf("lag with feed-forward: %.4f mm, %.5f deg\n", 1e3 * lag.translation,
              lag.rotation / kDegree);
  EXPECT_LT(lag.translation, 1e-4);
  EXPECT_LT(lag.rotation, 1e-3);
}

TEST(PoseServo, LagsByVelocityOverGainWithoutFeedForward) {
  SwingingHook steady;
  steady.swing = 0.0;
  const RingGoal goal = placeAt({0.0, 0.035, 0.007});
  // Sampled loop: e' = e - lambda T (e + v T / 2 - u T / 2) + v T settles at v / lambda.
  EXPECT_NEAR(follow(steady, goal, false).translation, steady.belt / kLambda, 1e-4);
  EXPECT_LT(follow(steady, goal, true).translation, 1e-9);
}

TEST(PoseServo, ConvergesExponentiallyOnAStraightLine) {
  PoseServo servo(constantGain(kLambda));
  HookEstimate hook = SwingingHook().at(0.3);
  hook.twist_f.setZero();
  const RingGoal goal = placeAt({0.0, 0.035, 0.075});
  const Vector3d start_d(-0.15, 0.08, 0.06);
  const Pose dMr_start = makePoseThetaU(start_d, Vector3d(0.3, -0.2, 0.5));
  Pose fMr = hook.fMo * goal.oMr * dMr_start;
  constexpr double kFine = 1e-4;  // [s]: the law itself, sampling out of sight
  for (int k = 0; k < 10000; ++k) {
    fMr = fMr * expSe3(kFine * commandOrFail(servo, fMr, hook, goal).twist_r);
    if ((k + 1) % 1000 == 0) {
      const double expected = std::exp(-kLambda * (k + 1) * kFine);
      const Pose dMr = (hook.fMo * goal.oMr).inverse() * fMr;
      EXPECT_NEAR(dMr.translation().norm() / start_d.norm(), expected, 1e-3 * expected);
      EXPECT_NEAR(thetaU(dMr.linear()).norm() / thetaU(dMr_start.linear()).norm(), expected,
                  1e-3 * expected);
      EXPECT_LT(dMr.translation().cross(start_d).norm() / start_d.norm(), 1e-5);  // off the line
    }
  }
}

TEST(PoseServo, StaysOnTheStraightLineInTheFrameOfASwingingHook) {
  PoseServo servo(constantGain(kLambda));
  const SwingingHook truth;
  const RingGoal goal = placeAt({0.0, 0.035, 0.075});
  const Vector3d start_d(-0.10, 0.02, 0.0);
  Pose fMr = truth.at(0.0).fMo * goal.oMr * makePose(start_d, Eigen::Quaterniond::Identity());
  Twist last = Twist::Zero();
  double worst = 0.0;
  for (int k = 0; k < 250; ++k) {
    const double t = k * kPeriod;
    last =
        commandOrFail(servo, fMr * expSe3(0.5 * kPeriod * last), truth.at(t + 0.5 * kPeriod), goal)
            .twist_r;
    fMr = fMr * expSe3(kPeriod * last);
    const Pose dMr = (truth.at(t + kPeriod).fMo * goal.oMr).inverse() * fMr;
    worst = std::max(worst, dMr.translation().cross(start_d).norm() / start_d.norm());
  }
  EXPECT_LT(worst, 1e-3);
}

TEST(PoseServo, CarriesTheHooksRotationToTheGoalPoint) {
  // A hook turning about its own origin: a ring on the goal must circle round that origin.
  PoseServo servo(constantGain(kLambda));
  HookEstimate hook;
  hook.fMo = makePoseThetaU(Vector3d(0.4, 0.1, 0.6), Vector3d(0.0, 0.0, 0.7));
  hook.twist_f << 0.0, 0.2, 0.0, 0.0, 0.0, 1.5;
  const RingGoal goal = placeAt({0.0, 0.035, 0.007});
  const Pose fMr = hook.fMo * goal.oMr;
  const Twist twist_r = commandOrFail(servo, fMr, hook, goal).twist_r;
  const Vector3d arm_f = fMr.translation() - hook.fMo.translation();
  const Vector3d expected_f = Vector3d(0.0, 0.2, 0.0) + Vector3d(0.0, 0.0, 1.5).cross(arm_f);
  EXPECT_TRUE((fMr.linear() * twist_r.head<3>()).isApprox(expected_f, 1e-12));
  EXPECT_TRUE((fMr.linear() * twist_r.tail<3>()).isApprox(Vector3d(0.0, 0.0, 1.5), 1e-12));
}

TEST(PoseServo, AddsThePathsOwnVelocity) {
  PoseServo servo(constantGain(kLambda));
  HookEstimate hook = SwingingHook().at(0.1);
  hook.twist_f.setZero();
  RingGoal goal = placeAt({0.0, 0.035, 0.05});
  goal.oMr.rotate(Eigen::AngleAxisd(0.4, Vector3d::UnitX()));
  goal.twist_o << 0.0, 0.0, -0.08, 0.1, 0.0, 0.0;
  const Twist twist_r = commandOrFail(servo, hook.fMo * goal.oMr, hook, goal).twist_r;
  EXPECT_TRUE((goal.oMr.linear() * twist_r.head<3>()).isApprox(goal.twist_o.head<3>(), 1e-12));
  EXPECT_TRUE((goal.oMr.linear() * twist_r.tail<3>()).isApprox(goal.twist_o.tail<3>(), 1e-12));
}

TEST(PoseServo, RaisesAnAdaptiveGainTowardsTheGoal) {
  const ServoGains gains{8.0, 2.0, 60.0};
  PoseServo servo(gains);
  HookEstimate hook;
  hook.fMo = Pose::Identity();
  hook.twist_f.setZero();
  for (const double error : {0.0, 0.01, 0.1, 0.5}) {
    const ServoCommand command =
        commandOrFail(servo, makePose({error, 0.0, 0.0}, Eigen::Quaterniond::Identity()), hook, {});
    const double lambda = 6.0 * std::exp(-60.0 / 6.0 * error) + 2.0;
    EXPECT_NEAR(command.gain_per_s, lambda, 1e-9);
    EXPECT_NEAR(command.twist_r(0), -lambda * error, 1e-9);
    EXPECT_NEAR(command.error.translation_m, error, 1e-15);
  }
}

TEST(PoseServo, RefusesInputThatIsNotFinite) {
  PoseServo servo(constantGain(kLambda));
  HookEstimate hook = SwingingHook().at(0.0);
  hook.twist_f(3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(servo.command(Pose::Identity(), hook, {}).hasValue());
  EXPECT_TRUE(servo.command(Pose::Identity(), SwingingHook().at(0.0), {}).hasValue());
}

TEST(PoseServo, RejectsGainsThatDoNotConverge) {
  EXPECT_THROW(PoseServo({0.0, 1.0, 1.0}), InputError);
  EXPECT_THROW(PoseServo({1.0, -1.0, 1.0}), InputError);
  EXPECT_THROW(PoseServo({1.0, 1.0, std::nan("")}), InputError);
}

TEST(PoseServo, SurvivesBeingMoved) {
  std::vector<PoseServo> servos;
  for (int i = 0; i < 3; ++i) {
    servos.emplace_back(constantGain(1.0 + i));
  }
  const HookEstimate hook = SwingingHook().at(0.0);
  const Pose fMr = hook.fMo * makePose({0.1, 0.0, 0.0}, Eigen::Quaterniond::Identity());
  HookEstimate still = hook;
  still.twist_f.setZero();
  for (int i = 0; i < 3; ++i) {
    const Twist twist_r =
        commandOrFail(servos[static_cast<std::size_t>(i)], fMr, still, {}).twist_r;
    EXPECT_NEAR(twist_r(0), -0.1 * (1.0 + i), 1e-12);
  }
}

}  // namespace
}  // namespace ringhook
