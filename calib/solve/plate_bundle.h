#pragma once

/// \file
/// The least-squares problem of plate_views.h.

#include <vector>

#include "calib/solve/plate_views.h"

namespace ringhook {

struct BundleResult {
  HandEye pose;
  std::optional<Covariance12> covariance;  ///< of the small twists (a, b), see hand_eye_fit.h
  double rms_px = 0.0;                     ///< per axis, at the minimum [px]
  double arm_rms_px = 0.0;                 ///< per axis, with all d_i = 0 [px]
};

/// RMS per axis of the used views' corners under these poses c1Mt, one a view [px]; infinite with a
/// corner behind its camera.
double cornerRms(const std::vector<PlateView>& views, const std::vector<bool>& used,
                 const std::vector<Pose>& c1Mt);

/// Where a result puts the target of every view: c1Mt, the arm taken to be perfect.
std::vector<Pose> predictedPlates(const std::vector<PlateView>& views, EyeSetup setup,
                                  const HandEye& pose);

/// Refines from `start` over the views with `used`. Throws Error if the minimum is not reached.
BundleResult refineOnPlates(const std::vector<PlateView>& views, const std::vector<bool>& used,
                            EyeSetup setup, const HandEye& start, double corner_sigma_px,
                            const PairNoise& arm);

}  // namespace ringhook
