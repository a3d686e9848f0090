#pragma once

/// \file
/// Which instants stand for an exposure, and where in the image they have to be drawn.
///
/// A sensor adds up light from -T/2 to +T/2 around mid-exposure. The sum is taken at the points of
/// Gauss and Legendre's rule with its weights: n points integrate a polynomial of degree 2n - 1
/// exactly, so already two points give an edge the box blur's mean and variance (Abramowitz and
/// Stegun, "Handbook of Mathematical Functions", 25.4.29). As long as neighbouring instants lie
/// less than about a pixel apart, the pixel's own width hides the steps. The number comes from the
/// fastest thing that the cameras can see, never from the window that is read out.

#include <vector>

#include "core/image.h"
#include "sim/solids.h"

namespace ringhook {

struct SubInstant {
  double at = 0.0;      ///< from mid-exposure [s]
  double weight = 1.0;  ///< all add up to 1
};

/// Earliest first; `count` of 1 is mid-exposure itself.
std::vector<SubInstant> subInstants(int count, double exposure_s);

/// 1 below 0.05 px of motion during the exposure, 2 below 1 px, then one more for every pixel, at
/// most 24.
int subInstantCount(double motion_px);

/// The solids at the start and at the end of an exposure.
struct ExposureEnds {
  std::vector<Solid> start;
  std::vector<Solid> end;
};

/// Longest image motion [px] of anything that `eye` sees in its plane.
double largestMotion(const ExposureEnds& ends, const Pinhole& eye, const Window& plane);

/// Rectangles of the plane, none overlapping another, that hold all that moves by more than
/// 0.01 px.
std::vector<Window> movingParts(const ExposureEnds& ends, const Pinhole& eye, const Window& plane);

}  // namespace ringhook
