#pragma once

/// \file
/// Grids of dark circles, and the bias of their centres.
///
/// What can be measured of a circle's image is its centroid. The image of a circle under
/// perspective is an ellipse whose centre is not the image of the circle's centre, and the lens
/// bends it further; the difference grows with the square of the circle's size in the image and
/// with the tilt, and it biases focal length and distortion (Heikkila, "Geometric camera
/// calibration using circular control points", PAMI 22, 2000; Mallon and Whelan, "Which pattern?",
/// Pattern Recognition Letters 28, 2007). Here the bias is computed from the current solution, by
/// taking the outline of each circle through the whole camera model and the centroid of the area
/// inside, and taken off the measured centroids; fit and correction are repeated until nothing
/// moves (stereo_calibration.cpp).

#include "calib/solve/board.h"
#include "core/pose.h"
#include "rig/camera_model.h"

namespace ringhook {

/// Centroids of all circles of a symmetric or asymmetric grid.
/// Refuses, with a reason, an image without the whole grid.
Outcome<BoardSighting> findCircles(const GrayImage& image, const Board& board);

/// Centroid of the image of a circle minus the image of its centre [px].
/// \param centre_t in t [m]; the circle lies in the plane z = const of t. \param diameter_m [m].
Eigen::Vector2d circleBias(const CameraModel& camera, const Pose& cMt,
                           const Eigen::Vector3d& centre_t, double diameter_m);

}  // namespace ringhook
