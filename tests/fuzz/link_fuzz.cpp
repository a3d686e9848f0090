// The RX60's client against a controller that says anything at any time, and a user who asks for
// anything at any time, both within what the driver (rx60_arm.cpp) lets through: every frame sent
// decodes, nothing moves while the arm is not armed or after a stop, every velocity is within the
// joints' speeds, one a wake-up at most, and a link that is of no use says why.

#include <cmath>
#include <vector>

#include "fuzz/random_message.h"
#include "robot/rx60/kinematics.h"
#include "robot/rx60/link.h"

namespace ringhook::fuzz {
namespace {

using rx60::Channel;
using rx60::CommType;
using rx60::LinkState;
using rx60::ReplyCode;

constexpr double kPeriod = 0.004;
constexpr std::size_t kMostPeriods = 64;  // served in one input

class Dialogue {
 public:
  explicit Dialogue(Script script) : script_(script), link_(rx60::LinkSettings{}) {}

  void run() {
    while (!script_.over() && served_ < kMostPeriods) {
      const bool armed = link_.armed();
      step();
      look(armed);
    }
  }

 private:
  void step() {
    const std::size_t kind = script_.choice(16);
    if (kind < 8) {
      controllerStep(kind);
    } else {
      userStep(kind);
    }
  }

  void controllerStep(std::size_t kind) {
    switch (kind) {
      case 0:
        return connect();
      case 1:
        return passTime();
      case 2:
        return say(Channel::kState, {CommType::kTopic, ReplyCode::kNone, feedback()});
      case 3:
        return say(Channel::kState, {CommType::kTopic, ReplyCode::kNone, status()});
      case 4:
        return reply(script_.byte() % 8 == 0 ? ReplyCode::kFailure : ReplyCode::kSuccess);
      case 5:
        return hear(anyChannel(), script_.raw(script_.byte()));
      case 6:
        return hear(anyChannel(), damagedFrame(script_));
      default:
        return say(anyChannel(), scriptedMessage(script_));
    }
  }

  void userStep(std::size_t kind) {
    switch (kind) {
      case 8:
        if (link_.armed()) {
          link_.setTarget(target(), now_);
        }
        return;
      case 9:
        return link_.stop(now_);
      case 10:
        return static_cast<void>(link_.rearm(now_));
      case 11:
        return link_.setGripper(script_.byte() % 2 == 0, now_);
      case 12:
        return move();
      case 13:
        return link_.refuse("the user wishes so", now_);
      case 14:
        return link_.lost("the line broke", now_);
      default:
        return serve(1 + script_.choice(32));
    }
  }

  void connect() {
    if (link_.wantsOpen()) {
      link_.opened(now_);
      for (auto& bytes : heard_) {
        bytes.clear();
      }
      owed_.clear();
    }
  }

  void passTime() {
    static constexpr std::array<double, 8> kSteps = {0.0,  1e-4, kPeriod, 0.008,
                                                     0.03, 0.3,  1.5,     4e6};
    now_ = now_ + kSteps.at(script_.choice(kSteps.size()));
    wakeUp();
  }

  /// Periods of an orderly controller, with a user who renews the target.
  void serve(std::size_t periods) {
    const JointVector wanted = target();
    const bool moves = script_.byte() % 2 == 0;
    served_ += periods;
    for (std::size_t i = 0; i < periods; ++i) {
      now_ = now_ + kPeriod;
      arm_ += kPeriod * velocity_;
      say(Channel::kState, {CommType::kTopic, ReplyCode::kNone, restingFeedback()});
      if (i % 16 == 0) {
        say(Channel::kState, {CommType::kTopic, ReplyCode::kNone, goodStatus()});
      }
      reply(ReplyCode::kSuccess);
      if (moves && link_.armed()) {
        link_.setTarget(wanted, now_);
      }
      const bool armed = link_.armed();
      wakeUp();
      look(armed);
    }
  }

  /// One wake-up of the driver.
  void wakeUp() {
    for (const Channel channel : rx60::kChannels) {
      std::vector<std::byte>& bytes = heard_.at(static_cast<std::size_t>(channel));
      std::size_t given = 0;
      while (link_.open() && given < bytes.size()) {
        const std::span<std::byte> room = link_.room(channel);
        require(!room.empty(), "there is room for the next bytes");
        const std::size_t count = std::min(room.size(), bytes.size() - given);
        std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(given), count, room.begin());
        given += count;
        link_.received(channel, count, now_);
      }
      bytes.clear();
    }
    link_.pass(now_);
  }

  void move() {
    std::vector<rx60::JointPoint> points(script_.choice(4));
    for (rx60::JointPoint& point : points) {
      point.position = target() / 10.0;
      point.speed_fraction = script_.choice(4) == 0 ? static_cast<double>(script_.real()) : 0.5;
    }
    static_cast<void>(link_.move(std::move(points), now_));
  }

