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
/// corners by OpenCV's projectPoints plus Gaussian noise of `sigma_px` per axis [px].
StereoViews simulatedViews(int count, const Board& board, double sigma_px, std::uint32_t seed,
                           double tilt_rad = 0.5);

/// The board as a distortion-free camera K at cMt sees it, each pixel the mean of 8x8 samples
/// over 2x2 px (the blur of a lens; sharper edges would be undersampled), on a grey ground.
/// Square (0, 0), between the first four inner corners, is dark.
GrayImage drawBoard(const Board& board, const Eigen::Matrix3d& K, const Pose& cMt, int width,
                    int height);

}  // namespace ringhook
