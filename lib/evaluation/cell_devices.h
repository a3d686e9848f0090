#pragma once

/// \file
/// The devices of a cell, opened for watching: from a cell file to a StereoCamera and an Arm, be
/// they simulated in this process or on a network. Simulated ones share a world, whose truth
/// evaluation may look at; the arm of a network is asked for its state only.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "camera/stereo_camera.h"
#include "cycle/cell_config.h"
#include "rig/stereo_rig.h"
#include "robot/arm.h"
#include "sim/cell_world.h"
#include "sim/scenario.h"

namespace ringhook {

struct CellDevices {
  StereoRig told_rig;                    ///< as the cell file's rig.yaml says
  std::string scenario;                  ///< name; empty for devices on a network
  std::unique_ptr<CellWorld> world;      ///< null for devices on a network
  StereoRig true_rig;                    ///< where the simulated cameras truly stand
  std::unique_ptr<Arm> arm;              ///< clocks the loop
  std::unique_ptr<StereoCamera> camera;  ///< delivers at search rate at first
};

struct CellChoice {
  std::string scenario;    ///< name beside the cell's own scenario; empty for the cell's own
  std::uint64_t seed = 1;  ///< of everything random in a simulated cell
};

/// The simulated cameras of a scenario, at the rate and with the delay that the cell file tells.
SimCameraOptions simCameraOptions(const CellConfig& cell, const Scenario& scenario);

/// The scenario's file; throws InputError for a name without one.
std::filesystem::path scenarioFile(const CellConfig& cell, const std::string& name);

/// Throws InputError for bad files, DeviceError for a device that cannot be opened.
CellDevices openCell(const CellConfig& cell, const CellChoice& choice);

}  // namespace ringhook
