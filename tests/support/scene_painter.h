#pragma once

/// \file
/// Small synthetic images for tests: planar figures seen by a pinhole camera, antialiased by 4 x 4
/// rays a pixel. Pixel (u, v) covers u - 0.5 .. u + 0.5, so the centre of the first is (0, 0).

#include <Eigen/Core>
#include <functional>
#include <random>
#include <vector>

#include "core/image.h"
#include "core/pinhole_view.h"
#include "core/pose.h"
#include "core/stereo_frame.h"

namespace ringhook::test {

/// Grey level of a figure at (x, y) of its plane [m]; negative where there is nothing.
using Figure = std::function<double(double x, double y)>;

/// Paints a figure that lies within |x|, |y| <= half_size of its plane over the view's image.
void paint(RectifiedView& view, const Pose& c1Mplane, const Eigen::Vector2d& half_size,
           const Figure& figure);

/// A filled polygon, corners in the plane [m].
Figure polygon(std::vector<Eigen::Vector2d> corners, double grey);

/// Gaussian noise on every pixel [grey levels].
void addNoise(GrayImage& image, double sigma, std::mt19937& random);

/// Two parallel cameras (f = 2500 px, 2048 x 2048, baseline 0.4 m) at x_f = 1.75 looking along
/// -x_f, with empty images of one grey level. `fMc1` of the left one.
RectifiedFrame emptyPair(std::uint8_t grey);
Pose pairPose();

}  // namespace ringhook::test
