// Vision on a thread of its own, between a camera that delivers on demand and a control side that
// only ever asks. Nothing here looks at times: each side waits for the other one's act.

#include "cycle/vision_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>

#include "core/error.h"
#include "cycle/servo_loop.h"
#include "default_cell.h"

namespace ringhook {
namespace {

/// Dark frames, handed over one by one; or a failure.
class HandedCamera : public StereoCamera {
 public:
  [[nodiscard]] Window fullImage() const override { return {0, 0, 256, 256}; }
  void setWindows(const Window& left, const Window&) override {
    const std::lock_guard lock(mutex_);
    left_ = left;
    ++windows_set_;
    changed_.notify_all();
  }
  void setFrameRate(double) override {}
  std::optional<StereoFrame> grab(double timeout_s) override {
    std::unique_lock lock(mutex_);
    if (timeout_s > 0.0) {
      changed_.wait_for(lock, std::chrono::duration<double>(timeout_s),
                        [this] { return broken_ || !frames_.empty(); });
    }
    if (broken_) {
      throw DeviceError("left camera unplugged");
    }
    if (frames_.empty()) {
      return std::nullopt;
    }
    StereoFrame frame = std::move(frames_.front());
    frames_.pop_front();
    return frame;
  }
  [[nodiscard]] bool finished() const override { return false; }

  void hand(std::initializer_list<double> times_s) {
    const std::lock_guard lock(mutex_);
    for (const double time_s : times_s) {
      StereoFrame frame;
      frame.time = Time::fromSeconds(time_s);
      frame.left_window = frame.right_window = {90, 90, 64, 64};
      frame.left = frame.right = GrayImage(64, 64, 20);
      frames_.push_back(std::move(frame));
    }
    changed_.notify_all();
  }
  void unplug() {
    const std::lock_guard lock(mutex_);
    broken_ = true;
    changed_.notify_all();
  }
  void awaitWindowsSet(int times) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return windows_set_ >= times; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<StereoFrame> frames_;
  Window left_;
  int windows_set_ = 0;
  bool broken_ = false;
};

class SeenFrames : public LoopObserver {
 public:
  void onFrame(const StereoFrame& frame, const VisionReport&, double) override {
    const std::lock_guard lock(mutex_);
    last_ = frame.time;
    thread_ = std::this_thread::get_id();
    changed_.notify_all();
  }
  void onCommand(const ArmState&, const TaskCommand&) override {}

  void await(double time_s) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return last_ == Time::fromSeconds(time_s); });
  }
  std::thread::id thread() {
    const std::lock_guard lock(mutex_);
    return thread_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  Time last_;
  std::thread::id thread_;
};

/// An arm that gives states for ever and remembers that it was stopped.
class PatientArm : public Arm {
 public:
  PatientArm() {
    state_.position = test::defaultCell().arm.load_rad;
    state_.velocity.setZero();
    state_.motion_possible = true;
  }
  ArmState waitState() override {
    state_.time = state_.time + 0.004;
    std::this_thread::yield();
    return state_;
  }
  void commandVelocity(const JointVector&) override {}
  void stop() noexcept override { stopped = true; }
  void rearm() override {}
  [[nodiscard]] double commandDelay() const override { return 0.0; }
  void setGripper(bool) override {}

  bool stopped = false;

 private:
  ArmState state_;
};

class VisionThreadTest : public ::testing::Test {
 protected:
  VisionThreadTest()
      : cell(test::defaultCell()), step(cell, test::coarseRig(cell), TrackerKind::kMarker) {}

  CellConfig cell;
  VisionStep step;
  HandedCamera camera;
  SeenFrames seen;
};

TEST_F(VisionThreadTest, FramesAreWorkedOffBesideTheControlSide) {
  VisionThread vision(camera, step, seen);
  camera.hand({1.0});
  seen.await(1.0);
  EXPECT_NE(seen.thread(), std::this_thread::get_id());
  EXPECT_FALSE(vision.newest(ArmState{}));  // a dark frame shows no hook
}

TEST_F(VisionThreadTest, OfFramesThatWaitedTheNewestIsTaken) {
  camera.hand({1.0, 1.02, 1.04});
  VisionThread vision(camera, step, seen);
  seen.await(1.04);
  EXPECT_EQ(vision.passedOver(), 2);
}

TEST_F(VisionThreadTest, RestartSetsTheSearchWindowsWithoutAFrame) {
  VisionThread vision(camera, step, seen);
  vision.restart();
  camera.awaitWindowsSet(1);
}

TEST_F(VisionThreadTest, AFailureOfTheCameraComesOutWhereTheArmIsStopped) {
  VisionThread vision(camera, step, seen);
  PatientArm arm;
  TaskControl task(cell, rx60::rx60());
  const std::atomic<bool> never = false;
  camera.unplug();
  EXPECT_THROW((void)runAttempt(vision, arm, task, seen, never), DeviceError);
  EXPECT_TRUE(arm.stopped);
}

TEST_F(VisionThreadTest, EndsWhileTheCameraIsSilent) {
  const VisionThread vision(camera, step, seen);
}

}  // namespace
}  // namespace ringhook
