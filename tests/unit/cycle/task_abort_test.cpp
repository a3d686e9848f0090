#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cycle/task_control.h"
#include "default_cell.h"
#include "task_bench.h"

namespace ringhook {
namespace {

using test::MovingHook;
using test::Sight;
using test::TaskBench;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

/// True if the gripper was never told to open.
bool keptTheRing(const TaskBench& bench) {
  return std::none_of(bench.orders.begin(), bench.orders.end(),
                      [](const test::GripperOrder& order) { return !order.close; });
}

/// Steps half a lowering and tells how high the ring is over the hook.
double lowerHalfway(TaskBench& bench) {
  EXPECT_TRUE(bench.runTo(TaskPhase::kLower)) << bench.task.result().abort_reason;
  const double middle =
      0.5 * (bench.cell.task.tip_o.z() + bench.cell.task.hover_m + bench.cell.task.release_o.z());
  while (bench.task.phase() == TaskPhase::kLower && bench.ring_o().translation().z() > middle) {
    bench.step();
  }
  EXPECT_EQ(bench.task.phase(), TaskPhase::kLower);
  return bench.ring_o().translation().z();
}

TEST(TaskAbort, StaleEstimateWhileLoweringIsNamedAndTheRingRisesAway) {
  TaskBench bench(test::defaultCell(), MovingHook{});
  lowerHalfway(bench);
  const double frozen = bench.seconds();
  ASSERT_TRUE(bench.runTo(TaskPhase::kBackOff, Sight::kFrozen));
  EXPECT_NEAR(bench.seconds() - frozen, bench.cell.vision.stale_after_s, 0.025);
  const double height = bench.ring_o().translation().z();
  double lowest = height;
  double least_side = 1.0;  // of the ring from the hook's plane, once it is below the hover point
  while (!bench.task.finished()) {
    bench.step(Sight::kFrozen);
    const Eigen::Vector3d ring_o = bench.ring_o().translation();
    lowest = std::min(lowest, ring_o.z());
    least_side = std::min(least_side, ring_o.x());
  }
  const AttemptResult& result = bench.task.result();
  EXPECT_EQ(result.abort_reason, "hook's estimate stale");
  EXPECT_FALSE(result.released);
  EXPECT_TRUE(keptTheRing(bench));
  EXPECT_GT(lowest, height - 0.004) << "it may only coast down";
  EXPECT_GT(bench.ring_o().translation().z(),
            bench.cell.task.tip_o.z() + 0.8 * bench.cell.task.hover_m);
  EXPECT_LT(least_side, -0.05) << "and leave beside the hook";
  EXPECT_THAT(bench.broken_limits, IsEmpty());
}

TEST(TaskAbort, StaleEstimateThatIsFreshAgainIsTriedOnceMoreOnTheSameHook) {
  TaskBench bench(test::defaultCell(), MovingHook{});
  lowerHalfway(bench);
  ASSERT_TRUE(bench.runTo(TaskPhase::kBackOff, Sight::kFrozen));
  bench.phases.clear();
  ASSERT_TRUE(bench.finish());
  const AttemptResult& result = bench.task.result();
  EXPECT_TRUE(result.released) << result.abort_reason;
  EXPECT_THAT(result.abort_reason, IsEmpty());
  EXPECT_EQ(result.tries, 2);
  EXPECT_THAT(bench.phases, ElementsAre(TaskPhase::kBackOff, TaskPhase::kWait, TaskPhase::kApproach,
                                        TaskPhase::kAlign, TaskPhase::kLower, TaskPhase::kRelease,
                                        TaskPhase::kRetreat, TaskPhase::kWatch));
  ASSERT_EQ(bench.orders.size(), 2U) << "closed once, opened once";
  EXPECT_LT((bench.orders[1].oMr.translation() - bench.cell.task.release_o).norm(), 1e-3);
  EXPECT_THAT(bench.broken_limits, IsEmpty());
}

TEST(TaskAbort, HookThatLeavesTheWindowMeanwhileIsNotTriedAgain) {
  CellConfig cell = test::defaultCell();
  cell.belt.pick_to_m = 0.0;  // enough for one try at 0.05 m/s, not for two
  TaskBench bench(cell, MovingHook{});
  lowerHalfway(bench);
  ASSERT_TRUE(bench.runTo(TaskPhase::kBackOff, Sight::kFrozen));
  ASSERT_TRUE(bench.finish());
  EXPECT_FALSE(bench.task.result().released);
  EXPECT_EQ(bench.task.result().abort_reason, "hook's estimate stale");
  EXPECT_EQ(bench.task.result().tries, 1);
  EXPECT_TRUE(keptTheRing(bench));
}

TEST(TaskAbort, HookThatIsLostAfterAStaleEstimateEndsTheAttempt) {
  TaskBench bench(test::defaultCell(), MovingHook{});
  lowerHalfway(bench);
  ASSERT_TRUE(bench.runTo(TaskPhase::kBackOff, Sight::kFrozen));
  ASSERT_TRUE(bench.runTo(TaskPhase::kWait));
  ASSERT_TRUE(bench.finish(Sight::kNothing));
  EXPECT_EQ(bench.task.result().abort_reason, "hook's estimate stale");
  EXPECT_THAT(bench.phases, Not(Contains(TaskPhase::kRelease)));
}

TEST(TaskAbort, HookLostWhileLoweringIsNamedAtOnce) {
  TaskBench bench(test::defaultCell(), MovingHook{});
  lowerHalfway(bench);
  bench.step(Sight::kNothing);
  EXPECT_EQ(bench.task.phase(), TaskPhase::kBackOff);
  ASSERT_TRUE(bench.finish(Sight::kNothing));
  EXPECT_EQ(bench.task.result().abort_reason, "hook lost");
  EXPECT_TRUE(keptTheRing(bench));
  EXPECT_THAT(bench.broken_limits, IsEmpty());
}

TEST(TaskAbort, RingOffItsPathIsNotLoweredFurther) {
  CellConfig cell = test::defaultCell();
  cell.task.abort_tolerance_m = 1e-9;
  TaskBench bench(cell, MovingHook{});
  ASSERT_TRUE(bench.finish());
  EXPECT_EQ(bench.task.result().abort_reason, "ring off its path while lowering");
  EXPECT_EQ(bench.task.result().tries, 2) << "and then it is given up";
  EXPECT_TRUE(keptTheRing(bench));
}

TEST(TaskAbort, RingThatCannotBeAlignedIsNotLowered) {
  CellConfig cell = test::defaultCell();
  cell.task.align_tolerance_m = 1e-6;
  cell.task.align_timeout_s = 0.5;
  TaskBench bench(cell, MovingHook{});
  ASSERT_TRUE(bench.finish());
  EXPECT_EQ(bench.task.result().abort_reason, "ring could not be aligned in time");
  EXPECT_THAT(bench.phases, Not(Contains(TaskPhase::kLower)));
  EXPECT_TRUE(keptTheRing(bench));
}

TEST(TaskAbort, HookThatComesTooLateIsRefusedWithoutAnApproach) {
  // 0.15 m from the end of the window at 0.05 m/s: three seconds are not enough.
  TaskBench bench(test::defaultCell(), MovingHook{0.15, 0.05, 0.05});
  ASSERT_TRUE(bench.finish());
  EXPECT_EQ(bench.task.result().abort_reason, "hook came too late for the arm's window");
  EXPECT_THAT(bench.phases, Not(Contains(TaskPhase::kApproach)));
  EXPECT_FALSE(bench.task.result().met);
  EXPECT_TRUE(keptTheRing(bench));
}

TEST(TaskAbort, NoHookIsSaidOnceTheTimeIsUp) {
  CellConfig cell = test::defaultCell();
  cell.task.hook_timeout_s = 2.0;
  TaskBench bench(cell, MovingHook{});
  ASSERT_TRUE(bench.runTo(TaskPhase::kWait, Sight::kNothing));
  const double waiting_since = bench.seconds();
  ASSERT_TRUE(bench.runTo(TaskPhase::kBackOff, Sight::kNothing));
  EXPECT_NEAR(bench.seconds() - waiting_since, 2.0, 3 * kArmPeriod);
  ASSERT_TRUE(bench.finish(Sight::kNothing));
  EXPECT_EQ(bench.task.result().abort_reason, "no hook came");
  EXPECT_FALSE(bench.task.result().released);
}

TEST(TaskAbort, RingStillHeldIsKeptForTheNextAttempt) {
  CellConfig cell = test::defaultCell();
  cell.task.hook_timeout_s = 10.0;
  TaskBench bench(cell, MovingHook{});
  ASSERT_TRUE(bench.finish(Sight::kNothing));
  ASSERT_EQ(bench.orders.size(), 1U);
  // The next hook is where the first one was, as far ahead.
  bench.hook.travel_m -= bench.hook.speed_m_s * bench.seconds();
  bench.phases.clear();
  bench.task.startAttempt();
  EXPECT_FALSE(bench.task.finished());
  EXPECT_THAT(bench.task.result().abort_reason, IsEmpty());
  ASSERT_TRUE(bench.finish());
  EXPECT_EQ(bench.phases.front(), TaskPhase::kStandby);
  EXPECT_TRUE(bench.task.result().released) << bench.task.result().abort_reason;
  ASSERT_EQ(bench.orders.size(), 2U);
  EXPECT_FALSE(bench.orders.back().close);
  // Now that it is gone, the third attempt fetches another.
  bench.task.startAttempt();
  ASSERT_TRUE(bench.runTo(TaskPhase::kGrip, Sight::kNothing));
}

}  // namespace
}  // namespace ringhook
