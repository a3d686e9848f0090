#include "app/simulate_cell.h"

#include <malloc.h>

#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/controller_report.h"
#include "app/interrupt.h"
#include "core/error.h"
#include "cycle/cell_config.h"
#include "evaluation/cell_devices.h"
#include "evaluation/truth_log.h"
#include "sim/cell_server.h"
#include "sim/nominal_rig.h"
#include "sim/scenario.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

constexpr std::int64_t kTicksPerTruthRow = 5;  // of 4 ms

CellConfig networkCell(const std::string& file) {
  CellConfig cell = loadCellConfig(file);
  if (cell.devices.kind != DeviceKind::kNetwork) {
    throw InputError(file +
                     ": devices.kind is simulated; expected network, with the addresses at "
                     "which the cell shall be served (app/config/cell-network.yaml has them)");
  }
  if (cell.devices.scenario.empty()) {
    throw InputError(file + ": field devices.scenario is missing; expected the scenario to serve");
  }
  return cell;
}

CellOptions worldOptions(const CellJob& job, const Scenario& scenario) {
  CellOptions options = scenario.cell;
  options.seed = job.seed;
  if (job.hooks > 0) {
    options.hook.count = job.hooks;
  }
  options.ring.count = options.hook.count;  // more would lie about and cost time
  options.physics_step = kLivePhysicsStep;
  if (job.belt_parked) {
    parkBelt(options);
  }
  return options;
}

CellServerOptions serverOptions(const CellJob& job, const CellConfig& cell,
                                const Scenario& scenario) {
  const ControllerDevice& arm = cell.devices.arm;
  CellServerOptions options;
  options.arm.address = arm.address;
  options.arm.ports = {
      static_cast<std::uint16_t>(arm.motion_port), static_cast<std::uint16_t>(arm.system_port),
      static_cast<std::uint16_t>(arm.state_port), static_cast<std::uint16_t>(arm.io_port)};
  options.arm.seed = job.seed;
  options.gripper = {arm.gripper_module, arm.gripper_pin};
  options.cameras = {cell.devices.cameras.left, cell.devices.cameras.right, job.lost_packets};
  options.sensor = scenario.camera.sensor;
  options.transport_delay_s = cell.vision.transport_delay_s;
  return options;
}

const char* fateOf(const RingTruth& ring) {
  if (ring.held) {
    return "in the gripper";
  }
  if (ring.hanging) {
    return "hangs";
  }
  return ring.linked_hook >= 0 ? "on a hook, not yet at rest" : "fell";
}

nlohmann::ordered_json ringsJson(const CellTruth& cell) {
  auto rings = nlohmann::ordered_json::array();
  for (const RingTruth& ring : cell.rings) {
    if (!ring.in_magazine) {
      rings.push_back({{"fate", fateOf(ring)},
                       {"hook", ring.linked_hook},
                       {"peak_contact_n", ring.peak_force_in_grip}});
    }
  }
  return rings;
}

void printRings(const CellTruth& cell) {
  int hanging = 0;
  for (std::size_t i = 0; i < cell.rings.size(); ++i) {
    const RingTruth& ring = cell.rings[i];
    if (ring.in_magazine) {
      continue;
    }
    hanging += ring.hanging ? 1 : 0;
    std::printf("ring %zu: %s", i + 1, fateOf(ring));
    if (ring.linked_hook >= 0) {
      std::printf(" on hook %d", ring.linked_hook + 1);
    }
    std::printf(", peak contact in the gripper %.2f N\n", ring.peak_force_in_grip);
  }
  std::printf("%d rings hang, judged by the simulated physics\n", hanging);
}

/// Freed memory stays with the program: to hand it back, or to fetch it anew for every picture, a
/// drawing thread would hold what the ticks need as well, and may lose its processor meanwhile.
void keepMemory() {
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
}

/// Prints what the cell saw, and gives it as JSON.
nlohmann::ordered_json toldAtTheEnd(CellServer& server, const CellTruth& end) {
  std::fprintf(stderr, "served with %s priority\n", nameOf(server.arm().priority()));
  const Rx60Counts counts = server.controller().counts();
  printController(counts, server.arm().lateTicks());
  printCount("pairs of images", server.pairs());
  printRings(end);
  nlohmann::ordered_json json = controllerJson(counts, server.arm().lateTicks());
  json["image_pairs"] = server.pairs();
  json["rings"] = ringsJson(end);
  return json;
}

}  // namespace

nlohmann::ordered_json serveCell(const CellJob& job) {
  keepMemory();
  const CellConfig cell = networkCell(job.cell);
  const Scenario scenario = loadScenario(scenarioFile(cell, job.scenario));
  const StereoRig true_rig = disturbedRig(nominalRig(), job.seed, scenario.calibration);
  CellWorld world(worldOptions(job, scenario));
  CellServer server(world, true_rig, serverOptions(job, cell, scenario));
  std::optional<TruthLog> log;
  if (!job.truth.empty()) {
    log.emplace(job.truth, world, true_rig);
  }
  MishapScript script(job.mishaps, server.controller(), server.arm());
  server.arm().onEvent(sayEvent);
  std::int64_t tick = 0;
  server.onTick([&](Time now) {
    for (const std::string& event : script.tick(now)) {
      sayEvent(now, event);
    }
    if (log && tick++ % kTicksPerTruthRow == 0) {
      log->sample();
    }
  });
  sayWhere(server.arm(), cell.devices.arm.address);
  std::fprintf(stderr,
               "simulated cameras answer at %s and %s, port 3956\n"
               "scenario %s, seed %llu; the belt %s\n",
               cell.devices.cameras.left.c_str(), cell.devices.cameras.right.c_str(),
               scenario.name.c_str(), static_cast<unsigned long long>(job.seed),
               job.belt_parked ? "is parked" : "starts when the arm's client connects");
  server.run(interruptRequested(), job.seconds);
  if (log) {
    log->commit();
  }
  nlohmann::ordered_json json = toldAtTheEnd(server, truth(world));
  json["scenario"] = scenario.name;
  json["seed"] = job.seed;
  return json;
}

}  // namespace ringhook