  // ---- what is said

  Channel anyChannel() { return rx60::kChannels.at(script_.choice(rx60::kChannels.size())); }

  void hear(Channel channel, std::span<const std::byte> bytes) {
    auto& heard = heard_.at(static_cast<std::size_t>(channel));
    heard.insert(heard.end(), bytes.begin(), bytes.end());
  }

  void say(Channel channel, const rx60::Message& message) {
    hear(channel, encode(message).bytes());
  }

  void reply(ReplyCode code) {
    for (const auto& [channel, body] : owed_) {
      say(channel, {CommType::kReply, code, body});
    }
    owed_.clear();
  }

  [[nodiscard]] rx60::JointFeedback restingFeedback() const {
    rx60::JointFeedback feedback;
    feedback.valid_fields = 7;
    feedback.position = rx60::toWire(arm_);
    return feedback;
  }

  rx60::JointFeedback feedback() {
    rx60::JointFeedback feedback = restingFeedback();
    const std::size_t slot = script_.choice(12);
    if (slot < 6) {
      feedback.position.at(slot) = script_.real();
    }
    return feedback;
  }

  static rx60::RobotStatus goodStatus() {
    rx60::RobotStatus status;
    status.drives_powered = status.motion_possible = 1;
    status.mode = rx60::PendantMode::kAutomatic;
    return status;
  }

  rx60::RobotStatus status() {
    rx60::RobotStatus status = goodStatus();
    const std::uint8_t bits = script_.byte();
    status.e_stopped = bits & 1;
    status.drives_powered = bits & 2 ? 0 : 1;
    status.motion_possible = bits & 4 ? 0 : 1;
    status.error_code = bits & 8;
    status.mode = bits & 16 ? rx60::PendantMode::kManual : rx60::PendantMode::kAutomatic;
    return status;
  }

  JointVector target() {
    const double scale = script_.choice(8) == 0 ? 1e308 : 10.0;
    JointVector velocity;
    for (double& v : velocity) {
      v = scale * script_.share();
    }
    return velocity;
  }

  // ---- what must hold

  void look(bool armed_before) {
    int velocities = 0;
    bool stopped = false;
    while (const auto out = link_.takeOutgoing()) {
      const Outcome<rx60::Message> message = rx60::decode(out->frame.bytes());
      require(message.hasValue(), "every frame sent decodes");
      require(message->comm == CommType::kRequest, "a client sends requests");
      const auto* command = std::get_if<rx60::VelocityCmd>(&message->body);
      const auto* point = std::get_if<rx60::JointTrajPt>(&message->body);
      if ((command != nullptr && command->sequence == rx60::kStopSequence) ||
          (point != nullptr && point->sequence == rx60::kStopSequence)) {
        stopped = true;
        velocity_.setZero();
      } else if (command != nullptr || point != nullptr) {
        require(armed_before || link_.armed(), "no motion while not armed");
        require(!stopped, "no motion after a stop");
        velocities += command != nullptr ? 1 : 0;
      }
      if (command != nullptr && command->sequence != rx60::kStopSequence) {
        lookAt(*command);
      }
      owed_.emplace_back(out->channel, message->body);
    }
    require(velocities <= 1, "one velocity a wake-up at most");
    lookAtLink();
  }

  void lookAt(const rx60::VelocityCmd& command) {
    static const JointLimits limits = rx60::limits();
    for (std::size_t i = 0; i < command.velocity.size(); ++i) {
      const auto joint = static_cast<Eigen::Index>(i);
      const double v = static_cast<double>(command.velocity.at(i));
      require(std::isfinite(v) && std::abs(v) <= limits.velocity[joint] * (1.0 + 1e-6),
              "every velocity is within the joint's speed");
      velocity_[joint] = v;
    }
  }

  void lookAtLink() {
    if (link_.wantsClose()) {
      link_.closed();
      require(!link_.open(), "closed is not open");
    }
    const rx60::LinkReport& report = link_.report();
    require(report.state != LinkState::kFault || (!report.armed && !report.last_fault.empty()),
            "a fault disarms and has words");
    require(link_.open() || link_.wantsOpen() || report.state == LinkState::kFault,
            "a link of no use says so");
  }

  Script script_;
  rx60::Link link_;
  Time now_;
  std::size_t served_ = 0;
  JointVector arm_ = JointVector::Constant(0.3);      ///< of the orderly controller [rad]
  JointVector velocity_ = JointVector::Zero();        ///< sent last [rad/s]
  std::array<std::vector<std::byte>, 3> heard_;       ///< waits for the next wake-up, per channel
  std::vector<std::pair<Channel, rx60::Body>> owed_;  ///< requests without a reply so far
};

}  // namespace
}  // namespace ringhook::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using ringhook::fuzz::Dialogue;
  using ringhook::fuzz::Script;
  Dialogue(Script({data, size})).run();
  return 0;
}
