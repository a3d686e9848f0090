#include "scripted_controller.h"

#include <algorithm>

namespace ringhook::test {

using rx60::Channel;
using rx60::CommType;
using rx60::Message;
using rx60::ReplyCode;

rx60::RobotStatus ScriptedController::good() {
  return {1, 0, 0, 0, 0, rx60::PendantMode::kAutomatic, 1};
}

void ScriptedController::connect() {
  link.opened(now);
  pass(1.0);
  static_cast<void>(feedback());
  giveStatus(good());
  link.pass(now);
}

void ScriptedController::connectAndServe() {
  connect();
  for (int k = 0; k < 40 && link.state() != rx60::LinkState::kServoing; ++k) {
    link.setTarget(JointVector::Zero(), now);
    static_cast<void>(feedback());
  }
}

void ScriptedController::pass(double seconds) {
  now = now + seconds;
  link.pass(now);
}

void ScriptedController::give(Channel channel, const Message& message) {
  giveBytes(channel, encode(message).bytes());
}

void ScriptedController::giveBytes(Channel channel, std::span<const std::byte> bytes) {
  std::copy(bytes.begin(), bytes.end(), link.room(channel).begin());
  link.received(channel, bytes.size(), now);
}

void ScriptedController::giveStatus(const rx60::RobotStatus& status) {
  give(Channel::kState, {CommType::kTopic, ReplyCode::kNone, status});
}

std::vector<Message> ScriptedController::feedback() {
  now = now + kPeriod;
  rx60::JointFeedback state;
  state.valid_fields = 7;
  state.position = rx60::toWire(position);
  give(Channel::kState, {CommType::kTopic, ReplyCode::kNone, state});
  if (++feedbacks % 20 == 0) {
    giveStatus(good());
  }
  link.pass(now);
  return collect();
}

std::vector<Message> ScriptedController::collect() {
  std::vector<Message> sent;
  while (const auto out = link.takeOutgoing()) {
    const Outcome<Message> message = rx60::decode(out->frame.bytes());
    sent.push_back(message.value());
    if (!silent) {
      reply(*out);
    }
  }
  return sent;
}

void ScriptedController::reply(const rx60::Link::Outgoing& out) {
  Message answer = rx60::decode(out.frame.bytes()).value();
  answer.comm = CommType::kReply;
  answer.reply = verdict;
  give(out.channel, answer);
}

std::vector<JointVector> velocitiesIn(const std::vector<Message>& messages) {
  std::vector<JointVector> velocities;
  for (const Message& message : messages) {
    const auto* command = std::get_if<rx60::VelocityCmd>(&message.body);
    if (command && command->sequence != rx60::kStopSequence) {
      JointVector v;
      std::copy(command->velocity.begin(), command->velocity.end(), v.begin());
      velocities.push_back(v);
    }
  }
  return velocities;
}

int stopsIn(const std::vector<Message>& messages) {
  return static_cast<int>(
      std::count_if(messages.begin(), messages.end(), [](const Message& message) {
        const auto* command = std::get_if<rx60::VelocityCmd>(&message.body);
        const auto* point = std::get_if<rx60::JointTrajPt>(&message.body);
        return (command && command->sequence == rx60::kStopSequence) ||
               (point && point->sequence == rx60::kStopSequence);
      }));
}

}  // namespace ringhook::test
