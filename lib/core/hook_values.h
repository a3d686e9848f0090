#pragma once

/// \file
/// What the stages say of the hook: seen (tracking), fixed (stereo), estimated (prediction).

#include <Eigen/Core>
#include <vector>

#include "core/pinhole_view.h"
#include "core/pose.h"
#include "core/time.h"

namespace ringhook {

/// A model point found in an image: two residuals, u and v.
struct CornerFeature {
  Eigen::Vector3d point_o;  ///< in the hook frame [m]
  Eigen::Vector2d pixel;    ///< where it was seen, rectified image [px]
  double sigma_px = 0.1;    ///< standard deviation per axis [px]
};

/// A point found on the image of a straight model edge: one residual, the distance from the pixel
/// to the projected line (Comport et al., "Real-time markerless tracking", TVCG 2006).
struct EdgeFeature {
  Eigen::Vector3d start_o;  ///< first end of the model edge [m]
  Eigen::Vector3d end_o;    ///< second end of the model edge [m]
  Eigen::Vector2d pixel;    ///< where it was seen, rectified image [px]
  double sigma_px = 0.3;    ///< standard deviation across the edge [px]
};

/// Features of the hook in one camera.
struct CameraFeatures {
  PinholeView camera;
  std::vector<CornerFeature> corners;
  std::vector<EdgeFeature> edges;
};

/// The hook as tracking saw it at one instant, in one or two cameras (left first).
struct HookView {
  Time time;                            ///< mid-exposure
  std::vector<CameraFeatures> cameras;  ///< only cameras that saw it
  Pose c1Mo_start;                      ///< rough pose to start a refinement from
};

/// Hook pose at one instant, in the left camera frame.
struct HookFix {
  Time time;               ///< mid-exposure of the stereo pair
  Pose c1Mo;               ///< hook model in left camera
  Covariance6 covariance;  ///< of the small twist d in c1Mo * exp(d), at and in o [m^2, rad^2]
  double rms_px = 0.0;     ///< root mean square of the residuals used [px]
  int features = 0;        ///< residuals used
};

/// Hook as the filter believes it to be at one instant, past or future.
struct HookEstimate {
  Time time;
  Pose fMo;                ///< hook model in the robot reference frame
  Twist twist_f;           ///< velocity of the hook at o, expressed in f [m/s, rad/s]
  Covariance6 covariance;  ///< of the small twist d in fMo * exp(d), at and in o [m^2, rad^2]
};

}  // namespace ringhook
