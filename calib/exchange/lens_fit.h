#pragma once

/// \file
/// A lens told in another program's model. Where that has fewer terms, the closest lens that it can
/// tell is found by least squares over the image (focal lengths, principal point and the terms that
/// are left, all free: only where a ray meets the sensor counts), and what is lost is measured:
/// the largest distance between the pixels that both models give to one ray.

#include "rig/camera_model.h"

namespace ringhook {

/// What other programs know of a lens.
enum class LensKind {
  kRadialOne,  ///< k1 (ViSP)
  kRadTan,     ///< k1 k2 p1 p2 (Kalibr's radtan)
  kFull,       ///< all of ours (OpenCV, ROS)
};

struct FittedLens {
  CameraModel camera;    ///< with no other than the allowed terms; 4 coefficients where limited
  double loss_px = 0.0;  ///< largest over the image; 0 if the lens is told exactly
};

/// Throws InputError for a lens model that cannot be inverted anywhere in the image.
FittedLens closestLens(const CameraModel& camera, LensKind kind);

/// ViSP's polynomial for the way back, x_u = x_d (1 + kdu r_d^2), for a lens of k1 alone.
struct InverseRadial {
  double kdu = 0.0;
  double loss_px = 0.0;  ///< largest error of the way back over the image
};
InverseRadial inverseRadial(const CameraModel& camera);

}  // namespace ringhook
