#include "robot/rx60/rx60_arm.h"

#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"

namespace ringhook {
namespace {

using rx60::LinkState;

// How long a wait may last before time-outs are looked at again [s].
constexpr double kLookAgain = 0.002;

}  // namespace

Rx60Arm::Rx60Arm(std::unique_ptr<rx60::LinkPort> port, const rx60::LinkSettings& settings,
                 Runs runs, Needs needs)
    : port_(std::move(port)), link_(settings), runs_(runs) {
  if (runs_ == Runs::kOnItsOwnThread) {
    thread_ = std::thread([this] { run(); });
  }
  try {
    Lock lock(mutex_);
    awaitReady(lock, needs);
  } catch (...) {
    end();
    throw;
  }
}

Rx60Arm::~Rx60Arm() { end(); }

void Rx60Arm::end() noexcept {
  stop();
  if (thread_.joinable()) {
    {
      const Lock lock(mutex_);
      ending_ = true;
    }
    thread_.join();
  }
  port_->close();
}

// ---- one wake-up

void Rx60Arm::run() noexcept {
  const RaisedPriority raised(kLinkRank);
  priority_ = raised.reached();
  Lock lock(mutex_);
  while (!ending_) {
    try {
      turn(lock);
    } catch (const std::exception& e) {
      if (!lock.owns_lock()) {
        lock.lock();
      }
      link_.lost(std::string("the link failed: ") + e.what(), port_->now());
      served_.notify_all();
    }
  }
}

void Rx60Arm::turn(Lock& lock) {
  if (link_.wantsOpen()) {
    open(lock);
  }
  lock.unlock();
  port_->wait(port_->now() + kLookAgain);
  lock.lock();
  serve();
  ++turns_;
  served_.notify_all();
}

void Rx60Arm::open(Lock& lock) {
  std::string failure;
  lock.unlock();  // connecting takes time, and stop() must not wait for it
  try {
    port_->open();
  } catch (const DeviceError& e) {
    failure = e.what();
    failure.erase(failure.find_last_not_of('.') + 1);  // it goes into a sentence of the fault
  }
  lock.lock();
  if (failure.empty()) {
    link_.opened(port_->now());
  } else {
    link_.lost(failure, port_->now());
  }
}

void Rx60Arm::serve() {
  const Time now = port_->now();
  for (const rx60::Channel channel : rx60::kChannels) {
    readAll(channel, now);
  }
  link_.pass(now);
  flush();
  closeIfUseless();
}

/// A closed connection stops the arm even if commands are still on their way. Only for the thread
/// that waits on the port.
void Rx60Arm::closeIfUseless() {
  if (link_.wantsClose()) {
    port_->close();
    link_.closed();
  }
}

void Rx60Arm::readAll(rx60::Channel channel, Time now) {
  while (link_.open()) {
    const std::optional<std::size_t> count = port_->read(channel, link_.room(channel));
    if (!count) {
      link_.lost(std::string("the controller closed the ") + nameOf(channel) + " connection", now);
    } else if (*count == 0) {
      return;
    } else {
      link_.received(channel, *count, now);
    }
  }
}

void Rx60Arm::flush() {
  while (const std::optional<rx60::Link::Outgoing> out = link_.takeOutgoing()) {
    if (!port_->write(out->channel, out->frame.bytes()) && link_.open()) {
      link_.lost(std::string("the controller takes nothing more on the ") + nameOf(out->channel) +
                     " connection",
                 port_->now());
    }
  }
}

template <class Done>
void Rx60Arm::waitUntil(Lock& lock, Done done) {
  if (runs_ == Runs::kOnItsOwnThread) {
    served_.wait(lock, done);
  } else {
    while (!done()) {
      turn(lock);
    }
  }
}

// ---- the interface

void Rx60Arm::awaitReady(Lock& lock, Needs needs) {
  waitUntil(lock, [this] {
    return !link_.wantsOpen() && link_.state() != LinkState::kDisconnected &&
           link_.state() != LinkState::kAwaitState && link_.state() != LinkState::kStopping;
  });
  const bool streams = link_.open() && needs == Needs::kState;
  if (link_.state() == LinkState::kFault && !streams) {
    throw DeviceError("The RX60 is not ready: " + link_.report().last_fault + ".");
  }
}

ArmState Rx60Arm::waitState() {
  Lock lock(mutex_);
  const auto fresh = [this] {
    const Time newest = link_.report().arm.time;
    return link_.open() && (!any_given_ || newest > given_);
  };
  waitUntil(lock, [&] { return link_.state() == LinkState::kFault || fresh(); });
  if (link_.state() == LinkState::kFault) {
    throw DeviceError("The RX60 stopped: " + link_.report().last_fault + ".");
  }
  any_given_ = true;
  given_ = link_.report().arm.time;
  return link_.report().arm;
}

void Rx60Arm::commandVelocity(const JointVector& joint_velocity) {
  const Lock lock(mutex_);
  if (!link_.armed()) {
    throw DeviceError("The arm is stopped and accepts no motion until it is rearmed.");
  }
  if (link_.state() == LinkState::kMoving) {
    refuse("a velocity was commanded during a coarse move");
  }
  if (!joint_velocity.allFinite()) {
    refuse("a joint velocity is not a finite number");
  }
  const JointVector& limit = link_.settings().limiter.limits.velocity;
  for (int i = 0; i < 6; ++i) {
    if (std::abs(joint_velocity[i]) > limit[i]) {
      refuse("J" + std::to_string(i + 1) + " was commanded " + std::to_string(joint_velocity[i]) +
             " rad/s, its limit is " + std::to_string(limit[i]) + " rad/s");
    }
  }
  link_.setTarget(joint_velocity, port_->now());
}

void Rx60Arm::refuse(const std::string& why) {
  link_.refuse(why, port_->now());
  flush();
  throw DeviceError("The arm refused a command and stopped: " + why + ".");
}

void Rx60Arm::stop() noexcept {
  try {
    const Lock lock(mutex_);
    link_.stop(port_->now());
    flush();
    if (runs_ == Runs::kInWaitState) {
      closeIfUseless();
    }
  } catch (...) {
    // Nothing is left to try: the controller zeroes a velocity that is not renewed.
    return;
  }
}

void Rx60Arm::rearm() {
  Lock lock(mutex_);
  // The status at hand may be older than what the operator has just mended.
  const std::int64_t before = link_.report().statuses;
  waitUntil(lock, [&] { return !link_.open() || link_.report().statuses != before; });
  const Outcome<bool> done = link_.rearm(port_->now());
  if (!done) {
    throw DeviceError("The RX60 cannot be re-armed: " + done.reason() + ".");
  }
  flush();
  awaitReady(lock, Needs::kMotion);
}

double Rx60Arm::commandDelay() const { return 2.0 * link_.settings().limiter.period_s; }

void Rx60Arm::setGripper(bool closed) {
  const Lock lock(mutex_);
  link_.setGripper(closed, port_->now());
  flush();
}

void Rx60Arm::startMove(std::vector<rx60::JointPoint> points) {
  const Lock lock(mutex_);
  const Outcome<std::size_t> checked = checkPoints(points, link_.settings().limiter.limits);
  if (!checked) {
    throw InputError("The move is refused: " + checked.reason() + ".");
  }
  const Outcome<std::size_t> started = link_.move(std::move(points), port_->now());
  if (!started) {
    throw DeviceError("The move is refused: " + started.reason() + ".");
  }
}

bool Rx60Arm::moving() const {
  const Lock lock(mutex_);
  return link_.state() == LinkState::kMoving;
}

void Rx60Arm::awaitNews() {
  Lock lock(mutex_);
  const std::int64_t before = turns_;
  waitUntil(lock, [&] { return turns_ != before; });
}

rx60::LinkReport Rx60Arm::report() const {
  const Lock lock(mutex_);
  return link_.report();
}

}  // namespace ringhook
