#pragma once

/// \file
/// ChArUco boards: a chessboard whose white squares carry ArUco markers, so that a part of it
/// suffices (Garrido-Jurado et al., "Automatic generation and detection of highly reliable fiducial
/// markers under occlusion", Pattern Recognition 47, 2014). The markers only say which corner is
/// which: each chessboard corner starts where the nearest markers' plane predicts it and is then
/// measured like any other (corner_refinement.h).
/// Two layouts are in use, which differ for an even number of rows: until OpenCV 4.6 the lower left
/// square is black, from 4.7 on the upper left one. Both are tried; the markers tell.

#include <string>

#include "calib/solve/board.h"

namespace ringhook {

/// Number of markers in one of OpenCV's predefined dictionaries; 0 for a name that is none.
int charucoDictionarySize(const std::string& name);

/// The inner corners whose two markers are both seen.
/// Refuses, with a reason, fewer than two rows and two columns of them.
Outcome<BoardSighting> findCharuco(const GrayImage& image, const Board& board);

}  // namespace ringhook
