#pragma once

/// \file
/// Robot-camera calibration from images of a tag plate, in one or two cameras: the way to take
/// where images are at hand. Pose pairs throw away how well each image tells its plate's pose; a
/// single small tag, for one, shows its distance and tilt ten times worse than its place. Here the
/// corners themselves are explained (bundle adjustment):
///   minimise  sum over views i, corners j, cameras  |pixel_ij - project(cMc1 hMc^-1 hMj_i jMt
///             exp(d_i) X_j)|^2 / s_px^2  +  sum over i  d_i^T diag(s_t^2, s_r^2)^-1 d_i,
/// where d_i is what the arm's own error does to the plate of view i. Without it the arm would have
/// to be perfect: a plate seen by two cameras is measured better than most arms stand. s_px comes
/// from what single views leave unexplained, s_t and s_r from the pose pairs' fit (hand_eye_fit.h).
/// Where pairs left out refute the views' covariances (pair_weights.h), the corners are not seen as
/// this law believes, by a wrong lens model for one: the result of the pairs stands then.

#include <string>
#include <vector>

#include "calib/solve/hand_eye.h"
#include "calib/solve/joint_zeros.h"
#include "core/hook_values.h"

namespace ringhook {

/// A plate seen while the arm stood still. `seen` is as a HookTracker delivers it, with the plate's
/// frame t in place of o: load the plate without oMk, or take eMt to be that of o.
struct PlateView {
  std::string name;  ///< for messages
  Pose fMe;          ///< flange in the robot reference
  HookView seen;
  std::optional<JointVector> joints{};  ///< reported [rad], of which fMe is an RX60's kinematics
};

struct PlateCalibration {
  HandEyeResult result;  ///< pose, covariance, held-out errors, verdict
  std::vector<PosePair>
      pairs;  ///< what each view says by itself, with its covariance; the arm as result takes it
  std::vector<RejectedPair> blind;  ///< views that tell no pose; index among the views given
  double corner_sigma_px = 0.0;     ///< s_px, per axis
  double rms_px = 0.0;              ///< of the corners under the result, arm errors taken out
  double arm_rms_px = 0.0;  ///< likewise with all d_i = 0: the arm's errors as the camera sees
  std::optional<JointZeros> zeros;  ///< where all views have joints and the plain result is usable
  bool zeros_used = false;          ///< result belongs to the arm corrected by them
  JointVector arm_zeros_rad = JointVector::Zero();  ///< of the arm that result belongs to
  PairError plain_heldout;                          ///< of the arm as it is
};

/// What to make of the arm's joint zeros.
enum class ZeroChoice {
  kKeep,        ///< the arm stays as it is
  kWherePaying  ///< it is corrected where that predicts views left out clearly better
};

/// The whole job: each view's own pose, the pairs' calibration, then the refinement above from its
/// result over the views it uses, then the joint zeros. Throws as calibrateRobotCamera does.
/// \param told_zeros_rad by which the views' fMe may have been corrected already.
PlateCalibration calibrateFromViews(const std::vector<PlateView>& views, EyeSetup setup,
                                    ZeroChoice choice, const StepHook& hook,
                                    const JointVector& told_zeros_rad = JointVector::Zero());

}  // namespace ringhook
