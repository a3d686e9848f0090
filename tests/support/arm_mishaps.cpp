#include "arm_mishaps.h"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <random>

#include "core/error.h"
#include "dealt_mishap.h"
#include "robot/rx60/rx60_arm.h"
#include "wire_watch.h"

namespace ringhook::test {
namespace {

constexpr double kVisionPeriod = 0.020;  // [s]
constexpr double kLatestTarget = 0.250;  // a target this old no longer acts [s]

class Episode {
 public:
  Episode(std::uint64_t seed, MishapResult& result);
  void run(int mishaps);

 private:
  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }
  [[nodiscard]] Time now() const { return wire_->now(); }

  void connect();
  void onTick(Time time);
  void serve(double seconds, bool silent = false);
  void deal(Mishap mishap);
  void misuse(Mishap mishap);
  void endStand();
  void bringBack();
  void tryMove();
  void revoke();
  void fault();
  void violation(const std::string& what);

  std::uint64_t seed_;
  std::mt19937_64 random_;
  MishapResult& result_;
  KinematicPlant plant_{JointVector{{0.3, 0.4, 0.9, -0.2, 0.8, 0.1}}};
  Rx60Controller controller_{plant_};
  WireWatch* wire_ = nullptr;
  std::unique_ptr<Rx60Arm> arm_;
  Mishap mishap_ = Mishap::kCount;  ///< the present one
  MishapTally* tally_ = nullptr;

