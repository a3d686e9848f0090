#pragma once

/// \file
/// Where the flange should go for a robot-camera calibration: the corners of a cube around where
/// it stands, as in the 2007 report (Jeyabalan, Fork project, section 6.1), and turned differently
/// at each, since pictures from turned flanges alone tell where the plate sits on the flange and
/// where the camera stands (Tsai and Lenz, IEEE Trans. Robotics and Automation 5, 1989: rotations
/// about at least two axes, the larger the better).

#include <vector>

#include "core/pose.h"

namespace ringhook {

struct ArmPoseOptions {
  double side_m = 0.20;    ///< of the cube
  double turn_rad = 0.35;  ///< of the flange, about its own axes, away from where it began
};

/// 24 poses fMe, near ones after each other: three turns at each corner of the cube around `start`.
std::vector<Pose> armPoses(const Pose& start, const ArmPoseOptions& options = {});

}  // namespace ringhook
