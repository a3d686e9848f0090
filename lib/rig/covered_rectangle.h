#pragma once

/// \file
/// The largest axis-aligned rectangle inside the image of a window: what a raw window yields after
/// rectification. The window's border, taken through the lens and the rotation, is a slightly
/// curved quadrangle. Rows [a, b] of a convex region allow the columns common to rows a and b, so
/// the area is a function of two numbers, searched coarse to fine; exactness comes last, by
/// shrinking until every border pixel is covered.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "core/image.h"

namespace ringhook {

/// \param polygon once around the region [px].
/// \param bounds the result lies in it [px].
/// \param covered tells of a pixel (x, y) in bounds whether it can be had.
/// \return all its border pixels are covered; empty if no rectangle was found.
Window coveredRectangle(const std::vector<Eigen::Vector2d>& polygon, const Window& bounds,
                        const std::function<bool(int, int)>& covered);

}  // namespace ringhook
