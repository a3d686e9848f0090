#include "evaluation/cell_devices.h"

#include <utility>

#include "core/error.h"
#include "core/file_kind.h"
#include "cycle/network_devices.h"
#include "sim/nominal_rig.h"
#include "sim/sim_arm.h"

namespace ringhook {

std::filesystem::path scenarioFile(const CellConfig& cell, const std::string& name) {
  if (name.empty()) {
    return cell.devices.scenario;
  }
  std::filesystem::path file = cell.devices.scenario.parent_path() / (name + ".yaml");
  if (!isFile(file)) {
    throw InputError("--scenario " + name + ": expected a scenario with a file " + file.string());
  }
  return file;
}

SimCameraOptions simCameraOptions(const CellConfig& cell, const Scenario& scenario) {
  SimCameraOptions options = scenario.camera;
  options.rate_hz = cell.vision.search_rate_hz;
  options.transport_delay_s = cell.vision.transport_delay_s;
  return options;
}

namespace {

void openNetwork(const CellConfig& cell, CellDevices& devices) {
  devices.camera = openCameras(cell, devices.told_rig.camera_delay_s);
  devices.arm = openArm(cell, Rx60Arm::Needs::kState);
}

void openSimulation(const CellConfig& cell, const CellChoice& choice, CellDevices& devices) {
  Scenario scenario = loadScenario(scenarioFile(cell, choice.scenario));
  scenario.cell.seed = choice.seed;
  devices.scenario = scenario.name;
  devices.true_rig = disturbedRig(nominalRig(), choice.seed, scenario.calibration);
  devices.world = std::make_unique<CellWorld>(scenario.cell);
  devices.arm = std::make_unique<SimArm>(*devices.world);
  devices.camera = std::make_unique<SimStereoCamera>(*devices.world, devices.true_rig,
                                                     simCameraOptions(cell, scenario));
}

}  // namespace

CellDevices openCell(const CellConfig& cell, const CellChoice& choice) {
  CellDevices devices;
  devices.told_rig = loadRig(cell.rig);
  if (cell.devices.kind == DeviceKind::kSimulated) {
    openSimulation(cell, choice, devices);
  } else if (!choice.scenario.empty()) {
    throw InputError("--scenario " + choice.scenario + ": expected a cell file of kind simulated");
  } else {
    openNetwork(cell, devices);
  }
  return devices;
}

}  // namespace ringhook
