#pragma once

/// \file
/// An RX60 behind the Arm interface, over its protocol (link.h). Two ways to run it:
/// - on a thread of its own: the real arm. The thread sleeps until the controller speaks, answers
///   within microseconds, and keeps the arm safe even when the program's own loop is late. It has
///   real-time priority where that is permitted (core/thread_priority.h);
/// - on the caller's thread, inside waitState(): a simulated controller in virtual time, where
///   every run is the same.

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "core/thread_priority.h"
#include "robot/arm.h"
#include "robot/rx60/link.h"
#include "robot/rx60/link_port.h"

namespace ringhook {

class Rx60Arm : public Arm {
 public:
  enum class Runs { kOnItsOwnThread, kInWaitState };
  /// What must be there to begin with: permitted motion, or no more than the stream of states.
  enum class Needs { kMotion, kState };

  /// Connects and waits until the controller streams and, if needed, permits motion. Throws
  /// DeviceError that says what is missing.
  Rx60Arm(std::unique_ptr<rx60::LinkPort> port, const rx60::LinkSettings& settings, Runs runs,
          Needs needs = Needs::kMotion);
  /// Stops the arm, then closes the connections.
  ~Rx60Arm() override;

  /// The newest state, once there is one that was not yet given out; others are skipped. After
  /// stop() states go on; after a fault DeviceError is thrown, with the fault in words, until
  /// rearm().
  [[nodiscard]] ArmState waitState() override;
  /// A velocity acts from the next feedback on, until the next one is given, at most for the hold
  /// time of the settings. Entering velocity mode takes about 60 ms, during which zeros are sent.
  void commandVelocity(const JointVector& joint_velocity) override;
  void stop() noexcept override;
  /// Throws DeviceError if the controller does not permit motion. After a lost connection this
  /// connects anew, as the constructor does.
  void rearm() override;
  /// Two periods: a command goes out in answer to the next feedback, and the controller takes it
  /// in the tick after that.
  [[nodiscard]] double commandDelay() const override;
  void setGripper(bool closed) override;

  /// Starts a coarse move through points in joint space; the arm stands still at each. Throws
  /// InputError for points outside the limits, DeviceError if the arm is busy or not armed.
  void startMove(std::vector<rx60::JointPoint> points);
  /// True until the move has ended. Call it after waitState(), which throws if the move fails.
  [[nodiscard]] bool moving() const;

  /// Returns after the next wake-up of the link, whatever came; also during a fault.
  void awaitNews();
  /// How the link is doing; never throws, also during a fault.
  [[nodiscard]] rx60::LinkReport report() const;
  /// Of the arm's own thread.
  [[nodiscard]] ThreadPriority priority() const { return priority_; }

 private:
  using Lock = std::unique_lock<std::mutex>;

  void run() noexcept;
  void turn(Lock& lock);
  void open(Lock& lock);
  void serve();
  void readAll(rx60::Channel channel, Time now);
  void flush();
  void closeIfUseless();
  template <class Done>
  void waitUntil(Lock& lock, Done done);
  void awaitReady(Lock& lock, Needs needs);
  void end() noexcept;
  [[noreturn]] void refuse(const std::string& why);

  std::unique_ptr<rx60::LinkPort> port_;
  rx60::Link link_;
  const Runs runs_;
  mutable std::mutex mutex_;  ///< guards the link and writing to the port
  std::condition_variable served_;
  Time given_;  ///< stamp of the state that waitState() gave last
  bool any_given_ = false;
  std::int64_t turns_ = 0;  ///< wake-ups
  bool ending_ = false;
  std::atomic<ThreadPriority> priority_ = ThreadPriority::kOrdinary;
  std::thread thread_;
};

}  // namespace ringhook
