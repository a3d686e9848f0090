#include "prediction/swing_filter.h"

#include <gtest/gtest.h>

#include <set>

#include "outcome_text.h"
#include "swing_trial.h"

namespace ringhook {
namespace {

std::vector<HookWorldSample> world(const HookWorldOptions& options, double seconds) {
  return simulateHookWorld(options, seconds, kTrialFrame);
}

/// Events that the filter tells over frames [first, end), all frames given from the first on.
std::vector<SwingEvent> eventsOf(SwingFilter& filter, const std::vector<SwingMeasurement>& seen,
                                 std::size_t first, std::size_t end) {
  std::vector<SwingEvent> events;
  for (std::size_t i = first; i < end; ++i) {
    const auto update = filter.update(seen[i]);
    if (update && update->event != SwingEvent::kNone) {
      events.push_back(update->event);
    }
  }
  return events;
}

TEST(SwingFilter, LearnsAHookItNeverSawAndToldNothingOf) {
  const auto truth = world(usualHook(), 4.0);
  const auto seen = seenPoses(truth, 1);
  SwingFilter filter(swingOptions(usualKnowledge()));
  EXPECT_LT(missedAhead(filter, seen, truth, 150, 180), 3e-4);
  const SwingBelief belief = filter.state()->belief;
  EXPECT_NEAR(belief.mean(kSwingSpeed + 1), 0.2, 1e-3);
  EXPECT_LT(std::sqrt(belief.covariance(kSwingLogLength, kSwingLogLength)), 2e-3);
}

TEST(SwingFilter, LateMeasurementsEndInTheSameBelief) {
  const auto truth = world(usualHook(), 5.0);
  const auto seen = seenPoses(truth, 2);
  SwingFilterOptions options = swingOptions(usualKnowledge());
  options.batch_s = 2.0;
  SwingFilter in_order(options);
  SwingFilter shuffled(options);
  for (std::size_t i = 0; i < 240; ++i) {
    ASSERT_TRUE(in_order.update(seen[i]).hasValue()) << i;
    const bool after_start = i >= 120;
    const std::size_t third = i % 3;  // 2, 0, 1 of three
    const std::size_t other = after_start ? i - third + (third + 2) % 3 : i;
    ASSERT_TRUE(shuffled.update(seen[other]).hasValue()) << other;
  }
  const SwingFilterState a = *in_order.state();
  const SwingFilterState b = *shuffled.state();
  EXPECT_EQ(a.time, b.time);
  EXPECT_LT((a.belief.mean - b.belief.mean).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((a.belief.covariance - b.belief.covariance).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(SwingFilter, RefusesDuplicatesAndWhatIsTooLate) {
  const auto truth = world(usualHook(), 3.0);
  const auto seen = seenPoses(truth, 3);
  SwingFilter filter(swingOptions(usualKnowledge()));
  (void)eventsOf(filter, seen, 0, 100);
  const SwingFilterState before = *filter.state();
  EXPECT_EQ(reasonOf(filter.update(seen[99])), "duplicate time stamp");
  EXPECT_EQ(reasonOf(filter.update(seen[95])), "duplicate time stamp");
  EXPECT_EQ(reasonOf(filter.update(seen[10])), "too late");
  EXPECT_EQ(filter.state()->time, before.time);
  EXPECT_EQ(filter.state()->belief.mean, before.belief.mean);
}

/// What is told of the second after `frame` first, if anything; before it, nothing is told.
SwingEvent firstToldAfter(const std::vector<SwingMeasurement>& seen, std::size_t frame) {
  SwingFilter filter(swingOptions(usualKnowledge()));
  EXPECT_TRUE(eventsOf(filter, seen, 0, frame).empty());
  const auto events = eventsOf(filter, seen, frame, frame + 50);
  return events.empty() ? SwingEvent::kNone : events.front();
}

TEST(SwingFilter, ABeltStopIsToldAndSoonPredictedWell) {
  HookWorldOptions options = usualHook();
  options.belt.changes = {{4.0, 0.0}};
  const auto truth = world(options, 7.0);
  for (const unsigned seed : {4U, 5U, 6U}) {
    const auto seen = seenPoses(truth, seed);
    EXPECT_EQ(firstToldAfter(seen, 200), SwingEvent::kSpeedChange);
    // The belt takes half a second and a little to stop.
    SwingFilter filter(swingOptions(usualKnowledge()));
    EXPECT_LT(missedAhead(filter, seen, truth, 280, 330), 1e-3);
    EXPECT_NEAR(filter.state()->belief.mean(kSwingSpeed + 1), 0.0, 2e-3);
  }
}

TEST(SwingFilter, ABumpIsToldAndSoonPredictedWell) {
  HookWorldOptions options = usualHook();
  options.blows = {{4.01, {0.15, -0.2}}};
  const auto truth = world(options, 6.0);
  for (const unsigned seed : {7U, 8U, 9U}) {
    const auto seen = seenPoses(truth, seed);
    EXPECT_EQ(firstToldAfter(seen, 201), SwingEvent::kBump);
    SwingFilter filter(swingOptions(usualKnowledge()));
    EXPECT_LT(missedAhead(filter, seen, truth, 250, 280), 1e-3);
  }
}

TEST(SwingFilter, ASingleOutlierIsRefusedAndNoEvent) {
  const auto truth = world(usualHook(), 5.0);
  auto seen = seenPoses(truth, 10);
  const std::set<std::size_t> wild = {175, 190, 205, 220};
  for (const std::size_t i : wild) {
    seen[i].fMo.translation() += Eigen::Vector3d(0.02, -0.01, 0.03);
  }
  SwingFilter filter(swingOptions(usualKnowledge()));
  for (std::size_t i = 0; i < 235; ++i) {
    const auto update = filter.update(seen[i]);
    EXPECT_EQ(update.hasValue(), !wild.contains(i)) << i;
    EXPECT_TRUE(!update || update->event == SwingEvent::kNone) << i;
  }
  EXPECT_EQ(filter.mode(), SwingMode::kSteady);
}

}  // namespace
}  // namespace ringhook
