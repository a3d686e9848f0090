#pragma once

/// \file
/// A chessboard found in an image: OpenCV's search for the grid, an order that does not depend on
/// how the board is held, corners measured as corner_refinement.h says.

#include "calib/solve/board.h"
#include "calib/solve/corner_refinement.h"

namespace ringhook {

/// Finds all inner corners. The order is right-handed as one looks at the print (z_t into the
/// board), and where the print allows it (columns + rows odd) the first square, between the first
/// two rows and columns, is a dark one, so that the order does not depend on the camera.
/// Refuses, with a reason, an image without the whole board or with squares too small to be
/// measured.
Outcome<BoardSighting> findChessboard(const GrayImage& image, const Board& board);

/// Inner corners, "9x6", of whatever chessboard is seen; empty if none is. Slow: for explaining a
/// refusal, not for live images.
std::string seenChessboard(const GrayImage& image);

/// A grid of columns x rows points in right-handed order: rows are reversed where that is needed.
void makeRightHanded(Corners& grid, int columns, int rows);

/// Half side of the refinement window [px] of every corner of a whole grid; `rough` to one or two
/// pixels.
std::vector<int> refinementWindows(const Corners& rough, const Board& board);

}  // namespace ringhook
