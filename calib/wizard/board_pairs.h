#pragma once

/// \file
/// Pictures of a board, pair by pair, with advice how to hold it next, until they cover images,
/// tilts and distances; every pair is kept in the session at once.

#include "calib/solve/stereo_images.h"
#include "calib/wizard/context.h"
#include "calib/wizard/coverage.h"
#include "calib/wizard/shot_folder.h"

namespace ringhook {

struct BoardPairsOptions {
  std::string part;       ///< board or check
  int goal = 20;          ///< pairs with the board that end the job
  bool coverage = true;   ///< go on until nothing is lacking, and say what is
  Coverage begin_from{};  ///< of pairs taken before, elsewhere: the next holds differ from theirs
};

/// Takes up the pairs that are in the session and adds more. In the simulated cell the board is
/// held by the program; before stored images nobody is asked anything. Throws Interrupted when the
/// integrator leaves.
StereoViews takeBoardPairs(WizardContext& context, const BoardPairsOptions& options);

/// Coverage of views.
Coverage coverageOf(const StereoViews& views, const WizardContext& context);

}  // namespace ringhook
