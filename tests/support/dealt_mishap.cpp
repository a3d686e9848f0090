#include "dealt_mishap.h"

#include <vector>

namespace ringhook::test {
namespace {

using Random = std::mt19937_64;

double uniform(Random& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

bool dealToController(Mishap mishap, Rx60Controller& controller, ControllerPort& port) {
  switch (mishap) {
    case Mishap::kEStop:
      controller.pressEStop();
      return true;
    case Mishap::kError:
      controller.setError(40);
      return true;
    case Mishap::kDrivesOff:
      controller.setDrives(false);
      return true;
    case Mishap::kCutMotion:
      port.cut(Rx60Socket::kMotion);
      return true;
    case Mishap::kCutState:
      port.cut(Rx60Socket::kState);
      return true;
    case Mishap::kCutIo:
      port.cut(Rx60Socket::kIo);
      return false;
    case Mishap::kManualMode:
      controller.setPendantMode(rx60::PendantMode::kManual);
      return false;
    default:
      return false;
  }
}

/// Silence in one direction, for a while or for good.
DealtMishap silence(Mishap mishap, ControllerPort& port, Random& random) {
  FaultyLine& feedback = port.toClient(Rx60Socket::kState);
  FaultyLine& commands = port.toController(Rx60Socket::kMotion);
  LineFaults half_open;
  half_open.half_open = true;
  DealtMishap dealt;
  switch (mishap) {
    case Mishap::kStallToClient:
      dealt.stand = MustStand{port.now()};
      dealt.stand->lasts_s = uniform(random, 0.01, 0.5);
      feedback.stall(port.now(), dealt.stand->lasts_s);
      break;
    case Mishap::kStallToController:
      commands.stall(port.now(), uniform(random, 0.01, 0.5));
      dealt.in_flight_s = 0.5;
      break;
    case Mishap::kHalfOpenState:
      feedback.setFaults(half_open);
      dealt.stand = MustStand{port.now()};
      break;
    case Mishap::kHalfOpenMotion:
      commands.setFaults(half_open);
      dealt.stand = MustStand{port.now()};
      break;
    default:
      break;
  }
  return dealt;
}

void lose(Mishap mishap, ControllerPort& port, Random& random) {
  LineFaults faults;
  faults.loss = uniform(random, 0.05, 0.9);
  if (mishap == Mishap::kLostFeedback) {
    port.toClient(Rx60Socket::kState).setFaults(faults);
  } else if (mishap == Mishap::kLostCommands) {
    port.toController(Rx60Socket::kMotion).setFaults(faults);
  }
}

/// Late, jittering, torn or merged in both directions; how late at most [s].
double disturb(Mishap mishap, ControllerPort& port, Random& random) {
  LineFaults faults;
  switch (mishap) {
    case Mishap::kDelay:
      faults.delay = uniform(random, 0.001, 0.04);
      break;
    case Mishap::kJitter:
      faults.jitter = uniform(random, 0.001, 0.03);
      break;
    case Mishap::kSplit:
      faults.split_gap = uniform(random, 0.0005, 0.005);
      break;
    case Mishap::kMerge:
      faults.merge = uniform(random, 0.005, 0.03);
      break;
    default:
      return 0.0;
  }
  for (const Rx60Socket socket : {Rx60Socket::kMotion, Rx60Socket::kState}) {
    port.toClient(socket).setFaults(faults);
    port.toController(socket).setFaults(faults);
  }
  return 0.15;
}

void sayNonsense(Mishap mishap, ControllerPort& port, Random& random) {
  if (mishap == Mishap::kNonsense) {
    std::vector<std::byte> nonsense(static_cast<std::size_t>(uniform(random, 1.0, 200.0)));
    for (std::byte& b : nonsense) {
      b = static_cast<std::byte>(random() & 0xFFU);
    }
    const bool on_state = uniform(random, 0.0, 1.0) < 0.5;
    port.toClient(on_state ? Rx60Socket::kState : Rx60Socket::kMotion).push(nonsense, port.now());
  } else if (mishap == Mishap::kForeignMessage) {
    const rx60::Message feedback{rx60::CommType::kTopic, rx60::ReplyCode::kNone,
                                 rx60::JointFeedback{}};
    port.toClient(Rx60Socket::kMotion).push(rx60::encode(feedback).bytes(), port.now());
  }
}

}  // namespace

DealtMishap dealMishap(Mishap mishap, Rx60Controller& controller, ControllerPort& port,
                       std::mt19937_64& random) {
  DealtMishap dealt = silence(mishap, port, random);
  if (dealToController(mishap, controller, port)) {
    dealt.stand = MustStand{port.now()};
  }
  lose(mishap, port, random);
  dealt.in_flight_s += disturb(mishap, port, random);
  sayNonsense(mishap, port, random);
  return dealt;
}

void mendMishaps(Rx60Controller& controller, ControllerPort& port) {
  controller.releaseEStop();
  controller.setError(0);
  controller.setDrives(true);
  controller.setPendantMode(rx60::PendantMode::kAutomatic);
  controller.refuseNextPoints(0);
  for (const Rx60Socket socket : kRx60Sockets) {
    for (FaultyLine* line : {&port.toClient(socket), &port.toController(socket)}) {
      line->setFaults({});
      line->stall(port.now(), 0.0);
    }
  }
}

}  // namespace ringhook::test
