#pragma once

/// \file
/// Why a picture cannot be measured, said before anything is looked for: constant, too dark, too
/// bright; and how sharp its edges are. The width of an edge is that of the Gaussian that would
/// have blurred a step: for a step of contrast C blurred with sigma the steepest slope is
/// C / (sigma sqrt(2 pi)).

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/image.h"

namespace ringhook {

/// A phrase for a table, empty if grey values leave nothing to be said: no contrast at all, too
/// dark, overexposed.
std::string exposureFault(const GrayImage& image);

/// Blur [px], as the sigma above, of the edge that crosses the segment from a to b [px] in its
/// middle; infinity where nothing crosses it.
double edgeBlur(const GrayImage& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// Blur [px] of the picture's strongest edges, whatever they belong to: their median; 0 where there
/// are too few edges to tell.
double strongestEdgesBlur(const GrayImage& image);

}  // namespace ringhook
