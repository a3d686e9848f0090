// The dialogue itself: what each message means, and what each feedback is answered with.

#include <cmath>
#include <string>

#include "robot/rx60/link.h"
#include "robot/rx60/target_hold.h"

namespace ringhook::rx60 {
namespace {

constexpr double kStandingRadS = 1e-3;     // slower than this is standing still
constexpr double kForgottenAfter = 0.010;  // ticks without a command [s]
constexpr double kArrivedRad = 1e-3;       // nearer than this is there

bool standing(const ArmState& arm) { return arm.velocity.cwiseAbs().maxCoeff() < kStandingRadS; }

}  // namespace

void Link::take(Channel channel, const Message& message, Time now) {
  switch (channel) {
    case Channel::kState:
      takeState(message, now);
      return;
    case Channel::kMotion:
      takeMotionReply(message, now);
      return;
    case Channel::kIo:
      break;
  }
  if (message.comm != CommType::kReply || !std::holds_alternative<WriteSingleIo>(message.body)) {
    linkFault(std::string("the controller sent ") + nameOf(typeOf(message.body)) +
                  " on the IO connection, expected replies to WRITE_SINGLE_IO",
              now);
    return;
  }
  io_unanswered_.reset();
  if (message.reply == ReplyCode::kFailure) {
    fault("the controller refused to set output " + std::to_string(settings_.gripper_pin) +
              " of module " + std::to_string(settings_.gripper_module) + ", the gripper's",
          now);
  }
}

void Link::takeState(const Message& message, Time now) {
  if (const auto* feedback = std::get_if<JointFeedback>(&message.body)) {
    takeFeedback(*feedback, now);
  } else if (const auto* status = std::get_if<RobotStatus>(&message.body)) {
    takeStatus(*status, now);
  } else if (std::holds_alternative<JointPosition>(message.body)) {
    linkFault(
        "the controller streams JOINT_POSITION instead of JOINT_FEEDBACK: its server has no "
        "velocity control, install the VAL3 server with the velocity extension (needs the "
        "controller's Velocity add-on)",
        now);
  } else {
    linkFault(std::string("the controller sent ") + nameOf(typeOf(message.body)) +
                  " on the state connection",
              now);
  }
}

void Link::takeFeedback(const JointFeedback& feedback, Time now) {
  const JointVector position = fromWire(feedback.position);
  if ((feedback.valid_fields & kPositionValid) == 0 || !position.allFinite()) {
    linkFault("the controller sent a feedback without usable joint positions", now);
    return;
  }
  ArmState& arm = report_.arm;
  const Time stamp = clock_.stamp(now);
  if (have_feedback_) {
    // Samples lie on the controller's grid, at least one period apart.
    const double period = settings_.limiter.period_s;
    const double steps = std::max(1.0, std::round((stamp - arm.time) / period));
    arm.velocity = (position - arm.position) / (steps * period);
  } else {
    arm.velocity.setZero();
  }
  arm.time = stamp;
  arm.position = position;
  have_feedback_ = true;
  last_feedback_ = now;
  report_.drained += answer_due_ ? 1 : 0;
  answer_due_ = true;
}

std::string obstacleIn(const RobotStatus& status) {
  if (status.e_stopped != 0) {
    return "the emergency stop is pressed";
  }
  if (status.in_error != 0 || status.error_code != 0) {
    return "the controller is in error " + std::to_string(status.error_code);
  }
  if (status.drives_powered == 0) {
    return "the drives have no power";
  }
  return status.motion_possible == 0 ? "the controller says that no motion is possible" : "";
}

void Link::takeStatus(const RobotStatus& status, Time now) {
  const bool first = !have_status_;
  report_.status = status;
  ++report_.statuses;
  have_status_ = true;
  last_status_ = now;
  const std::string obstacle = obstacleIn(status);
  if (obstacle.empty()) {
    if (report_.state == LinkState::kAwaitState && have_feedback_) {
      report_.armed = true;
      enter(LinkState::kIdle, now);
    }
  } else if (report_.state != LinkState::kFault || first) {
    fault(obstacle, now);
  }
}

void Link::takeMotionReply(const Message& message, Time now) {
  const auto* command = std::get_if<VelocityCmd>(&message.body);
  const bool point = std::holds_alternative<JointTrajPt>(message.body);
  const bool configuration = std::holds_alternative<VelocityCfg>(message.body);
  if (message.comm != CommType::kReply || !(command || point || configuration)) {
    linkFault(std::string("the controller sent ") + nameOf(typeOf(message.body)) +
                  " on the motion connection, expected a reply",
              now);
    return;
  }
  const bool success = message.reply == ReplyCode::kSuccess;
  if (command && command->sequence != kStopSequence) {
    unanswered_ -= unanswered_ > 0 ? 1 : 0;
    answered_ = now;
  } else if (configuration) {
    cfg_unanswered_.reset();
  } else if (command || stop_unanswered_) {
    stop_unanswered_.reset();
    return;
  } else {
    points_.replied(success, now);
    return;
  }
  if (!success && report_.state != LinkState::kFault) {
    fault(std::string("the controller refused ") + nameOf(typeOf(message.body)), now);
  }
}

void Link::answer(Time now) {
  switch (report_.state) {
    case LinkState::kIdle:
      if (report_.armed && targetFresh(now)) {
        configure(now);
      }
      break;
    case LinkState::kConfiguring:
      settle(now);
      break;
    case LinkState::kServoing:
      servo(now);
      break;
    case LinkState::kMoving:
      followMove(now);
      break;
    case LinkState::kStopping:
      if (!stop_unanswered_ && standing(report_.arm)) {
        enter(LinkState::kIdle, now);
      }
      break;
    case LinkState::kDisconnected:
    case LinkState::kAwaitState:
    case LinkState::kFault:
      break;
  }
}

void Link::configure(Time now) {
  VelocityCfg configuration;
  configuration.translation_speed = static_cast<float>(settings_.limiter.tool_speed_automatic_m_s);
  configuration.rotation_speed = static_cast<float>(settings_.limiter.limits.velocity.maxCoeff());
  send(Channel::kMotion, CommType::kRequest, configuration);
  cfg_unanswered_ = now;
  velocity_mode_ = true;
  settle_left_ = settings_.settle_periods;
  enter(LinkState::kConfiguring, now);
}

void Link::settle(Time now) {
  // The reply comes before the mode is in force: zeros until then.
  if (cfg_unanswered_ || leavesOut(now)) {
    return;
  }
  sendVelocity(JointVector::Zero(), now);
  if (--settle_left_ <= 0) {
    limiter_.reset();
    last_sent_ = now;
    enter(LinkState::kServoing, now);
  }
}

/// What is queued acts meanwhile, and the queue gets shorter.
bool Link::leavesOut(Time now) {
  const bool left_out = backlog_.leaveOut(unanswered_);
  last_sent_ = left_out ? now : last_sent_;
  report_.left_out += left_out ? 1 : 0;
  return left_out;
}

void Link::servo(Time now) {
  if (!targetFresh(now)) {
    has_target_ = false;
    sendStop(now);
    enter(LinkState::kStopping, now);
    return;
  }
  if (leavesOut(now)) {
    return;
  }
  if (now - last_sent_ > kForgottenAfter) {
    limiter_.reset();  // the controller has zeroed what it was told last: from rest again
  }
  last_sent_ = now;
  const double age = now - target_.given;
  const JointVector wanted = heldShare(age, settings_.hold_s, settings_.ramp_s) * target_.velocity;
  const OperatingMode mode = report_.status.mode == PendantMode::kAutomatic
                                 ? OperatingMode::kAutomatic
                                 : OperatingMode::kManual;
  sendVelocity(limiter_.limit(wanted, report_.arm.position, mode).velocity, now);
  report_.command_age_s = age;
}

void Link::followMove(Time now) {
  if (const std::optional<JointTrajPt> point = points_.next(now)) {
    send(Channel::kMotion, CommType::kRequest, *point);
  }
  if (points_.refusedFor(now) > settings_.refusal_patience_s) {
    fault("the controller keeps refusing point " + std::to_string(points_.current() + 1) +
              " of the move",
          now);
    return;
  }
  const bool still = standing(report_.arm);
  if (!still || !points_.allAccepted()) {
    last_motion_ = now;
    return;
  }
  if ((report_.arm.position - points_.goal()).cwiseAbs().maxCoeff() < kArrivedRad) {
    points_.clear();
    enter(LinkState::kIdle, now);
  } else if (now - last_motion_ > settings_.standstill_s) {
    fault(
        "the controller took the move but the arm stands still away from its end: is motion "
        "enabled on the pendant?",
        now);
  }
}

}  // namespace ringhook::rx60
