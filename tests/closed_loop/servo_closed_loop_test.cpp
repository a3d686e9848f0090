// The operator's job from cell file to verdict, judged by physics that the loop knows nothing of.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>

#include "../support/scratch_folder.h"
#include "camera/sequence.h"
#include "evaluation/servo_run.h"
#include "evaluation/servo_summary.h"

namespace ringhook {
namespace {

using ::testing::IsEmpty;

class ServoClosedLoop : public ::testing::Test {
 protected:
  [[nodiscard]] ServoJob oneHook(TrackerKind tracker, std::uint64_t seed) const {
    ServoJob job;
    job.cell_file = RINGHOOK_SOURCE_DIR "/app/config/cell-sim.yaml";
    job.tracker = tracker;
    job.cycles = 1;
    job.seed = seed;
    job.out = scratch_.path();
    return job;
  }

  static ServoReport run(const ServoJob& job) {
    const std::atomic<bool> never{false};
    return runServo(
        job, never, [](int, TaskPhase, double) {}, [](int, const ServoAttempt&) {});
  }

  /// The ring hangs, and nothing on the way was rough.
  static void expectHung(const ServoReport& report) {
    ASSERT_EQ(report.attempts.size(), 1U);
    const ServoAttempt& attempt = report.attempts.front();
    std::printf("insertion error %.3f mm, contact %.2f N, limited %d\n",
                1e3 * attempt.truth->insertion_error_m.max(), attempt.truth->peak_contact_n,
                report.statistics.limited_commands);
    EXPECT_TRUE(attempt.loop.released) << attempt.loop.abort_reason;
    EXPECT_TRUE(attempt.truth->hanging);
    EXPECT_GT(attempt.truth->insertion_error_m.count(), 100U);
    EXPECT_LT(attempt.truth->insertion_error_m.max(), 3e-3);
    EXPECT_LE(attempt.truth->peak_contact_n, 5.0);
    EXPECT_EQ(report.statistics.limit_violations, 0);
    EXPECT_FALSE(report.interrupted);
    EXPECT_EQ(ringsHung(report), 1);
  }

  ScratchFolder scratch_;
};

TEST_F(ServoClosedLoop, MarkerHangsARingAndTheSameSeedSaysTheSameBytes) {
  const ServoJob job = oneHook(TrackerKind::kMarker, 1);
  const ServoReport first = run(job);
  expectHung(first);
  EXPECT_TRUE(std::filesystem::exists(scratch_.path() / "hanging.png"));
  // The recorded cycle is whole: frames and their truth.
  const Sequence sequence = openSequence(first.sequence);
  EXPECT_GT(sequence.frames.size(), 100U);
  EXPECT_GT(sequence.c1Mo_truth.size(), 100U);
  EXPECT_EQ(servoSummaryJson(job, first), servoSummaryJson(job, run(job)));
}

TEST_F(ServoClosedLoop, EdgesHangARing) {
  const ServoReport report = run(oneHook(TrackerKind::kEdges, 1));
  expectHung(report);
  EXPECT_LT(report.statistics.fix_error_m.mean(), 1e-3);
}

TEST_F(ServoClosedLoop, HangsARingThroughTheRx60sProtocolToo) {
  ServoJob job = oneHook(TrackerKind::kMarker, 1);
  job.arm_link = ArmLink::kRx60;
  expectHung(run(job));
}

// Each seed draws hooks of another length, damping and phase, and other errors of arm and cameras.
class ServoSeeds : public ServoClosedLoop, public ::testing::WithParamInterface<std::uint64_t> {};

TEST_P(ServoSeeds, HangARing) {
  const ServoReport report = run(oneHook(TrackerKind::kMarker, GetParam()));
  expectHung(report);
  EXPECT_LT(report.statistics.fix_error_m.mean(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Easy, ServoSeeds, ::testing::Values(2U, 3U, 5U));

TEST_F(ServoClosedLoop, InterruptionWhileTheHookIsApproachedKeepsWhatWasRecorded) {
  const ServoJob job = oneHook(TrackerKind::kMarker, 1);
  std::atomic<bool> stop{false};
  int approaching = 0;  // states
  bool moved_on = false;
  const auto progress = [&](int, TaskPhase phase, double) {
    // A fifth of a second into the approach; nothing may be told after that.
    moved_on = moved_on || stop.load();
    approaching += phase == TaskPhase::kApproach ? 1 : 0;
    stop = approaching >= 50;
  };
  const ServoReport report = runServo(job, stop, progress, [](int, const ServoAttempt&) {});
  EXPECT_TRUE(report.interrupted);
  EXPECT_FALSE(moved_on) << "no state was answered after the operator's stop";
  EXPECT_EQ(approaching, 50);
  EXPECT_THAT(report.attempts, IsEmpty());
  const Sequence sequence = openSequence(report.sequence);
  EXPECT_GT(sequence.frames.size(), 50U);
  EXPECT_TRUE(sequence.rig.has_value() || !sequence.rig_file.empty());
}

}  // namespace
}  // namespace ringhook
