#pragma once

/// \file
/// How far the arm's stamps lie behind the cameras', from one motion that both have seen: the arm
/// carries a plate through a smooth motion, its states tell where the flange was, the cameras where
/// the plate was. Shifted in time until both tell the same.
///
/// Law: a frame is stamped s_i = m_i + d_c, with m_i its mid-exposure; a state is stamped
/// sampling + d_r. F is the flange over the states' stamps (natural cubic spline of position and
/// rotation vector). Then, with offset = d_r - d_c,
///   minimise over offset, eMg, fMc1  sum_ij rho(|z_ij - project((fMc1)^-1 F(s_i + offset) eMg
///   X_j)|)
/// + priors that hold fMc1 near where it is told to stand. The plate's place on the flange and a
/// small error of fMc1 are unknowns, so that geometry does not bias time: an error of scale or
/// direction of the motion is orthogonal to its velocity over a motion that comes and goes.
/// (Compare Furgale, Rehder, Siegwart, "Unified temporal and spatial calibration for multi-sensor
/// systems", IROS 2013.)
///
/// **What can be known.** The motion tells the difference d_r - d_c and nothing else: a later clock
/// of both is the same motion later. With cameras that stamp mid-exposure on the arm's clock (PTP,
/// or simulated) d_c = 0, so offset = d_r, and the camera's delay is measured frame by frame as
/// arrival - stamp. With stamps that are arrivals d_r has to be told, and d_c = d_r - offset.
/// Commands do not help: they are answers to states, so what they show is the time from a state's
/// sampling to the motion it caused, findResponseDelay(), in which d_r is hidden.
///
/// Uncertainty: from the spread of the residuals' gradients over blocks of time (Huber's sandwich),
/// which does not take neighbouring frames for independent.

#include <vector>

#include "calib/solve/motion_spline.h"
#include "core/hook_values.h"
#include "core/joints.h"
#include "core/outcome.h"
#include "core/pose.h"

namespace ringhook {

struct PlateMotion {
  std::vector<StampedPoint> flange;  ///< fMe by each state message, stamped as it is; growing
  std::vector<HookView> plate;       ///< `time` is the frame's stamp, o the plate's frame g
  Pose fMc1 = Pose::Identity();      ///< left camera in f as told
};

struct TimeOffsetOptions {
  double largest_offset_s = 0.100;
  double told_position_m = 0.010;    ///< standard deviation of the told fMc1, per axis
  double told_rotation_rad = 0.010;  ///< likewise
  double huber_px = 0.5;             ///< from here on a corner's weight falls
  double largest_rms_px = 1.5;       ///< beyond: states do not explain what was seen
  double largest_sigma_s = 0.0003;   ///< beyond: too little motion
  int fewest_views = 40;
};

struct TimeOffset {
  double offset_s = 0.0;          ///< arm's stamps behind the cameras': d_r - d_c
  double sigma_s = 0.0;           ///< standard deviation
  double rms_px = 0.0;            ///< of the corners, per axis
  double rms_without_px = 0.0;    ///< the same with offset zero and all else fitted anew
  double image_speed_px_s = 0.0;  ///< root mean square of the corners' motion
  int views = 0;                  ///< frames used
  Pose eMg = Pose::Identity();    ///< plate on the flange, as fitted
  Pose fMc1 = Pose::Identity();   ///< as fitted, close to the told one
};

/// Refuses "too few pictures of the plate", "the plate hardly moved", "the arm's states do not
/// explain what the cameras saw", "the delay is larger than ...", "no state around most pictures".
Outcome<TimeOffset> findTimeOffset(const PlateMotion& motion,
                                   const TimeOffsetOptions& options = {});

/// A velocity as it was commanded: in answer to the state of that stamp.
struct SentVelocity {
  Time stamp;                  ///< of the state answered
  JointVector joint_velocity;  ///< until the next one [rad/s]
};

struct ResponseDelay {
  double delay_s = 0.0;  ///< from a state's sampling until its answer acts
  double sigma_s = 0.0;  ///< standard deviation
  double rms_rad = 0.0;  ///< of the joints against the commands added up
};

/// When commands act, from joints against the commands added up and shifted: least squares over the
/// shift, with a place to start from and a gain for every joint. Refuses as above, and
/// "the joints do not follow the commands".
Outcome<ResponseDelay> findResponseDelay(const std::vector<SentVelocity>& sent,
                                         const std::vector<ArmState>& states);

}  // namespace ringhook
