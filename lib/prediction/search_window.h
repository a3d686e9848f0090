#pragma once

/// \file
/// Where to look next: the window of one image that will hold the hook, from the predicted pose and
/// its covariance. A predicted point's pixel has the covariance S = H P H^T, H the derivative of
/// the projection by the small twist d in c1Mo * exp(d). The box of all predicted pixels, each
/// grown by k sqrt(S_uu) and k sqrt(S_vv), holds all true pixels at once with probability p or more
/// if k^2 is the chi-square quantile of p with 6 degrees (Scheffe, 1953: all linear functions of d
/// together), as far as the projection is linear over the uncertainty.

#include <Eigen/Core>
#include <span>

#include "core/image.h"
#include "core/pinhole_view.h"
#include "core/pose.h"

namespace ringhook {

struct SearchWindowOptions {
  double sigmas = 4.1;     ///< k; 4.1 keeps all points inside with 99 %
  double margin_px = 8.0;  ///< added on each side: what a detector needs around a feature
  int min_size_px = 64;    ///< width and height are at least this, as far as the image reaches
  int max_size_px = 4096;  ///< and at most this, about the middle; breaks the promise if it acts
  int alignment_px = 1;    ///< x, y, width, height become multiples of it (2: even), outwards
};

/// The k that keeps all points inside with `probability`, in (0, 1).
double sigmasForProbability(double probability);

/// Window in the full image of `view`. `points_o`: corners of what is looked for, in the hook frame
/// [m]; those behind the camera are left out. `covariance`: at and in o [m^2, rad^2]. Empty if the
/// grown box does not meet the image or no point lies before the camera. The promise is about the
/// part of the box inside the image.
Window searchWindow(const PinholeView& view, const Pose& c1Mo, const Covariance6& covariance,
                    std::span<const Eigen::Vector3d> points_o, const SearchWindowOptions& options);

}  // namespace ringhook
