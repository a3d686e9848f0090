#include "app/simulate.h"

#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/interrupt.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "sim/rx60_mishaps.h"
#include "sim/rx60_server.h"

namespace ringhook {
namespace {

struct SimulateArguments {
  bool arm_only = false;
  Rx60ServerOptions server;
  std::string plant = "kinematic";
  bool no_velocity_addon = false;
  std::vector<std::string> faults;
  std::uint64_t seed = 1;
  double seconds = std::numeric_limits<double>::infinity();
  std::string json;
};

/// The arm, and the cell around it where there is one.
struct SimulatedArm {
  std::unique_ptr<CellWorld> world;
  std::unique_ptr<Rx60Plant> plant;
};

SimulatedArm makeArm(const SimulateArguments& arguments) {
  SimulatedArm arm;
  if (arguments.plant == "cell") {
    CellOptions options;
    options.seed = arguments.seed;
    arm.world = std::make_unique<CellWorld>(options);
    arm.plant = std::make_unique<CellPlant>(*arm.world);
  } else {
    arm.plant = std::make_unique<KinematicPlant>(startingJoints());
  }
  return arm;
}

std::vector<Mishap> mishapsFrom(const SimulateArguments& arguments) {
  std::vector<Mishap> mishaps;
  for (const std::string& text : arguments.faults) {
    mishaps.push_back(parseMishap(text));
  }
  return mishaps;
}

void say(Time now, const std::string& what) {
  std::fprintf(stderr, "%9.3f s  %s\n", now.seconds(), what.c_str());
}

void sayWhere(const Rx60Server& server, const SimulateArguments& arguments) {
  std::string ports;
  for (const Rx60Socket socket : kRx60Sockets) {
    ports += (ports.empty() ? "" : ", ") + std::string(nameOf(socket)) + " " +
             std::to_string(server.port(socket));
  }
  std::fprintf(stderr, "simulated RX60 controller listens on %s, ports %s\n",
               arguments.server.address.c_str(), ports.c_str());
}

nlohmann::ordered_json jsonOf(const std::map<rx60::MessageType, std::int64_t>& messages) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [type, count] : messages) {
    json[rx60::nameOf(type)] = count;
  }
  return json;
}

std::string summaryJson(const Rx60Counts& counts, std::int64_t late_ticks) {
  nlohmann::ordered_json json;
  json["ticks"] = counts.ticks;
  json["tick_s"] = Rx60Controller::kTick;
  json["late_ticks"] = late_ticks;
  json["velocity_ticks"] = counts.velocity_ticks;
  json["missed_ticks"] = counts.missed_ticks;
  json["zero_ticks"] = counts.zero_ticks;
  json["received"] = jsonOf(counts.received);
  json["sent"] = jsonOf(counts.sent);
  json["refused"] = counts.refused;
  json["flushes"] = counts.flushes;
  json["travel_rad"] = counts.travel;
  return json.dump(2) + "\n";
}

void printCount(const std::string& what, std::int64_t count) {
  std::printf("%-42s %10lld\n", what.c_str(), static_cast<long long>(count));
}

void printMessages(const char* verb, const std::map<rx60::MessageType, std::int64_t>& messages) {
  for (const auto& [type, count] : messages) {
    printCount(std::string(verb) + " " + rx60::nameOf(type), count);
  }
}

void printEnd(const Rx60Counts& counts, std::int64_t late_ticks) {
  printCount("controller ticks of 4 ms", counts.ticks);
  printCount("ticks left out, this host was late", late_ticks);
  printCount("ticks in velocity mode", counts.velocity_ticks);
  printCount("of these without a command (missed)", counts.missed_ticks);
  printCount("of these with zero velocity", counts.zero_ticks);
  printMessages("received", counts.received);
  printMessages("sent", counts.sent);
  printCount("refused messages", counts.refused);
  printCount("flushes of unknown input", counts.flushes);
  std::printf("%-42s %10.4f rad\n", "way of the joint that moved most", counts.travel);
}

void runCommand(const SimulateArguments& arguments) {
  if (!arguments.arm_only) {
    throw InputError("simulate: --arm-only is required, since the cameras cannot be served yet");
  }
  const std::vector<Mishap> mishaps = mishapsFrom(arguments);
  // Opened first: a place that cannot be written is found out before the work, not after it.
  std::optional<AtomicFile> summary;
  if (!arguments.json.empty()) {
    summary.emplace(arguments.json);
  }
  const SimulatedArm arm = makeArm(arguments);
  Rx60Controller controller(*arm.plant, {.velocity_addon = !arguments.no_velocity_addon});
  Rx60ServerOptions options = arguments.server;
  options.seed = arguments.seed;
  Rx60Server server(controller, options);
  MishapScript script(mishaps, controller, server);
  server.onEvent(say);
  server.onTick([&script](Time now) {
    for (const std::string& event : script.tick(now)) {
      say(now, event);
    }
  });
  sayWhere(server, arguments);
  server.run(interruptRequested(), arguments.seconds);
  printEnd(controller.counts(), server.lateTicks());
  if (summary) {
    summary->stream() << summaryJson(controller.counts(), server.lateTicks());
    summary->commit();
  }
}

void addNetworkOptions(CLI::App& command, Rx60ServerOptions& server) {
  command.add_option("--address", server.address, "Where to listen; default 127.0.0.1")
      ->type_name("A")
      ->check(CLI::ValidIPV4);
  for (const Rx60Socket socket : kRx60Sockets) {
    const auto index = static_cast<std::size_t>(socket);
    command
        .add_option("--" + std::string(nameOf(socket)) + "-port", server.ports.at(index),
                    "0 takes a free one; default " + std::to_string(server.ports.at(index)))
        ->type_name("N");
  }
}

}  // namespace

void addSimulateCommand(CLI::App& app) {
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command =
      app.add_subcommand("simulate", "Serves the simulated cell's devices to clients on a network");
  command->footer(
      "Example: ringhook simulate --arm-only --fault e-stop@10:2 --fault jitter@20\n"
      "Faults: e-stop, error, drives-off, delay, jitter, loss, split, merge, stall, half-open,\n"
      "refuse-points, cut. SECONDS since the start, DURATION in seconds, for good without.\n"
      "Serves until Ctrl-C, or for --seconds, and then tells what it saw.");
  command->add_flag("--arm-only", arguments->arm_only,
                    "The RX60's controller on TCP, without cameras");
  addNetworkOptions(*command, arguments->server);
  command
      ->add_option("--plant", arguments->plant,
                   "What the controller drives: an arm without masses, or the cell's physics")
      ->check(CLI::IsMember({"kinematic", "cell"}));
  command->add_flag("--no-velocity-addon", arguments->no_velocity_addon,
                    "A controller that knows points but no velocities");
  command->add_option("--fault", arguments->faults, "What goes wrong when; may be given again")
      ->type_name("NAME@SECONDS[:DURATION]");
  command->add_option("--seed", arguments->seed, "Of everything random")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--seconds", arguments->seconds, "How long to serve; default until Ctrl-C")
      ->type_name("S")
      ->check(CLI::PositiveNumber);
  command->add_option("--json", arguments->json, "Write what it saw here")->type_name("FILE");
  command->callback([arguments] { runCommand(*arguments); });
}

}  // namespace ringhook
