#pragma once

/// \file
/// Closed-form solutions of A X = Z B as starts for the refinement: Tsai and Lenz 1989, Park and
/// Martin 1994, Horaud and Dornaika 1995, Andreff et al. 1999, Daniilidis 1998 (camera alone from
/// motions, OpenCV's calibrateHandEye) and Shah 2013, Li et al. 2010 (camera and target at once,
/// OpenCV's calibrateRobotWorldHandEye). None of them is to be trusted alone: each has sets of
/// perfectly good pairs on which it returns nonsense, and none survives a single wrong pair.

#include <optional>
#include <string>
#include <vector>

#include "calib/solve/pose_pairs.h"

namespace ringhook {

enum class ClosedForm { kTsai, kPark, kHoraud, kAndreff, kDaniilidis, kShah, kLi };

/// All of them, in this order.
const std::vector<ClosedForm>& closedForms();

/// "Tsai", "Park", ...
std::string toString(ClosedForm form);

/// The solution of one of them from at least three pairs; nothing where it fails inside or what
/// it returns is no pose. A target that the method does not give is the average over the pairs.
std::optional<HandEye> solveClosedForm(ClosedForm form, const std::vector<PosePair>& pairs,
                                       EyeSetup setup);

}  // namespace ringhook
