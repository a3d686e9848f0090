#pragma once

/// \file
/// The zero errors of an arm's joints, together with camera and target. A joint whose encoder is
/// off by a constant puts the flange elsewhere in every pose, in a way that repeats: no noise, and
/// not to be averaged away. Camera and target take up a part of it, those of joints 1 and 6 wholly:
/// turning the base or the tool is the same thing, so these two are zero by definition. The rest
/// stays in every residual. With joint angles at hand it can be told (Mooring, Roth, Driels,
/// "Fundamentals of Manipulator Calibration", 1991):
///   fMe(q + z) = fMe(q) exp(eJe(q) z),
/// z joins the unknowns of hand_eye_fit.h, with a weak prior that holds what the poses do not tell
/// near zero. A camera found along with zeros belongs to an arm corrected by them; one that stays
/// as it is wants the plain result. Zeros may also explain noise, so they are to be used where
/// poses that took no part in the fit say so (zerosPay).

#include <vector>

#include "calib/solve/hand_eye.h"
#include "core/joints.h"
#include "robot/rx60/kinematics.h"

namespace ringhook {

constexpr double kJointZeroPrior = 0.003;  ///< standard deviation of a zero error [rad]

struct JointZeros {
  JointVector zero_rad = JointVector::Zero();      ///< true minus reported angle [rad]
  JointVector sigma_rad = JointVector::Zero();     ///< standard deviations [rad]; 0: by definition
  HandEye pose;                                    ///< with the arm so corrected
  Covariance12 covariance = Covariance12::Zero();  ///< of its small twists, zeros unknown
  PairNoise noise;                                 ///< what is left
  PairError residual;                              ///< RMS over the pairs used
  PairError heldout;                               ///< RMS of left_out
  std::vector<PairError> left_out;                 ///< as in HandEyeResult
};

/// \param joints reported [rad], one for each pair, of which fMe is the nominal kinematics.
/// \param start a result from the same pairs; its `used` decides which take part.
JointZeros fitJointZeros(const std::vector<PosePair>& pairs, const std::vector<JointVector>& joints,
                         const rx60::Geometry& geometry, const HandEyeResult& start);

/// Whether pairs left out are predicted clearly better with the zeros: their squared errors [m^2]
/// fall by more than two standard errors of the mean fall. Both lists are of the same pairs.
bool zerosPay(const std::vector<PairError>& plain, const std::vector<PairError>& with_zeros);

/// The pairs of an arm corrected by `zero`.
std::vector<PosePair> withZeros(const std::vector<PosePair>& pairs,
                                const std::vector<JointVector>& joints,
                                const rx60::Geometry& geometry, const JointVector& zero);

}  // namespace ringhook
