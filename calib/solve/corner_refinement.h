#pragma once

/// \file
/// Corners of black and white squares to a fraction of a pixel, in two steps that look at the same
/// window:
///   1. Foerstner's corner (OpenCV's cornerSubPix): every gradient belongs to one of the two edges
///      through the corner q, so that g(p) . (q - p) = 0 for all p; from a start off by pixels;
///   2. the grey of every pixel explained (saddle_fit.h), which leaves a third of the first step's
///      error. Where no saddle is seen, the first step's corner stays.
/// The window must therefore see these two edges and nothing else, and it must be as large as that
/// allows, because noise falls with its size. A square window of half side w reaches
/// w * sqrt(2) in the direction of its corners. What it must not reach lies, in squares:
///   chessboard  half a square away: the rim, where printed boards are often cut; the next grid
///               line is a whole one away;
///   ChArUco     (1 - marker / square) / 2 away in x and in y: the marker's black border, whose
///               corner lies on the diagonal of the white squares.
/// Hence w = share * d, with d the smallest perpendicular distance from this corner to its
/// neighbouring grid lines in this image, and share = 0.3 for the chessboard (0.3 * sqrt(2) = 0.42
/// squares, which leaves the rest of the half square to blur and to the error of the start) and
/// 0.85 of the gap for ChArUco where that is less. Each corner has a window of its own, since
/// perspective makes squares differ.

#include <Eigen/Core>
#include <vector>

#include "core/image.h"

namespace ringhook {

/// Corners of a grid: row * columns + column, where they are known [px].
using Corners = std::vector<Eigen::Vector2d>;

/// Share of the grid spacing that half the window's side may take, by the law above.
/// \param gap from a corner to the nearest foreign edge, in squares.
double windowShare(double gap);

/// Half side [px] of the window for a grid spacing [px]: whole, at least 2.
int windowFor(double spacing_px, double share);

/// Smallest perpendicular distance [px] from each corner of a whole grid to the grid lines through
/// its neighbours. \param grid columns * rows corners, to one or two pixels.
std::vector<double> gridSpacings(const Corners& grid, int columns, int rows);

/// Moves each corner by both steps. \param windows half sides [px].
void refineCorners(const GrayImage& image, const std::vector<int>& windows, Corners& corners);

}  // namespace ringhook
