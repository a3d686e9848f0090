#pragma once

/// \file
/// The wizard's steps, in order. Each asks, measures, judges, and leaves its result in the session;
/// each may be left (Interrupted) and taken up again.

#include "calib/wizard/context.h"

namespace ringhook {

/// Both cameras and the pose between them, from pairs of a board: rig-stereo.yaml. Throws Error if
/// the integrator does not accept what came out.
void stereoStep(WizardContext& context);

/// The cameras in the robot's frame, from pairs of the gripper's plate: rig-robot.yaml. Throws as
/// above, and InputError for a cell without a gripper plate.
void robotStep(WizardContext& context);

/// The delays of cameras and arm: rig-time.yaml. Without devices the delays stay as they were.
void timeStep(WizardContext& context);

/// New pairs of the board against the rig. Throws Error if the rig does not stand the test.
void checkStep(WizardContext& context);

/// rig.yaml and cell.yaml, and a copy of the rig with its evidence among the accepted ones.
/// \param accepted folder of the accepted rigs. \param date of the result.
/// \param version of the program.
void finishStep(WizardContext& context, const std::filesystem::path& accepted,
                const std::string& date, const std::string& version);

}  // namespace ringhook
