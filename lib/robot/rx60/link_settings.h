#pragma once

/// \file
/// What the link to an RX60 may be told, and what it tells about itself.

#include <cstdint>
#include <string>

#include "core/joints.h"
#include "robot/limiter.h"
#include "robot/rx60/feedback_clock.h"
#include "robot/rx60/messages.h"

namespace ringhook::rx60 {

struct LinkSettings {
  LimiterSettings limiter;     ///< between every velocity and the wire
  double hold_s = 0.05;        ///< a target acts for so long: 2.5 vision periods of 20 ms
  double ramp_s = 0.02;        ///< then goes down to zero within this time
  double stop_after_s = 0.25;  ///< without a target the arm leaves velocity mode
  double stall_s = 0.05;       ///< moving without feedback for longer is a fault
  double idle_stall_s = 0.5;   ///< standing without feedback for longer is a fault
  double first_state_s = 3.0;  ///< from connecting to the first feedback and status; usual: 1.1
  double status_s = 1.0;       ///< between two STATUS messages; usual: 0.08
  double reply_s = 0.2;        ///< from a request to its reply; usual: 0.008
  int settle_periods = 12;     ///< zeros sent after VELOCITY_CFG was acknowledged
  int max_unanswered = 4;      ///< commands without a reply; beyond, one is left out
  double refusal_patience_s = 20.0;  ///< how long a refused trajectory point is sent again
  double standstill_s = 2.0;        ///< accepted points that do not move the arm for so long: fault
  std::int32_t gripper_module = 2;  ///< of the VAL3 server: 1 and 2 are the arm's own
  std::int32_t gripper_pin = 0;
  bool gripper_closes_on = true;  ///< the state of the output that closes the gripper
};

enum class LinkState {
  kDisconnected,
  kAwaitState,   ///< connected; the controller begins to stream after about a second
  kIdle,         ///< streaming, no motion asked for
  kConfiguring,  ///< velocity mode asked for; zeros until it is in force
  kServoing,     ///< one velocity for each feedback
  kMoving,       ///< trajectory points are under way
  kStopping,     ///< stop sent, not yet confirmed
  kFault,        ///< stopped for a reason; moves again only after rearm()
};
const char* nameOf(LinkState state);

/// How the link is doing. Times of the host.
struct LinkReport {
  LinkState state = LinkState::kDisconnected;
  bool armed = false;          ///< motion is permitted
  Time now;                    ///< when this was written
  ArmState arm;                ///< of the newest feedback
  RobotStatus status;          ///< the newest
  std::int64_t statuses = 0;   ///< received since the start
  ArrivalStatistics arrivals;  ///< of the feedbacks
  double command_age_s = 0.0;  ///< from commandVelocity to the wire, last command
  JointVector sent_velocity = JointVector::Zero();  ///< last on the wire [rad/s]
  std::int64_t commands = 0;                        ///< velocities sent
  std::int64_t drained = 0;   ///< feedbacks superseded before they were answered
  std::int64_t left_out = 0;  ///< commands not sent: too many were unanswered
  std::int64_t faults = 0;
  std::string last_fault;  ///< in words; empty if there was none
};

}  // namespace ringhook::rx60
