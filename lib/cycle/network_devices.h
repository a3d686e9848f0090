#pragma once

/// \file
/// Opens the devices of a cell on a network: two GigE Vision cameras and an RX60's controller. They
/// may be real or simulated (`ringhook simulate`); nothing here can tell.

#include <memory>

#include "camera/aravis_stereo_camera.h"
#include "cycle/cell_config.h"
#include "robot/rx60/rx60_arm.h"

namespace ringhook {

/// The cameras, streaming full images at the search rate; `delay_s`: from mid-exposure to
/// arrival, as calibrated [s]. Throws DeviceError naming the camera.
std::unique_ptr<AravisStereoCamera> openCameras(const CellConfig& cell, double delay_s);

/// The arm, ready to move, or only to be watched. Throws DeviceError that says what is missing.
std::unique_ptr<Rx60Arm> openArm(const CellConfig& cell,
                                 Rx60Arm::Needs needs = Rx60Arm::Needs::kMotion);

}  // namespace ringhook
