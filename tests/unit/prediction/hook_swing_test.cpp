// The hook followed by the swing filter: what one hook teaches about the next, neighbours, belts
// that stop, and the smoother afterwards. Truth: MuJoCo's hook below a belt.

#include "prediction/hook_swing.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>
#include <random>

#include "outcome_text.h"
#include "prediction/hook_filter.h"
#include "prediction/swing_smoother.h"
#include "sim/hook_body.h"
#include "sim/hook_world.h"

namespace ringhook {
namespace {

constexpr double kFrame = 0.02;

/// A hook of the simulated physics and fixes of it.
struct Seen {
  std::vector<HookWorldSample> truth;  ///< a frame apart
  std::mt19937 random{7};

  explicit Seen(double length_factor = 1.0, double stop_at_s = 0.0) {
    HookWorldOptions world;
    world.hook.pivot_height = 0.45 * length_factor;
    world.hook.friction = 2e-4;
    world.hook.damping = 5e-4;
    world.hook.angle[0] = 0.08;
    world.hook.rate[1] = 0.4;
    world.belt.initial_speed = 0.2;
    if (stop_at_s > 0.0) {
      world.belt.changes = {{stop_at_s, 0.0}};
    }
    truth = simulateHookWorld(world, 8.0, kFrame);
  }

  HookFix fix(int frame) {
    std::normal_distribution<double> normal;
    Twist sigma;
    sigma << Eigen::Vector3d::Constant(2e-4), Eigen::Vector3d::Constant(1e-3);
    const Twist off = sigma.cwiseProduct(Twist::NullaryExpr([&] { return normal(random); }));
    HookFix fix;
    fix.time = Time::fromSeconds(frame * kFrame);
    fix.c1Mo = truth[static_cast<std::size_t>(frame)].fMo * expSe3(off);
    fix.covariance = sigma.cwiseAbs2().asDiagonal();
    return fix;
  }

  /// Frame at which the filter is ready; -1: not within `frames`.
  int follow(HookFilter& filter, int frames) {
    int ready_at = -1;
    for (int i = 0; i < frames; ++i) {
      EXPECT_EQ(reasonOf(filter.update(fix(i))), "taken") << i;
      ready_at = ready_at < 0 && filter.ready() ? i : ready_at;
    }
    return ready_at;
  }

