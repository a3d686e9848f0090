#pragma once

/// \file
/// Grids of AprilTags, as Kalibr prints them (aprilgrid; Maye, Furgale, Siegwart, "Self-supervised
/// calibration for robotic systems", IV 2013) or row by row from the top. The corners are those
/// that the detector fits to the sides of each black square; they are not refined further, which
/// would make them worse (tracking/tag_detector.h). Which corner is which follows from where the
/// tags lie: the plane through the tags' centres predicts the corners, so that sheets counted
/// upwards or downwards and tags printed in any turn are read alike.

#include "calib/solve/board.h"

namespace ringhook {

/// All corners of all tags seen. Refuses, with a reason, fewer than four tags in two rows and two
/// columns, and tags that do not lie as the board says.
Outcome<BoardSighting> findTagBoard(const GrayImage& image, const Board& board);

}  // namespace ringhook
