#include "cycle/task_control.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "default_cell.h"
#include "task_bench.h"

namespace ringhook {
namespace {

using test::MovingHook;
using test::Sight;
using test::TaskBench;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(TaskControl, PhasesHaveTheirNames) {
  EXPECT_STREQ(phaseName(TaskPhase::kLoad), "load");
  EXPECT_STREQ(phaseName(TaskPhase::kLower), "lower");
  EXPECT_STREQ(phaseName(TaskPhase::kBackOff), "back off");
  EXPECT_STREQ(phaseName(TaskPhase::kDone), "done");
}

TEST(TaskControl, LetsTheRingGoWithinAMillimetreOfItsPlaceOnTheTrueHook) {
  TaskBench bench(test::defaultCell(), MovingHook{});
  ASSERT_TRUE(bench.finish());
  const AttemptResult& result = bench.task.result();
  EXPECT_TRUE(result.released) << result.abort_reason;
  EXPECT_THAT(result.abort_reason, IsEmpty());
  EXPECT_EQ(bench.refused_fixes, 0);
  ASSERT_EQ(bench.orders.size(), 2U);
  const Pose oMr = bench.orders[1].oMr;
  const double miss = (oMr.translation() - bench.cell.task.release_o).norm();
  RecordProperty("miss_um", static_cast<int>(1e6 * miss));
  RecordProperty("worst_hold_um", static_cast<int>(1e6 * bench.worst_hold_m));
  EXPECT_LT(miss, 1e-3);
  EXPECT_LT(bench.worst_hold_m, 1e-3);
  EXPECT_LT(thetaU(oMr.linear()).norm(), 0.02);
  EXPECT_LT(result.tracking_error_m.max(), 1e-3);
}

TEST(TaskControl, GoesThroughItsPhasesInOrder) {
  TaskBench bench(test::defaultCell(), MovingHook{});
  ASSERT_TRUE(bench.finish());
  EXPECT_THAT(bench.phases,
              ElementsAre(TaskPhase::kLoad, TaskPhase::kGrip, TaskPhase::kStandby, TaskPhase::kWait,
                          TaskPhase::kApproach, TaskPhase::kAlign, TaskPhase::kLower,
                          TaskPhase::kRelease, TaskPhase::kRetreat, TaskPhase::kWatch));
}

TEST(TaskControl, OrdersTheGripperTwiceCloseThenOpen) {
  TaskBench bench(test::defaultCell(), MovingHook{});
  ASSERT_TRUE(bench.finish());
  ASSERT_EQ(bench.orders.size(), 2U);
  EXPECT_TRUE(bench.orders[0].close);
  EXPECT_EQ(bench.orders[0].phase, TaskPhase::kGrip);
  EXPECT_FALSE(bench.orders[1].close);
  EXPECT_EQ(bench.orders[1].phase, TaskPhase::kLower);
}

TEST(TaskControl, NoCommandBreaksTheArmsLimits) {
  for (const double swing : {0.0, 0.05, 0.087}) {
    TaskBench bench(test::defaultCell(), MovingHook{-0.5, 0.05, swing});
    ASSERT_TRUE(bench.finish());
    EXPECT_GT(bench.commands, 1000);
    EXPECT_THAT(bench.broken_limits, IsEmpty()) << "swing " << swing;
  }
}

TEST(TaskControl, LeavesOnlyAfterTheGripperHadItsTime) {
  const CellConfig cell = test::defaultCell();
  TaskBench bench(cell, MovingHook{});
  ASSERT_TRUE(bench.runTo(TaskPhase::kRelease));
  const double opened = bench.seconds();
  ASSERT_TRUE(bench.runTo(TaskPhase::kRetreat));
  EXPECT_GE(bench.seconds() - opened, cell.arm.gripper_time_s - 1e-9);
}

TEST(TaskControl, MeetsNoHookBeforeThePickWindow) {
  const CellConfig cell = test::defaultCell();
  // Seen from the start, but 0.37 m ahead of the window: more than seven seconds of travel.
  TaskBench bench(cell, MovingHook{-0.70, 0.05, 0.05});
  ASSERT_TRUE(bench.runTo(TaskPhase::kApproach));
  ASSERT_TRUE(bench.task.result().met);
  const double travel = -0.70 + 0.05 * bench.task.result().met->seconds();
  EXPECT_GE(travel, cell.belt.pick_from_m - 1e-3);
  EXPECT_LT(travel, cell.belt.pick_from_m + 5e-3);
}

TEST(TaskControl, WatchesTheRingForTheTimeAskedFor) {
  TaskBench bench(test::defaultCell(), MovingHook{});
  ASSERT_TRUE(bench.finish());
  const AttemptResult& result = bench.task.result();
  ASSERT_TRUE(result.released_at);
  EXPECT_NEAR(result.ended - *result.released_at, bench.cell.task.watch_s, 2 * kArmPeriod);
}

TEST(TaskControl, HookLostAfterTheReleaseAbortsNothing) {
  TaskBench bench(test::defaultCell(), MovingHook{});
  ASSERT_TRUE(bench.runTo(TaskPhase::kRelease));
  ASSERT_TRUE(bench.runTo(TaskPhase::kWatch, Sight::kNothing));
  EXPECT_LT(bench.worst_hold_m, 3e-3) << "half a second by the last estimate";
  // The gripper has left the hook all the same.
  const Eigen::Vector3d gone = bench.ring_o().translation() - bench.cell.task.release_o;
  EXPECT_LT(gone.x(), 0.8 * bench.cell.task.retreat_o.x());
  ASSERT_TRUE(bench.finish(Sight::kNothing));
  EXPECT_TRUE(bench.task.result().released);
  EXPECT_THAT(bench.task.result().abort_reason, IsEmpty());
}

}  // namespace
}  // namespace ringhook
