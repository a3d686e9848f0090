#include "app/simulate.h"

#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/controller_report.h"
#include "app/interrupt.h"
#include "app/options.h"
#include "app/simulate_cell.h"
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
  double seconds = std::numeric_limits<double>::infinity();
  std::string json;
  CellJob cell;
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
    options.seed = arguments.cell.seed;
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

nlohmann::ordered_json serveArm(const SimulateArguments& arguments) {
  const SimulatedArm arm = makeArm(arguments);
  Rx60Controller controller(*arm.plant, {.velocity_addon = !arguments.no_velocity_addon});
  Rx60ServerOptions options = arguments.server;
  options.seed = arguments.cell.seed;
  Rx60Server server(controller, options);
  MishapScript script(arguments.cell.mishaps, controller, server);
  server.onEvent(sayEvent);
  server.onTick([&script](Time now) {
    for (const std::string& event : script.tick(now)) {
      sayEvent(now, event);
    }
  });
  sayWhere(server, options.address);
  server.run(interruptRequested(), arguments.seconds);
  printController(controller.counts(), server.lateTicks());
  return controllerJson(controller.counts(), server.lateTicks());
}

void runCommand(SimulateArguments arguments) {
  if (arguments.arm_only == !arguments.cell.cell.empty()) {
    throw InputError("simulate: give either --cell FILE, for a whole cell, or --arm-only");
  }
  arguments.cell.mishaps = mishapsFrom(arguments);
  arguments.cell.seconds = arguments.seconds;
  // Opened first: a place that cannot be written is found out before the work, not after it.
  JsonFile summary(arguments.json);
  const nlohmann::ordered_json seen =
      arguments.arm_only ? serveArm(arguments) : serveCell(arguments.cell);
  summary.commit(seen.dump(2) + "\n");
}

void addArmOptions(CLI::App& command, SimulateArguments& arguments) {
  Rx60ServerOptions& server = arguments.server;
  command
      .add_flag("--arm-only", arguments.arm_only, "The RX60's controller on TCP, without cameras")
      ->group("Arm only");
  command.add_option("--address", server.address, "Where to listen; default 127.0.0.1")
      ->type_name("A")
      ->check(CLI::ValidIPV4)
      ->group("Arm only");
  for (const Rx60Socket socket : kRx60Sockets) {
    const auto index = static_cast<std::size_t>(socket);
    command
        .add_option("--" + std::string(nameOf(socket)) + "-port", server.ports.at(index),
                    "0 takes a free one; default " + std::to_string(server.ports.at(index)))
        ->type_name("N")
        ->group("Arm only");
  }
  command
      .add_option("--plant", arguments.plant,
                  "What the controller drives: an arm without masses, or the cell's physics")
      ->check(CLI::IsMember({"kinematic", "cell"}))
      ->group("Arm only");
  command
      .add_flag("--no-velocity-addon", arguments.no_velocity_addon,
                "A controller that knows points but no velocities")
      ->group("Arm only");
}

void addCellOptions(CLI::App& command, CellJob& cell) {
  const char* group = "Whole cell";
  command
      .add_option("--cell", cell.cell,
                  "Cell file with devices on a network: says where to serve, and what scenario")
      ->type_name("FILE")
      ->group(group);
  command.add_option("--scenario", cell.scenario, "Another scenario of that folder, by name")
      ->type_name("NAME")
      ->group(group);
  command.add_option("--hooks", cell.hooks, "Hooks on the belt, with a ring each")
      ->check(CLI::Range(1, 100))
      ->group(group);
  command
      .add_flag("--belt-parked", cell.belt_parked,
                "The belt stands still and empty, as for calibrating")
      ->excludes("--hooks")
      ->group(group);
  command
      .add_option("--lost-packets", cell.lost_packets,
                  "Share of the cameras' packets that are lost on the way")
      ->type_name("SHARE")
      ->check(CLI::Range(0.0, 1.0))
      ->group(group);
  command.add_option("--truth", cell.truth, "Write what really happens into this folder")
      ->type_name("DIR")
      ->group(group);
}

}  // namespace

void addSimulateCommand(CLI::App& app) {
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command =
      app.add_subcommand("simulate", "Serves the simulated cell's devices to clients on a network");
  command->footer(
      "Example: app/own-network build/release/ringhook simulate --cell "
      "app/config/cell-network.yaml\n"
      "         ringhook simulate --arm-only --fault e-stop@10:2 --fault jitter@20\n"
      "Faults: e-stop, error, drives-off, delay, jitter, loss, split, merge, stall, half-open,\n"
      "refuse-points, cut. SECONDS since the start, DURATION in seconds, for good without.\n"
      "Serves until Ctrl-C, or for --seconds, and then tells what it saw.");
  addCellOptions(*command, arguments->cell);
  addArmOptions(*command, *arguments);
  command->add_option("--fault", arguments->faults, "What goes wrong when; may be given again")
      ->type_name("NAME@SECONDS[:DURATION]");
  command->add_option("--seed", arguments->cell.seed, "Of everything random")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--seconds", arguments->seconds, "How long to serve; default until Ctrl-C")
      ->type_name("S")
      ->check(CLI::PositiveNumber);
  command->add_option("--json", arguments->json, "Write what it saw here")->type_name("FILE");
  command->callback([arguments] { runCommand(*arguments); });
}

}  // namespace ringhook
