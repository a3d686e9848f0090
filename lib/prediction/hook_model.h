#pragma once

/// \file
/// Belt and hook as two separate linear models in one state (the 2007 report, Jeyabalan, Fork
/// project, chapter 5): the pivot moves along the belt with nearly constant acceleration (5.5), the
/// hook swings about it as two damped pendulums (5.21), and nothing in the transition joins them.
/// What joins them is the measurement: one fix gives the pivot and the angles with errors that are
/// tied to each other, since the pivot is reached from o over the measured orientation. Both are
/// linear in the state, so the whole is one linear Kalman filter; it keeps the ties, and what
/// counts, the hook at o, comes out of it with the errors of pivot and swing cancelling again.
///
/// State, model kPendulum (17): pivot (p v a) in f; per axis x, y (phi, L phi', rest angle); yaw;
/// how much longer the hook hangs than pivot_o says. The last four are constants that walk slowly:
/// rest angles let a hook hang tilted, and yaw is what is left about the shank. A measured swing
/// angle is phi + rest angle; the measured anchor is the pivot less that length along the shank, so
/// a pivot that is misplaced by 9 mm does not seem to swing by half a millimetre itself. State,
/// model kConstantAcceleration (15): (p v a) of o itself in f; swing_x, swing_y and yaw, each
/// (angle, rate) with nearly constant rate. It knows nothing of gravity: the plain alternative.

#include <Eigen/Core>

#include "core/hook_values.h"
#include "prediction/hanging_pose.h"
#include "prediction/linear_kalman.h"
#include "prediction/pendulum.h"

namespace ringhook {

enum class HookMotionModel {
  kConstantAcceleration,
  kPendulum,          ///< linear, belt and swing apart, parameters given: the report's
  kSphericalPendulum  ///< swing_law.h; not a model of this file, see hook_swing.h
};

struct HookFilterOptions {
  HookMotionModel model = HookMotionModel::kSphericalPendulum;

  // The cell, from calibration and CAD.
  Pose fMc1 = Pose::Identity();              ///< left camera in the robot reference frame
  Eigen::Vector3d pivot_o{0.0, 0.0, 0.450};  ///< pivot in the hook frame [m]
  double pendulum_length_m = 0.35;           ///< nominal effective length of the hook, from CAD
  double length_sigma_m = 0.007;             ///< how well it is known; process noise follows
  double mass_kg = 0.4;                      ///< of the hook; only damping/mass acts
  double damping_kg_per_s = 0.01;            ///< D of equation 5.18
  double gravity = 9.81;                     ///< [m/s^2]
  double map_step_s = 0.002;                 ///< sampling dt of the pendulum map

  // Measurement noise is the fix's own covariance plus what every fix shares with no other:
  double position_floor_m = 5e-5;    ///< shutter and clock jitter at the tip's speed
  double rotation_floor_rad = 1e-4;  ///< window and lens residuals that the fix cannot see

  // Process noise of kPendulum.
  double pivot_jerk_density = 1e-7;  ///< the belt's speed is nearly constant [m^2/s^5]
  double swing_density = 1e-6;       ///< phi'': pivot friction, joints of the belt [rad^2/s^3]
  double rest_density = 1e-9;        ///< walk of the rest angles [rad^2/s]
  double yaw_density = 1e-8;         ///< walk of yaw, besides what swinging adds [rad^2/s]
  double longer_density = 1e-10;     ///< walk of the extra hanging length [m^2/s]

  // Process noise of kConstantAcceleration: a swing of 3 deg has 3 m/s^3 of jerk.
  double hook_jerk_density = 1.0;  ///< of o [m^2/s^5]
  double hook_turn_density = 0.3;  ///< of the angles' acceleration [rad^2/s^3]

  // What is believed before the first fix, as standard deviations about 0.
  double speed_sigma = 0.3;               ///< of pivot or o, per axis [m/s]
  double belt_acceleration_sigma = 0.05;  ///< of the pivot, per axis (kPendulum) [m/s^2]
  double hook_acceleration_sigma = 2.0;   ///< of o, per axis (kConstantAcceleration) [m/s^2]
  double swing_sigma = 0.2;               ///< amplitude of the swing, per axis [rad]
  double rest_sigma = 0.02;               ///< tilt of the hanging hook [rad]
  double longer_sigma_m = 0.01;           ///< pivot against pivot_o, along the shank [m]

  // kSphericalPendulum learns the damping: standard deviations about damping/mass and about none.
  double viscous_sigma = 0.05;                                  ///< [1/s]
  double dry_sigma = 0.02;                                      ///< dry friction [rad/s^2]
  Eigen::Vector3d belt_direction_f = Eigen::Vector3d::UnitY();  ///< unit; along it speed changes
  double belt_change = 0.5;            ///< acceleration of a belt that starts or stops [m/s^2]
  double next_length_sigma = 0.012;    ///< of ln length from one hook to the next of its kind
  double ready_sigma_m = 5e-4;         ///< ready() once a prediction 0.3 s ahead is this good
  double neighbour_distance_m = 0.15;  ///< a fix so far off is of another hook

  // Judgement.
  double gate_probability = 0.9999;  ///< of a good fix to pass the NIS gate, in (0, 1)
  int lost_after = 5;                ///< fixes refused by the gate in a row
  int warm_up_fixes = 15;            ///< fixes taken before ready()
  double warm_up_s = 0.5;            ///< time since the first fix before ready()
  double max_horizon_s = 2.0;        ///< farthest prediction, and longest gap between fixes
};

using HookBelief = Gaussian<Eigen::Dynamic>;  ///< on the state described above

/// One fix in the filter's coordinates: (anchor in f [m], swing_x, swing_y, yaw [rad]).
struct HangingMeasurement {
  Eigen::Matrix<double, 6, 1> value;
  Eigen::Matrix<double, 6, 6> covariance;  ///< [m^2, m rad, rad^2], full: pivot and angles are tied
};

/// The point that carries (p v a): the pivot, or o itself in model kConstantAcceleration [m].
Eigen::Vector3d anchorInHook(const HookFilterOptions& options);

HangingMeasurement hangingMeasurement(const HookFix& fix, const HookFilterOptions& options);

/// Belief after the first measurement.
HookBelief startHookBelief(const HangingMeasurement& measurement, const HookFilterOptions& options);

/// Belief `dt` [s] later (earlier when negative).
HookBelief advanceHookBelief(const HookBelief& belief, double dt, const HookFilterOptions& options);

/// Belief after a measurement of the same instant; yaw is taken the short way round.
Correction<Eigen::Dynamic, 6> correctHookBelief(const HookBelief& belief,
                                                const HangingMeasurement& measurement,
                                                const HookFilterOptions& options);

/// Pose, velocity and covariance at o that the belief stands for.
HookEstimate composeHookEstimate(const HookBelief& belief, Time time,
                                 const HookFilterOptions& options);

}  // namespace ringhook
