#include "calib/wizard/place.h"

#include "core/error.h"
#include "robot/rx60/kinematics.h"

namespace ringhook {

void CalibrationPlace::holdBoard(const std::optional<Pose>& /*fMt*/) {
  throw Error("nobody here can hold the board: that is for the simulated cell");
}

Outcome<Pose> CalibrationPlace::flange() {
  const Outcome<ArmState> state = armState();
  if (!state) {
    return Refusal{state.reason()};
  }
  return rx60::forward(rx60::rx60(), state->position);
}

Outcome<Pose> CalibrationPlace::moveFlange(const Pose& fMe) {
  const Outcome<ArmState> state = armState();
  if (!state) {
    return Refusal{state.reason()};
  }
  const Outcome<JointVector> target =
      rx60::nearestInverse(rx60::rx60(), rx60::limits(), fMe, state->position);
  if (!target) {
    return Refusal{target.reason()};
  }
  return moveJoints(*target);
}

Outcome<Pose> CalibrationPlace::moveJoints(const JointVector& /*target*/) {
  return Refusal{"no arm here that could be moved"};
}

}  // namespace ringhook
