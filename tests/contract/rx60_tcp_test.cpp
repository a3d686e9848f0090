// The RX60's client on its own thread, over real TCP connections on loopback, against the simulated
// controller as a server on another thread. Order and outcome are looked at, never times: the
// client is patient here, since a busy machine may stop either side for long.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "core/error.h"
#include "robot/rx60/rx60_arm.h"
#include "robot/rx60/tcp_port.h"
#include "sim/rx60_server.h"

namespace ringhook {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

rx60::LinkSettings patient() {
  rx60::LinkSettings settings;
  settings.gripper_module = 2;
  settings.hold_s = 10.0;
  settings.stop_after_s = 20.0;
  settings.stall_s = settings.idle_stall_s = settings.reply_s = settings.status_s = 20.0;
  settings.first_state_s = 30.0;
  return settings;
}

/// A controller that serves until it goes.
class ServedController {
 public:
  ServedController() {
    Rx60ServerOptions options;
    options.ports = {0, 0, 0, 0};
    server_.emplace(controller_, options);
    address_.motion_port = server_->port(Rx60Socket::kMotion);
    address_.state_port = server_->port(Rx60Socket::kState);
    address_.io_port = server_->port(Rx60Socket::kIo);
    server_->onTick([this](Time now) {
      if (press_e_stop_.exchange(false)) {
        controller_.pressEStop();
      }
      if (mend_.exchange(false)) {
        controller_.releaseEStop();
        controller_.setDrives(true);
      }
      if (cut_.exchange(false)) {
        server_->cut(Rx60Socket::kMotion);
      }
      static_cast<void>(now);
    });
    thread_ = std::thread([this] { server_->run(end_); });
  }
  ~ServedController() { finish(); }
  ServedController(const ServedController&) = delete;
  ServedController& operator=(const ServedController&) = delete;

  void finish() {
    end_ = true;
    if (thread_.joinable()) {
      thread_.join();
      // The server ends with its last client; the controller lives on for a moment.
      controller_.tick(Time::fromSeconds(1e6));
    }
  }
  std::unique_ptr<rx60::LinkPort> port() const { return std::make_unique<rx60::TcpPort>(address_); }
  void pressEStop() { press_e_stop_ = true; }
  void mend() { mend_ = true; }
  void cut() { cut_ = true; }
  /// After finish().
  const Rx60Controller& controller() const { return controller_; }
  const KinematicPlant& plant() const { return plant_; }

 private:
  KinematicPlant plant_{JointVector{{0.3, 0.4, 0.9, -0.2, 0.8, 0.1}}};
  Rx60Controller controller_{plant_};
  std::optional<Rx60Server> server_;
  rx60::ControllerAddress address_;
  std::atomic<bool> press_e_stop_ = false;
  std::atomic<bool> mend_ = false;
  std::atomic<bool> cut_ = false;
  std::atomic<bool> end_ = false;
  std::thread thread_;
};

JointVector slow() { return JointVector{{0.1, -0.1, 0.1, 0.2, -0.1, 0.2}}; }

std::string failureOf(Rx60Arm& arm) {
  try {
    for (int k = 0; k < 5000; ++k) {
      static_cast<void>(arm.waitState());
    }
  } catch (const DeviceError& e) {
    return e.what();
  }
  return "nothing went wrong";
}

TEST(Rx60OverTcp, MovesTheArmWorksTheGripperAndLeavesItStanding) {
  ServedController served;
  double moved = 0.0;
  {
    Rx60Arm arm(served.port(), patient(), Rx60Arm::Runs::kOnItsOwnThread);
    const ArmState start = arm.waitState();
    arm.setGripper(true);
    ArmState state = start;
    for (int k = 0; k < 100; ++k) {
      arm.commandVelocity(slow());
      state = arm.waitState();
      EXPECT_TRUE(state.motion_possible);
    }
    moved = (state.position - start.position).cwiseAbs().maxCoeff();
  }
  served.finish();
  EXPECT_GT(moved, 1e-3);
  EXPECT_EQ(served.controller().commandedVelocity(), JointVector::Zero());
  EXPECT_TRUE(served.plant().output(2, 0));
  EXPECT_EQ(served.controller().counts().flushes, 0);
}

TEST(Rx60OverTcp, AnEStopIsToldAndMotionComesBackWithRearmOnly) {
  ServedController served;
  Rx60Arm arm(served.port(), patient(), Rx60Arm::Runs::kOnItsOwnThread);
  arm.commandVelocity(slow());
  static_cast<void>(arm.waitState());
  served.pressEStop();
  // Two connections keep no order between them: the refusal may be read before its reason.
  EXPECT_THAT(failureOf(arm), AnyOf(HasSubstr("emergency stop"), HasSubstr("refused VELOCITY_C")));
  EXPECT_THROW(arm.commandVelocity(slow()), DeviceError);
  served.mend();
  for (int tries = 0; tries < 50; ++tries) {  // a status may be under way that does not know yet
    try {
      arm.rearm();
      break;
    } catch (const DeviceError& e) {
      EXPECT_THAT(e.what(), AnyOf(HasSubstr("emergency stop"), HasSubstr("drives")));
    }
  }
  EXPECT_NO_THROW(arm.commandVelocity(slow()));
  EXPECT_NO_THROW(static_cast<void>(arm.waitState()));
}

TEST(Rx60OverTcp, ALostConnectionIsNamedAndRearmConnectsAnew) {
  ServedController served;
  Rx60Arm arm(served.port(), patient(), Rx60Arm::Runs::kOnItsOwnThread);
  served.cut();
  EXPECT_THAT(failureOf(arm), HasSubstr("closed the motion connection"));
  EXPECT_EQ(arm.report().state, rx60::LinkState::kFault);
  arm.rearm();
  EXPECT_TRUE(arm.waitState().motion_possible);
}

TEST(Rx60OverTcp, StopMayComeFromAnyThread) {
  ServedController served;
  Rx60Arm arm(served.port(), patient(), Rx60Arm::Runs::kOnItsOwnThread);
  std::thread operator_thread([&arm] {
    for (int k = 0; k < 20; ++k) {
      arm.stop();
      static_cast<void>(arm.report());
    }
  });
  for (int k = 0; k < 50; ++k) {
    try {
      arm.commandVelocity(slow());
    } catch (const DeviceError&) {
      arm.rearm();
    }
    static_cast<void>(arm.waitState());
  }
  operator_thread.join();
  arm.stop();
  EXPECT_FALSE(arm.report().armed);
}

TEST(Rx60OverTcp, NobodyThereIsNamedWithItsAddress) {
  rx60::ControllerAddress nowhere;
  nowhere.state_port = 1;  // reserved, nobody listens there
  try {
    const Rx60Arm arm(std::make_unique<rx60::TcpPort>(nowhere), patient(),
                      Rx60Arm::Runs::kOnItsOwnThread);
    FAIL() << "expected DeviceError";
  } catch (const DeviceError& e) {
    EXPECT_THAT(e.what(), HasSubstr("127.0.0.1, port 1: Connection refused"));
  }
}

}  // namespace
}  // namespace ringhook
