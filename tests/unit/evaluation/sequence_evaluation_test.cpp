#include "evaluation/sequence_evaluation.h"

#include <gmock/gmock.h>

#include <cmath>
#include <deque>

#include "core/error.h"
#include "evaluation/sequence_summary.h"

namespace ringhook {
namespace {

constexpr double kPeriod = 0.1;  // [s]

StereoRig tinyRig() {
  StereoRig rig;
  rig.left.width = 32;
  rig.left.height = 24;
  rig.left.K << 30, 0, 16, 0, 30, 12, 0, 0, 1;
  return rig;
}

/// `count` grey frames, kPeriod apart.
class FakeCamera : public StereoCamera {
 public:
  explicit FakeCamera(int count) : count_(count) {}
  [[nodiscard]] Window fullImage() const override { return {0, 0, 32, 24}; }
  void setWindows(const Window&, const Window&) override {}
  void setFrameRate(double) override {}
  [[nodiscard]] std::optional<StereoFrame> grab(double) override {
    StereoFrame frame;
    frame.index = static_cast<std::uint64_t>(next_);
    frame.time = Time::fromSeconds(kPeriod * next_++);
    frame.left = GrayImage(32, 24, 90);
    frame.left_window = fullImage();
    return frame;
  }
  [[nodiscard]] bool finished() const override { return next_ >= count_; }

 private:
  int count_;
  int next_ = 0;
};

/// The hook's true place: it moves along x at 1 m/s.
Pose poseNumber(int frame) { return makePoseThetaU({kPeriod * frame, 0, 1}, {0, 0, 0}); }

/// Sees the truth, except in the calls that it is told to fail; remembers its predictions.
class FakeTracker : public HookTracker {
 public:
  explicit FakeTracker(std::deque<bool> sees, double error = 0.0)
      : sees_(std::move(sees)), error_(error) {}
  [[nodiscard]] Outcome<HookView> track(const RectifiedFrame& frame,
                                        const std::optional<Pose>& predicted) override {
    predictions.push_back(predicted);
    const bool seen = sees_.empty() || sees_.front();
    if (!sees_.empty()) {
      sees_.pop_front();
    }
    if (!seen) {
      return Refusal{"hidden, by a passer-by"};
    }
    HookView view;
    view.time = frame.time;
    view.c1Mo_start = poseNumber(static_cast<int>(std::lround(frame.time.seconds() / kPeriod)));
    view.c1Mo_start.translation().y() += error_;
    return view;
  }
  std::vector<std::optional<Pose>> predictions;