  /// Distance of a prediction `frames` ahead of `frame` from the truth [m].
  double miss(const HookFilter& filter, int frame, int frames) {
    const auto there = filter.predict(Time::fromSeconds((frame + frames) * kFrame));
    const Pose& fMo = truth[static_cast<std::size_t>(frame + frames)].fMo;
    return there ? (there->fMo.translation() - fMo.translation()).norm() : 1e9;
  }
};

HookFilterOptions options() {
  HookFilterOptions options;
  options.pivot_o = hookPivot(0.45);
  options.pendulum_length_m = 0.36;
  options.warm_up_s = 0.2;
  options.ready_sigma_m = 3e-4;
  return options;
}

TEST(HookSwing, PredictsTheTravellingSwingingHook) {
  Seen seen;
  HookFilter filter(options());
  seen.follow(filter, 151);
  EXPECT_LT(seen.miss(filter, 150, 2), 3e-4);
  EXPECT_LT(seen.miss(filter, 150, 15), 5e-4);
}

TEST(HookSwing, IsReadySoonerForTheNextHookOfItsKind) {
  Seen first;
  Seen second;
  HookFilter filter(options());
  const int alone = first.follow(filter, 200);
  filter.restart();
  EXPECT_FALSE(filter.ready());
  const int after = second.follow(filter, 200);
  ASSERT_GT(alone, 0);
  ASSERT_GT(after, 0);
  EXPECT_LT(after, alone);
}

TEST(HookSwing, ForgetsWhatTheNextHookContradicts) {
  Seen first;
  Seen second(1.3);  // a hook of another kind
  HookFilterOptions wide = options();
  wide.length_sigma_m = 0.1;
  wide.longer_sigma_m = 0.2;
  HookFilter filter(wide);
  first.follow(filter, 200);
  filter.restart();
  for (int i = 0; i < 200; ++i) {
    (void)filter.update(second.fix(i)).hasValue();
  }
  EXPECT_LT(second.miss(filter, 199, 15), 1e-3);
}

TEST(HookSwing, RefusesANeighbourByName) {
  Seen seen;
  HookFilter filter(options());
  seen.follow(filter, 100);
  HookFix neighbour = seen.fix(100);
  neighbour.c1Mo.translation().y() -= 0.8;
  EXPECT_EQ(reasonOf(filter.update(neighbour)), "another hook");
  EXPECT_EQ(reasonOf(filter.update(seen.fix(101))), "taken");
}

TEST(HookSwing, TellsABeltThatStopsAndPredictsAgain) {
  Seen seen(1.0, 4.0);
  HookFilter filter(options());
  bool told = false;
  for (int i = 0; i < 290; ++i) {
    (void)filter.update(seen.fix(i)).hasValue();
    told = told || filter.lastEvent() == SwingEvent::kSpeedChange;
  }
  EXPECT_TRUE(told);
  EXPECT_FALSE(filter.lost());
  EXPECT_LT(seen.miss(filter, 289, 15), 1e-3);
}

TEST(HookSwing, ABeltMayStopAlongAnyAxis) {
  Seen seen(1.0, 4.0);
  HookFilterOptions turned = options();
  turned.fMc1 = Pose(Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ()));
  turned.belt_direction_f = -Eigen::Vector3d::UnitX();
  HookFilter filter(turned);
  bool told = false;
  for (int i = 0; i < 290; ++i) {
    (void)filter.update(seen.fix(i)).hasValue();
    told = told || filter.lastEvent() == SwingEvent::kSpeedChange;
  }
  EXPECT_TRUE(told);
  const auto there = filter.predict(Time::fromSeconds((289 + 15) * kFrame));
  ASSERT_TRUE(there);
  const Pose fMo = turned.fMc1 * seen.truth[289 + 15].fMo;
  EXPECT_LT((there->fMo.translation() - fMo.translation()).norm(), 1e-3);
}

TEST(HookSwing, TakesALateFixAndRefusesItTwice) {
  Seen seen;
  HookFilter filter(options());
  seen.follow(filter, 50);
  const HookFix late = seen.fix(51);
  EXPECT_EQ(reasonOf(filter.update(seen.fix(52))), "taken");
  EXPECT_EQ(reasonOf(filter.update(late)), "taken");
  EXPECT_EQ(reasonOf(filter.update(late)), "duplicate time stamp");
}

TEST(SwingSmoother, KnowsAfterwardsWhatTheFilterCouldNot) {
  Seen seen;
  HookFilter filter(options());
  std::vector<SwingMeasurement> measurements;
  std::vector<double> filter_miss;
  for (int i = 0; i < 200; ++i) {
    const HookFix fix = seen.fix(i);
    measurements.push_back(swingMeasurement(fix, options()));
    (void)filter.update(fix).hasValue();
    filter_miss.push_back(seen.miss(filter, i, 0));
  }
  const auto smoothed = smoothSwing(measurements, swingOptions(options()), SwingMode::kSteady);
  ASSERT_TRUE(smoothed);
  double by_filter = 0.0;
  double by_smoother = 0.0;
  for (std::size_t i = 20; i < 180; ++i) {
    const Eigen::Vector3d o = swingPose((*smoothed)[i].mean, options().pivot_o).translation();
    by_filter += filter_miss[i] * filter_miss[i];
    by_smoother += (o - seen.truth[i].fMo.translation()).squaredNorm();
    EXPECT_LT((*smoothed)[i].covariance(kSwingAngle, kSwingAngle), 1e-6);
  }
  EXPECT_LT(by_smoother, 0.5 * by_filter);
  EXPECT_EQ(reasonOf(smoothSwing({}, swingOptions(options()), SwingMode::kSteady)),
            "no measurement");
}

}  // namespace
}  // namespace ringhook
