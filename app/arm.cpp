#include "app/arm.h"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "app/interrupt.h"
#include "app/options.h"
#include "core/angle.h"
#include "core/error.h"
#include "robot/rx60/drive_power.h"
#include "robot/rx60/rx60_arm.h"
#include "robot/rx60/tcp_port.h"

namespace ringhook {
namespace {

constexpr double kPeriod = 0.004;  // between states [s]

struct ArmArguments {
  rx60::ControllerAddress address;
  double seconds = 5.0;
  std::vector<double> to_deg;
  double speed = 0.05;
  int joint = 6;
  double speed_deg_s = 2.0;
  std::string gripper;
  std::string power;
  int gripper_module = 2;
  int gripper_pin = 0;
  bool yes = false;
};

rx60::LinkSettings settingsFrom(const ArmArguments& arguments) {
  rx60::LinkSettings settings;
  settings.gripper_module = arguments.gripper_module;
  settings.gripper_pin = arguments.gripper_pin;
  return settings;
}

std::unique_ptr<Rx60Arm> connect(const ArmArguments& arguments, Rx60Arm::Needs needs) {
  std::fprintf(stderr, "connecting to the controller at %s ...\n", arguments.address.host.c_str());
  return std::make_unique<Rx60Arm>(std::make_unique<rx60::TcpPort>(arguments.address),
                                   settingsFrom(arguments), Rx60Arm::Runs::kOnItsOwnThread, needs);
}

std::string inWords(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

std::string inDegrees(const JointVector& joints) {
  std::string text;
  for (int i = 0; i < 6; ++i) {
    char number[32];
    std::snprintf(number, sizeof number, "%s%.2f", i == 0 ? "" : " ", joints[i] / kDegree);
    text += number;
  }
  return text;
}

const char* nameOf(rx60::PendantMode mode) {
  switch (mode) {
    case rx60::PendantMode::kManual:
      return "manual";
    case rx60::PendantMode::kAutomatic:
      return "automatic";
    case rx60::PendantMode::kUnknown:
      break;
  }
  return "unknown mode";
}

void print(const rx60::LinkReport& report) {
  std::printf("%-12s host time %.3f s   joints %s deg   %s deg/s\n", rx60::nameOf(report.state),
              report.now.seconds(), inDegrees(report.arm.position).c_str(),
              inDegrees(report.arm.velocity).c_str());
  std::printf(
      "             %s, drives %s; period %.3f ms, jitter %.3f ms, longest gap %.1f ms, "
      "missed %lld of %lld\n",
      nameOf(report.status.mode), report.status.drives_powered != 0 ? "on" : "off",
      1e3 * report.arrivals.period_s, 1e3 * report.arrivals.jitter_s,
      1e3 * report.arrivals.worst_gap_s, static_cast<long long>(report.arrivals.missed_cycles),
      static_cast<long long>(report.arrivals.feedbacks));
  if (report.commands > 0) {
    std::printf(
        "             %lld velocities sent, the last one %.1f ms after it was wanted; %lld "
        "feedbacks drained, %lld commands left out\n",
        static_cast<long long>(report.commands), 1e3 * report.command_age_s,
        static_cast<long long>(report.drained), static_cast<long long>(report.left_out));
  }
  if (!report.last_fault.empty()) {
    std::printf("             last fault: %s\n", report.last_fault.c_str());
  }
  std::fflush(stdout);
}

void throwIfInterrupted() {
  if (interruptRequested().load()) {
    throw Interrupted("stopped by the operator; the arm stands still");
  }
}

/// The person at the keyboard must have said yes to motion.
void confirm(const ArmArguments& arguments, const std::string& what) {
  if (arguments.yes) {
    return;
  }
  std::fprintf(stderr, "%s\nIs everybody out of reach? Type yes: ", what.c_str());
  std::string answer;
  std::getline(std::cin, answer);
  if (answer != "yes") {
    throw Interrupted("not confirmed: nothing was moved");
  }
}

/// States until `seconds` have passed or `more` says no; Ctrl-C stops the arm.
template <class More>
void follow(Rx60Arm& arm, double seconds, More more) {
  const Time begin = arm.waitState().time;
  for (Time time = begin; time - begin < seconds && more();) {
    throwIfInterrupted();
    time = arm.waitState().time;
  }
}

void watch(const ArmArguments& arguments) {
  const std::unique_ptr<Rx60Arm> arm = connect(arguments, Rx60Arm::Needs::kState);
  const Time begin = arm->report().now;
  for (int second = 0; second < arguments.seconds; ++second) {
    print(arm->report());
    while (arm->report().now - begin < second + 1) {
      throwIfInterrupted();
      arm->awaitNews();
    }
  }
}

void move(const ArmArguments& arguments) {
  JointVector goal;
  for (int i = 0; i < 6; ++i) {
    goal[i] = arguments.to_deg.at(static_cast<std::size_t>(i)) * kDegree;
  }
  const std::vector<rx60::JointPoint> points = {{goal, arguments.speed}};
  if (const Outcome<std::size_t> checked = checkPoints(points, rx60::limits()); !checked) {
    throw InputError("arm move: --to-deg: " + checked.reason());
  }
  const std::unique_ptr<Rx60Arm> arm = connect(arguments, Rx60Arm::Needs::kMotion);
  print(arm->report());
  confirm(arguments, "The arm will move to " + inDegrees(goal) + " deg with " +
                         std::to_string(static_cast<int>(std::lround(100 * arguments.speed))) +
                         " % of its nominal speed.");
  arm->startMove(points);
  follow(*arm, 3600.0, [&] { return arm->moving(); });
  print(arm->report());
}

void jog(const ArmArguments& arguments) {
  const std::unique_ptr<Rx60Arm> arm = connect(arguments, Rx60Arm::Needs::kMotion);
  print(arm->report());
  confirm(arguments, "Joint " + std::to_string(arguments.joint) + " will turn with " +
                         inWords(arguments.speed_deg_s) + " deg/s for " +
                         inWords(arguments.seconds) + " s.");
  JointVector velocity = JointVector::Zero();
  follow(*arm, arguments.seconds, [&] {
    velocity[arguments.joint - 1] = arguments.speed_deg_s * kDegree;
    arm->commandVelocity(velocity);
    return true;
  });
  const rx60::LinkReport report = arm->report();
  arm->stop();
  print(report);
}

void gripper(const ArmArguments& arguments) {
  const std::unique_ptr<Rx60Arm> arm = connect(arguments, Rx60Arm::Needs::kState);
  arm->setGripper(arguments.gripper == "close");
  follow(*arm, 100 * kPeriod, [] { return true; });  // a refusal would have come by then
  std::printf("output %d of module %d is set: gripper %s\n", arguments.gripper_pin,
              arguments.gripper_module, arguments.gripper == "close" ? "closed" : "open");
}

void power(const ArmArguments& arguments) {
  rx60::setDrivePower(arguments.address, arguments.power == "on");
  std::printf("the controller was told to switch its drives %s; watch tells whether it did\n",
              arguments.power.c_str());
}

void addAddress(CLI::App& command, ArmArguments& arguments) {
  rx60::ControllerAddress& address = arguments.address;
  command.add_option("--address", address.host, "Of the controller; default 127.0.0.1")
      ->type_name("HOST");
  command.add_option("--motion-port", address.motion_port, "Default 11000")->type_name("N");
  command.add_option("--system-port", address.system_port, "Default 11001")->type_name("N");
  command.add_option("--state-port", address.state_port, "Default 11002")->type_name("N");
  command.add_option("--io-port", address.io_port, "Default 11003")->type_name("N");
}

CLI::App& addStep(CLI::App& parent, const std::shared_ptr<ArmArguments>& arguments,
                  const std::string& name, const std::string& what, const std::string& example,
                  void (*run)(const ArmArguments&)) {
  CLI::App& step = addCommand(
      parent, name, what, "Example: ringhook arm " + name + " --address 192.168.0.254" + example);
  addAddress(step, *arguments);
  step.callback([arguments, run] { run(*arguments); });
  return step;
}

void addState(CLI::App& step, std::string& state, const std::string& one,
              const std::string& other) {
  step.add_option("state", state, one + " or " + other)
      ->required()
      ->check(CLI::IsMember({one, other}));
}

void addSeconds(CLI::App& step, ArmArguments& arguments, const CLI::Validator& permitted) {
  step.add_option("--seconds", arguments.seconds, "How long; default 5")->check(permitted);
}

void addWithoutAsking(CLI::App& step, ArmArguments& arguments) {
  step.add_flag("--yes", arguments.yes, "Do not ask before the arm moves");
}

void addMove(CLI::App& arm, const std::shared_ptr<ArmArguments>& arguments) {
  CLI::App& step = addStep(arm, arguments, "move", "Moves to joint angles, as a trajectory point",
                           " --to-deg 0,0,90,0,90,0 --speed 0.05", move);
  step.add_option("--to-deg", arguments->to_deg, "Six joint angles [deg]")
      ->required()
      ->delimiter(',')
      ->expected(6)
      ->type_name("J1,...,J6");
  step.add_option("--speed", arguments->speed, "Share of the nominal joint speeds; default 0.05")
      ->check(CLI::Range(0.001, 1.0));
  addWithoutAsking(step, *arguments);
}

void addJog(CLI::App& arm, const std::shared_ptr<ArmArguments>& arguments) {
  CLI::App& step = addStep(arm, arguments, "jog", "Turns one joint by velocity commands",
                           " --joint 6 --speed-deg-s 2 --seconds 3", jog);
  step.add_option("--joint", arguments->joint, "1 to 6; default 6")->check(CLI::Range(1, 6));
  step.add_option("--speed-deg-s", arguments->speed_deg_s, "Default 2")
      ->check(CLI::Range(-20.0, 20.0));
  addSeconds(step, *arguments, CLI::Range(0.1, 60.0));
  addWithoutAsking(step, *arguments);
}

void addGripper(CLI::App& arm, const std::shared_ptr<ArmArguments>& arguments) {
  CLI::App& step =
      addStep(arm, arguments, "gripper", "Opens or closes the gripper", " open", gripper);
  addState(step, arguments->gripper, "open", "close");
  step.add_option("--module", arguments->gripper_module,
                  "I/O module of the VAL3 server; default 2");
  step.add_option("--pin", arguments->gripper_pin, "Output of the module; default 0");
}

}  // namespace

void addArmCommand(CLI::App& app) {
  auto arguments = std::make_shared<ArmArguments>();
  CLI::App& arm = addCommand(app, "arm", "Looks at an RX60 and moves it by hand",
                             "Example: ringhook arm watch --address 192.168.0.254");
  arm.require_subcommand(1);
  addSeconds(addStep(arm, arguments, "watch", "Tells state, link health and faults", "", watch),
             *arguments, CLI::PositiveNumber);
  addState(addStep(arm, arguments, "power", "Switches the drives on or off", " on", power),
           arguments->power, "on", "off");
  addMove(arm, arguments);
  addJog(arm, arguments);
  addGripper(arm, arguments);
}

}  // namespace ringhook
