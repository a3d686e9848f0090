#pragma once

/// \file
/// Starts for the refinement. A closed form averages over all pairs, so one wrong pair spoils it;
/// hence, beside all of them on all pairs, one of them on random subsets of four pairs (Fischler
/// and Bolles, CACM 24, 1981): with a quarter of wrong pairs one of 60 subsets is free of them with
/// a probability of 1 - 1e-10. Seeded: the same pairs give the same starts. All starts are judged
/// by medianError, the least median of squares (Rousseeuw 1984).

#include <string>
#include <vector>

#include "calib/solve/hand_eye.h"

namespace ringhook {

struct Start {
  HandEye pose;
  double median_m = 0.0;  ///< medianError [m]
  std::string name;       ///< of the closed form; "Park on four pairs" for a subset
};

/// Starts by `forms` on all pairs and by Park's on so many subsets, best first. Empty if nothing
/// solves at all.
std::vector<Start> handEyeStarts(const std::vector<PosePair>& pairs, EyeSetup setup,
                                 const std::vector<ClosedForm>& forms, int subsets);

/// Pairs read in every other convention that people mix up: robot poses inverted (or the other
/// set-up), target poses inverted, quaternions written w, x, y, z, target rows shifted by one. The
/// best of them (both inverted is left out: that only exchanges the two unknowns); `words` empty if
/// none is better than `median_m` by kConventionGain.
Convention betterConvention(const std::vector<PosePair>& pairs, EyeSetup setup, double median_m);
constexpr double kConventionGain = 3.0;  ///< noise alone does not make this factor

}  // namespace ringhook
