// What the simulated controller does with a client's messages.

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "robot/rx60/kinematics.h"
#include "sim/rx60_controller.h"

namespace ringhook {
namespace {

using rx60::ReplyCode;

/// The server's reply: the request's type and size, its sequence number if it has one, zeros.
rx60::Body replyBody(const rx60::Body& request) {
  return std::visit(
      [](const auto& body) {
        using B = std::decay_t<decltype(body)>;
        B reply{};
        if constexpr (requires { reply.sequence; }) {
          reply.sequence = body.sequence;
        }
        if constexpr (std::is_same_v<B, rx60::VelocityCfg>) {
          reply = {rx60::VelocityKind{}, {}, {}, 0.0F, 0.0F, 0.0F, 0.0F};
        } else if constexpr (std::is_same_v<B, rx60::VelocityCmd>) {
          reply.kind = rx60::VelocityKind{};
        }
        return rx60::Body(reply);
      },
      request);
}

bool inRange(const rx60::WireJoints& joints) {
  static const JointLimits limits = rx60::limits();
  const JointVector q = rx60::fromWire(joints);
  return q.allFinite() && (q.array() >= limits.lower.array()).all() &&
         (q.array() <= limits.upper.array()).all();
}

}  // namespace

void Rx60Controller::receiveOne(Rx60Socket socket) {
  Connection& connection = at(socket);
  const int flushes = connection.receiver.flushes();
  const std::optional<rx60::Message> message = connection.receiver.next();
  counts_.flushes += connection.receiver.flushes() - flushes;
  if (!message) {
    return;
  }
  ++counts_.received[typeOf(message->body)];
  const bool success = take(*message);
  counts_.refused += success ? 0 : 1;
  if (message->comm == rx60::CommType::kRequest) {
    send(socket, {rx60::CommType::kReply, success ? ReplyCode::kSuccess : ReplyCode::kFailure,
                  replyBody(message->body)});
  }
}

bool Rx60Controller::take(const rx60::Message& message) {
  if (const auto* drives = std::get_if<rx60::SetDrivePower>(&message.body)) {
    setDrives(drives->on != 0);
    return true;  // whether or not the drives obey
  }
  if (const auto* write = std::get_if<rx60::WriteSingleIo>(&message.body)) {
    return takeOutputWrite(*write);
  }
  return takeMotion(message.body);
}

bool Rx60Controller::takeMotion(const rx60::Body& body) {
  if (options_.velocity_addon && last_status_.motion_possible == 0) {
    stop_ = true;
    return false;
  }
  if (const auto* configuration = std::get_if<rx60::VelocityCfg>(&body)) {
    configuration_ = *configuration;
    mode_event_ = rx60::MessageType::kVelocityCfg;
    return true;
  }
  if (const auto* command = std::get_if<rx60::VelocityCmd>(&body)) {
    takeVelocity(*command);
    return true;
  }
  const auto* point = std::get_if<rx60::JointTrajPt>(&body);
  const bool success = point != nullptr && takePoint(*point);
  if (success) {
    mode_event_ = rx60::MessageType::kJointTrajPt;
  }
  return success;
}

bool Rx60Controller::takePoint(const rx60::JointTrajPt& point) {
  if (point.sequence == rx60::kStopSequence) {
    stop_ = true;
    return true;
  }
  if (points_to_refuse_ > 0) {
    --points_to_refuse_;
    return false;
  }
  if (!inRange(point.joints) || !(point.velocity > 0.0F) || points_.size() == kQueueDepth) {
    return false;
  }
  points_.push_back(point);
  return true;
}

void Rx60Controller::takeVelocity(const rx60::VelocityCmd& command) {
  if (command.sequence == rx60::kStopSequence) {
    stop_ = true;
    return;
  }
  command_.setZero();
  command_fresh_ = true;
  const bool joint = command.kind == rx60::VelocityKind::kJoint &&
                     configuration_.kind == rx60::VelocityKind::kJoint;
  const bool finite = std::all_of(command.velocity.begin(), command.velocity.end(),
                                  [](float v) { return std::isfinite(v); });
  if (joint && finite) {
    for (std::size_t i = 0; i < command.velocity.size(); ++i) {
      command_[static_cast<Eigen::Index>(i)] = static_cast<double>(command.velocity[i]);
    }
  }
}

/// Modules of the VAL3 server: 1 and 2 are the arm's own input and valves with two pins each, 3 to
/// 6 the cabinet's with sixteen.
bool Rx60Controller::takeOutputWrite(const rx60::WriteSingleIo& write) {
  const int pins = write.module >= 1 && write.module <= 2   ? 2
                   : write.module >= 3 && write.module <= 6 ? 16
                                                            : 0;
  if (write.pin < 0 || write.pin >= pins) {
    return false;
  }
  plant_.setOutput(write.module, write.pin, write.state != 0);
  return true;
}

}  // namespace ringhook
