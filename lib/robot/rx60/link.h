#pragma once

/// \file
/// The client's side of the dialogue with an RX60's controller, without sockets, threads or clocks:
/// bytes and times go in, frames come out. doc/rx60.md draws the states.
///
/// The controller forgets a velocity after one tick of 4 ms and takes one message a tick, so a
/// free-running client leaves ticks empty or builds a backlog. Therefore the arm clocks the link:
/// each feedback is answered by exactly one velocity command, made from the newest target; of
/// several feedbacks read at once only the newest is answered. A target is held for a bounded time,
/// then ramps to zero (target_hold.h); without one for longer the arm is stopped. Every velocity
/// passes the limiter.
///
/// Whatever goes wrong (e-stop, error, no motion possible, silence, a reply that does not come, a
/// message that cannot be understood, a lost connection) is a fault: a stop is sent, no velocity
/// follows, and only rearm() permits motion again. After a fault of the connection rearm() starts
/// over with new connections.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/outcome.h"
#include "robot/limiter.h"
#include "robot/rx60/backlog_guard.h"
#include "robot/rx60/frame_reader.h"
#include "robot/rx60/link_port.h"
#include "robot/rx60/link_settings.h"
#include "robot/rx60/point_sender.h"

namespace ringhook::rx60 {

/// What in a status forbids motion, in words; empty if nothing does.
std::string obstacleIn(const RobotStatus& status);

class Link {
 public:
  explicit Link(const LinkSettings& settings);

  // What the driver reports. Of one wake-up: received() for all that has arrived, then pass().

  /// All three connections were just opened.
  void opened(Time now);
  /// A connection broke or could not be opened; `why` in words.
  void lost(const std::string& why, Time now);
  /// Room for bytes of a channel: write into its front, then call received().
  [[nodiscard]] std::span<std::byte> room(Channel channel);
  void received(Channel channel, std::size_t count, Time now);
  /// Time has passed: answers the newest feedback and looks for what has not come.
  void pass(Time now);

  // What the user wishes.

  /// The newest velocity target [rad/s]. Precondition: armed() and finite.
  void setTarget(const JointVector& velocity, Time now);
  /// Sends a stop at once and permits no motion until rearm().
  void stop(Time now);
  /// stop(), for a reason that the report will tell.
  void refuse(const std::string& why, Time now);
  /// Permits motion again; asks for new connections where they are lost. Refused while the
  /// controller says that motion is not possible.
  [[nodiscard]] Outcome<bool> rearm(Time now);
  void setGripper(bool closed, Time now);
  /// Moves to the points one after the other. Refused with a reason unless idle, armed and the
  /// points are within the limits.
  [[nodiscard]] Outcome<std::size_t> move(std::vector<JointPoint> points, Time now);

  // What the driver must do.

  struct Outgoing {
    Channel channel;
    Frame frame;
  };
  /// The next frame to be sent, in order.
  [[nodiscard]] std::optional<Outgoing> takeOutgoing();
  /// Connections are open as far as the link knows: read them.
  [[nodiscard]] bool open() const { return open_; }
  /// The connections are of no more use and must be closed.
  [[nodiscard]] bool wantsClose() const { return wants_close_; }
  void closed() { wants_close_ = false; }
  /// New connections are asked for.
  [[nodiscard]] bool wantsOpen() const { return wants_open_; }

  [[nodiscard]] LinkState state() const { return report_.state; }
  [[nodiscard]] bool armed() const { return report_.armed; }
  [[nodiscard]] const LinkReport& report() const { return report_; }
  [[nodiscard]] const LinkSettings& settings() const { return settings_; }

 private:
  struct Target {
    JointVector velocity = JointVector::Zero();  ///< [rad/s]
    Time given;
  };

  // messages
  void take(Channel channel, const Message& message, Time now);
  void takeState(const Message& message, Time now);
  void takeMotionReply(const Message& message, Time now);
  void takeFeedback(const JointFeedback& feedback, Time now);
  void takeStatus(const RobotStatus& status, Time now);

  // states
  void enter(LinkState state, Time now);
  void answer(Time now);
  void configure(Time now);
  void settle(Time now);
  void servo(Time now);
  [[nodiscard]] bool leavesOut(Time now);
  void followMove(Time now);

  // faults
  void fault(const std::string& why, Time now);
  void linkFault(const std::string& why, Time now);
  [[nodiscard]] std::string overdue(Time now) const;
  [[nodiscard]] bool targetFresh(Time now) const;

  // sending
  void send(Channel channel, CommType comm, const Body& body);
  void sendVelocity(const JointVector& velocity, Time now);
  void sendStop(Time now);

  LinkSettings settings_;
  Limiter limiter_;
  FeedbackClock clock_;
  std::array<FrameReader, kChannels.size()> readers_;
  PointSender points_;
  BacklogGuard backlog_;
  LinkReport report_;
  Target target_;
  bool has_target_ = false;
  bool answer_due_ = false;
  bool open_ = false;  ///< the three connections
  bool wants_close_ = false;
  bool wants_open_ = false;
  bool velocity_mode_ = false;  ///< the controller was last brought there
  bool have_feedback_ = false;  ///< of this connection
  bool have_status_ = false;
  int settle_left_ = 0;
  std::int32_t sequence_ = 0;

  Time entered_;  ///< the present state
  Time last_feedback_;
  Time last_status_;
  Time last_motion_;  ///< of the arm, while points are under way
  Time last_sent_;    ///< last velocity, or the decision to leave one out
  std::optional<Time> cfg_unanswered_;
  std::optional<Time> stop_unanswered_;
  std::optional<Time> io_unanswered_;
  int unanswered_ = 0;  ///< velocity commands
  Time answered_;       ///< last reply to one, or when the first unanswered one was sent

  std::array<Outgoing, 16> outgoing_;
  std::size_t out_begin_ = 0;
  std::size_t out_end_ = 0;
};

}  // namespace ringhook::rx60
