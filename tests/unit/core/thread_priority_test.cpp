// How far a thread may be raised depends on the rights of whoever runs the tests; what is told must
// be what the kernel says, whatever that is.

#include "core/thread_priority.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>

#include <thread>

namespace ringhook {
namespace {

/// Runs on a thread of its own, so that the others keep their priority.
template <class Work>
void apart(Work work) {
  std::thread(work).join();
}

/// Policy and nice value of the calling thread, as the kernel has them.
struct InForce {
  int policy = sched_getscheduler(0) & ~SCHED_RESET_ON_FORK;
  int nice = getpriority(PRIO_PROCESS, 0);
  bool operator==(const InForce&) const = default;
};

TEST(RaisedPriority, TellsWhatIsInForce) {
  apart([] {
    const InForce before;
    const RaisedPriority raised(kLinkRank);
    const InForce now;
    EXPECT_EQ(raised.reached() == ThreadPriority::kRealTime, now.policy == SCHED_FIFO);
    EXPECT_EQ(raised.reached() == ThreadPriority::kNice, now.nice < before.nice);
    EXPECT_EQ(raised.reached() == ThreadPriority::kOrdinary, now == before);
  });
}

TEST(RaisedPriority, HasTheRankAskedFor) {
  apart([] {
    const RaisedPriority raised(kCameraRank);
    if (raised.reached() != ThreadPriority::kRealTime) {
      GTEST_SKIP() << "real-time priority is not permitted here";
    }
    sched_param parameters{};
    ASSERT_EQ(sched_getparam(0, &parameters), 0);
    EXPECT_EQ(parameters.sched_priority, kCameraRank);
  });
}

TEST(RaisedPriority, IsNotInheritedAsRealTime) {
  apart([] {
    const RaisedPriority raised(kLinkRank);
    apart([] { EXPECT_NE(InForce().policy, SCHED_FIFO); });
  });
}

TEST(RaisedPriority, EndsWithItsScope) {
  apart([] {
    const InForce before;
    { const RaisedPriority raised(kLinkRank); }
    EXPECT_EQ(InForce(), before);
  });
}

TEST(RaisedPriority, CanBeGivenBackBefore) {
  apart([] {
    const InForce before;
    RaisedPriority raised(kLinkRank);
    raised.giveBack();
    EXPECT_EQ(InForce(), before);
    EXPECT_EQ(raised.reached(), ThreadPriority::kOrdinary);
  });
}

TEST(RaisedPriority, LeavesOtherThreadsAlone) {
  const InForce before;
  apart([] { const RaisedPriority raised(kLinkRank); });
  EXPECT_EQ(InForce(), before);
}

}  // namespace
}  // namespace ringhook
