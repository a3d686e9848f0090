#pragma once

/// \file
/// The fence around ViSP's servo law: feedback -lambda L^+ e on a relative pose, Eigen outside.
/// A unit of its own because ViSP 3.5's headers are not valid C++20; includes nothing that is.

#include <memory>

#include "core/pose.h"

namespace ringhook {

/// vpServo with vpFeatureTranslation (cdMc) and vpFeatureThetaU (cdRc), current interaction matrix.
class VispLaw {
 public:
  /// Parameters of vpAdaptiveGain, see ServoGains. Throws Error if ViSP refuses them.
  VispLaw(double gain_at_zero, double gain_at_infinity, double slope_at_zero);
  ~VispLaw();
  VispLaw(VispLaw&&) noexcept;
  VispLaw& operator=(VispLaw&&) noexcept;

  struct Feedback {
    Twist twist_r = Twist::Zero();  ///< expressed in r at r [m/s, rad/s]
    double gain_per_s = 0.0;        ///< lambda that was used [1/s]
  };

  /// Velocity of the ring r towards the desired ring frame d. Throws Error if ViSP fails.
  Feedback feedback(const Pose& dMr);

 private:
  struct Task;
  std::unique_ptr<Task> task_;
};

}  // namespace ringhook
