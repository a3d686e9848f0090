#pragma once

/// \file
/// From the fits to the verdict of verify.h.

#include "calib/solve/verify.h"

namespace ringhook {

/// The same views fitted four times.
struct RigFits {
  RigFit held;       ///< the rig as accepted
  RigFit moved;      ///< the right camera free
  RigFit refocused;  ///< both focal lengths free
  RigFit both;       ///< all of these
};

/// Fills move, focal change, noise, state and reasons of `result`, whose rows, bar and costs are
/// there. \param after rows with the moved camera put right. \param tolerance_m see VerifyOptions.
void judgeRig(const StereoRig& rig, const RigFits& fits, const RowDrift& after, double tolerance_m,
              Verification& result);

}  // namespace ringhook
