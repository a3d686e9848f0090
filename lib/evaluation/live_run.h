#pragma once

/// \file
/// The operator's job on a cell in real time: cameras and arm on a network, vision on a thread of
/// its own, control on the caller's, clocked by the arm. Nobody here knows the truth: whether a
/// ring hangs is told by whoever looks (`ringhook simulate` prints it for a simulated cell).

#include "evaluation/servo_run.h"

namespace ringhook {

/// \param cell one whose devices are on a network. Throws DeviceError if one cannot be opened. An
/// interruption and the failure of a device at work are no errors here: the arm was stopped before
/// anything else, the report says so and holds what was finished.
ServoReport runLiveServo(const ServoJob& job, const CellConfig& cell, const std::atomic<bool>& stop,
                         const ServoProgress& progress, const AttemptDone& attempt_done);

}  // namespace ringhook
