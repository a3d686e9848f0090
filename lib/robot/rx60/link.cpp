#include "robot/rx60/link.h"

#include <cassert>
#include <cmath>
#include <utility>

namespace ringhook::rx60 {
namespace {

std::size_t indexOf(Channel channel) { return static_cast<std::size_t>(channel); }

std::string milliseconds(double seconds) {
  return std::to_string(std::llround(seconds * 1e3)) + " ms";
}

}  // namespace

const char* nameOf(Channel channel) {
  switch (channel) {
    case Channel::kMotion:
      return "motion";
    case Channel::kState:
      return "state";
    case Channel::kIo:
      break;
  }
  return "IO";
}

const char* nameOf(LinkState state) {
  switch (state) {
    case LinkState::kDisconnected:
      return "disconnected";
    case LinkState::kAwaitState:
      return "await state";
    case LinkState::kIdle:
      return "idle";
    case LinkState::kConfiguring:
      return "configuring";
    case LinkState::kServoing:
      return "servoing";
    case LinkState::kMoving:
      return "moving";
    case LinkState::kStopping:
      return "stopping";
    case LinkState::kFault:
      break;
  }
  return "fault";
}

Link::Link(const LinkSettings& settings)
    : settings_(settings),
      limiter_(settings.limiter),
      clock_(settings.limiter.period_s),
      backlog_(settings.max_unanswered) {
  wants_open_ = true;
}

void Link::opened(Time now) {
  open_ = true;
  wants_open_ = wants_close_ = false;
  for (FrameReader& reader : readers_) {
    reader.clear();
  }
  clock_ = FeedbackClock(settings_.limiter.period_s);
  points_.clear();
  has_target_ = answer_due_ = velocity_mode_ = have_feedback_ = have_status_ = false;
  cfg_unanswered_.reset();
  stop_unanswered_.reset();
  io_unanswered_.reset();
  unanswered_ = 0;
  backlog_ = BacklogGuard(settings_.max_unanswered);
  out_begin_ = out_end_ = 0;
  last_feedback_ = last_status_ = now;
  enter(LinkState::kAwaitState, now);
}

void Link::lost(const std::string& why, Time now) { linkFault(why, now); }

std::span<std::byte> Link::room(Channel channel) { return readers_[indexOf(channel)].room(); }

void Link::received(Channel channel, std::size_t count, Time now) {
  FrameReader& reader = readers_[indexOf(channel)];
  reader.commit(count);
  while (open_) {
    const Outcome<std::optional<Message>> message = reader.next();
    if (!message) {
      linkFault(std::string("the controller sent ") + message.reason() + " on the " +
                    nameOf(channel) + " connection",
                now);
      return;
    }
    if (!*message) {
      return;
    }
    take(channel, **message, now);
  }
}

void Link::pass(Time now) {
  report_.now = now;
  if (std::exchange(answer_due_, false)) {
    answer(now);
  }
  if (open_) {
    const std::string late = overdue(now);
    if (!late.empty()) {
      linkFault(late, now);
    }
  }
  report_.arm.motion_possible = report_.armed && obstacleIn(report_.status).empty();
  report_.arrivals = clock_.statistics();
}

void Link::setTarget(const JointVector& velocity, Time now) {
  assert(report_.armed && velocity.allFinite());
  target_ = {velocity, now};
  has_target_ = true;
}

void Link::stop(Time now) {
  report_.armed = false;
  has_target_ = false;
  points_.clear();
  if (!open_ || report_.state == LinkState::kAwaitState) {
    return;
  }
  sendStop(now);
  if (report_.state != LinkState::kFault) {
    enter(LinkState::kStopping, now);
  }
}

void Link::refuse(const std::string& why, Time now) {
  stop(now);
  report_.last_fault = why;
  ++report_.faults;
}

Outcome<bool> Link::rearm(Time now) {
  if (!open_) {
    has_target_ = false;
    wants_open_ = true;
    enter(LinkState::kDisconnected, now);
    return true;
  }
  const std::string obstacle = obstacleIn(report_.status);
  if (have_status_ && !obstacle.empty()) {
    return Refusal{obstacle};
  }
  has_target_ = false;
  if (report_.state == LinkState::kFault) {
    enter(LinkState::kStopping, now);
    sendStop(now);
  }
  report_.armed = true;
  return true;
}

void Link::setGripper(bool closed, Time now) {
  if (!open_) {
    return;
  }
  WriteSingleIo write;
  write.module = settings_.gripper_module;
  write.pin = settings_.gripper_pin;
  write.state = closed == settings_.gripper_closes_on ? 1 : 0;
  send(Channel::kIo, CommType::kRequest, write);
  io_unanswered_ = io_unanswered_.value_or(now);
}

Outcome<std::size_t> Link::move(std::vector<JointPoint> points, Time now) {
  if (report_.state != LinkState::kIdle || !report_.armed) {
    return Refusal{std::string("a move can only start from idle, the link is ") +
                   nameOf(report_.state) + (report_.armed ? "" : " and not armed")};
  }
  Outcome<std::size_t> checked = checkPoints(points, settings_.limiter.limits);
  if (checked) {
    points_.start(std::move(points), now);
    has_target_ = false;
    velocity_mode_ = false;
    last_motion_ = now;
    enter(LinkState::kMoving, now);
  }
  return checked;
}

std::optional<Link::Outgoing> Link::takeOutgoing() {
  if (out_begin_ == out_end_) {
    return std::nullopt;
  }
  return outgoing_[out_begin_++ % outgoing_.size()];
}

bool Link::targetFresh(Time now) const {
  return has_target_ && now - target_.given <= settings_.stop_after_s;
}

void Link::enter(LinkState state, Time now) {
  report_.state = state;
  entered_ = now;
}

void Link::fault(const std::string& why, Time now) {
  stop(now);
  report_.last_fault = why;
  ++report_.faults;
  enter(LinkState::kFault, now);
}

void Link::linkFault(const std::string& why, Time now) {
  fault(why, now);
  open_ = wants_open_ = false;
  wants_close_ = true;
}

std::string Link::overdue(Time now) const {
  const auto longer = [now](const std::optional<Time>& since, double limit) {
    return since && now - *since > limit;
  };
  if (report_.state == LinkState::kAwaitState) {
    return now - entered_ > settings_.first_state_s
               ? "the controller sent no state and status within " +
                     milliseconds(settings_.first_state_s) + " of connecting"
               : "";
  }
  const bool moving = report_.state != LinkState::kIdle && report_.state != LinkState::kFault;
  const double stall = moving ? settings_.stall_s : settings_.idle_stall_s;
  if (now - last_feedback_ > stall) {
    return "the controller sent no feedback for " + milliseconds(now - last_feedback_);
  }
  if (now - last_status_ > settings_.status_s) {
    return "the controller sent no status for " + milliseconds(now - last_status_);
  }
  if (longer(cfg_unanswered_, settings_.reply_s) || longer(stop_unanswered_, settings_.reply_s) ||
      longer(points_.unansweredSince(), settings_.reply_s) ||
      (unanswered_ > 0 && now - answered_ > settings_.reply_s)) {
    return "the controller does not reply on the motion connection";
  }
  return longer(io_unanswered_, settings_.reply_s)
             ? "the controller does not reply on the IO connection"
             : "";
}

void Link::send(Channel channel, CommType comm, const Body& body) {
  if (out_end_ - out_begin_ == outgoing_.size()) {
    open_ = false;
    linkFault("nobody sends what the link says", report_.now);
    return;
  }
  outgoing_[out_end_++ % outgoing_.size()] = {channel, encode({comm, ReplyCode::kNone, body})};
}

void Link::sendVelocity(const JointVector& velocity, Time now) {
  if (unanswered_++ == 0) {
    answered_ = now;
  }
  VelocityCmd command;
  command.sequence = sequence_ = sequence_ % 1'000'000 + 1;
  for (int i = 0; i < 6; ++i) {
    command.velocity.at(static_cast<std::size_t>(i)) = static_cast<float>(velocity[i]);
  }
  send(Channel::kMotion, CommType::kRequest, command);
  report_.sent_velocity = velocity;
  ++report_.commands;
}

void Link::sendStop(Time now) {
  report_.sent_velocity.setZero();
  stop_unanswered_ = stop_unanswered_.value_or(now);
  // Each mode obeys only its own kind of message.
  if (velocity_mode_) {
    VelocityCmd command;
    command.sequence = kStopSequence;
    send(Channel::kMotion, CommType::kRequest, command);
  } else {
    JointTrajPt point;
    point.sequence = kStopSequence;
    send(Channel::kMotion, CommType::kRequest, point);
  }
}

}  // namespace ringhook::rx60
