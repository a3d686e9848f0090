// The simulated controller under clients and operators who do anything: what it sends decodes, the
// arm stays finite, within its joints' ranges and speeds, and stands without drives.

#include <cmath>

#include "fuzz/random_message.h"
#include "robot/rx60/kinematics.h"
#include "sim/rx60_controller.h"

namespace ringhook::fuzz {
namespace {

constexpr int kMostTicks = 700;  // an input ends there

Rx60ControllerOptions optionsOf(Script& script) {
  Rx60ControllerOptions options;
  options.velocity_addon = script.byte() % 8 != 7;
  options.switch_ticks = 1 + static_cast<int>(script.choice(8));
  return options;
}

class Cabinet {
 public:
  explicit Cabinet(Script script) : script_(script), controller_(plant_, optionsOf(script_)) {}

  void run() {
    while (!script_.over() && ticks_ < kMostTicks) {
      step();
    }
    tick(1);
  }

 private:
  void step() {
    switch (script_.choice(8)) {
      case 0:
        return controller_.connect(anySocket());
      case 1:
        return controller_.disconnect(anySocket());
      case 2: {
        const Rx60Socket socket = anySocket();
        return controller_.receive(socket, script_.raw(script_.byte()));
      }
      case 3: {
        const Rx60Socket socket = anySocket();
        return controller_.receive(socket, damagedFrame(script_));
      }
      case 4:
        return tick(1 + static_cast<int>(script_.choice(16)));
      case 5:
        return tick(260);
      case 6:
        return operate();
      default: {
        const Rx60Socket socket = anySocket();
        return controller_.receive(socket, encode(scriptedMessage(script_)).bytes());
      }
    }
  }

  void operate() {
    switch (script_.choice(6)) {
      case 0:
        return controller_.pressEStop();
      case 1:
        return controller_.releaseEStop();
      case 2:
        return controller_.setDrives(script_.byte() % 4 != 0);
      case 3:
        return controller_.setError(script_.byte() % 2);
      case 4:
        return controller_.setPendantMode(rx60::PendantMode::kManual);
      default:
        return controller_.refuseNextPoints(script_.byte());
    }
  }

  Rx60Socket anySocket() { return kRx60Sockets.at(script_.choice(kRx60Sockets.size())); }

  void tick(int count) {
    for (int i = 0; i < count; ++i) {
      controller_.tick(Time::fromSeconds(Rx60Controller::kTick * ++ticks_));
      look();
    }
  }

  void look() {
    static const JointLimits limits = rx60::limits();
    const JointVector q = plant_.position();
    require(q.allFinite() && (q.array() >= limits.lower.array()).all() &&
                (q.array() <= limits.upper.array()).all(),
            "the arm stays within its joints' ranges");
    const JointVector v = controller_.commandedVelocity();
    require(v.allFinite() && (v.cwiseAbs().array() <= limits.velocity.array() * (1.0 + 1e-6)).all(),
            "the arm keeps its joints' speeds");
    require(controller_.drivesOn() || v.isZero(0.0), "the arm stands without drives");
    require(controller_.waitingPoints() <= Rx60Controller::kQueueDepth, "ten points may wait");
    for (const Rx60Socket socket : kRx60Sockets) {
      const std::vector<rx60::Frame> frames = controller_.takeOutput(socket);
      require(frames.empty() || controller_.connected(socket), "only those connected are told");
      for (const rx60::Frame& frame : frames) {
        require(rx60::decode(frame.bytes()).hasValue(), "every frame sent decodes");
      }
    }
  }

  Script script_;
  KinematicPlant plant_;
  Rx60Controller controller_;
  int ticks_ = 0;
};

}  // namespace
}  // namespace ringhook::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using ringhook::fuzz::Cabinet;
  using ringhook::fuzz::Script;
  Cabinet(Script({data, size})).run();
  return 0;
}
