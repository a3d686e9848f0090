#include "sim/rx60_controller.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "robot/rx60/kinematics.h"

namespace ringhook {
namespace {

using rx60::CommType;
using rx60::MessageType;

constexpr int kStateDelayTicks = 250;  // 1.0 s
constexpr int kStatusEvery = 20;       // feedbacks
constexpr int kPositionEvery = 5;      // ticks, 50 Hz: without the extension

const JointLimits& armLimits() {
  static const JointLimits limits = rx60::limits();
  return limits;
}

/// The server's limit() of a share of the nominal speed.
double shareOf(float value) {
  return value > 0.0F ? std::min(1.0, static_cast<double>(value)) : 0.0;
}

}  // namespace

const char* nameOf(Rx60Socket socket) {
  switch (socket) {
    case Rx60Socket::kMotion:
      return "motion";
    case Rx60Socket::kSystem:
      return "system";
    case Rx60Socket::kState:
      return "state";
    case Rx60Socket::kIo:
      break;
  }
  return "io";
}

Rx60Controller::Rx60Controller(Rx60Plant& plant, const Rx60ControllerOptions& options)
    : plant_(plant),
      options_(options),
      connections_(kRx60Sockets.size(),
                   Connection{false, Rx60Receiver(options.velocity_addon), {}}) {}

void Rx60Controller::connect(Rx60Socket socket) {
  disconnect(socket);
  at(socket).connected = true;
}

void Rx60Controller::disconnect(Rx60Socket socket) {
  Connection& connection = at(socket);
  connection.connected = false;
  connection.receiver.clear();
  connection.output.clear();
  if (socket == Rx60Socket::kState) {
    state_flows_ = false;
    state_ticks_ = 0;
  }
}

void Rx60Controller::receive(Rx60Socket socket, std::span<const std::byte> bytes) {
  if (at(socket).connected) {
    at(socket).receiver.push(bytes);
  }
}

std::vector<rx60::Frame> Rx60Controller::takeOutput(Rx60Socket socket) {
  return std::exchange(at(socket).output, {});
}

void Rx60Controller::send(Rx60Socket socket, const rx60::Message& message) {
  ++counts_.sent[typeOf(message.body)];
  at(socket).output.push_back(encode(message));
}

void Rx60Controller::tick(Time now) {
  const JointVector before = plant_.position();
  plant_.advanceTo(now);
  counts_.travel += (plant_.position() - before).cwiseAbs().maxCoeff();
  ++counts_.ticks;
  heartbeat();
  stream(now);
  receiveOne(Rx60Socket::kMotion);
  runMotion();
  switchMode();
  receiveOne(Rx60Socket::kSystem);
  receiveOne(Rx60Socket::kIo);
}

void Rx60Controller::heartbeat() {
  if (!at(Rx60Socket::kState).connected || state_flows_) {
    return;
  }
  state_flows_ = state_ticks_ == kStateDelayTicks;
  ++state_ticks_;
}

void Rx60Controller::stream(Time now) {
  if (!state_flows_ || (!options_.velocity_addon && counts_.ticks % kPositionEvery != 0)) {
    return;
  }
  if (options_.velocity_addon) {
    rx60::JointFeedback feedback;
    feedback.valid_fields = 7;
    feedback.time = std::bit_cast<float>(static_cast<std::int32_t>(now.seconds()));
    feedback.position = rx60::toWire(plant_.position());
    feedback.velocity = rx60::toWire(applied_);
    send(Rx60Socket::kState, {CommType::kTopic, rx60::ReplyCode::kNone, feedback});
  } else {
    send(Rx60Socket::kState, {CommType::kTopic, rx60::ReplyCode::kNone,
                              rx60::JointPosition{0, rx60::toWire(plant_.position())}});
  }
  if (throttle_ == kStatusEvery) {
    last_status_ = status();
    send(Rx60Socket::kState, {CommType::kTopic, rx60::ReplyCode::kNone, last_status_});
    throttle_ = 0;
  }
  ++throttle_;
}

rx60::RobotStatus Rx60Controller::status() const {
  rx60::RobotStatus status;
  status.drives_powered = drives_on_ ? 1 : 0;
  status.e_stopped = e_stopped_ ? 1 : 0;
  status.error_code = error_code_;
  status.in_error = error_code_ != 0 ? 1 : 0;
  status.in_motion = applied_.isZero(0.0) ? 0 : 1;
  status.mode = mode_switch_;
  status.motion_possible = powered() && error_code_ == 0 ? 1 : 0;
  return status;
}

void Rx60Controller::resetMotion() {
  move_.reset();
  apply(JointVector::Zero());
}

void Rx60Controller::apply(const JointVector& velocity) {
  applied_ = powered() ? velocity : JointVector::Zero();
  plant_.setVelocity(applied_, kTick);
}

void Rx60Controller::runMotion() {
  if (error_code_ != 0) {
    return;  // the task does not run
  }
  if (!at(Rx60Socket::kMotion).connected || !state_flows_ || stop_) {
    resetMotion();
    if (velocity_mode_) {
      command_.setZero();
      command_fresh_ = false;
    } else {
      points_.clear();
    }
    stop_ = false;
    return;
  }
  if (velocity_mode_) {
    applyVelocityCommand();
  } else {
    followPoints();
  }
}

void Rx60Controller::applyVelocityCommand() {
  const JointVector fastest = armLimits().velocity * shareOf(configuration_.velocity);
  apply(command_.cwiseMin(fastest).cwiseMax(-fastest));
  ++counts_.velocity_ticks;
  counts_.missed_ticks += command_fresh_ ? 0 : 1;
  counts_.zero_ticks += command_.isZero(0.0) ? 1 : 0;
  command_.setZero();
  command_fresh_ = false;
}

void Rx60Controller::followPoints() {
  if (!move_ && !points_.empty() && powered()) {
    const rx60::JointTrajPt& point = points_.front();
    move_ = Move{Rx60JointMove(plant_.position(), rx60::fromWire(point.joints),
                               shareOf(point.velocity), armLimits()),
                 0.0};
    points_.pop_front();
  }
  if (!move_) {
    apply(JointVector::Zero());
    return;
  }
  move_->time_s += kTick;
  apply((move_->path.position(move_->time_s) - plant_.position()) / kTick);
  if (move_->time_s >= move_->path.duration()) {
    move_.reset();
  }
}

void Rx60Controller::switchMode() {
  if (switching_to_) {
    // The old task does the reset first; it cannot while it is dead.
    if (--switch_ticks_left_ <= 0 && !stop_) {
      velocity_mode_ = *switching_to_;
      switching_to_.reset();
      resetMotion();
    }
    return;
  }
  if (!mode_event_) {
    return;
  }
  const bool to_velocity = *std::exchange(mode_event_, {}) == MessageType::kVelocityCfg;
  if (!to_velocity && !velocity_mode_) {
    return;
  }
  stop_ = true;  // all that a second VELOCITY_CFG does
  if (to_velocity != velocity_mode_) {
    switching_to_ = to_velocity;
    switch_ticks_left_ = options_.switch_ticks - 1;
  }
}

void Rx60Controller::pressEStop() {
  e_stopped_ = true;
  drives_on_ = false;
  resetMotion();
}

void Rx60Controller::releaseEStop() { e_stopped_ = false; }

void Rx60Controller::setDrives(bool on) {
  drives_on_ = on && !e_stopped_;
  if (!drives_on_) {
    resetMotion();
  }
}

void Rx60Controller::setError(std::int32_t code) {
  error_code_ = code;
  resetMotion();
}

}  // namespace ringhook