  bool permitted_ = true;     ///< to move
  Time revoked_;              ///< when that ended
  double in_flight_s_ = 0.0;  ///< how late a command may still arrive
  std::optional<MustStand> stand_;
  double phase_ = 0.0;     ///< of the targets [rad]
  bool violated_ = false;  ///< told once for each mishap
};

Episode::Episode(std::uint64_t seed, MishapResult& result)
    : seed_(seed), random_(seed), result_(result) {
  phase_ = uniform(0.0, 6.28);
}

void Episode::violation(const std::string& what) {
  result_.violations.push_back("seed " + std::to_string(seed_) + ", " +
                               std::to_string(now().seconds()) + " s, after " + nameOf(mishap_) +
                               ": " + what);
}

void Episode::connect() {
  auto port = std::make_unique<ControllerPort>(controller_, plant_, Time(), seed_);
  port->onTick([this](Time time) { onTick(time); });
  auto wire = std::make_unique<WireWatch>(std::move(port));
  wire_ = wire.get();
  arm_ =
      std::make_unique<Rx60Arm>(std::move(wire), rx60::LinkSettings(), Rx60Arm::Runs::kInWaitState);
}

void Episode::onTick(Time time) {
  if (controller_.commandedVelocity().isZero(0.0)) {
    return;
  }
  if (!permitted_ && time - revoked_ > kStopWithin + in_flight_s_ && !violated_) {
    violated_ = true;
    violation("the arm is told to move without a re-arm");
  }
  if (stand_ && time > stand_->since && time - stand_->since < stand_->lasts_s) {
    stand_->longest_s = time - stand_->since;
    if (stand_->longest_s > stand_->grace_s && !violated_) {
      violated_ = true;
      violation("the commanded speed is not zero in time");
    }
  }
}

void Episode::revoke() {
  if (permitted_) {
    permitted_ = false;
    revoked_ = now();
  }
}

void Episode::serve(double seconds, bool silent) {
  const Time end = now() + seconds;
  Time next_target = now();
  try {
    while (now() < end) {
      const ArmState state = arm_->waitState();
      if (!silent && permitted_ && state.time >= next_target) {
        next_target = next_target + kVisionPeriod;
        const double t = now().seconds();
        JointVector target;
        for (int i = 0; i < 6; ++i) {
          target[i] = (0.2 + 0.05 * i) * std::sin((1.0 + 0.3 * i) * t + phase_ + i);
        }
        arm_->commandVelocity(target);
      }
    }
  } catch (const DeviceError&) {
    fault();
  }
}

/// The client stopped with a reason.
void Episode::fault() {
  tally_->client_faults += permitted_ ? 1 : 0;
  revoke();
}

void Episode::misuse(Mishap mishap) {
  JointVector bad = JointVector::Zero();
  try {
    switch (mishap) {
      case Mishap::kNotANumber:
        bad[1] = chance(0.5) ? std::nan("") : std::numeric_limits<double>::infinity();
        arm_->commandVelocity(bad);
        break;
      case Mishap::kTooFast:
        bad[2] = 99.0;
        arm_->commandVelocity(bad);
        break;
      case Mishap::kOperatorStop:
        revoke();
        arm_->stop();
        return;
      default:
        return;
    }
    violation("a bad command was accepted");
  } catch (const DeviceError&) {
    revoke();
  }
}

void Episode::endStand() {
  if (stand_) {
    tally_->longest_to_zero_s = std::max(tally_->longest_to_zero_s, stand_->longest_s);
    stand_.reset();
  }
}

/// A coarse move with some refusals.
void Episode::tryMove() {
  if (!permitted_) {
    return;
  }
  serve(0.6, true);  // leaves velocity mode
  controller_.refuseNextPoints(static_cast<int>(uniform(0.0, 6.0)));
  const JointVector start = plant_.position();
  try {
    arm_->startMove({{start + JointVector::Constant(0.02), 0.2}, {start, 0.4}});
    const Time end = now() + 8.0;
    while (arm_->moving() && now() < end) {
      static_cast<void>(arm_->waitState());
    }
    if (arm_->moving()) {
      violation("a coarse move does not end");
    }
  } catch (const DeviceError&) {
    fault();
  }
}

void Episode::deal(Mishap mishap) {
  ControllerPort& port = wire_->port();
  DealtMishap dealt = dealMishap(mishap, controller_, port, random_);
  stand_ = dealt.stand;
  in_flight_s_ = dealt.in_flight_s;
  misuse(mishap);
  switch (mishap) {
    case Mishap::kSilentVision:
      stand_ = MustStand{now(), kLatestTarget + kStopWithin};
      serve(0.5, true);
      endStand();
      break;
    case Mishap::kRefusedPoints:
      tryMove();
      break;
    case Mishap::kReconnectStorm:
      port.cut(chance(0.5) ? Rx60Socket::kState : Rx60Socket::kMotion);
      port.refuseOpening(static_cast<int>(uniform(0.0, 4.0)));
      break;
    default:
      break;
  }
}

/// Lets the stopped arm be looked at for a while, then asks for permission until it is given.
void Episode::bringBack() {
  if (!permitted_) {
    const double idle = uniform(0.05, 0.4);
    serve(idle, true);
    wire_->wait(now() + uniform(0.0, 0.1));  // the program may also not come back at once
  }
  for (int tries = 0; !permitted_; ++tries) {
    if (tries == 10) {
      violation("the arm does not come back after ten attempts");
      return;
    }
    // Whatever happens within rearm() after the permission is motion with permission; before its
    // end nothing has been asked for.
    try {
      arm_->rearm();
      permitted_ = true;
      ++result_.rearms;
    } catch (const DeviceError&) {
      wire_->wait(now() + 0.05);
    }
  }
}

void Episode::run(int mishaps) {
  ++result_.episodes;
  connect();
  wire_->setPatience(Time::fromSeconds(30.0 * mishaps + 30.0));
  for (int k = 0; k < mishaps; ++k) {
    mishap_ = static_cast<Mishap>(random_() % static_cast<unsigned>(Mishap::kCount));
    tally_ = &result_.tallies[mishap_];
    ++tally_->dealt;
    violated_ = false;
    in_flight_s_ = 0.0;
    serve(uniform(0.1, 0.6));
    deal(mishap_);
    if (mishap_ != Mishap::kRefusedPoints) {
      serve(uniform(0.05, 0.8));
    }
    endStand();
    mendMishaps(controller_, wire_->port());
    bringBack();
    if (!permitted_) {
      break;
    }
  }
  result_.virtual_s += now().seconds();
  result_.commands += wire_->commands();
  for (const std::string& what : wire_->violations()) {
    violation(what);
  }
}

}  // namespace

const char* nameOf(Mishap mishap) {
  static constexpr std::array<const char*, static_cast<std::size_t>(Mishap::kCount)> kNames = {
      "e-stop",       "error",        "drives off",      "motion cut",       "state cut",
      "IO cut",       "state stalls", "commands stall",  "motion half-open", "state half-open",
      "delay",        "jitter",       "lost feedback",   "lost commands",    "split",
      "merged",       "nonsense",     "foreign message", "manual mode",      "silent vision",
      "not a number", "too fast",     "operator's stop", "refused points",   "reconnect storm"};
  return kNames.at(static_cast<std::size_t>(mishap));
}

void runMishaps(std::uint64_t seed, int mishaps, MishapResult& result) {
  Episode episode(seed, result);
  try {
    episode.run(mishaps);
  } catch (const std::exception& e) {
    result.violations.push_back("seed " + std::to_string(seed) + ": unexpected: " + e.what());
  }
}

}  // namespace ringhook::test
