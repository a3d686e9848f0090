#pragma once

/// \file
/// Undistortion and rectification combined in one map (the 2007 report (Jeyabalan, Fork project),
/// section 2.4), for whole images, for windows and for single points. After it both views are
/// ideal pinhole cameras of one focal length and one principal point, whose rows correspond.
/// Construction (Bouguet; Fusiello, Trucco, Verri 2000): each camera turns half of the relative
/// rotation, then both turn so that x lies along the baseline. With c2Mc1 = (R, T), R1 and R2:
///   rectified left  = R1 x1,   rectified right = R2 x2 = R1 x1 + (-+B, 0, 0).
/// The focal length is the mean of the originals, and the full view is as large as both undistorted
/// images need (at most twice the raw size), so verged cameras lose no field of view. A rig of one
/// camera is undistorted only: same K but for the shift that the full view needs.
/// Grey values are bilinear with positions in 1/32 px (OpenCV's fixed-point remap): a position is
/// wrong by at most 1/64 px per axis, below 0.01 px RMS, and differs from pixel to pixel, so that
/// features that use many pixels average it out. Points (rectifyPoint, distortPoint) are exact.
/// All members are const and may be called from several threads; copies share the maps, which are
/// made when an image is first rectified (some 0.3 s for 2048 x 2048).

#include <Eigen/Core>
#include <memory>

#include "core/image.h"
#include "core/stereo_frame.h"
#include "rig/stereo_rig.h"

namespace ringhook {

class Rectifier {
 public:
  /// Throws InputError for a rig that checkRig refuses or whose lens model cannot be inverted at
  /// any border of the image.
  explicit Rectifier(const StereoRig& rig);

  /// Two cameras?
  [[nodiscard]] bool stereo() const;

  /// Side 0 is left, 1 is right. Ideal camera after rectification; cMc1 is relative to the true
  /// left camera: rotation only for left, identity for a rig of one camera.
  [[nodiscard]] const PinholeView& view(int side) const;

  /// Both images (left alone for a mono frame) after rectification. A view's window is
  /// rectifiedWindow(raw window). Throws InputError naming both sizes if the frame's windows do not
  /// lie in the rig's images or do not match the pixels, or if a rig of one camera gets two images.
  [[nodiscard]] RectifiedFrame rectify(const StereoFrame& frame) const;

  /// Smallest raw window (found by growing) whose rectification covers `rectified`, with a margin
  /// for interpolation; clipped to the raw image, empty if `rectified` lies outside it.
  [[nodiscard]] Window rawWindow(int side, const Window& rectified) const;

  /// What the pixels of `raw` yield: the largest rectified rectangle that they cover fully. For the
  /// full raw image: the bounding box of everything it shows, black where it shows nothing.
  [[nodiscard]] Window rectifiedWindow(int side, const Window& raw) const;

  /// Rectified pixel of a raw pixel [px]. Throws InputError for a pixel beyond the lens model.
  [[nodiscard]] Eigen::Vector2d rectifyPoint(int side, const Eigen::Vector2d& raw) const;

  /// Raw pixel of a rectified pixel [px]; may lie outside the raw image.
  [[nodiscard]] Eigen::Vector2d distortPoint(int side, const Eigen::Vector2d& rectified) const;

 private:
  struct Side;
  [[nodiscard]] const Side& at(int side) const;
  [[nodiscard]] RectifiedView rectifySide(int side, const GrayImage& image,
                                          const Window& window) const;

  std::shared_ptr<const Side> left_;
  std::shared_ptr<const Side> right_;
};

}  // namespace ringhook
