#pragma once

/// \file
/// A known rig looking at a known board: exact corners with seeded noise, and drawn images.

#include <cstdint>
#include <vector>

#include "calib/solve/stereo_images.h"
#include "core/image.h"
#include "rig/stereo_rig.h"

namespace ringhook {

/// Two cameras of 1280x1024 px, f about 1000 px, baseline 0.12 m, five-term distortion.
StereoRig knownRig();

/// `count` views of the board, tilted up to 0.5 rad in all directions, whole in both images;
/// corners by OpenCV's projectPoints plus Gaussian noise of `sigma_px` per axis [px]. `bowl_m`: the
/// board is bent by that much from its middle to its outermost corner.
StereoViews simulatedViews(int count, const Board& board, double sigma_px, std::uint32_t seed,
                           double tilt_rad = 0.5, double bowl_m = 0.0);

/// Midway between the outermost points of the print, in t [m].
Eigen::Vector3d middleOf(const Board& board);

/// Height of a bowl z = depth (r / R)^2, R its outermost corner: mean of the four outer corners
/// less the mean of the two in the middle of the rows [m], of a 9x6 board.
double boardSag(const Board& board, double bowl_m);

/// The board as a distortion-free camera K at cMt sees it, each pixel the mean of 8x8 samples
/// over 2x2 px (the blur of a lens; sharper edges would be undersampled), on a grey ground.
/// Chessboards: square (0, 0), between the first four inner corners, is dark. ChArUco in OpenCV
/// 4.7's layout, or in the older one. Tags are OpenCV's print of tag36h11.
GrayImage drawBoard(const Board& board, const Eigen::Matrix3d& K, const Pose& cMt, int width,
                    int height, bool older_charuco = false);

}  // namespace ringhook
