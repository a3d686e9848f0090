#include "wire_watch.h"

#include <stdexcept>

#include "robot/rx60/kinematics.h"
#include "robot/rx60/messages.h"

namespace ringhook::test {
namespace {

constexpr double kPeriod = 0.004;
constexpr double kForgottenAfter = 0.010;  // [s]
// The wire carries float32: half a unit of the last place of 5 rad/s, differentiated once and
// twice.
constexpr double kSpeedRounding = 5e-7;  // [rad/s]
constexpr double kAccelerationRounding = 2 * kSpeedRounding / kPeriod;
constexpr double kJerkRounding = 2 * kAccelerationRounding / kPeriod;

}  // namespace

bool WireWatch::write(rx60::Channel channel, std::span<const std::byte> frame) {
  const Outcome<rx60::Message> message = rx60::decode(frame);
  if (!message) {
    violations_.push_back("the client wrote " + message.reason());
  } else if (const auto* command = std::get_if<rx60::VelocityCmd>(&message->body);
             command && command->sequence != rx60::kStopSequence) {
    look(JointVector(
        Eigen::Map<const Eigen::Matrix<float, 6, 1>>(command->velocity.data()).cast<double>()));
  } else if (!std::holds_alternative<rx60::WriteSingleIo>(message->body)) {
    velocity_.setZero();  // a stop, or a mode that begins at rest
    acceleration_.setZero();
  }
  return port_->write(channel, frame);
}

void WireWatch::wait(Time deadline) {
  if (now() > patience_) {
    throw std::runtime_error("waiting without end");
  }
  port_->wait(deadline);
}

void WireWatch::look(const JointVector& velocity) {
  ++commands_;
  static const JointLimits limits = rx60::limits();
  // After ticks without a command the arm stands, and a client may begin from rest.
  const bool small =
      ((velocity.cwiseAbs() - kPeriod * kPeriod * limits.jerk).array() < kSpeedRounding).all();
  if (now() - last_ > kForgottenAfter && small) {
    velocity_.setZero();
    acceleration_.setZero();
  }
  last_ = now();
  const JointVector acceleration = (velocity - velocity_) / kPeriod;
  const JointVector jerk = (acceleration - acceleration_) / kPeriod;
  const auto say = [this](const char* what) {
    violations_.push_back(std::string(what) + " at " + std::to_string(now().seconds()) + " s");
  };
  if (!velocity.allFinite()) {
    say("a velocity that is not a number");
  }
  if (((velocity.cwiseAbs() - limits.velocity).array() > kSpeedRounding).any()) {
    say("a speed beyond its limit");
  }
  if (((acceleration.cwiseAbs() - limits.acceleration).array() > kAccelerationRounding).any()) {
    say("an acceleration beyond its limit");
  }
  if (((jerk.cwiseAbs() - limits.jerk).array() > kJerkRounding).any()) {
    say("a jerk beyond its limit");
  }
  velocity_ = velocity;
  acceleration_ = acceleration;
}

}  // namespace ringhook::test
