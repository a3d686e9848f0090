#pragma once

/// \file
/// What a small recording needs besides its frames.

#include "camera/sequence_writer.h"

namespace ringhook::test {

/// Two cameras of this size [px], side by side.
inline StereoRig smallRig(int width, int height) {
  StereoRig rig;
  rig.left.width = width;
  rig.left.height = height;
  rig.left.K << 300, 0, 16, 0, 300, 12, 0, 0, 1;
  rig.right = rig.left;
  rig.c2Mc1.translation() = Eigen::Vector3d(-0.1, 0, 0);
  return rig;
}

inline SequenceInfo someInfo() {
  SequenceInfo info;
  info.name = "recorded";
  info.rate_hz = 50.0;
  return info;
}

}  // namespace ringhook::test
