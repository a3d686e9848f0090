#include "cycle/servo_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <exception>
#include <string>
#include <vector>

#include "core/error.h"
#include "default_cell.h"

namespace ringhook {
namespace {

using ::testing::ElementsAre;

/// What the devices and the observer were asked, in order; where it bites, and with what.
struct Script {
  std::string biting_call;   ///< throws when it is reached
  std::exception_ptr teeth;  ///< what it throws
  std::vector<std::string> calls;

  void reach(const std::string& call) {
    calls.push_back(call);
    if (call == biting_call) {
      std::rethrow_exception(teeth);
    }
  }
};

/// Stands where rings are loaded and never moves.
class FakeArm : public Arm {
 public:
  FakeArm(Script& script, const JointVector& position) : script_(script) {
    state_.position = position;
    state_.velocity.setZero();
    state_.motion_possible = true;
  }
  ArmState waitState() override {
    script_.reach("waitState");
    if (stop_flag != nullptr && ++waited_ == 3) {
      stop_flag->store(true);
    }
    state_.motion_possible = motion_possible;
    state_.time = state_.time + kArmPeriod;
    return state_;
  }
  void commandVelocity(const JointVector&) override { script_.reach("commandVelocity"); }
  void stop() noexcept override { script_.calls.push_back("stop"); }
  void rearm() override { script_.reach("rearm"); }
  [[nodiscard]] double commandDelay() const override { return 0.0; }
  void setGripper(bool) override { script_.reach("setGripper"); }

  bool motion_possible = true;
  std::atomic<bool>* stop_flag = nullptr;  ///< set in the third state

 private:
  Script& script_;
  ArmState state_;
  int waited_ = 0;
};

/// Shows one dark frame per state.
class FakeCamera : public StereoCamera {
 public:
  explicit FakeCamera(Script& script) : script_(script) {}
  [[nodiscard]] Window fullImage() const override { return {0, 0, 256, 256}; }
  void setWindows(const Window&, const Window&) override { script_.reach("setWindows"); }
  void setFrameRate(double) override { script_.reach("setFrameRate"); }
  std::optional<StereoFrame> grab(double) override {
    script_.reach("grab");
    waiting_ = !waiting_;
    if (!waiting_) {
      return std::nullopt;
    }
    StereoFrame frame;
    frame.time = Time::fromSeconds(1e-3 * static_cast<double>(++index_));
    frame.left_window = frame.right_window = {90, 90, 64, 64};
    frame.left = frame.right = GrayImage(64, 64, 20);
    return frame;
  }
  [[nodiscard]] bool finished() const override { return false; }

 private:
  Script& script_;
  bool waiting_ = false;
  int index_ = 0;
};

class FakeObserver : public LoopObserver {
 public:
  explicit FakeObserver(Script& script) : script_(script) {}
  void onFrame(const StereoFrame&, const VisionReport&, double) override {
    script_.reach("onFrame");
  }
  void onCommand(const ArmState&, const TaskCommand&) override { script_.reach("onCommand"); }

 private:
  Script& script_;
};

/// The loop of the default cell on fake devices.
class LoopBench {
 public:
  LoopBench()
      : arm(script, test::defaultCell().arm.load_rad),
        cell_(test::defaultCell()),
        vision_(cell_, test::coarseRig(cell_), TrackerKind::kMarker),
        task_(cell_, rx60::rx60()),
        camera_(script),
        observer_(script) {}

  /// Runs until something leaves; null if nothing does.
  std::exception_ptr run() {
    try {
      VisionInTurn vision(camera_, vision_, observer_);
      (void)runAttempt(vision, arm, task_, observer_, stop);
    } catch (...) {
      return std::current_exception();
    }
    return nullptr;
  }

  Script script;
  std::atomic<bool> stop{false};
  FakeArm arm;