 private:
  std::deque<bool> sees_;
  double error_;
};

Outcome<HookFix> startAsFix(const HookView& view) {
  HookFix fix;
  fix.time = view.time;
  fix.c1Mo = view.c1Mo_start;
  fix.covariance.setZero();
  return fix;
}

/// Runs `tracker` over `count` frames; every look at the clock costs a millisecond.
MethodRun runFake(std::unique_ptr<FakeTracker> tracker, int count, bool needs_start,
                  std::size_t stop_after = 1000) {
  FakeCamera camera(count);
  std::vector<EvaluationMethod> methods(1);
  methods[0].name = "fake";
  methods[0].tracker = std::move(tracker);
  methods[0].fix = startAsFix;
  methods[0].needs_start = needs_start;
  SequenceRunOptions options;
  options.c1Mo_start = poseNumber(0);
  for (int i = 0; i < count; ++i) {
    options.c1Mo_truth.push_back({Time::fromSeconds(kPeriod * i), poseNumber(i)});
  }
  double seconds = 0.0;
  options.clock_s = [&seconds] { return seconds += 1e-3; };
  options.proceed = [stop_after](std::size_t done) { return done < stop_after; };
  auto runs = runSequence(camera, Rectifier(tinyRig()), methods, options);
  return std::move(runs.at(0));
}

TEST(SequenceEvaluation, CountsLossesAndReacquisitions) {
  // Not yet seen, seen, lost, seen, seen, lost: the first frame is no loss, the second no return.
  const auto run = runFake(
      std::make_unique<FakeTracker>(std::deque<bool>{false, true, false, true, true, false}), 6,
      false);
  const SequenceSummary summary = summarise(run, 5.0);
  EXPECT_EQ(summary.frames, 6U);
  EXPECT_EQ(summary.frames_tracked, 3U);
  EXPECT_EQ(summary.losses, 2U);
  EXPECT_EQ(summary.reacquisitions, 1U);
  EXPECT_EQ(summary.false_poses, 0U);
  EXPECT_EQ(run.frames[2].reason, "hidden, by a passer-by");
}

TEST(SequenceEvaluation, PredictsWithConstantVelocity) {
  auto tracker = std::make_unique<FakeTracker>(std::deque<bool>{});
  const FakeTracker& seen = *tracker;
  FakeCamera camera(4);
  std::vector<EvaluationMethod> methods(1);
  methods[0].tracker = std::move(tracker);
  methods[0].fix = startAsFix;
  SequenceRunOptions options;
  options.c1Mo_start = poseNumber(0);
  options.clock_s = [] { return 0.0; };
  options.proceed = [](std::size_t) { return true; };
  (void)runSequence(camera, Rectifier(tinyRig()), methods, options);
  ASSERT_EQ(seen.predictions.size(), 4U);
  EXPECT_NEAR(seen.predictions[0]->translation().x(), 0.0, 1e-12);
  EXPECT_NEAR(seen.predictions[1]->translation().x(), 0.0, 1e-12);
  EXPECT_NEAR(seen.predictions[2]->translation().x(), 0.2, 1e-12);
  EXPECT_NEAR(seen.predictions[3]->translation().x(), 0.3, 1e-12);
}

TEST(SequenceEvaluation, TriesALostStartOnceAgainFromTheLastPose) {
  // The third frame's prediction fails; the second attempt in the same frame succeeds.
  const auto run = runFake(
      std::make_unique<FakeTracker>(std::deque<bool>{true, true, false, true, true}), 4, true);
  EXPECT_EQ(summarise(run, 5.0).frames_tracked, 4U);
  EXPECT_EQ(summarise(run, 5.0).losses, 0U);
}

TEST(SequenceEvaluation, CountsPosesBeyondTheGate) {
  const auto run = runFake(std::make_unique<FakeTracker>(std::deque<bool>{}, 0.006), 3, false);
  EXPECT_EQ(summarise(run, 5.0).false_poses, 3U);
  EXPECT_EQ(summarise(run, 7.0).false_poses, 0U);
  EXPECT_NEAR(summarise(run, 7.0).position_error_mm->mean, 6.0, 1e-9);
}

TEST(SequenceEvaluation, TimesTheStagesWithTheGivenClock) {
  const auto run = runFake(std::make_unique<FakeTracker>(std::deque<bool>{}), 3, false);
  const auto stages = summarise(run, 5.0).stages;
  for (const auto* stage : {"read", "rectify", "track", "fix"}) {
    EXPECT_NEAR(stages.at(stage).p95_ms, 1.0, 1e-9) << stage;
  }
}

TEST(SequenceEvaluation, EndsWhenToldAndKeepsWhatItHas) {
  const auto run = runFake(std::make_unique<FakeTracker>(std::deque<bool>{}), 9, false, 4);
  EXPECT_EQ(run.frames.size(), 4U);
}

TEST(SequenceEvaluation, RefusesAMissingStart) {
  FakeCamera camera(2);
  std::vector<EvaluationMethod> methods(1);
  methods[0].name = "edges";
  methods[0].needs_start = true;
  EXPECT_THROW((void)runSequence(camera, Rectifier(tinyRig()), methods, {}), InputError);
}

TEST(ConstantVelocity, ATurningBodyKeepsTurning) {
  const Time t0 = Time::fromSeconds(0.0);
  const Twist motion = (Twist() << 0.1, 0, 0.02, 0, 0.3, 0.1).finished();
  const Pose a = makePoseThetaU({0.2, 0.1, 1.0}, {0.5, 0, 0});
  const Pose b = a * expSe3(motion);
  const Pose predicted = predictConstantVelocity({t0, a}, {t0 + 0.1, b}, t0 + 0.15);
  EXPECT_TRUE(predicted.isApprox(a * expSe3(1.5 * motion), 1e-9));
}

}  // namespace
}  // namespace ringhook
