#pragma once

/// \file
/// Where on the hook the ring shall be at one instant, and how it shall move there.

#include "core/pose.h"

namespace ringhook {

struct RingGoal {
  Pose oMr = Pose::Identity();    ///< ring in the hook frame
  Twist twist_o = Twist::Zero();  ///< of the ring relative to the hook, at r, expressed in o
                                  ///< [m/s, rad/s]
};

}  // namespace ringhook