 private:
  CellConfig cell_;
  VisionStep vision_;
  TaskControl task_;
  FakeCamera camera_;
  FakeObserver observer_;
};

std::ptrdiff_t count(const std::vector<std::string>& calls, const std::string& call) {
  return std::count(calls.begin(), calls.end(), call);
}

struct NoStdException {
  int value;
};

class BitingCall : public ::testing::TestWithParam<std::string> {};

/// The arm is stopped after the bite, nothing is asked of anybody afterwards, and what leaves is
/// the very object that was thrown.
void expectStoppedBefore(const std::string& call, const std::exception_ptr& teeth) {
  LoopBench bench;
  bench.script.biting_call = call;
  bench.script.teeth = teeth;
  EXPECT_EQ(bench.run(), teeth);
  const std::vector<std::string>& calls = bench.script.calls;
  ASSERT_GE(calls.size(), 2U);
  EXPECT_EQ(calls.back(), "stop");
  EXPECT_EQ(calls[calls.size() - 2], call);
  EXPECT_EQ(count(calls, "stop"), 1);
}

TEST_P(BitingCall, StopsTheArmBeforeAnErrorLeaves) {
  expectStoppedBefore(GetParam(), std::make_exception_ptr(DeviceError("link lost")));
}

TEST_P(BitingCall, StopsTheArmBeforeAStandardExceptionLeaves) {
  expectStoppedBefore(GetParam(), std::make_exception_ptr(std::out_of_range("index 7")));
}

TEST_P(BitingCall, StopsTheArmBeforeAnythingElseLeaves) {
  expectStoppedBefore(GetParam(), std::make_exception_ptr(NoStdException{7}));
}

INSTANTIATE_TEST_SUITE_P(ServoLoop, BitingCall,
                         ::testing::Values("waitState", "commandVelocity", "setGripper", "grab",
                                           "setWindows", "setFrameRate", "onFrame", "onCommand"),
                         [](const auto& test) { return test.param; });

TEST(ServoLoop, OperatorsStopStopsTheArmThenSaysInterrupted) {
  LoopBench bench;
  bench.arm.stop_flag = &bench.stop;
  const std::exception_ptr left = bench.run();
  ASSERT_TRUE(left);
  EXPECT_THROW(std::rethrow_exception(left), Interrupted);
  EXPECT_EQ(bench.script.calls.back(), "stop");
  EXPECT_EQ(count(bench.script.calls, "waitState"), 3);
  // The state in which the flag rose was still answered, no other.
  EXPECT_EQ(count(bench.script.calls, "commandVelocity"), 3);
}

TEST(ServoLoop, StopAskedForBeforehandAsksNoMotion) {
  LoopBench bench;
  bench.stop = true;
  const std::exception_ptr left = bench.run();
  ASSERT_TRUE(left);
  EXPECT_THROW(std::rethrow_exception(left), Interrupted);
  EXPECT_EQ(bench.script.calls.back(), "stop");
  EXPECT_EQ(count(bench.script.calls, "commandVelocity"), 0);
}

TEST(ServoLoop, ArmThatCannotMoveIsStoppedAndReported) {
  LoopBench bench;
  bench.arm.motion_possible = false;
  const std::exception_ptr left = bench.run();
  ASSERT_TRUE(left);
  EXPECT_THROW(std::rethrow_exception(left), DeviceError);
  EXPECT_EQ(bench.script.calls.back(), "stop");
  EXPECT_EQ(count(bench.script.calls, "commandVelocity"), 0);
}

TEST(ServoLoop, AnswersEveryStateWithOneVelocity) {
  LoopBench bench;
  bench.arm.stop_flag = &bench.stop;
  ASSERT_TRUE(bench.run());
  std::vector<std::string> arm_calls;
  for (const std::string& call : bench.script.calls) {
    if (call == "waitState" || call == "commandVelocity" || call == "onCommand") {
      arm_calls.push_back(call);
    }
  }
  EXPECT_THAT(arm_calls, ElementsAre("waitState", "commandVelocity", "onCommand", "waitState",
                                     "commandVelocity", "onCommand", "waitState", "commandVelocity",
                                     "onCommand"));
}

}  // namespace
}  // namespace ringhook
