#pragma once

/// \file
/// Which way the ring must move now so that it goes where the path wants it on a moving hook.
///
/// Law (position-based visual servoing, Chaumette and Hutchinson, "Visual servo control, part I",
/// IEEE RAM 2006; part II, 2007, for moving targets), the ring in the place of the camera:
///   e = (dPr, theta*u of dRr),   d = the desired ring frame, fMd = fMo * oMr_goal
///   twist_r = -lambda L^+ e + rVd twist_d.
/// The first term is ViSP's vpServo with vpFeatureTranslation (cdMc) and vpFeatureThetaU (cdRc): a
/// straight line in d. The second is the motion of d itself, carried rigidly to the ring: the
/// hook's twist taken from o to d plus the path's own velocity on the hook. It makes e decay as
/// exp(-lambda t) whatever the hook does; without it the ring lags by v / lambda.

#include "core/hook_values.h"
#include "core/outcome.h"
#include "servo/ring_goal.h"
#include "servo/visp_law.h"

namespace ringhook {

/// Gain lambda(|e|) of vpAdaptiveGain: lambda = (at_zero - at_infinity)
/// * exp(-slope_at_zero / (at_zero - at_infinity) * |e|) + at_infinity, |e| being the greatest of
/// the six errors, metres and radians side by side. Equal gains at both ends make it constant.
struct ServoGains {
  double at_zero = 6.0;         ///< lambda for a vanishing error [1/s]
  double at_infinity = 6.0;     ///< lambda for a great error [1/s]
  double slope_at_zero = 30.0;  ///< how fast lambda leaves at_zero [1/s per m or rad]
};

/// Distance of the ring from its goal.
struct ServoError {
  double translation_m = 0.0;
  double rotation_rad = 0.0;
};

struct ServoCommand {
  Twist twist_r;            ///< for the ring, expressed in r at r [m/s, rad/s]
  Twist feed_forward_r;     ///< the part of twist_r that follows the moving goal [m/s, rad/s]
  ServoError error;         ///< before the command acts
  double gain_per_s = 0.0;  ///< lambda that was used [1/s]
};

/// Velocity of the goal ring frame d, expressed in d at d: hook twist carried from o to d, plus
/// the path's own velocity.
Twist goalTwist(const HookEstimate& hook, const RingGoal& goal);

class PoseServo {
 public:
  /// Throws InputError for gains that are not positive and finite.
  explicit PoseServo(const ServoGains& gains);

  /// Ring velocity for the coming period. `fMr` and `hook` belong to one and the same instant:
  /// best the middle of the period in which the command will act (hook predicted there, ring moved
  /// on there by the command before), which leaves an error of second order in the period. Refuses
  /// input that is not finite. Throws Error if ViSP fails.
  [[nodiscard]] Outcome<ServoCommand> command(const Pose& fMr, const HookEstimate& hook,
                                              const RingGoal& goal);

 private:
  VispLaw law_;
};

}  // namespace ringhook
